//! The hostile corpus: what a broken or malicious robot may try, each as a case with
//! the verdict or refusal that it has to get, and ceilings of time and memory.
//!
//! The cases are data, one file for each chapter, generated when they are needed.
//! [`Bench`] plays them through the `wasmouse` binary and judges; the program `corpus`
//! (`cargo xtask corpus`) prints the table, or writes the files for other hosts.
//! The numbers of the cases are those of the list that the corpus was written after.

mod bench;
mod case;
mod costs;
mod execution;
mod measure;
mod memory;

pub use bench::{Bench, Judgement};
pub use case::{Case, MEGABYTES_MAX, Mode};

/// All cases, chapter by chapter.
pub fn cases() -> Vec<Case> {
    [execution::cases(), costs::cases(), memory::cases()]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

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
