//! [`Climb`]: the search itself.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use wasmouse_engine::Limits;

use super::candidate::Candidate;
use super::generators::GENERATORS;
use super::measure::{Cost, Estimate, Threads, cost, estimate};
use super::worst::Worst;

/// What a file may be estimated to take in the short test, in seconds.
const SHORT_ESTIMATE_MAX: f64 = 0.5;

/// What a file that is changed again and again may be estimated to take in a long run, in
/// seconds.
const LONG_ESTIMATE_MAX: f64 = 2.0;

/// Times that for memory: functions that take much of it take long.
const MEMORY_ESTIMATE_TIMES: f64 = 4.0;

/// Estimates below these say nothing: seconds.
const CPU_SECONDS_MIN: f64 = 0.05;

/// MiB.
const MEMORY_MIB_MIN: f64 = 50.0;

/// Changes of each generator before the worst is copied.
const CHANGES: u32 = 6;

/// Files of two generators that are kept for each goal.
const PAIRS: usize = 12;

/// Files that are copied up to the limits in each round, for each goal: of one generator, and of two.
const COPIED: usize = 3;

/// A search for files that take long to compile.
#[derive(Debug)]
pub struct Climb {
    limits: Limits,
    random: u64,
    estimate_max: f64,
    changes: u32,
    duration: Option<Duration>,
}

/// What the search is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    Time,
    Memory,
}

impl Goal {
    const ALL: [Self; 2] = [Self::Time, Self::Memory];

    /// How much of its estimate a file takes. Of small ones, nothing can be said.
    fn ratio(self, cost: Cost, estimate: Estimate) -> f64 {
        match self {
            Self::Time => cost.cpu_seconds / estimate.cpu_seconds.max(CPU_SECONDS_MIN),
            Self::Memory => {
                let grown_mib = u32::try_from(cost.grown_mib).map_or(f64::INFINITY, f64::from);
                grown_mib / estimate.memory_mib.max(MEMORY_MIB_MIN)
            }
        }
    }
}

/// What took the most of one thing for its estimate.
struct Best {
    candidate: Candidate,
    ratio: f64,
}

impl Best {
    const fn new(candidate: Candidate) -> Self {
        Self {
            candidate,
            ratio: 0.0,
        }
    }

    /// The worst first.
    fn sort(all: &mut [Self]) {
        all.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    }
}

/// The search for one goal.
struct Search {
    goal: Goal,
    /// One file of each generator.
    best: Vec<Best>,
    pairs: Vec<Best>,
}

impl Search {
    fn new(goal: Goal) -> Self {
        let candidates = GENERATORS.into_iter().map(Candidate::of);
        Self {
            goal,
            best: candidates.map(Best::new).collect(),
            pairs: Vec::new(),
        }
    }
}

impl Climb {
    /// One that takes a few seconds and is always the same.
    pub fn short() -> Self {
        Self::new(1, SHORT_ESTIMATE_MAX, 2, None)
    }

    /// One that takes that long, and is another one each time.
    pub fn long(duration: Duration) -> Self {
        let since_epoch = SystemTime::now().duration_since(UNIX_EPOCH);
        let seed = since_epoch.unwrap_or_default().as_secs();
        Self::new(seed, LONG_ESTIMATE_MAX, CHANGES, Some(duration))
    }

    fn new(random: u64, estimate_max: f64, changes: u32, duration: Option<Duration>) -> Self {
        Self {
            limits: Limits::default(),
            random,
            estimate_max,
            changes,
            duration,
        }
    }

    /// Searches.
    ///
    /// # Panics
    ///
    /// When the engine refuses to load what was admitted.
    pub fn run(&mut self) -> Worst {
        let begin = Instant::now();
        let mut worst = Worst::default();
        let mut searches = Goal::ALL.map(Search::new);
        loop {
            for search in &mut searches {
                self.round(search, &mut worst);
            }
            if self
                .duration
                .is_none_or(|duration| begin.elapsed() >= duration)
            {
                return worst;
            }
        }
    }

