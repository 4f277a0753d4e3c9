//! `wasmouse contest`: contests that are described by a contest file.

mod check;
mod commit;
mod init;
mod load;
mod merge;
mod pictures;
mod planned;
mod progress;
mod report;
mod resolve;
mod reveal;
mod run;
mod shard;
mod status;
mod watch;

use super::exit::Exit;
use super::failure::Failure;
use super::output::message;
use crate::contest::{NotAdmitted, ScoreMatrix};
use crate::report::text::text;
use crate::store::StoreError;

/// Arguments of `wasmouse contest`.
#[derive(clap::Args)]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    Init(init::Args),
    Check(check::Args),
    Run(run::Args),
    Status(status::Args),
    Report(report::Args),
    Merge(merge::Args),
    Commit(commit::Args),
    Reveal(reveal::Args),
}

/// Runs the chosen command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    match &args.command {
        Command::Init(args) => init::run(args),
        Command::Check(args) => check::run(args),
        Command::Run(args) => run::run(args),
        Command::Status(args) => status::run(args),
        Command::Report(args) => report::run(args),
        Command::Merge(args) => merge::run(args),
        Command::Commit(args) => commit::run(args),
        Command::Reveal(args) => reveal::run(args),
    }
}

/// Says on stderr what was not played.
fn print_unplayed(matrix: &ScoreMatrix) {
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
fn print_hint(error: &StoreError) {
    if let Some(hint) = error.hint() {
        message!("  hint: {}", hint);
    }
}

/// The failure of a store.
fn store_failure(error: StoreError) -> Failure {
    store_failure_of(&error)
}

fn store_failure_of(error: &StoreError) -> Failure {
    use crate::store::StoreErrorKind as Kind;
    let message = text!("{}", error);
    let failure = match &error.kind {
        Kind::Full | Kind::Io(_) | Kind::Sqlite(_) | Kind::Conflict { .. } => {
            Failure::internal(message)
        }
        _ => Failure::input(message),
    };
    match error.hint() {
        Some(hint) => failure.hint(hint),
        None => failure,
    }
}
