//! `cargo xtask`: the commands of a maintainer.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use xtask::{bindings, corpus, fuzz, reference, repository, robots, verify};

/// Automation for the wasmouse repository.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Do what CI does: format, lints, docs, build, robots, tests, licences.
    Test {
        /// Also what takes minutes each: faults 200 times over, every robot in 2,000
        /// mazes, and the hostile corpus's slow cases.
        #[arg(long)]
        long: bool,
    },
    /// Generate the SDK's bindings from wit/robot.wit.
    Bindings,
    /// Build the bundled robots into example-robots/prebuilt.
    Robots {
        /// Build nothing: say which prebuilt robots are stale.
        #[arg(long)]
        check: bool,
    },
    /// Play the hostile corpus and print what came of each case; `--help` tells more.
    #[command(disable_help_flag = true)]
    Corpus {
        /// Arguments for the program `corpus`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Feed changed inputs to what reads a stranger's bytes; `--help` tells more.
    #[command(disable_help_flag = true)]
    Fuzz {
        /// Arguments for the program `fuzz`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Play the bundled robots and write docs/REFERENCE.md; `--help` lists the options.
    #[command(disable_help_flag = true)]
    Reference {
        /// Arguments for the program `reference`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
}

fn main() -> ExitCode {
    let root = repository();
    let outcome = match Cli::parse().command {
        Command::Test { long } => verify::run(&root, long),
        Command::Bindings => bindings::generate(&root),
        Command::Robots { check: false } => robots::rebuild(&root),
        Command::Robots { check: true } => robots::check(&root),
        Command::Corpus { arguments } => corpus::run(&root, &arguments),
        Command::Fuzz { arguments } => fuzz::run(&root, &arguments),
        Command::Reference { arguments } => reference::run(&root, &arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
