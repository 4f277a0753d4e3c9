//! Whole matches of random modules.

use std::sync::LazyLock;

use super::{Played, limits, modules, play};
use crate::admission::{ComponentizeError, Rejection};
use crate::bundled::find;
use crate::runtime::{CompiledRobot, Runtime};

struct Bench {
    runtime: Runtime,
    flood: CompiledRobot,
    /// How flood plays on an engine that no other robot has used.
    undisturbed: Played,
}

static BENCH: LazyLock<Bench> = LazyLock::new(|| {
    let runtime = Runtime::new(limits(), 1, None).expect("address space for one match");
    let flood = find("flood").expect("a bundled robot").component;
    let flood = runtime.admit(flood).expect("a robot");
    Bench {
        undisturbed: play(&runtime, &flood),
        runtime,
        flood,
    }
});

/// Plays a random module twice. It gets the same record both times, never an error of the
/// host, and does not affect the robot that plays after it.
pub fn matches(bytes: &[u8]) -> bool {
    let Some(file) = modules::robot(bytes) else {
        return false;
    };
    let bench = &*BENCH;
    let robot = match bench.runtime.admit(&file) {
        Ok(robot) => robot,
        Err(rejection) => {
            check_rejection(&rejection);
            return false;
        }
    };
    let played = play(&bench.runtime, &robot);
    assert_eq!(play(&bench.runtime, &robot), played, "a second time");
    let flood = play(&bench.runtime, &bench.flood);
    assert_eq!(flood, bench.undisturbed, "another robot afterwards");
    played.record.steps.total() > 0
}

/// The module is valid and has the exports of a robot, so only a limit can be exceeded.
fn check_rejection(rejection: &Rejection) {
    let is_called_invalid = matches!(
        rejection,
        Rejection::Invalid(_)
            | Rejection::NotWasm(_)
            | Rejection::CoreModule(
                ComponentizeError::Malformed { .. } | ComponentizeError::MissingExport { .. }
            )
    );
    assert!(!is_called_invalid, "a valid module: {rejection}");
}
