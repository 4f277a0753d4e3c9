//! `wasmouse inspect`: whether a robot file is admitted, and what it is.

use wasmouse_engine::sandbox::SandboxStatus;

use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::output;
use super::robots;
use super::setup::{IsolationArgs, SetupArgs, TimeArgs};
use crate::report::inspection::InspectionReport;

const EXAMPLES: &str = "\
Examples:
  wasmouse inspect my-robot.wasm
  wasmouse inspect my-robot.wasm --measures
  wasmouse inspect flood --json

Exit codes:
  0  the robot is admitted
  4  the robot is rejected; the reason is printed";

/// Validate a robot file and show its imports, exports and resource usage
///
/// Reports whether the robot is admitted and, if not, why and how to fix it.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!("{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP))]
pub struct Args {
    /// A bundled robot, a file or a robot project
    robot: String,
    /// Show everything that is measured before a robot is compiled, with its limit
    ///
    /// For an untrusted robot, also names the layers of its sandbox on this system.
    #[arg(long)]
    measures: bool,
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
    let specs = robots::resolve(&args.robot)?;
    let [spec] = &specs[..] else {
        let message = format!("`{}` has {} robots", args.robot, specs.len());
        return Err(Failure::usage(message).hint("name one of its files"));
    };
    let executor = args
        .setup
        .executor_for_all(&args.isolation, &TimeArgs::default())?;
    let bytes = spec.read(executor.limits().admission.component_bytes_max)?;
    let inspection = executor
        .inspect(&bytes, spec.trust())
        .map_err(|error| entrants::setup_failure(&error))?;
    entrants::warn_about_sandbox(&executor);
    let report = InspectionReport::new(&args.robot, &inspection, executor.limits());
    if args.json {
        output::print(&report.to_json())?;
    } else {
        output::print(&report.to_text(args.measures))?;
        if args.measures
            && let Some(sandbox) = executor.sandbox()
        {
            output::print(&layers(sandbox))?;
        }
    }
    Ok(if inspection.rejection.is_some() {
        Exit::Robot
    } else {
        Exit::Success
    })
}

/// The layers of the sandbox, and those that this system does not provide.
fn layers(sandbox: SandboxStatus) -> String {
    let named = |there: bool| {
        let layers = sandbox.layers().into_iter();
        let names: Vec<_> = layers.filter(|it| it.1 == there).map(|it| it.0).collect();
        names.join(", ")
    };
    let (there, missing) = (named(true), named(false));
    if missing.is_empty() {
        format!("  sandbox   {there}\n")
    } else {
        format!("  sandbox   {there}; not on this system: {missing}\n")
    }
}
