//! `wasmouse maze`: commands about mazes alone, without robots.

mod check;
mod convert;
mod edit;
mod generate;
mod show;
mod solve;

use super::exit::Exit;
use super::failure::Failure;

/// Arguments of `wasmouse maze`.
#[derive(clap::Args)]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    Check(check::Args),
    Convert(convert::Args),
    Edit(edit::Args),
    Generate(generate::Args),
    Show(show::Args),
    Solve(solve::Args),
}

/// Runs the chosen command.
pub fn run(args: Args) -> Result<Exit, Failure> {
    match args.command {
        Command::Check(args) => check::run(args),
        Command::Convert(args) => convert::run(args),
        Command::Edit(args) => edit::run(&args),
        Command::Generate(args) => generate::run(args),
        Command::Show(args) => show::run(args),
        Command::Solve(args) => solve::run(args),
    }
}
