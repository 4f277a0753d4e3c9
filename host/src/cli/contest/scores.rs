//! The scores of a contest that other commands draw.

use std::path::Path;

use super::super::failure::Failure;
use super::super::store_failure::store_failure;
use super::planned::PlannedContest;
use crate::contest::ScoreMatrix;
use crate::store::Store;

/// The scores of a contest, with everything that it hides from contestants. `store` is used instead
/// of the one that the contest file names.
///
/// # Errors
///
/// When the contest file or the store cannot be read.
pub fn scores(file: &Path, store: Option<&Path>) -> Result<ScoreMatrix, Failure> {
    let contest = PlannedContest::read(file)?;
    let path = store.map_or_else(|| contest.folder.store(), Path::to_owned);
    let store = Store::open_read_only(&path).map_err(store_failure)?;
    contest.matrix(&store, &contest.rejections(&store)?)
}
