//! Playing one recorded match again with everything that the robot leaves behind.

use wasmouse_core::record::MatchRecord;
use wasmouse_engine::{DetailedMatch, Executor, InfrastructureError};

use crate::contest::{ContestMaze, Plan, Player};

/// A match of a plan, with what it takes to play it again.
pub struct Replayed<'a> {
    /// Who plays.
    pub player: &'a Player,
    /// Where.
    pub maze: ContestMaze,
    /// What came of it.
    pub detailed: DetailedMatch,
}

/// The player of a record; `None` when the plan has none.
pub fn player_of<'a>(players: &'a [Player], record: &MatchRecord) -> Option<&'a Player> {
    let key = &record.key;
    players
        .iter()
        .find(|it| *it.robot.digest() == key.robot && it.variant == key.variant)
}

/// The maze of a record, generated again if need be; `None` when the plan has none.
pub fn maze_of(plan: &Plan, record: &MatchRecord) -> Option<ContestMaze> {
    let mut mazes = plan.mazes.iter().map(|it| it.prepare(&plan.rules.game));
    mazes.find(|maze| maze.digest == record.key.maze)
}

/// Plays a match again; `None` when it is not of this plan.
///
/// # Errors
///
/// When the host fails.
pub fn play_again<'a>(
    plan: &Plan,
    players: &'a [Player],
    executor: &dyn Executor,
    record: &MatchRecord,
) -> Result<Option<Replayed<'a>>, InfrastructureError> {
    let (Some(player), Some(maze)) = (player_of(players, record), maze_of(plan, record)) else {
        return Ok(None);
    };
    let spec = plan.spec(plan.key_parts(), player, &maze, record.key.seed);
    let detailed = executor.execute_with_details(&player.robot, &spec)?;
    Ok(Some(Replayed {
        player,
        maze,
        detailed,
    }))
}
