//! [`PairedNumbers`]: the serialised form of a comparison of two robots, in every document alike.

use serde::Serialize;

use crate::contest::{Mean, PairedComparison};

/// The fields of a [`PairedComparison`].
#[derive(Serialize)]
pub(super) struct PairedNumbers {
    pub(super) verdict: &'static str,
    pub(super) mazes: u64,
    pub(super) wins: u64,
    pub(super) ties: u64,
    pub(super) losses: u64,
    pub(super) difference_thousandths: Option<i64>,
    pub(super) interval_thousandths: Option<[i64; 2]>,
    pub(super) standard_error_thousandths: Option<u64>,
    pub(super) mazes_to_decide: Option<u64>,
}

impl PairedNumbers {
    /// The fields of that comparison.
    pub(super) fn new(compared: &PairedComparison) -> Self {
        Self {
            verdict: compared.verdict.name(),
            mazes: compared.mazes,
            wins: compared.wins,
            ties: compared.ties,
            losses: compared.losses,
            difference_thousandths: compared.difference.map(Mean::thousandths),
            interval_thousandths: compared.interval_thousandths,
            standard_error_thousandths: compared.standard_error_thousandths,
            mazes_to_decide: compared.mazes_to_decide,
        }
    }
}
