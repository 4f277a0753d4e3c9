//! `wasmouse contest`: contests that are described by a contest file.

mod check;
mod commit;
mod failures;
mod init;
mod load;
mod merge;
mod pictures;
mod planned;
mod progress;
mod recorder;
mod report;
mod resolve;
mod reveal;
mod run;
mod scores;
mod shard;
mod status;
mod watch;

use super::exit::Exit;
use super::failure::Failure;

pub use scores::scores;

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
