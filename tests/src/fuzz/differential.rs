//! The same robot on differently set up engines: with fuel and without, optimised and
//! not, from the pool and on demand.

use wasmouse::maze::Maze;
use wasmouse::robot::componentize::{BinaryKind, componentize};
use wasmouse::robot::{FaultKind, Game, Host, Recorder, Verdict};
use wasmouse::sim::Ruleset;

use super::variants::Variant;
use super::{Target, matches};

pub(super) const TARGET: Target = Target {
    name: "differential",
    about: "the same matches on differently set up engines",
    seeds: matches::seeds,
    words: &[b"\x00\x00\x0b", b"\x41\x10\x0b", b"\x03\x40\x0c\0\x0b"],
    bytes_max: 64 << 10,
    make: || {
        let bench = Bench::new(matches::rules());
        Box::new(move |input| match matches::robot_file(input) {
            Some(file) => bench.compare(&file, &matches::maze()),
            None => "nothing to wrap".into(),
        })
    },
    short: 60,
    takes_modules: true,
};

/// A host and engines to compare it with.
pub struct Bench {
    host: Host,
    rules: Ruleset,
    variants: Vec<Variant>,
}

impl Bench {
    /// Engines for matches by these rules.
    ///
    /// # Panics
    ///
    /// When the machine cannot give the address space.
    pub fn new(rules: Ruleset) -> Self {
        Self {
            host: Host::new(rules.limits, 1, None).expect("address space for one match"),
            variants: Variant::all(&rules).expect("address space for all variants"),
            rules,
        }
    }

    /// Plays a match on all of them and says how it ended.
    ///
    /// # Panics
    ///
    /// When one of them sees other answers.
    pub fn compare(&self, file: &[u8], maze: &Maze) -> String {
        let robot = match self.host.admit(file) {
            Ok(robot) => robot,
            Err(refusal) => return refusal.name().to_owned(),
        };
        let game = Game {
            maze,
            rules: &self.rules,
            seed: 5,
            setting: 0,
        };
        let mut recorder = Recorder::default();
        let outcome = self.host.play(&robot, &game, &mut recorder);
        let outcome = outcome.unwrap_or_else(|error| panic!("the host failed: {error}"));
        let failure = match &outcome.verdict {
            Verdict::Fault(fault) if is_of_limits(fault.kind) => {
                return format!("limited by {}", fault.kind.name());
            }
            Verdict::Fault(fault) => Some(fault.kind.name()),
            Verdict::Finished(_) | Verdict::BudgetUsedUp { .. } => None,
        };
        let steps = recorder.trace.steps().iter();
        let actions: Vec<_> = steps.map(|step| step.action).collect();
        let component = match BinaryKind::of(file) {
            BinaryKind::CoreModule => componentize(file).expect("it was admitted"),
            BinaryKind::Component | BinaryKind::Other => file.to_vec(),
        };
        let mut first = None;
        for variant in &self.variants {
            let played = variant.play(&component, (maze, &self.rules), (game.seed, game.setting));
            let moves = played.unwrap_or_else(|error| panic!("{}: {error:#}", variant.name));
            assert_eq!(moves.actions, actions, "{}", variant.name);
            assert_eq!(
                moves.failure.is_some(),
                failure.is_some(),
                "{}: {:?}, {failure:?}",
                variant.name,
                moves.failure
            );
            let expected = first.get_or_insert(moves.failure);
            assert_eq!(moves.failure, *expected, "{}", variant.name);
        }
        let steps = actions.len().checked_ilog2().unwrap_or(0);
        let steps = char::from(b'a' + u8::try_from(steps).unwrap_or(25));
        format!("{} {failure:?} {steps}", outcome.verdict.name())
    }
}

/// Whether the verdict is about a limit: without fuel there is none, the player has
/// none of memory, and the size of stack frames differs with optimisation.
const fn is_of_limits(kind: FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::OutOfFuel(_)
            | FaultKind::MemoryLimit
            | FaultKind::TableLimit
            | FaultKind::StackOverflow
    )
}
