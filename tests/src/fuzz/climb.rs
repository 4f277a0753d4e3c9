//! [`Climb`]: the search itself.

use std::fmt;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use wasmouse_engine::Limits;
use wasmtime::Engine;

use super::generators::{GENERATORS, Generator};
use super::measure::{Cost, copies, cost, engine, estimate, repeated};

/// Below this the time says nothing, in estimated seconds.
const ESTIMATE_MIN: f64 = 0.05;

/// What a file may be estimated to take in the short test, in seconds.
const SHORT_ESTIMATE_MAX: f64 = 0.5;

/// What a file that is changed again and again may be estimated to take in a long run, in
/// seconds.
const LONG_ESTIMATE_MAX: f64 = 2.0;

/// Changes of each generator before the worst is copied.
const CHANGES: u32 = 6;

/// A search for files that take long to compile.
#[derive(Debug)]
pub struct Climb {
    limits: Limits,
    engine: Engine,
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

/// What a generator made that took the longest for its estimate.
struct Best {
    generator: Generator,
    parameters: Vec<u32>,
    ratio: f64,
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
        let limits = Limits::default();
        Self {
            engine: engine(&limits),
            limits,
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
            .map(|generator| Best {
                generator,
                parameters: generator.start.to_vec(),
                ratio: 0.0,
            })
            .collect();
        loop {
            for best in &mut best {
                self.change(best, &mut worst);
                if self.duration.is_some() {
                    println!("{worst}");
                }
            }
            let Some(duration) = self.duration else {
                return worst;
            };
            best.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
            for best in best.iter().take(3) {
                self.fill(best, &mut worst);
            }
            println!("{worst}");
            if begin.elapsed() >= duration {
                return worst;
            }
        }
    }

    /// Changes the parameters of a generator a few times, and keeps what is worse.
    fn change(&mut self, best: &mut Best, worst: &mut Worst) {
        for change in 0..self.changes {
            let parameters = match (change, best.ratio > 0.0) {
                (0, false) => best.parameters.clone(),
                _ => self.changed(&best.parameters),
            };
            let file = (best.generator.make)(&parameters);
            let Some(estimate) = estimate(&file, &self.limits) else {
                continue;
            };
            if estimate > self.estimate_max {
                continue;
            }
            let Some(cost) = cost(&file, estimate, &self.engine) else {
                continue;
            };
            let name = format!("{}{parameters:?}", best.generator.name);
            worst.note(&name, &cost);
            let ratio = cost.cpu_seconds / estimate.max(ESTIMATE_MIN);
            if ratio > best.ratio {
                best.ratio = ratio;
                best.parameters = parameters;
            }
        }
    }

    /// Compiles a file with as much as is admitted of what a generator made: its functions again
    /// and again, or else copies of its module.
    fn fill(&self, best: &Best, worst: &mut Worst) {
        let module = (best.generator.make)(&best.parameters);
        let is_module = module.get(4) == Some(&1);
        let Some(one) = estimate(&module, &self.limits).filter(|_| is_module) else {
            return;
        };
        let all = f64::from(self.limits.admission.work_ms_max) / 1000.0;
        let most = self.limits.admission.functions_max;
        let is_within = |&number: &u32| f64::from(number) * one <= all;
        let mut number = (1..=most).rev().find(is_within).unwrap_or(1);
        while number > 0 {
            let modules = number.min(self.limits.admission.modules_max);
            let functions = repeated(&module, number).map(|module| copies(&module, 1));
            let files = [
                (functions, format!("functions {number} times")),
                (Some(copies(&module, modules)), format!("{modules} modules")),
            ];
            for (file, what) in files {
                let Some((file, estimate)) = file.and_then(|file| {
                    let estimate = estimate(&file, &self.limits)?;
                    Some((file, estimate))
                }) else {
                    continue;
                };
                if let Some(cost) = cost(&file, estimate, &self.engine) {
                    let Best {
                        generator,
                        parameters,
                        ..
                    } = best;
                    worst.note(&format!("{}{parameters:?}, {what}", generator.name), &cost);
                }
                return;
            }
            number = number * 19 / 20;
        }
    }

    /// The same parameters with one of them up to four times as large or as small.
    fn changed(&mut self, parameters: &[u32]) -> Vec<u32> {
        let mut parameters = parameters.to_vec();
        let length = u32::try_from(parameters.len()).unwrap_or(1);
        let at = usize::try_from(self.next() % length).unwrap_or(0);
        let eighths = 2 + self.next() % 31;
        let value = u64::from(parameters[at]) * u64::from(eighths) / 8;
        parameters[at] = u32::try_from(value).unwrap_or(u32::MAX).max(1);
        parameters
    }

    /// A random number (`xorshift64*`).
    const fn next(&mut self) -> u32 {
        self.random ^= self.random >> 12;
        self.random ^= self.random << 25;
        self.random ^= self.random >> 27;
        (self.random.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 32) as u32
    }
}
