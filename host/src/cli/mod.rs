//! The command line: the only layer that touches files and the terminal.
//!
//! [`main`] parses the arguments, matches on the command, and turns failures into exit codes in
//! one place. Each command has a file with its arguments and a `run` function; typed arguments
//! become domain values there, and nothing below sees a flag. No command calls another one.

mod again;
mod backtrace;
mod bar;
mod build;
mod compare;
mod complaints;
mod completions;
mod contest;
mod demo;
mod doctor;
mod drive;
mod entrants;
mod exit;
mod explain;
mod fail_under;
mod failure;
mod grade;
mod image_file;
mod input;
mod inspect;
mod interrupt;
mod keep;
mod log;
mod man;
mod maze;
mod maze_source;
mod mazes;
mod new;
mod output;
mod page;
mod pattern;
mod picture;
mod play;
pub mod player;
mod plot;
mod profile;
mod project;
mod replay;
mod replays;
mod reproduce;
mod resolve;
mod robot_list;
mod robots;
mod run;
mod samples;
mod setup;
mod store_failure;
mod study;
mod terminal;
mod theme;

mod trial;
mod tui;
mod verdict;
mod verify;
mod worker;

use std::process::ExitCode;
use std::thread;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory as _, Parser, Subcommand};

use exit::{EXIT_CODES_HELP, Exit};
use failure::Failure;
use output::message;

use crate::report::escape::for_terminal;
use crate::report::text::Text;

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
    Profile(profile::Args),
    Drive(drive::Args),
    Grade(grade::Args),
    Compare(compare::Args),
    Picture(picture::Args),
    Plot(plot::Args),
    Study(study::Args),
    Verify(verify::Args),
    Replay(replay::Args),
    /// Run contests that are described by a contest file
    Contest(contest::Args),
    Robots(robot_list::Args),
    Inspect(inspect::Args),
    /// Check, convert, draw, edit, solve and generate mazes
    Maze(maze::Args),
    New(new::Args),
    Build(build::Args),
    Doctor(doctor::Args),
    Completions(completions::Args),
    Man(man::Args),
    /// A worker process of a contest; started by wasmouse itself
    #[command(hide = true)]
    Worker(worker::Args),
}

/// Stack of the thread that a command runs on, in bytes. The one that the system gives may be a
/// few pages (`ulimit -s`), and signals are delivered there too.
const STACK_BYTES: usize = 8 << 20;

/// Runs the command line of this process and returns its exit code.
pub fn main() -> ExitCode {
    // A worker has no room for a thread that it does not need, and starts those that it does.
    if let Some(args) = worker::Args::of_process() {
        return end(worker::run(&args));
    }
    let thread = thread::Builder::new()
        .name("main".to_owned())
        .stack_size(STACK_BYTES);
    match thread.spawn(command) {
        Ok(thread) => thread
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        // Perhaps the stack that is there is large enough.
        Err(_) => command(),
    }
}

fn command() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return print_clap_error(error),
    };
    // A worker is ended by its supervisor, and must not start threads of its own.
    if !matches!(cli.command, Command::Worker(_)) {
        interrupt::handle();
    }
    let outcome: Result<Exit, Failure> = match cli.command {
        Command::Demo(args) => demo::run(&args),
        Command::Run(args) => run::run(&args),
        Command::Profile(args) => profile::run(&args),
        Command::Drive(args) => drive::run(&args),
        Command::Grade(args) => grade::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Picture(args) => picture::run(&args),
        Command::Plot(args) => plot::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Replay(args) => replay::run(&args),
        Command::Contest(args) => contest::run(&args),
        Command::Robots(args) => robot_list::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Maze(args) => maze::run(args),
        Command::New(args) => new::run(&args),
        Command::Build(args) => build::run(&args),
        Command::Doctor(args) => doctor::run(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
        Command::Man(args) => man::run(&args, Cli::command()),
        Command::Worker(args) => worker::run(&args),
    };
    end(outcome)
}

/// The exit code of a command that ended so, with a message when it failed.
fn end(outcome: Result<Exit, Failure>) -> ExitCode {
    let exit = outcome.unwrap_or_else(|failure| {
        message!("{}", failure.report());
        failure.exit()
    });
    output::finish(interrupt::exit_of(exit)).into()
}

/// Prints an invalid command line, or the help, as clap does, but with the word for hints that
/// all other messages have.
fn print_clap_error(mut error: clap::Error) -> ExitCode {
    escape_arguments(&mut error);
    let text = error.render();
    if error.use_stderr() {
        // It has arguments in it, so colours are not worth it.
        let plain = text.to_string().replace("tip:", "hint:");
        message!("{}", Text::of_lines(plain.trim_end()));
    } else {
        if let Err(error) = error.print() {
            output::keep_error(error);
        }
    }
    output::finish(Exit::from_clap(error.exit_code())).into()
}

/// Escapes the arguments that the message of an invalid command line quotes: one with a line break
/// could look like a message of its own.
fn escape_arguments(error: &mut clap::Error) {
    let context: Vec<(ContextKind, String)> = error
        .context()
        .filter_map(|(kind, value)| match value {
            ContextValue::String(text) => Some((kind, text.clone())),
            _ => None,
        })
        .collect();
    for (kind, text) in context {
        let escaped = for_terminal(&text);
        if escaped != text {
            error.insert(kind, ContextValue::String(escaped));
            // These quote it again.
            error.insert(ContextKind::Suggested, ContextValue::None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
