//! Fuzz targets: whatever bytes come, nothing panics, and what is believed is possible.
//!
//! Each target is an ordinary test, run by `fuzz-harness`, and a libFuzzer target in
//! `tests/fuzz`. Only a build for libFuzzer (`--cfg fuzzing`) makes this module public. A
//! target returns whether the input reached what it checks.

mod admission;
mod differential;
mod matches;
mod modules;

use std::sync::Arc;

use wasmouse_core::game::{GameRules, Ruleset, SandboxLimits};
use wasmouse_core::maze::{Maze, bundled, format};
use wasmouse_core::record::{MatchKey, MatchRecord, MatchSpec};

pub use self::admission::admission;
pub use self::differential::differential;
pub use self::matches::matches;
#[cfg(fuzzing)]
pub use crate::sandbox::fuzz::{reports, requests};

use crate::limits::Limits;
use crate::runner::Recording;
use crate::runtime::{CompiledRobot, Runtime, engine_id};

/// Short matches with little fuel and a small journal, so that every limit is reached.
pub(crate) fn rules() -> Ruleset {
    let rules = Ruleset::default();
    Ruleset {
        game: GameRules {
            budget: 60,
            ..rules.game
        },
        sandbox: SandboxLimits {
            start_fuel_max: 1_000_000,
            step_fuel_max: 1_000_000,
            match_fuel_max: 5_000_000,
            memory_bytes_max: 16 << 20,
            journal_bytes_max: 4 << 10,
            ..rules.sandbox
        },
        ..rules
    }
}

/// The limits of those matches.
pub(crate) fn limits() -> Limits {
    Limits::with_sandbox(rules().sandbox)
}

/// The maze of those matches.
pub(crate) fn maze() -> Maze {
    let first = &bundled()[0];
    format::parse(first.text).expect("a bundled maze").maze
}

/// A match of that robot.
fn spec(robot: &CompiledRobot) -> MatchSpec {
    let (maze, rules) = (maze(), rules());
    MatchSpec {
        key: MatchKey {
            engine: engine_id().digest(),
            rules: rules.digest(),
            robot: *robot.digest(),
            variant: 0,
            maze: maze.digest(),
            seed: 1,
        },
        maze: Arc::new(maze),
        rules: Arc::new(rules),
    }
}

/// Everything that must not differ between two runs of a match.
#[derive(Debug, PartialEq, Eq)]
struct Played {
    record: MatchRecord,
    step_fuel: Vec<u64>,
    journal: String,
}

/// Plays a match; a failure of the host is never the robot's doing.
fn play(runtime: &Runtime, robot: &CompiledRobot) -> Played {
    let spec = spec(robot);
    let mut recording = Recording::default();
    let ran = runtime.run(robot, &spec, &mut recording);
    let (result, usage) = ran.expect("the host works");
    Played {
        record: MatchRecord::new(spec.key, result, usage, &recording.transcript),
        step_fuel: recording.step_fuel,
        journal: format!("{:?}", recording.journal.entries().collect::<Vec<_>>()),
    }
}

#[cfg(test)]
mod tests {
    use fuzz_harness::Target;

    use super::*;
    use crate::bundled::find;

    #[test]
    fn admission() {
        Target {
            name: "admission",
            run: super::admission,
            seeds: admission::seeds,
            words: &[
                b"\0asm\x0d\0\x01\0",
                b"\0asm\x01\0\0\0",
                b"wasmouse:robot/controller@0.2.0",
                b"wasmouse:robot/journal@0.2.0",
                b"component-type",
                b"memory",
                b"cabi_realloc",
                b"(module ",
                b"(func ",
                b"(block ",
                b";;",
                b"(;",
                b"\x60\0\0",
                b"\x0b",
            ],
            bytes_max: 64 << 10,
            cases: 1_500,
        }
        .check();
    }

    #[test]
    fn matches() {
        Target {
            name: "matches",
            run: super::matches,
            seeds: Vec::new,
            words: &[],
            bytes_max: 4 << 10,
            cases: 40,
        }
        .check();
    }

    #[test]
    fn differential() {
        Target {
            name: "differential",
            run: super::differential,
            seeds: Vec::new,
            words: &[],
            bytes_max: 4 << 10,
            cases: 12,
        }
        .check();
    }

    /// Robots that drive for a whole match, which random modules seldom do.
    #[test]
    fn bundled_robots_play_the_same_on_all_engines() {
        for name in ["flood", "random", "lobato"] {
            let robot = find(name).expect("a bundled robot");
            assert!(differential::compare(robot.component), "{name}");
        }
    }
}
