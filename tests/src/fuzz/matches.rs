//! Whole matches with modules of any kind: every file ends in a refusal or a verdict, the
//! same twice, and harms no other match.

use std::sync::OnceLock;

use wasmouse::maze::{Maze, bundled, format};
use wasmouse::robot::bundled::find;
use wasmouse::robot::{Digest, Game, Host, Outcome, Recorder, Robot, Verdict};
use wasmouse::sim::{Limits, Ruleset};

use super::{Target, mutate, smith};
use crate::composite::Composite;
use crate::module::{Module, START_PARAMETERS};

pub(super) const TARGET: Target = Target {
    name: "matches",
    about: "whole matches of any modules, each twice",
    seeds,
    words: &[
        b"\x00\x00\x0b",
        b"\x41\x10\x0b",
        b"\x03\x40\x0c\0\x0b",
        b"\x40\0",
    ],
    bytes_max: 64 << 10,
    make: || {
        let mut table = Table::new();
        Box::new(move |bytes| table.run(bytes))
    },
    short: 60,
    takes_modules: true,
};

/// The rules of all matches here: short, with little fuel.
pub(super) fn rules() -> Ruleset {
    let rules = Ruleset::default();
    Ruleset {
        budget: 100,
        limits: Limits {
            start_fuel_max: 2_000_000,
            step_fuel_max: 2_000_000,
            match_fuel_max: 10_000_000,
            memory_bytes_max: 16 << 20,
            journal_bytes_max: 16 << 10,
            ..rules.limits
        },
        ..rules
    }
}

/// The maze of all matches here.
pub(super) fn maze() -> Maze {
    let first = &bundled()[0];
    format::parse(first.text).expect("a bundled maze").maze
}

/// A robot as it is in an input: a byte that says how it is wrapped, and its module.
pub(super) fn robot_file(input: &[u8]) -> Option<Vec<u8>> {
    let (&wrapping, module) = input.split_first()?;
    if wrapping % 2 == 0 {
        return Some(module.to_vec());
    }
    Some(driven(module))
}

/// Modules of wasm-smith, each as it is and driven, and robots.
pub(super) fn seeds() -> Vec<Vec<u8>> {
    let mut seeds = Vec::new();
    for module in smith::recorded() {
        for wrapping in [1, 0] {
            seeds.push([&[wrapping], module].concat());
        }
    }
    seeds.push([&[0][..], &Module::default().core()].concat());
    seeds
}

/// A robot that drives as the numbers tell that the module answers with: a module of
/// random instructions alone would seldom answer with a pointer to an action.
fn driven(module: &[u8]) -> Vec<u8> {
    let names = wasmouse::robot::componentize::CONTROLLER_EXPORTS;
    let imports = format!(
        r#"(import "guest" "{}" (func $start {START_PARAMETERS}))
           (import "guest" "{}" (func $next (param i32 i32 i32) (result i32)))"#,
        names[0], names[1]
    );
    let start: String = (0..14).map(|it| format!("local.get {it} ")).collect();
    // The text format has no place for a module in binary form.
    let before = r#"(core module $guest)
        (core instance $guest (instantiate $guest
            (with "wasmouse:robot/journal@VERSION" (instance $lowered))))"#;
    let composite = Composite {
        robot: Module {
            imports: &imports,
            start: &format!("{start} call $start"),
            next: "(local $told i32)
                (local.set $told
                    (call $next (local.get 0) (local.get 1) (local.get 2)))
                (i32.store8 (i32.const 16) (i32.eq
                    (i32.and (local.get $told) (i32.const 31)) (i32.const 31)))
                (i32.store8 (i32.const 17) (i32.rem_u
                    (i32.shr_u (local.get $told) (i32.const 5)) (i32.const 3)))
                (i32.store8 (i32.const 18) (i32.sub
                    (i32.and (i32.shr_u (local.get $told) (i32.const 8)) (i32.const 7))
                    (i32.const 3)))
                i32.const 16",
            ..Composite::default().robot
        },
        before,
        with: r#"(with "guest" (instance $guest))"#,
        ..Composite::default()
    };
    with_module(&composite.component(), module)
}

/// The component with another module in place of its second, the guest.
fn with_module(component: &[u8], module: &[u8]) -> Vec<u8> {
    const MODULE_SECTION: u8 = 1;
    let (header, mut rest) = component.split_at(8);
    let mut out = header.to_vec();
    let mut modules = 0;
    while let Some((&id, behind)) = rest.split_first() {
        let (length, behind) = variable_length(behind);
        let (mut content, behind) = behind.split_at(length);
        if id == MODULE_SECTION {
            modules += 1;
            if modules == 2 {
                content = module;
            }
        }
        let length = u64::try_from(content.len()).unwrap_or(u64::MAX);
        out.push(id);
        out.extend(mutate::variable_length(length));
        out.extend_from_slice(content);
        rest = behind;
    }
    out
}

/// A number of an encoder that never writes more than 5 bytes, and what follows it.
fn variable_length(bytes: &[u8]) -> (usize, &[u8]) {
    let last = bytes.iter().position(|byte| byte & 0x80 == 0);
    let (number, rest) = bytes.split_at(last.map_or(bytes.len(), |last| last + 1));
    let value = number
        .iter()
        .rev()
        .fold(0, |value, byte| (value << 7) | usize::from(byte & 0x7f));
    (value, rest)
}

struct Table {
    host: Host,
    rules: Ruleset,
    maze: Maze,
    flood: Robot,
    played: u32,
}

/// What may not differ between two matches.
type Played = (Outcome, Digest, String);

impl Table {
    fn new() -> Self {
        let rules = rules();
        let host = Host::new(rules.limits, 1, None).expect("address space for one match");
        let flood = find("flood").expect("a bundled robot").component;
        Self {
            flood: host.admit(flood).expect("a robot"),
            host,
            rules,
            maze: maze(),
            played: 0,
        }
    }

    fn run(&mut self, input: &[u8]) -> String {
        let Some(file) = robot_file(input) else {
            return "nothing to wrap".into();
        };
        let robot = match self.host.admit(&file) {
            Ok(robot) => robot,
            Err(refusal) => return format!("{}: {refusal}", refusal.name()),
        };
        let first = self.play(&robot);
        assert_eq!(first, self.play(&robot), "a second time");
        self.played += 1;
        if self.played.is_multiple_of(16) {
            static UNHARMED: OnceLock<Played> = OnceLock::new();
            let played = self.play(&self.flood);
            let expected = UNHARMED.get_or_init(|| {
                let fresh = Self::new();
                fresh.play(&fresh.flood)
            });
            assert_eq!(played, *expected, "a good robot afterwards");
        }
        let steps = first.0.steps[0].checked_ilog2();
        match &first.0.verdict {
            Verdict::Fault(fault) => {
                let detail = &fault.detail;
                format!(
                    "{} {:?} {steps:?}: {detail}",
                    fault.kind.name(),
                    fault.phase
                )
            }
            other => format!("{} {steps:?}", other.name()),
        }
    }

    fn play(&self, robot: &Robot) -> Played {
        let game = Game {
            maze: &self.maze,
            rules: &self.rules,
            seed: 1,
            setting: 0,
        };
        let mut recorder = Recorder::default();
        let played = self.host.play(robot, &game, &mut recorder);
        let outcome = played.unwrap_or_else(|error| panic!("the host failed: {error}"));
        let told = format!("{:?}", recorder.journal.entries().collect::<Vec<_>>());
        (outcome, recorder.trace_digest(), told)
    }
}
