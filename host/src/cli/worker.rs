//! `wasmouse worker`: what the program starts itself as, to run untrusted robots.

use wasmouse_engine::sandbox::child;

use super::exit::Exit;
use super::failure::Failure;

/// The name of the command.
const COMMAND: &str = "worker";

/// Serve a supervisor on standard input and output
#[derive(clap::Args, Debug)]
pub struct Args {
    /// What the worker is for
    #[arg(value_enum)]
    role: Role,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Role {
    /// Compile one file
    Compile,
    /// Run matches
    Run,
    /// Run one match and report where the robot fails
    Backtrace,
}

impl Args {
    /// The arguments of a process that a supervisor started; `None` for any other command line.
    /// Without the parser for users, which takes more stack than some systems give.
    pub fn of_process() -> Option<Self> {
        let mut arguments = std::env::args().skip(1);
        if arguments.next()? != COMMAND {
            return None;
        }
        let role = <Role as clap::ValueEnum>::from_str(&arguments.next()?, false);
        Some(Self { role: role.ok()? })
    }
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let served = match args.role {
        Role::Compile => child::compile_main(),
        Role::Run => child::run_main(),
        Role::Backtrace => child::backtrace_main(),
    };
    match served {
        Ok(()) => Ok(Exit::Success),
        Err(error) => Err(Failure::internal(format!("the worker failed: {error}"))),
    }
}
