//! `wasmouse grade`: points for robots, by a rubric.
//!
//! Everything that can be wrong with the rubric and the outputs is found before anything is
//! played. From then on all outputs are written, whatever becomes of the robots.

mod check;
mod classroom;
mod init;
mod outputs;
mod rubric;
mod submissions;
mod verdict;

use std::path::PathBuf;
use std::sync::Arc;

use wasmouse_core::GuestText;
use wasmouse_engine::engine_id;

use super::exit::Exit;
use super::failure::Failure;
use super::interrupt;
use super::output::{self, Existing};
use super::play::{Pace, play_all};
use super::setup::{EngineArgs, IsolationArgs, TimeArgs};
use crate::contest::grade::{Grade, Graded, UnplayedMatches, grade};
use crate::contest::{MatrixBuilder, Plan, Tee};
use crate::report::grade::{Report, annotations, for_workflow, table};

use outputs::{OutputArgs, Outputs};
use rubric::RubricFile;
use submissions::Field;

const EXAMPLES: &str = "\
Examples:
  wasmouse grade --init                          write a commented rubric.toml
  wasmouse grade rubric.toml my-robot            build a robot project and grade it
  wasmouse grade rubric.toml bot.wasm --junit junit.xml --step-summary --annotations
  wasmouse grade rubric.toml submissions --output-dir grades
                                                 grade every robot of a folder

Exit codes:
  0  every robot passed
  1  a robot is below the mark of the rubric
  3  the rubric, or what it names, is missing or invalid; or there is no robot to
     grade
  4  a robot that does not pass was rejected or faulted
  5  internal error, or a robot took too long or could not be admitted or played
     for a reason of the host
  130  interrupted
All outputs are written in each case, unless the rubric is bad.";

/// Grade robots by a rubric, for CI and for teachers
///
/// A rubric is a TOML file that says which mazes are played and what is expected
/// in them, with points; docs/GRADING.md describes it. Prints the points of each
/// robot, and writes them in as many formats as are asked for.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!("{}\n\n{EXAMPLES}", super::robots::SPECIFICATION_HELP))]
pub struct Args {
    /// The rubric
    #[arg(value_name = "RUBRIC", required_unless_present = "init")]
    rubric: Option<PathBuf>,
    /// Robots: files, folders of them, robot projects, bundled robots
    #[arg(value_name = "ROBOT", required_unless_present = "init")]
    robots: Vec<String>,
    /// Write a commented rubric to FILE and grade nothing
    // No conflict with options that have a variable: clap would also see that.
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "rubric.toml",
          conflicts_with_all = ["rubric", "robots", "json", "junit", "markdown", "tap", "csv",
                                "gradescope", "classroom", "output_dir", "step_summary",
                                "annotations"])]
    init: Option<PathBuf>,
    #[command(flatten)]
    outputs: OutputArgs,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
    #[command(flatten)]
    time: TimeArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    if let Some(path) = &args.init {
        return init::run(path, Existing::from_flag(args.outputs.force));
    }
    let path = args.rubric.as_deref();
    let path = path.ok_or_else(|| Failure::usage("no rubric specified"))?;
    let rubric = RubricFile::read(path)?;
    let rules = Arc::new(rubric.rubric.rules.clone());
    let contest = rubric.contest()?;
    let executor = args
        .engine
        .executor(rules.clone(), &args.isolation, &args.time)?;
    let bytes_max = executor.limits().admission.component_bytes_max;
    let references = submissions::references(&rubric, bytes_max)?;
    let outputs = Outputs::create(&args.outputs, args.robots.len())?;
    // From here on, Ctrl-C ends the work early and everything is written.
    interrupt::listen()?;
    let field = Field::load(&args.robots, references, &executor)?;
    outputs.check(&field.submissions)?;

    let plan = Plan {
        entrants: field.entrants,
        mazes: contest.mazes,
        seeds: rubric.rubric.seeds,
        rules,
    };
    let mut matrix = MatrixBuilder::new(&plan);
    let mut unplayed = UnplayedMatches::default();
    let mut played = Ok(());
    if field.has_player {
        let pace = Pace {
            jobs: args.engine.jobs(),
            robot_time: args.time.robot_time(),
        };
        let mut sink = Tee(vec![&mut matrix, &mut unplayed]);
        played = play_all(&plan, &executor, pace, &mut sink);
    }
    let stopped = match &played {
        Ok(()) => "interrupted".to_owned(),
        Err(failure) => failure.message().as_str().to_owned(),
    };
    let matrix = matrix.finish();
    let names: Vec<GuestText> = plan.mazes.iter().map(|it| it.name()).collect();
    let graded = Graded {
        rubric: &rubric.rubric,
        matrix: &matrix,
        unplayed: &unplayed,
        mazes: &names,
        scopes: &contest.scopes,
        references: &field.references,
        baselines: &contest.baselines,
        stopped: &stopped,
    };
    let grades: Vec<Grade> = field
        .submissions
        .iter()
        .map(|it| grade(&graded, it))
        .collect();
    let engine = engine_id();
    let report = Report {
        rubric: &rubric.rubric,
        engine: engine.as_str(),
        grades: &grades,
    };
    outputs.write(&report)?;
    output::print(&for_workflow(&table(&report)))?;
    if args.outputs.annotations {
        output::print(&annotations(&report))?;
    }
    let exit = verdict::exit(&grades);
    played.map(|()| exit)
}
