//! `wasmouse contest`: contests that are described by a contest file.

mod check;
mod init;
mod load;
mod resolve;

use super::exit::Exit;
use super::failure::Failure;

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
}

/// Runs the chosen command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    match &args.command {
        Command::Init(args) => init::run(args),
        Command::Check(args) => check::run(args),
    }
}
