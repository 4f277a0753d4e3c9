//! [`Fuzzer`]: feeds a target with mutated inputs, and keeps what led to something new.
//!
//! What is new is told by the target's own words for what came of an input: with digits
//! left out, error messages are a coarse map of the code that was reached.

use std::any::Any;
use std::cell::RefCell;
use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::panic::{self, AssertUnwindSafe};
use std::time::{Duration, Instant};

use super::mutate::{Random, mutate};
use super::{Run, Target};

/// Inputs that are mutated on, at most; older ones make room.
const CORPUS_MAX: usize = 2048;

/// Behaviours that are told apart, at most: a target has hundreds, and more are words of
/// the inputs themselves.
const BEHAVIOURS_MAX: usize = 1 << 16;

/// Tries to make an input that fails smaller.
const SMALLER_TRIES: u32 = 2000;

/// An input that made a target panic.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What the panic said, and where.
    pub panic: String,
    /// The input, made smaller.
    pub input: Vec<u8>,
}

/// What came of a run.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Inputs tried.
    pub inputs: u64,
    /// Different behaviours seen.
    pub behaviours: usize,
    /// What went wrong, once for each place.
    pub findings: Vec<Finding>,
    /// The time that the slowest input took.
    pub slowest: Duration,
    /// Everything that was seen, as one number: the same for the same seed.
    pub digest: u64,
}

/// A target in a run.
pub struct Fuzzer {
    target: Target,
    run: Run,
    random: Random,
    corpus: Vec<Vec<u8>>,
    seen: HashSet<u64>,
    places: HashSet<String>,
    summary: Summary,
    /// Real inputs that have not been tried yet.
    fresh: Vec<Vec<u8>>,
}

impl Fuzzer {
    /// A run with the random numbers of a seed.
    pub fn new(target: Target, seed: u64) -> Self {
        let mut fresh = (target.seeds)();
        fresh.reverse();
        Self {
            run: (target.make)(),
            target,
            random: Random::new(seed),
            corpus: Vec::new(),
            seen: HashSet::new(),
            places: HashSet::new(),
            summary: Summary::default(),
            fresh,
        }
    }

    /// What came of it so far.
    pub const fn summary(&self) -> &Summary {
        &self.summary
    }

    /// Has that be the next input.
    pub fn add(&mut self, input: Vec<u8>) {
        self.fresh.push(input);
    }

    /// The next input, which [`Fuzzer::feed`] is to be called with.
    pub fn next_input(&mut self) -> Vec<u8> {
        if let Some(input) = self.fresh.pop() {
            return input;
        }
        let parent = self.random.one_of(&self.corpus).cloned();
        let mut input = parent.unwrap_or_default();
        let empty = Vec::new();
        let other = self.random.one_of(&self.corpus).unwrap_or(&empty);
        let Target {
            words, bytes_max, ..
        } = self.target;
        mutate(&mut input, other, words, bytes_max, &mut self.random);
        input
    }

    /// Tries an input; returns what is wrong with it, the first time.
    pub fn feed(&mut self, input: Vec<u8>) -> Option<Finding> {
        let begin = Instant::now();
        let outcome = attempt(&mut self.run, &input);
        self.summary.slowest = self.summary.slowest.max(begin.elapsed());
        self.summary.inputs += 1;
        match outcome {
            Ok(behaviour) => {
                let hash = hash_of(&behaviour);
                self.summary.digest = self.summary.digest.rotate_left(5) ^ hash;
                if self.seen.len() < BEHAVIOURS_MAX && self.seen.insert(hash) {
                    self.summary.behaviours += 1;
                    self.keep(input);
                }
                None
            }
            Err(panic) => {
                if !self.places.insert(without_digits(&panic)) {
                    return None;
                }
                let finding = Finding {
                    input: self.smaller(input, &panic),
                    panic,
                };
                // A panic may leave the target half-done.
                self.run = (self.target.make)();
                self.summary.findings.push(finding.clone());
                Some(finding)
            }
        }
    }

