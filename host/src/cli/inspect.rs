//! `wasmouse inspect`: what a robot file is, needs, and whether it is admitted.

use std::fmt::Write as _;

use super::exit::Exit;
use super::failure::Failure;
use super::output;
use super::robots::{self, Specification};
use super::setup::{IsolationArgs, SetupArgs};
use crate::report::inspection::InspectionReport;

const EXAMPLES: &str = "\
Examples:
  wasmouse inspect my-robot.wasm
  wasmouse inspect flood --json

Exit codes:
  0  the robot would be admitted
  4  it would be refused; the reason is printed";

/// Show what a robot file is, imports, exports and needs.
///
/// Says whether a contest would admit it and, if not, why and what to do.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!("{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP))]
pub struct Args {
    /// A bundled robot or a file
    robot: String,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let specification = Specification::parse(&args.robot)?;
    let referee = args.setup.referee_for_all(&args.isolation)?;
    let bytes = specification.read(referee.rules().limits.component_bytes_max)?;
    let inspection = referee
        .inspect(&bytes, specification.trust())
        .map_err(|error| robots::setup_failure(&error))?;
    robots::tell_sandbox(&referee);
    let report = InspectionReport::new(&args.robot, &inspection, &referee.rules().limits);
    if args.json {
        output::print(&report.to_json())?;
    } else {
        let mut text = String::new();
        write!(text, "{report}").expect("writing to a string cannot fail");
        output::print(&text)?;
    }
    Ok(if inspection.refusal.is_some() {
        Exit::Robot
    } else {
        Exit::Success
    })
}
