//! The command line: the only layer that touches files and the terminal.
//!
//! [`main`] reads like a table of contents: parse, one `match` over the
//! commands, one place that turns failures into exit codes. Each command has a
//! file with its arguments and a `run` function; typed arguments become domain
//! values there, and nothing below sees a flag.

/// Tells the person at the terminal something, formatted as by `format!`, on
/// standard error.
macro_rules! tell {
    ($($arguments:tt)*) => {
        $crate::cli::output::tell(format_args!($($arguments)*))
    };
}

mod at_hand;
mod build;
mod completions;
mod demo;
mod exit;
mod explain;
mod failure;
mod inspect;
mod interrupt;
mod journal;
mod list;
mod man;
mod maze;
mod mazes;
mod new;
mod output;
mod page;
mod robots;
mod run;
mod setup;
mod study;
mod terminal;
mod toolchain;
mod twice;
mod verify;
mod watch;
mod worker;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use exit::{EXIT_CODES_HELP, Exit};
use failure::Failure;

/// A referee for virtual micromouse contests of WebAssembly robots.
#[derive(Parser)]
#[command(name = "wasmouse", version, about, after_help = EXIT_CODES_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Demo(demo::Args),
    Run(run::Args),
    Verify(verify::Args),
    Robots(list::Args),
    Inspect(inspect::Args),
    Study(study::Args),
    /// Look at mazes: check, convert, draw, solve and generate them.
    Maze(maze::Args),
    New(new::Args),
    Build(build::Args),
    Completions(completions::Args),
    Man(man::Args),
    /// Not for people: a worker process of a contest.
    #[command(hide = true)]
    Worker(worker::Args),
}

/// Runs the command line of this process and returns its exit code.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    // A worker is ended by its supervisor, and must not start threads of its own.
    if !matches!(cli.command, Command::Worker(_)) {
        interrupt::handle();
    }
    let outcome: Result<Exit, Failure> = match cli.command {
        Command::Demo(args) => demo::run(&args),
        Command::Run(args) => run::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Robots(args) => list::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Maze(args) => maze::run(args),
        Command::New(args) => new::run(&args),
        Command::Build(args) => build::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
        Command::Worker(args) => worker::run(&args),
    };
    match outcome {
        Ok(exit) => exit.into(),
        Err(failure) => {
            message!("{failure}");
            failure.exit().into()
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
