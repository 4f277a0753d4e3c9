//! What went wrong with a store or was not played, for the user.

use super::super::output::message;
use crate::contest::{NotAdmitted, ScoreMatrix};
use crate::report::number::counted_were;
use crate::store::StoreError;

/// Says on stderr what was not played.
pub fn print_unplayed(matrix: &ScoreMatrix) {
    for robot in &matrix.robots {
        if let Some(NotAdmitted::Failed(reason)) = &robot.not_admitted {
            message!(
                "error: `{}` could not be admitted: {}",
                robot.name.escaped(),
                reason.escaped()
            );
        }
        for (reason, matches) in &robot.unplayed {
            message!(
                "`{}`: {} not played: {}",
                robot.name.escaped(),
                counted_were(*matches, "match"),
                reason.escaped()
            );
        }
    }
}

/// Prints what to do about the error of a store.
pub fn print_hint(error: &StoreError) {
    if let Some(hint) = error.hint() {
        message!("  hint: {}", hint);
    }
}
