//! Small robots in WebAssembly text on a host in this process, and a good robot that
//! has to play as ever beside them.

use std::sync::OnceLock;

use wasmouse::maze::{self, format};
use wasmouse::robot::bundled::find;
use wasmouse::robot::{Digest, Game, Host, Outcome, Recorder};
use wasmouse::sim::{Limits, Ruleset};

pub use wasmouse_tests::module::{DRIVE_ON, IMPORT_LOG, Module, START_PARAMETERS, wasm};

/// The default rules under other limits.
pub fn rules(limits: Limits) -> Ruleset {
    Ruleset {
        limits,
        ..Ruleset::default()
    }
}

/// A host for one match at a time, without a cache.
pub fn host(limits: Limits) -> Host {
    Host::new(limits, 1, None).expect("address space for one match")
}

/// What the robot does in the first bundled maze on that host.
///
/// # Panics
///
/// When the robot is refused or the host fails.
#[track_caller]
pub fn play(host: &Host, component: &[u8], recorder: &mut Recorder) -> Outcome {
    let robot = match host.admit(component) {
        Ok(robot) => robot,
        Err(refusal) => panic!("refused: {refusal}"),
    };
    let maze = format::parse(maze::bundled()[0].text)
        .expect("bundled mazes parse")
        .maze;
    let rules = rules(*host.limits());
    let game = Game {
        maze: &maze,
        rules: &rules,
        seed: 0,
        setting: 0,
    };
    host.play(&robot, &game, recorder)
        .unwrap_or_else(|error| panic!("the host failed: {error}"))
}

/// The bundled flood robot plays on this host as it does on a host that has seen
/// nothing else.
#[track_caller]
pub fn assert_unharmed(host: &Host) {
    static UNHARMED: OnceLock<(Outcome, Digest)> = OnceLock::new();
    let flood = |host: &Host| {
        let mut recorder = Recorder::default();
        let robot = find("flood").expect("a bundled robot");
        let outcome = play(host, robot.component, &mut recorder);
        (outcome, Digest::of(&recorder.trace.identity_bytes()))
    };
    let expected = UNHARMED.get_or_init(|| flood(&self::host(Limits::default())));
    assert_eq!(expected.0.verdict.name(), "finished");
    assert_eq!(&flood(host), expected, "the next match is not as ever");
}
