//! Runs a fuzz target as an ordinary test.
//!
//! A fuzz target is a function of arbitrary bytes that panics when a property does not hold.
//! The same functions are libFuzzer targets (`tests/fuzz`). Here proptest calls them with
//! seeds (valid inputs) and mutations of seeds: always the same ones under `cargo test`, new
//! ones for as long as [`SECONDS_VARIABLE`] says. A failing input is shrunk and printed as a
//! byte string literal.

mod mutation;

use std::cell::Cell;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use std::{env, fmt, fs, thread};

use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};

/// Environment variable: run each target for this many seconds with new random numbers,
/// instead of a fixed number of cases.
pub const SECONDS_VARIABLE: &str = "WASMOUSE_FUZZ_SECONDS";

/// Environment variable: a folder to write the seeds of each target to, as a corpus for
/// libFuzzer. No case is run.
pub const CORPUS_VARIABLE: &str = "WASMOUSE_FUZZ_CORPUS";

/// Shrinking an input that takes long to try has to end, too.
const SHRINK_ITERATIONS_MAX: u32 = 2_000;

/// Compiled robots need more stack than a test thread has.
const STACK_BYTES: usize = 8 << 20;

/// A fuzz target with its inputs.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The name, as in `tests/fuzz`.
    pub name: &'static str,
    /// The function; returns whether it accepted the input, and so checked its properties.
    pub run: fn(&[u8]) -> bool,
    /// Valid inputs to mutate; if empty, all inputs are random bytes.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Byte strings to insert into inputs, such as keywords.
    pub words: &'static [&'static [u8]],
    /// The longest input, in bytes.
    pub bytes_max: usize,
    /// Cases under `cargo test`.
    pub cases: u32,
}

impl Target {
    /// Checks the seeds and mutations of them.
    ///
    /// # Panics
    ///
    /// With the shrunk input when the target panics. Also when fewer than one in fifty inputs
    /// is accepted, or rejected: such a target would check nothing.
    pub fn check(self) {
        let seeds = (self.seeds)();
        if let Some(folder) = env::var_os(CORPUS_VARIABLE) {
            write_corpus(&Path::new(&folder).join(self.name), &seeds);
            return;
        }
        thread::scope(|scope| {
            let checker = thread::Builder::new().stack_size(STACK_BYTES);
            let checker = checker.spawn_scoped(scope, || self.check_here(&seeds));
            let checked = checker.expect("a thread").join();
            checked.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        });
    }

    fn check_here(self, seeds: &[Vec<u8>]) {
        for seed in seeds {
            assert!((self.run)(seed), "{}: a seed is rejected", self.name);
        }
        let Some(duration) = duration() else {
            let accepted = self.check_cases(seeds, 0);
            let share = accepted * 100 / self.cases;
            assert!((2..=98).contains(&share), "{share} % of inputs accepted");
            return;
        };
        let begin = Instant::now();
        let since_epoch = SystemTime::now().duration_since(UNIX_EPOCH);
        let first = since_epoch.unwrap_or_default().as_secs() << 20;
        for random_seed in first.. {
            self.check_cases(seeds, random_seed);
            if begin.elapsed() >= duration {
                let rounds = random_seed - first + 1;
                println!("{}: {rounds} x {} cases", self.name, self.cases);
                return;
            }
        }
    }

    /// Returns how many inputs were accepted.
    fn check_cases(self, seeds: &[Vec<u8>], random_seed: u64) -> u32 {
        let mut runner = TestRunner::new(Config {
            cases: self.cases,
            rng_seed: RngSeed::Fixed(random_seed),
            failure_persistence: None,
            max_shrink_iters: SHRINK_ITERATIONS_MAX,
            ..Config::default()
        });
        let accepted = Cell::new(0);
        let inputs = mutation::inputs(seeds, self.words, self.bytes_max);
        let checked = runner.run(&inputs, |input| {
            accepted.set(accepted.get() + u32::from((self.run)(&input.0)));
            Ok::<(), TestCaseError>(())
        });
        match checked {
            Ok(()) => {}
            Err(TestError::Fail(reason, input)) => {
                panic!("{}: {reason}\nshrunk input: {input:?}", self.name)
            }
            Err(TestError::Abort(reason)) => panic!("{}: {reason}", self.name),
        }
        let accepted = accepted.get();
        println!(
            "{}: {accepted} of {} inputs accepted",
            self.name, self.cases
        );
        accepted
    }
}

/// An input; its debug form is a byte string literal.
#[derive(Clone, PartialEq, Eq)]
struct Input(Vec<u8>);

impl fmt::Debug for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "b\"{}\"", self.0.escape_ascii())
    }
}

fn duration() -> Option<Duration> {
    let seconds = env::var(SECONDS_VARIABLE).ok()?;
    let seconds = seconds.parse().expect("a number of seconds");
    Some(Duration::from_secs(seconds))
}

fn write_corpus(folder: &Path, seeds: &[Vec<u8>]) {
    fs::create_dir_all(folder).expect("a folder for the corpus");
    for (number, seed) in seeds.iter().enumerate() {
        fs::write(folder.join(format!("seed-{number}")), seed).expect("a file of the corpus");
    }
}

#[cfg(test)]
mod tests {
    use std::panic::catch_unwind;

    use super::*;

    /// Fails for inputs with an `x` after an `a`.
    const TARGET: Target = Target {
        name: "example",
        run: |bytes| {
            let a = bytes.iter().position(|byte| *byte == b'a');
            let x = bytes.iter().rposition(|byte| *byte == b'x');
            assert!(a.is_none() || x < a, "x after a");
            bytes.is_ascii()
        },
        seeds: || vec![b"one a and y".to_vec()],
        words: &[],
        bytes_max: 32,
        cases: 20_000,
    };

    #[test]
    fn a_failing_input_is_found_and_shrunk() {
        let message = |target: Target| {
            let panic = catch_unwind(|| target.check_here(&(target.seeds)()));
            let panic = panic.expect_err("there is such an input");
            panic.downcast_ref::<String>().expect("a message").clone()
        };
        let failed = message(TARGET);
        assert!(failed.contains("x after a"), "{failed}");
        let (_, input) = failed.split_once("shrunk input: b").expect("an input");
        assert!(input.len() < 24, "{failed}");
        assert_eq!(message(TARGET), failed, "the same cases each time");
    }

    #[test]
    #[should_panic(expected = "100 % of inputs accepted")]
    fn a_target_that_accepts_everything_checks_nothing() {
        let target = Target {
            run: |_| true,
            cases: 100,
            ..TARGET
        };
        target.check();
    }
}