    fn keep(&mut self, input: Vec<u8>) {
        if self.corpus.len() < CORPUS_MAX {
            self.corpus.push(input);
        } else {
            let at = self.random.below(CORPUS_MAX);
            self.corpus[at] = input;
        }
    }

    /// Takes pieces out of an input for as long as it fails in the same way.
    fn smaller(&mut self, mut input: Vec<u8>, panic: &str) -> Vec<u8> {
        let expected = without_digits(panic);
        let mut piece = input.len().div_ceil(2);
        let mut tries = 0;
        while piece > 0 && tries < SMALLER_TRIES {
            let mut at = 0;
            while at < input.len() && tries < SMALLER_TRIES {
                let end = input.len().min(at + piece);
                let without = [&input[..at], &input[end..]].concat();
                tries += 1;
                match attempt(&mut self.run, &without) {
                    Err(panic) if without_digits(&panic) == expected => input = without,
                    _ => at = end,
                }
            }
            piece /= 2;
        }
        input
    }
}

thread_local! {
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Has panics kept for the fuzzer instead of printed, for the whole process.
pub fn quiet_panics() {
    panic::set_hook(Box::new(|info| {
        PANIC.with_borrow_mut(|panic| *panic = info.to_string());
    }));
}

/// What the target says, or what its panic said.
fn attempt(run: &mut Run, input: &[u8]) -> Result<String, String> {
    PANIC.with_borrow_mut(String::clear);
    panic::catch_unwind(AssertUnwindSafe(|| run(input))).map_err(|payload| {
        let told = PANIC.with_borrow(String::clone);
        if told.is_empty() {
            words_of(payload.as_ref())
        } else {
            told
        }
    })
}

fn words_of(payload: &(dyn Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without words".into())
}

/// The text with every number as `0`, and quoted pieces left out: they are the input's.
fn without_digits(text: &str) -> String {
    let mut short = String::new();
    let (mut in_number, mut quoted) = (false, false);
    for character in text.chars() {
        if character == '`' {
            quoted = !quoted;
        }
        if quoted {
            continue;
        }
        let is_digit = character.is_ascii_digit();
        if !is_digit {
            short.push(character);
        } else if !in_number {
            short.push('0');
        }
        in_number = is_digit;
    }
    short
}

/// The words for a behaviour as a number. Only the first count: what comes behind is the
/// input's where it has backquotes of its own, and every input would be new.
fn hash_of(behaviour: &str) -> u64 {
    const CHARS_MAX: usize = 72;
    let words: String = without_digits(behaviour).chars().take(CHARS_MAX).collect();
    let mut hasher = DefaultHasher::new();
    words.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Panics on inputs that have an `x` behind an `a`.
    const TARGET: Target = Target {
        name: "example",
        about: "an example",
        seeds: || vec![b"hello a and y".to_vec()],
        words: &[],
        bytes_max: 64,
        make: || {
            Box::new(|bytes| {
                let a = bytes.iter().position(|byte| *byte == b'a');
                let x = bytes.iter().position(|byte| *byte == b'x');
                assert!(!(a.is_some() && x > a), "found `{bytes:?}`");
                format!("{} {}", a.is_some(), x.is_some())
            })
        },
        short: 0,
        takes_modules: false,
    };

    fn run(seed: u64) -> Summary {
        let mut fuzzer = Fuzzer::new(TARGET, seed);
        for _ in 0..20_000 {
            let input = fuzzer.next_input();
            fuzzer.feed(input);
        }
        fuzzer.summary().clone()
    }

    #[test]
    fn a_panic_is_found_once_and_made_small() {
        let summary = run(1);
        let [finding] = &summary.findings[..] else {
            panic!("{:?}", summary.findings);
        };
        assert_eq!(finding.input, b"ax");
    }

    #[test]
    fn a_run_is_the_same_each_time() {
        assert_eq!(run(3).digest, run(3).digest);
        assert_ne!(run(3).digest, run(4).digest);
    }

    #[test]
    fn numbers_and_quotes_do_not_count() {
        assert_eq!(
            without_digits("line 12, column 3: `a 1` b"),
            "line 0, column 0: ` b"
        );
    }
}
