//! `wasmouse contest status`: what a store has of a contest, and the history of its submissions.

use std::path::PathBuf;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output;
use super::super::store_failure::store_failure;
use super::load::FILE_NAME;
use super::planned::PlannedContest;
use super::shard::Shard;
use crate::report::contest_status::{Status, contest_status};
use crate::report::text::Text;
use crate::store::Store;

/// Show what was played of a contest, what is missing, and who submitted what
///
/// Nothing is played or changed.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The contest file, or a folder with a contest.toml
    #[arg(value_name = "FILE", default_value = FILE_NAME)]
    file: PathBuf,
    /// The store to use instead of the one that the contest file names
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
    /// Check every page and record of the store, too
    #[arg(long)]
    check: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let contest = PlannedContest::read(&args.file)?;
    let path = args.store.clone().unwrap_or_else(|| contest.folder.store());
    let store = Store::open_read_only(&path).map_err(store_failure)?;
    if args.check {
        store.integrity().map_err(store_failure)?;
    }
    let left = contest.left(&store, Shard::ALL, false)?;
    let matrix = contest.matrix(&store, &contest.rejections(&store)?)?;
    let conflicts = store.conflicts().map_err(store_failure)?.len() as u64;
    let submissions = store.submissions().map_err(store_failure)?;
    let status = Status {
        name: contest.folder.file.name.as_str(),
        store: Text::of_path(&path).as_str().to_owned(),
        is_checked: args.check,
        matches: contest.matches(&matrix),
        left: left.not_rejected(&matrix),
        matrix: &matrix,
        conflicts,
        submissions: submissions
            .iter()
            .map(|it| {
                let rejection = it.rejection.as_ref();
                let rejection = rejection.map(|rejection| rejection.kind.clone());
                (it.name.clone(), it.robot, it.variant, rejection)
            })
            .collect(),
    };
    output::print(&contest_status(&status))?;
    Ok(if conflicts > 0 {
        Exit::CheckFailed
    } else {
        Exit::Success
    })
}
