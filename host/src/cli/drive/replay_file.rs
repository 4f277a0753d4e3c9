//! A drive as a replay, like that of a robot's match.

use std::io::Write as _;
use std::path::Path;

use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;
use wasmouse_core::journal::Journal;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{EngineId, MatchKey, MatchRecord, Transcript, Usage, replay};
use wasmouse_core::replay::{Replay, ReplayParts};

use super::super::failure::Failure;
use super::super::output::{self, Draft};
use super::driver::Driver;

/// What results call a person.
pub const DRIVER: &str = "driven by hand";

/// Writes a match that has ended into a file.
///
/// # Errors
///
/// When the file cannot be written.
pub fn save(
    mut draft: Draft,
    path: &Path,
    driver: &Driver<'_>,
    (maze, rules): (&Maze, &Ruleset),
) -> Result<(), Failure> {
    let made = of(driver, maze, rules)?;
    let json = serde_json::to_string(&made).expect("a replay has a JSON form");
    let written = writeln!(draft, "{json}");
    written.map_err(|error| output::failure(path, &error))?;
    draft.commit()
}

/// The replay of a match that has ended.
///
/// # Errors
///
/// When the name of the maze is too long for a replay.
fn of(driver: &Driver<'_>, maze: &Maze, rules: &Ruleset) -> Result<Replay, Failure> {
    let mut transcript = Transcript::default();
    for step in driver.trace.steps() {
        transcript.push(step.action);
    }
    let result = replay(maze, &rules.game, &transcript).map_err(Failure::internal)?;
    // No robot played, so nothing else can have this key.
    let by_hand = DRIVER.as_bytes();
    let key = MatchKey {
        engine: EngineId::new(DRIVER).digest(),
        rules: rules.digest(),
        robot: Digest::of(by_hand),
        variant: 0,
        maze: maze.digest(),
        seed: 0,
    };
    let parts = ReplayParts {
        robot: DRIVER.into(),
        maze_name: driver.name.clone(),
        maze: maze.clone(),
        rules: rules.clone(),
        record: MatchRecord::new(key, result, Usage::default(), &transcript),
        transcript,
        journal: Journal::default(),
    };
    Replay::new(parts).map_err(|error| Failure::input(format!("failed to keep the drive: {error}")))
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::GameRules;
    use wasmouse_core::maze::Walls;

    use super::super::super::output::Existing;
    use super::super::super::tui::Look;
    use super::super::super::tui::testing::press;
    use super::*;

    #[test]
    fn a_drive_is_kept_as_a_replay() {
        let maze = Maze::contest(Walls::open(6)).expect("start and goal fit");
        let mut rules = Ruleset::default();
        rules.game = GameRules {
            budget: 5,
            ..rules.game
        };
        let mut driver = Driver::new("hall", &maze, &rules.game, Look::RICH);
        press(&mut driver, "2wdrwd");
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.replay.json");
        let draft = Draft::create(&path, Existing::Keep).expect("a new file");
        save(draft, &path, &driver, (&maze, &rules)).expect("it is saved");
        let json = std::fs::read_to_string(&path).expect("a file");
        let read: Replay = serde_json::from_str(&json).expect("a replay");
        assert_eq!(read.parts().robot, DRIVER);
        assert_eq!(read.trace(), &driver.trace);
        assert_eq!(Some(read.playback().verdict()), driver.verdict().as_ref());
    }
}
