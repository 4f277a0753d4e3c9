//! [`Worst`]: what a search found.

use std::fmt;

use super::measure::{Cost, Estimate};

/// Below this the time says nothing, in estimated seconds.
const ESTIMATE_MIN: f64 = 0.05;

/// The files that took the most of a search, each with its generator and parameters.
#[derive(Clone, Debug, Default)]
pub struct Worst {
    /// The file that took the longest.
    pub slowest: String,
    /// Its estimated time, in seconds.
    pub estimate: f64,
    /// Its processor time, in seconds.
    pub cpu_seconds: f64,
    /// The file that took the most memory.
    pub largest: String,
    /// Its estimated memory, in MiB.
    pub estimate_mib: f64,
    /// Its memory, in MiB.
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
            "{} files; the slowest, {}: {:.2} s of {:.2} s estimated; the largest, {}: {} MiB of \
             {:.0} MiB estimated; {:.2} of the estimate: {}",
            self.files,
            self.slowest,
            self.cpu_seconds,
            self.estimate,
            self.largest,
            self.memory_mib,
            self.estimate_mib,
            self.underestimated.1,
            self.underestimated.0,
        )
    }
}

impl Worst {
    pub(super) fn note(&mut self, file: &str, cost: Cost, estimate: Estimate) {
        self.files += 1;
        if cost.memory_mib > self.memory_mib {
            file.clone_into(&mut self.largest);
            self.memory_mib = cost.memory_mib;
            self.estimate_mib = estimate.memory_mib;
        }
        if cost.cpu_seconds > self.cpu_seconds {
            file.clone_into(&mut self.slowest);
            self.cpu_seconds = cost.cpu_seconds;
            self.estimate = estimate.cpu_seconds;
        }
        let ratio = cost.cpu_seconds / estimate.cpu_seconds;
        if estimate.cpu_seconds >= ESTIMATE_MIN && ratio > self.underestimated.1 {
            self.underestimated = (file.to_owned(), ratio);
        }
    }
}
