//! Fuzzing: what any bytes may do to the parts of wasmouse that read a stranger's.
//!
//! A [`Target`] is one function of any bytes that may not panic, hang or take memory, with
//! real inputs to start from. [`Fuzzer`] mutates those; inputs that lead to new behaviour
//! are mutated on. The same targets run shortly and deterministically in the tests, and
//! for long by the program `fuzz` (`cargo xtask fuzz`).

mod admission;
mod differential;
mod fuzzer;
mod matches;
mod mazes;
mod mutate;
mod protocol;
mod results;
mod smith;
mod specifications;
mod variants;

pub use differential::Bench;
pub use fuzzer::{Finding, Fuzzer, Summary, quiet_panics};
pub use smith::Smith;

/// Something to fuzz.
#[derive(Clone, Copy)]
pub struct Target {
    /// The name on the command line and of folders.
    pub name: &'static str,
    /// What it reads, in a few words.
    pub about: &'static str,
    /// Real inputs.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Pieces that inputs are made of.
    pub words: &'static [&'static [u8]],
    /// The longest input, in bytes.
    pub bytes_max: usize,
    /// Makes the function that is called with each input and says in a few words
    /// what came of it.
    pub make: fn() -> Run,
    /// Inputs in the short run of the tests.
    pub short: u64,
    /// Whether an input is a byte and a module, so that modules of wasm-smith are inputs.
    pub takes_modules: bool,
}

/// What is called with each input.
pub type Run = Box<dyn FnMut(&[u8]) -> String>;

/// Robots around random modules, those that are a part of the repository: most are
/// refused or fail, some drive.
pub fn strangers() -> Vec<Vec<u8>> {
    let inputs = matches::seeds();
    let files = inputs.iter().filter_map(|it| matches::robot_file(it));
    files.collect()
}

/// All targets.
pub fn targets() -> Vec<Target> {
    let mut targets = vec![
        mazes::TARGET,
        specifications::TARGET,
        results::TARGET,
        admission::TARGET,
    ];
    targets.extend(protocol::TARGETS);
    targets.extend([matches::TARGET, differential::TARGET]);
    targets
}
