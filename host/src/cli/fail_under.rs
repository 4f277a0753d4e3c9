//! `--fail-under`: thresholds for every robot of a contest.

use super::exit::Exit;
use super::output::message;
use crate::contest::ScoreMatrix;
use crate::contest::grade::{Target, Thresholds};
use crate::report::escape::for_terminal;
use crate::report::grade::missed;

/// The exit code of a contest that would have that one; says on stderr which thresholds are
/// missed.
///
/// A rejected robot and an error of the host keep their codes. Faults are no failure where there
/// is a threshold for them and every robot meets it.
pub fn exit(thresholds: &Thresholds, matrix: &ScoreMatrix, exit: Exit) -> Exit {
    let mut is_missed = false;
    for (index, robot) in matrix.robots.iter().enumerate() {
        for threshold in thresholds.missed(matrix, index) {
            is_missed = true;
            message!(
                "below the threshold: `{}`: {}",
                for_terminal(&robot.name),
                missed(&threshold)
            );
        }
    }
    let has_rejected = matrix.robots.iter().any(|it| it.not_admitted.is_some());
    match exit {
        Exit::Success | Exit::NoneFinished if is_missed => Exit::CheckFailed,
        Exit::Robot if is_missed && !has_rejected => Exit::CheckFailed,
        Exit::Robot if !has_rejected && thresholds.limits(Target::Faults) => Exit::Success,
        exit => exit,
    }
}
