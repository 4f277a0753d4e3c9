//! The hostile corpus: what a broken or malicious robot may try, each as a case with
//! its verdict or rejection, and ceilings of time and memory.
//!
//! The cases are data, one file for each chapter, generated when they are needed.
//! [`Bench`] plays them through the `wasmouse` binary and judges; the program `corpus`
//! (`cargo xtask corpus`) prints the table, or writes the files for other hosts.
//! The numbers of the cases are those of the list that the corpus was written after.

mod abi;
mod bench;
mod binary;
mod case;
mod compile;
mod costs;
mod execution;
mod files;
mod game;
mod inner;
mod measure;
mod memory;
mod names;
mod shape;
mod types;

pub use bench::{Bench, Judgement};
pub use case::{Case, MEGABYTES_MAX, Mode};

/// All cases, chapter by chapter.
pub fn cases() -> Vec<Case> {
    [
        execution::cases(),
        costs::cases(),
        memory::cases(),
        abi::cases(),
        inner::cases(),
        files::cases(),
        shape::cases(),
        names::cases(),
        types::cases(),
        compile::cases(),
        game::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::panic::AssertUnwindSafe;

    use super::*;

    #[test]
    fn every_case_has_files() {
        let _alone = crate::MUCH_MEMORY.lock();
        let failed: Vec<String> = cases()
            .into_iter()
            .filter(|case| {
                let files = std::panic::catch_unwind(AssertUnwindSafe(|| case.files()));
                files.map_or(true, |files| files.is_empty())
            })
            .map(|case| case.name)
            .collect();
        assert_eq!(failed, [""; 0]);
    }

    #[test]
    fn every_number_has_a_case() {
        // From 83 on they are about the host's surroundings, and in `tests/it/faults.rs`
        // and `tests/it/workers.rs`.
        let numbers: BTreeSet<u8> = cases()
            .iter()
            .flat_map(|case| case.numbers)
            .copied()
            .collect();
        assert_eq!(numbers, (1..=82).collect());
    }

    #[test]
    fn names_are_unique_and_fit_file_names() {
        let mut names = BTreeSet::new();
        for case in cases() {
            let legal =
                |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
            assert!(case.name.bytes().all(legal), "{}", case.name);
            assert!(
                names.insert(case.name.clone()),
                "{} is there twice",
                case.name
            );
        }
    }
}
