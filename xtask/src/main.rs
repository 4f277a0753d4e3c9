//! `cargo xtask`: the commands of a maintainer.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use xtask::{
    bindings, corpus, costs, dist, emulators, fuzz, languages, platforms, reference, repository,
    robots, validators, verify, wasi, web,
};

/// Automation for the wasmouse repository.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run everything that CI runs: formatting, lints, docs, build, robots, tests, licences.
    Test {
        /// Also run the tests that take minutes each: faults 200 times over, every robot in
        /// 2,000 mazes, and the slow cases of the hostile corpus.
        #[arg(long)]
        long: bool,
    },
    /// Generate the SDK's bindings, wit/wasmouse.h and docs/ABI.md from wit/robot.wit.
    Bindings,
    /// Build the bundled robots into example-robots/prebuilt.
    Robots {
        /// Build nothing; list which prebuilt robots are stale.
        #[arg(long)]
        check: bool,
    },
    /// Build what keeps WASI inside robots into host/engine/wasi/prebuilt.
    Wasi {
        /// Build nothing; list what is stale.
        #[arg(long)]
        check: bool,
    },
    /// Build the player of web pages into host/web/prebuilt.
    Web {
        /// Build nothing; list what is stale.
        #[arg(long, conflicts_with = "test")]
        check: bool,
        /// Build nothing; run its tests in a browser, with the programs that are built.
        #[arg(long)]
        test: bool,
    },
    /// Play the hostile corpus and print the verdict of each case; see `--help`.
    #[command(disable_help_flag = true)]
    Corpus {
        /// Arguments for the program `corpus`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Play the bundled robots and write docs/REFERENCE.md; see `--help`.
    #[command(disable_help_flag = true)]
    Reference {
        /// Arguments for the program `reference`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Build a robot in every language and write the costs into docs/LANGUAGES.md; see `--help`.
    #[command(disable_help_flag = true)]
    Costs {
        /// Arguments for the program `costs`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Check that everything compiles without warnings for Windows and macOS.
    CheckPlatforms,
    /// Build the program for release and pack it with its checksum, as a release has it.
    Dist(dist::Args),
    /// Install the validators that tests use into target/validators: packages of Python and Node.
    Validators,
    /// Install the tools of languages that tests use: packages of Python and Node into
    /// target/languages, and targets of the Rust compiler with rustup.
    Languages,
    /// Install the emulators of other processors that tests use into target/emulators: programs of
    /// a package of Debian.
    Emulators,
    /// Fuzz a parser of untrusted input; without a target, list the targets.
    Fuzz {
        /// The fuzz target.
        target: Option<String>,
        /// How long to run.
        #[arg(long, default_value_t = 10)]
        minutes: u64,
    },
}

fn main() -> ExitCode {
    let root = repository();
    let outcome = match Cli::parse().command {
        Command::Test { long } => verify::run(&root, long),
        Command::Bindings => bindings::generate(&root),
        Command::Robots { check: false } => robots::rebuild(&root),
        Command::Robots { check: true } => robots::check(&root),
        Command::Wasi { check: false } => wasi::rebuild(&root),
        Command::Wasi { check: true } => wasi::check(&root),
        Command::Web { check: true, .. } => web::check(&root),
        Command::Web { test: true, .. } => web::test(&root),
        Command::Web { .. } => web::rebuild(&root),
        Command::Corpus { arguments } => corpus::run(&root, &arguments),
        Command::Reference { arguments } => reference::run(&root, &arguments),
        Command::Costs { arguments } => costs::run(&root, &arguments),
        Command::CheckPlatforms => platforms::run(&root),
        Command::Dist(args) => dist::run(&root, &args),
        Command::Validators => validators::run(&root),
        Command::Languages => languages::run(&root),
        Command::Emulators => emulators::run(&root),
        Command::Fuzz { target, minutes } => fuzz::run(&root, target.as_deref(), minutes),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
