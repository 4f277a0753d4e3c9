//! `wasmouse robots`: the robots that come with wasmouse.

use std::fmt::Write as _;

use wasmouse_engine::bundled::bundled;

use super::exit::Exit;
use super::failure::Failure;
use super::output;
use crate::report::bundled::BundledReport;

/// List the bundled robots and their variants
#[derive(clap::Args, Debug)]
pub struct Args {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    if args.json {
        output::print(&BundledReport::new(bundled()).to_json())?;
        return Ok(Exit::Success);
    }
    let mut text = String::new();
    for robot in bundled() {
        let written = writeln!(text, "{:<16} {}", robot.name, robot.description);
        written.expect("writing to a string cannot fail");
        for variant in robot.variants {
            let name = format!("{}:{}", robot.name, variant.name);
            let written = writeln!(text, "  {name:<22} {}", variant.description);
            written.expect("writing to a string cannot fail");
        }
    }
    output::print(&text)?;
    Ok(Exit::Success)
}
