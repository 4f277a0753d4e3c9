//! Small robots in WebAssembly text for the tests of verdicts and refusals, and a
//! good robot that has to play as ever beside them.

use std::sync::OnceLock;

use wasmouse::maze::{self, format};
use wasmouse::robot::bundled::find;
use wasmouse::robot::componentize::componentize;
use wasmouse::robot::{Digest, Game, Host, Outcome, Recorder};
use wasmouse::sim::{Limits, Ruleset};

/// Where [`Module`] keeps the action "straight, 1 cell" in its memory.
pub const DRIVE_ON: &str = "i32.const 16";

/// The parts of a robot in text. Each part is written in the text format, and what
/// is not given does what a harmless robot would do.
#[derive(Clone, Copy)]
pub struct Module<'a> {
    /// Body of `start`.
    pub start: &'a str,
    /// Body of `next-move`; leaves a pointer to the answer.
    pub next: &'a str,
    /// Imports of the module, which come first.
    pub imports: &'a str,
    /// The memory, which has to be exported under the name `memory`.
    pub memory: &'a str,
    /// More fields of the module.
    pub rest: &'a str,
}

impl Default for Module<'_> {
    fn default() -> Self {
        Self {
            start: "",
            next: DRIVE_ON,
            imports: "",
            memory: r#"(memory (export "memory") 1)"#,
            rest: "",
        }
    }
}

/// The parameters of `start`: the 13 numbers of the briefing.
pub const START_PARAMETERS: &str = "(param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)";

/// `log` of the journal as a module imports it: level, pointer, length.
pub const IMPORT_LOG: &str = r#"(import "wasmouse:robot/journal@0.1.0" "log"
    (func $log (param i32 i32 i32)))"#;

impl Module<'_> {
    /// The module as text.
    pub fn wat(&self) -> String {
        let Self {
            start,
            next,
            imports,
            memory,
            rest,
        } = self;
        format!(
            r#"(module
                {imports}
                {memory}
                ;; the action at 16: move, straight, 1
                (data (i32.const 16) "\00\01\01")
                {rest}
                (func (export "wasmouse:robot/controller@0.1.0#start")
                    {START_PARAMETERS} {start})
                (func (export "wasmouse:robot/controller@0.1.0#next-move")
                    (param i32 i32 i32) (result i32) {next}))"#
        )
    }

    /// The module in binary form.
    pub fn core(&self) -> Vec<u8> {
        wasm(&self.wat())
    }

    /// The robot: a component around the module.
    pub fn component(&self) -> Vec<u8> {
        componentize(&self.core()).unwrap_or_else(|error| panic!("{error}\n{}", self.wat()))
    }
}

/// The binary form of a module or component in text.
pub fn wasm(text: &str) -> Vec<u8> {
    wat::parse_str(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

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
