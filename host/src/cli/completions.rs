//! `wasmouse completions`: completion scripts for shells.

use clap::Command;
use clap_complete::Shell;

use super::exit::Exit;
use super::failure::Failure;
use super::output;

const EXAMPLES: &str = "\
Examples:
  wasmouse completions bash > ~/.local/share/bash-completion/completions/wasmouse
  wasmouse completions fish > ~/.config/fish/completions/wasmouse.fish";

/// Print a completion script for a shell
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The shell
    shell: Shell,
}

/// Prints the script for a program with these commands.
pub fn run(args: &Args, mut program: Command) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "wasmouse", &mut script);
    output::print_data(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Success)
}
