//! [`Climb`]: the search itself.

use std::fmt;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use wasmouse_engine::Limits;

use super::candidate::Candidate;
use super::generators::GENERATORS;
use super::measure::{Cost, Threads, cost, estimate};

/// Below this the time says nothing, in estimated seconds.
const ESTIMATE_MIN: f64 = 0.05;

/// What a file may be estimated to take in the short test, in seconds.
const SHORT_ESTIMATE_MAX: f64 = 0.5;

/// What a file that is changed again and again may be estimated to take in a long run, in
/// seconds.
const LONG_ESTIMATE_MAX: f64 = 2.0;

/// Changes of each generator before the worst is copied.
const CHANGES: u32 = 6;

/// Files of two generators that are kept.
const PAIRS: usize = 12;

/// Files that are copied up to the limits in each round: of one generator, and of two.
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

/// The file that took the longest of a search.
#[derive(Clone, Debug, Default)]
pub struct Worst {
    /// The generator and its parameters.
    pub file: String,
    /// Estimated time, in seconds.
    pub estimate: f64,
    /// Processor time, in seconds.
    pub cpu_seconds: f64,
    /// The most memory that any file took, in MiB.
    pub memory_mib: u64,
    /// The file with the most time for its estimate, and how much that is.
    pub underestimated: (String, f64),
    /// Files that were compiled.
    pub files: u32,
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} files; the worst, {}: {:.2} s of {:.2} s estimated; at most {} MiB; \
             {:.2} of the estimate: {}",
            self.files,
            self.file,
            self.cpu_seconds,
            self.estimate,
            self.memory_mib,
            self.underestimated.1,
            self.underestimated.0,
        )
    }
}

impl Worst {
    fn note(&mut self, file: &str, cost: &Cost) {
        self.files += 1;
        self.memory_mib = self.memory_mib.max(cost.memory_mib);
        if cost.cpu_seconds > self.cpu_seconds {
            file.clone_into(&mut self.file);
            self.cpu_seconds = cost.cpu_seconds;
            self.estimate = cost.estimate;
        }
        let ratio = cost.cpu_seconds / cost.estimate;
        if cost.estimate >= ESTIMATE_MIN && ratio > self.underestimated.1 {
            self.underestimated = (file.to_owned(), ratio);
        }
    }
}

/// What took the longest for its estimate.
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
        let mut best: Vec<Best> = GENERATORS
            .into_iter()
            .map(|generator| Best::new(Candidate::of(generator)))
            .collect();
        let mut pairs: Vec<Best> = Vec::new();
        loop {
            for best in &mut best {
                self.change(best, &mut worst);
                self.report(&worst);
            }
            Best::sort(&mut best);
            self.pair(&best, &mut pairs);
            for pair in &mut pairs {
                self.change(pair, &mut worst);
                self.report(&worst);
            }
            Best::sort(&mut pairs);
            let Some(duration) = self.duration else {
                return worst;
            };
            for best in best.iter().take(COPIED).chain(pairs.iter().take(COPIED)) {
                self.fill(&best.candidate, &mut worst);
                self.report(&worst);
            }
            if begin.elapsed() >= duration {
                return worst;
            }
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
    fn change(&mut self, best: &mut Best, worst: &mut Worst) {
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
            if estimate > self.estimate_max {
                continue;
            }
            let Some(cost) = cost(&file, estimate, &self.limits, Threads::One) else {
                continue;
            };
            worst.note(&candidate.to_string(), &cost);
            let ratio = cost.cpu_seconds / estimate.max(ESTIMATE_MIN);
            if ratio > best.ratio {
                *best = Best { candidate, ratio };
            }
        }
    }

    /// Compiles as much as is admitted of a file, on as many threads as the program does: the functions
    /// of its last module again and again, or else copies of that module.
    fn fill(&self, candidate: &Candidate, worst: &mut Worst) {
        let estimate = |candidate: &Candidate| Some(self.admitted(candidate)?.1);
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
                    worst.note(&candidate.to_string(), &cost);
                }
                return;
            }
            number = number * 19 / 20;
        }
    }

    /// A file and its estimate in seconds, if it can be made and is admitted.
    fn admitted(&self, candidate: &Candidate) -> Option<(Vec<u8>, f64)> {
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
