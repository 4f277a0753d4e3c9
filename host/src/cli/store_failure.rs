//! What becomes of the errors of a store.

use super::failure::Failure;
use crate::report::text::text;
use crate::store::{StoreError, StoreErrorKind};

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
