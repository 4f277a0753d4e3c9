//! Whole matches of random modules.

use std::sync::LazyLock;

use super::{Played, limits, modules, play};
use crate::admission::{ComponentizeError, Rejection};
use crate::bundled::find;
use crate::runtime::{AdmissionError, CompiledRobot, Runtime};

struct Fixture {
    runtime: Runtime,
    flood: CompiledRobot,
    /// How flood plays on an engine that no other robot has used.
    undisturbed: Played,
}

static FIXTURE: LazyLock<Fixture> = LazyLock::new(|| {
    let runtime = Runtime::new(limits(), 1, None).expect("address space for one match");
    let flood = find("flood").expect("a bundled robot").component;
    let flood = runtime.admit(flood).expect("a robot");
    Fixture {
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
    let fixture = &*FIXTURE;
    let robot = match fixture.runtime.admit(&file) {
        Ok(robot) => robot,
        Err(AdmissionError::Rejected(rejection)) => {
            check_rejection(&rejection);
            return false;
        }
        Err(AdmissionError::Host(error)) => panic!("{error}"),
    };
    let played = play(&fixture.runtime, &robot);
    assert_eq!(play(&fixture.runtime, &robot), played, "a second time");
    let flood = play(&fixture.runtime, &fixture.flood);
    assert_eq!(flood, fixture.undisturbed, "another robot afterwards");
    played.record.steps.total() > 0
}

/// The module is valid and has the exports of a robot, so only a limit can be exceeded.
fn check_rejection(rejection: &Rejection) {
    let is_called_invalid = matches!(
        rejection,
        Rejection::Invalid { .. }
            | Rejection::NotWasm(_)
            | Rejection::CoreModule(
                ComponentizeError::Malformed { .. } | ComponentizeError::MissingExport { .. }
            )
    );
    assert!(!is_called_invalid, "a valid module: {rejection}");
}
