//! `wasmouse worker`: what the program starts itself as, to run strangers' robots.

use super::exit::Exit;
use super::failure::Failure;
use crate::robot::worker;

/// Serve a supervisor on standard input and output.
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
    /// Play matches
    Play,
    /// Play one match and say where the robot fails
    Explain,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let served = match args.role {
        Role::Compile => worker::compile_main(),
        Role::Play => worker::play_main(),
        Role::Explain => worker::explain_main(),
    };
    match served {
        Ok(()) => Ok(Exit::Success),
        Err(error) => Err(Failure::internal(format!("the worker failed: {error}"))),
    }
}