    fn round(&mut self, search: &mut Search, worst: &mut Worst) {
        let Search { goal, best, pairs } = search;
        for best in &mut *best {
            self.change(*goal, best, worst);
            self.report(worst);
        }
        Best::sort(best);
        self.pair(best, pairs);
        for pair in &mut *pairs {
            self.change(*goal, pair, worst);
            self.report(worst);
        }
        Best::sort(pairs);
        if self.duration.is_none() {
            return;
        }
        for best in best.iter().take(COPIED).chain(pairs.iter().take(COPIED)) {
            self.fill(&best.candidate, worst);
            self.report(worst);
        }
    }

    fn report(&self, worst: &Worst) {
        if self.duration.is_some() {
            println!("{worst}");
        }
    }

    /// Puts files of two generators in the place of those pairs that take the least for their
    /// estimate: what a compiler keeps of one function may make others take longer.
    fn pair(&mut self, best: &[Best], pairs: &mut Vec<Best>) {
        pairs.truncate(PAIRS / 2);
        // Not every pair is one of modules.
        for _ in 0..PAIRS {
            let [before, after] = [(); 2].map(|()| {
                let at = usize::try_from(self.next()).unwrap_or(0) % best.len();
                &best[at].candidate
            });
            if pairs.len() < PAIRS
                && let Some(pair) = before.followed_by(after)
            {
                pairs.push(Best::new(pair));
            }
        }
    }

    /// Changes the parameters of a file a few times, and keeps what is worse.
    fn change(&mut self, goal: Goal, best: &mut Best, worst: &mut Worst) {
        let estimate_max = match goal {
            Goal::Time => self.estimate_max,
            Goal::Memory => self.estimate_max * MEMORY_ESTIMATE_TIMES,
        };
        for change in 0..self.changes {
            let mut candidate = best.candidate.clone();
            if change > 0 || best.ratio > 0.0 {
                let at = self.next();
                let eighths = 2 + self.next() % 31;
                candidate.change(at, eighths);
            }
            let Some((file, estimate)) = self.admitted(&candidate) else {
                continue;
            };
            if estimate.cpu_seconds > estimate_max {
                continue;
            }
            let Some(cost) = cost(&file, estimate, &self.limits, Threads::One) else {
                continue;
            };
            worst.note(&candidate.to_string(), cost, estimate);
            let ratio = goal.ratio(cost, estimate);
            if ratio > best.ratio {
                *best = Best { candidate, ratio };
            }
        }
    }

    /// Compiles as much as is admitted of a file, on as many threads as the program does: the functions
    /// of its last module again and again, or else copies of that module.
    fn fill(&self, candidate: &Candidate, worst: &mut Worst) {
        let estimate = |candidate: &Candidate| Some(self.admitted(candidate)?.1.cpu_seconds);
        let once = estimate(&candidate.repeated(1));
        let twice = estimate(&candidate.repeated(2)).or_else(|| estimate(&candidate.copied(2)));
        let (Some(once), Some(twice)) = (once, twice) else {
            return;
        };
        let all = f64::from(self.limits.admission.work_ms_max) / 1000.0;
        let most = self.limits.admission.functions_max;
        let is_within =
            |&number: &u32| once + f64::from(number - 1) * (twice - once).max(1e-6) <= all;
        let mut number = (1..=most).rev().find(is_within).unwrap_or(1);
        while number > 0 {
            let modules = number.min(self.limits.admission.modules_max);
            let files = [candidate.repeated(number), candidate.copied(modules)];
            for candidate in files {
                let Some((file, estimate)) = self.admitted(&candidate) else {
                    continue;
                };
                if let Some(cost) = cost(&file, estimate, &self.limits, Threads::All) {
                    worst.note(&candidate.to_string(), cost, estimate);
                }
                return;
            }
            number = number * 19 / 20;
        }
    }

    /// A file and its estimate, if it can be made and is admitted.
    fn admitted(&self, candidate: &Candidate) -> Option<(Vec<u8>, Estimate)> {
        let file = candidate.file()?;
        let estimate = estimate(&file, &self.limits)?;
        Some((file, estimate))
    }

    /// A random number (`xorshift64*`).
    const fn next(&mut self) -> u32 {
        self.random ^= self.random >> 12;
        self.random ^= self.random << 25;
        self.random ^= self.random >> 27;
        (self.random.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 32) as u32
    }
}
