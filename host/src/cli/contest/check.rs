//! `wasmouse contest check`: what a contest file means, without playing anything.

use std::path::PathBuf;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output;
use super::load::{ContestFolder, FILE_NAME};
use super::resolve::{self, ResolvedRobot};
use crate::report::contest_check::{Overview, RobotLine, contest_check};
use crate::report::text::Text;

/// Check a contest file and print what would be played.
///
/// Finds all robots and mazes that the file names, builds robot projects, and reads the mazes.
/// Robots are not compiled and not run.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The contest file, or a folder with a contest.toml
    #[arg(value_name = "FILE", default_value = FILE_NAME)]
    file: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let contest = ContestFolder::read(&args.file)?;
    let resolved = resolve::resolve(&contest)?;
    let sets = resolved.sets.iter();
    let outputs = contest.outputs().into_iter();
    let overview = Overview {
        name: contest.file.name.as_str(),
        rules: &resolved.rules,
        seeds: resolved.seeds,
        robots: resolved.robots.iter().map(robot).collect(),
        sets: sets.map(|it| (&it.set, it.mazes.len() as u64)).collect(),
        matches: resolved.matches(),
        store: Text::of_path(contest.store()).as_str().to_owned(),
        outputs: outputs
            .map(|(key, path)| (key, Text::of_path(path).as_str().to_owned()))
            .collect(),
    };
    output::print(&contest_check(&overview))?;
    Ok(Exit::Success)
}

fn robot(robot: &ResolvedRobot) -> RobotLine {
    let file = robot.spec.file();
    RobotLine {
        name: robot.name.clone(),
        author: robot.author.clone(),
        class: robot.class.clone(),
        file: file.map(|it| Text::of_path(it).as_str().to_owned()),
    }
}
