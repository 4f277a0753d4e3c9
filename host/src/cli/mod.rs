//! The command line: the only layer that touches files and the terminal.
//!
//! [`main`] parses the arguments, matches on the command, and turns failures into exit codes in
//! one place. Each command has a file with its arguments and a `run` function; typed arguments
//! become domain values there, and nothing below sees a flag. No command calls another one.

mod again;
mod backtrace;
mod build;
mod completions;
mod demo;
mod exit;
mod failure;
mod inspect;
mod interrupt;
mod log;
mod man;
mod maze;
mod mazes;
mod new;
mod output;
mod page;
mod play;
mod reproduce;
mod resolve;
mod robot_list;
mod robots;
mod run;
mod setup;
mod suggest;
mod terminal;
mod toolchain;
mod verdict;
mod verify;
mod watch;
mod worker;

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser, Subcommand};

use exit::{EXIT_CODES_HELP, Exit};
use failure::Failure;
use output::message;

/// Run virtual micromouse contests of WebAssembly robots
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
    Robots(robot_list::Args),
    Inspect(inspect::Args),
    /// Check, convert, draw, solve and generate mazes
    Maze(maze::Args),
    New(new::Args),
    Build(build::Args),
    Completions(completions::Args),
    Man(man::Args),
    /// A worker process of a contest; started by wasmouse itself
    #[command(hide = true)]
    Worker(worker::Args),
}

/// Runs the command line of this process and returns its exit code.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return print_clap_error(&error),
    };
    // A worker is ended by its supervisor, and must not start threads of its own.
    if !matches!(cli.command, Command::Worker(_)) {
        interrupt::handle();
    }
    let outcome: Result<Exit, Failure> = match cli.command {
        Command::Demo(args) => demo::run(&args),
        Command::Run(args) => run::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Robots(args) => robot_list::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Maze(args) => maze::run(args),
        Command::New(args) => new::run(&args),
        Command::Build(args) => build::run(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
        Command::Man(args) => man::run(&args, Cli::command()),
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

/// Prints an invalid command line, or the help, as clap does, but with the word for hints that
/// all other messages have.
fn print_clap_error(error: &clap::Error) -> ExitCode {
    let text = error.render();
    if error.use_stderr() {
        let text = text.ansi().to_string();
        let plain = text.replace("tip:", "hint:");
        message!("{}", plain.trim_end());
    } else {
        // A closed pipe is no failure, and there is no other way to report one.
        let _ = error.print();
    }
    Exit::from_clap(error.exit_code()).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
