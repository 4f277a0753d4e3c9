//! The boundary between host and robot: a typed call by wasmtime alone, the same
//! call as a step of a match, and a fresh instance up to its first answer.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use wasmouse_core::game::{GameRules, Ruleset};
use wasmouse_core::record::{MatchSpec, trace};
use wasmouse_engine::admission::INTERFACE_VERSION;
use wasmouse_engine::{CompiledRobot, Limits, Recording, Runtime, engine_config};
use wasmtime::component::{Component, ComponentType, Lift, Linker, Lower, TypedFunc};
use wasmtime::{Engine, Store};

use super::stage;

/// The readings of `wit/robot.wit`, declared again: the bare call shares nothing
/// with the host but the configuration of the engine.
#[derive(Clone, Copy, ComponentType, Lower)]
#[component(record)]
pub struct Readings {
    left: u32,
    front: u32,
    right: u32,
}

#[derive(Clone, Copy, ComponentType, Lift)]
#[component(enum)]
#[repr(u8)]
#[expect(dead_code, reason = "the robot makes them")]
enum Turn {
    #[component(name = "left")]
    Left,
    #[component(name = "straight")]
    Straight,
    #[component(name = "right")]
    Right,
}

#[derive(Clone, Copy, ComponentType, Lift)]
#[component(record)]
#[expect(dead_code, reason = "only lifted")]
struct Move {
    turn: Turn,
    advance: i8,
}

#[derive(Clone, Copy, ComponentType, Lift)]
#[component(variant)]
#[expect(dead_code, reason = "only lifted")]
enum Action {
    #[component(name = "move")]
    Move(Move),
    #[component(name = "reset")]
    Reset,
}

/// A robot called by wasmtime alone: no limits, no simulation, fuel set once.
pub struct Bare {
    store: Store<()>,
    next_move: TypedFunc<(Readings,), (Action,)>,
}

impl Bare {
    /// An instance of the component, in an engine like the host's.
    pub fn new(component: &[u8]) -> Self {
        let engine = Engine::new(&engine_config(&Limits::default(), 1)).expect("the host's engine");
        let component = Component::from_binary(&engine, component).expect("a component");
        let mut store = Store::new(&engine, ());
        store.set_fuel(u64::MAX).expect("fuel is on");
        store.set_epoch_deadline(1);
        let mut linker = Linker::new(&engine);
        // Robots import `panic` of the journal, and this one does not call it.
        linker
            .define_unknown_imports_as_traps(&component)
            .expect("an empty linker");
        let instance = linker
            .instantiate(&mut store, &component)
            .expect("a robot that needs no journal");
        let controller = format!("wasmouse:robot/controller@{INTERFACE_VERSION}");
        let controller = instance
            .get_export_index(&mut store, None, &controller)
            .expect("a robot");
        let next_move = instance
            .get_export_index(&mut store, Some(&controller), "next-move")
            .expect("a robot");
        let next_move = instance
            .get_typed_func(&mut store, next_move)
            .expect("the signature of the contract");
        Self { store, next_move }
    }

    /// One typed call for each of the readings.
    pub fn answer(&mut self, readings: &[Readings]) {
        for &readings in readings {
            let answer = self.next_move.call(&mut self.store, (readings,));
            black_box(&answer.expect("the robot answers"));
        }
    }
}

/// A robot in the first maze, ready to be played.
pub struct Drive {
    runtime: Runtime,
    robot: CompiledRobot,
    spec: MatchSpec,
    recording: Recording,
}

impl Drive {
    /// Admits the robot of that component.
    pub fn new(component: &[u8]) -> Self {
        Self::with_rules(component, GameRules::default())
    }

    /// The same with a budget of that many steps.
    pub fn with_budget(component: &[u8], budget: u32) -> Self {
        let rules = GameRules {
            budget,
            ..GameRules::default()
        };
        Self::with_rules(component, rules)
    }

    fn with_rules(component: &[u8], game: GameRules) -> Self {
        let runtime = stage::runtime();
        let robot = runtime.admit(component).expect("an admissible robot");
        let (_, maze) = stage::match_mazes().swap_remove(0);
        let rules = Ruleset {
            game,
            ..Ruleset::default()
        };
        Self {
            spec: stage::spec(&robot, (&maze, 0), &rules.into()),
            runtime,
            robot,
            recording: Recording::default(),
        }
    }

    /// One match.
    pub fn play(&mut self) {
        let recording = &mut self.recording;
        black_box(stage::play(
            &self.runtime,
            &self.robot,
            &self.spec,
            recording,
        ));
    }

    /// What the robot saw in its last match.
    pub fn readings(&self) -> Vec<Readings> {
        let MatchSpec { maze, rules, .. } = &self.spec;
        let transcript = &self.recording.transcript;
        let (_, trace) = trace(maze, &rules.game, transcript).expect("a match by the rules");
        let steps = trace.steps().iter();
        let seen = steps.map(|step| Readings {
            left: step.sensors.left.into(),
            front: step.sensors.front.into(),
            right: step.sensors.right.into(),
        });
        seen.collect()
    }
}

/// `boundary/...`: times are for one step.
pub fn bench(criterion: &mut Criterion) {
    let driver = stage::driver();
    let mut drive = Drive::new(&driver);
    drive.play();
    let readings = drive.readings();
    let mut bare = Bare::new(&driver);

    let mut group = criterion.benchmark_group("boundary");
    group.throughput(Throughput::Elements(readings.len() as u64));
    group.bench_function("1000 bare typed calls", |b| {
        b.iter(|| bare.answer(&readings));
    });
    group.bench_function("1000 steps of a match", |b| b.iter(|| drive.play()));
    group.finish();

    let mut group = criterion.benchmark_group("first answer");
    let mut smallest = Drive::with_budget(&driver, 1);
    group.bench_function("smallest robot", |b| b.iter(|| smallest.play()));
    let flood = wasmouse_engine::bundled::find("flood").expect("a bundled robot");
    let mut flood = Drive::with_budget(flood.component, 1);
    group.bench_function("flood", |b| b.iter(|| flood.play()));
    group.finish();
}
