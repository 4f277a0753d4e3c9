//! What went wrong with a store or was not played, for the user.

use super::super::failure::Failure;
use super::super::output::message;
use crate::contest::{NotAdmitted, ScoreMatrix};
use crate::report::text::text;
use crate::store::{StoreError, StoreErrorKind};

/// Says on stderr what was not played.
pub fn print_unplayed(matrix: &ScoreMatrix) {
    for robot in &matrix.robots {
        if let Some(NotAdmitted::Failed(reason)) = &robot.not_admitted {
            message!("error: `{}` could not be admitted: {}", robot.name, reason);
        }
        for (reason, matches) in &robot.unplayed {
            message!(
                "`{}`: {} matches were not played: {}",
                robot.name,
                matches,
                reason
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

/// The failure of a store.
pub fn store_failure(error: StoreError) -> Failure {
    store_failure_of(&error)
}

/// As [`store_failure`], of an error that is inside another.
pub fn store_failure_of(error: &StoreError) -> Failure {
    let message = text!("{}", error);
    let failure = match &error.kind {
        StoreErrorKind::Full
        | StoreErrorKind::Io(_)
        | StoreErrorKind::Sqlite(_)
        | StoreErrorKind::Conflict { .. } => Failure::internal(message),
        _ => Failure::input(message),
    };
    match error.hint() {
        Some(hint) => failure.hint(hint),
        None => failure,
    }
}
