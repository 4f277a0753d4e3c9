//! Sample matches of a robot that was just built.

use std::path::Path;
use std::sync::Arc;

use wasmouse_core::game::Ruleset;
use wasmouse_engine::Executor as _;

use super::entrants;
use super::failure::Failure;
use super::mazes::{self, BadFiles, Legality};
use super::robots::RobotSpec;
use super::setup::{CacheArgs, IsolationArgs};
use crate::contest::{NotAdmitted, Plan, Seeds};
use crate::report::built::SampleMatch;
use crate::report::text::{Text, text};

/// The mazes of the samples: one that everybody knows, and one of the largest size, where a step
/// costs most.
const MAZES: [&str; 2] = ["test_maze_01", "gen:division:20:1"];

/// The rules of the samples: those with the most fuel, so that a sample shows how much is needed.
const RULES: &str = "udacity-interpreted";

/// Plays the sample matches of a robot in a file, in the sandbox.
///
/// # Errors
///
/// When the robot is not admitted, or the host fails.
pub fn play(
    robot: &Path,
    cache: &CacheArgs,
    isolation: &IsolationArgs,
) -> Result<Vec<SampleMatch>, Failure> {
    let rules = Ruleset::by_name(RULES).expect("a bundled ruleset");
    let executor = cache.executor(Arc::new(rules), isolation)?;
    let spec = RobotSpec::of_file(robot.to_owned(), 0, None);
    let mazes = MAZES.map(str::to_owned);
    let plan = Plan {
        entrants: entrants::load(&[spec], &executor)?,
        mazes: mazes::load(&mazes, Legality::Contest, BadFiles::Fail)?,
        seeds: Seeds { first: 0, count: 1 },
        rules: executor.rules().clone(),
    };
    for entrant in &plan.entrants {
        match &entrant.admission {
            Ok(_) => {}
            Err(NotAdmitted::Rejected(rejection)) => {
                let message = text!(
                    "`{}` is rejected: {}",
                    Text::of_path(robot),
                    rejection.reason().escaped()
                );
                return Err(Failure::robot(message).hint(rejection.hint().escaped()));
            }
            Err(NotAdmitted::Failed(reason)) => return Err(Failure::internal(reason.escaped())),
        }
    }
    let mut samples = Vec::new();
    for player in plan.players() {
        for maze in &plan.mazes {
            let maze = maze.prepare(&plan.rules.game);
            let spec = plan.spec(plan.key_parts(), &player, &maze, plan.seeds.first);
            let before = player.robot.account().used();
            let played = executor.execute_with_details(&player.robot, &spec);
            let played = played.map_err(Failure::internal)?;
            samples.push(SampleMatch {
                maze: maze.name,
                record: played.record,
                time: player.robot.account().used().saturating_sub(before),
            });
        }
    }
    Ok(samples)
}
