//! What the benchmarks play with: runtimes, robots and mazes.

use std::sync::Arc;

use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, Verdict};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Maze, bundled, format};
use wasmouse_core::record::{FuelUse, MatchKey, MatchSpec};
use wasmouse_engine::admission::componentize;
use wasmouse_engine::bundled::find;
use wasmouse_engine::sandbox::{Executable, PATIENCE, WorkerOptions};
use wasmouse_engine::{CompiledRobot, Control, Limits, Recording, Runtime, engine_id};

/// The smallest robot that drives: one cell ahead, or a turn to the right at a wall.
const DRIVER: &str = r#"(module
    (memory (export "memory") 1)
    (func (export "wasmouse:robot/controller@0.2.0#start")
        (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))
    (func (export "wasmouse:robot/controller@0.2.0#next-move")
        (param $left i32) (param $front i32) (param $right i32) (result i32)
        (local $clear i32)
        (local.set $clear (i32.ne (local.get $front) (i32.const 0)))
        ;; A move (0 at 16, as the memory is zeroed): turn at 17, advance at 18.
        (i32.store8 (i32.const 17) (i32.sub (i32.const 2) (local.get $clear)))
        (i32.store8 (i32.const 18) (local.get $clear))
        (i32.const 16)))"#;

/// A runtime for one match at a time, without a cache.
pub fn runtime() -> Runtime {
    Runtime::new(Limits::default(), 1, None).expect("address space for a match")
}

/// Workers that are the binary that cargo built beside the benchmark.
pub fn workers() -> WorkerOptions {
    WorkerOptions {
        executable: Executable::at(env!("CARGO_BIN_EXE_wasmouse")),
        patience: PATIENCE,
        require_sandbox: false,
        control: Control::default(),
    }
}

/// The component of the smallest robot.
pub fn driver() -> Vec<u8> {
    let module = wat::parse_str(DRIVER).expect("a constant module");
    componentize(&module).expect("it exports what a robot exports")
}

/// The bundled robot of that name.
pub fn robot(runtime: &Runtime, name: &str) -> CompiledRobot {
    let robot = find(name).expect("a bundled robot");
    runtime
        .admit(robot.component)
        .expect("bundled robots are admitted")
}

/// Mazes that matches are measured in: the official one, and three of 16 x 16 that
/// differ in kind.
pub fn match_mazes() -> Vec<(String, Maze)> {
    let official = format::parse(bundled()[0].text).expect("bundled mazes parse");
    let mut mazes = vec![(bundled()[0].name.to_owned(), official.maze)];
    for specification in ["gen:division:16:1", "gen:tree:16:1", "gen:braid:16:1"] {
        mazes.extend(generated(specification));
    }
    mazes
}

/// The mazes of a specification, with their names.
pub fn generated(specification: &str) -> Vec<(String, Maze)> {
    let specification: GenSpec = specification.parse().expect("a specification");
    let mazes = specification.expand();
    mazes
        .map(|maze| (maze.to_string(), maze.generate()))
        .collect()
}

/// A match with seed 0.
pub fn spec(
    robot: &CompiledRobot,
    (maze, variant): (&Maze, u32),
    rules: &Arc<Ruleset>,
) -> MatchSpec {
    MatchSpec {
        key: MatchKey {
            engine: engine_id().digest(),
            rules: rules.digest(),
            robot: *robot.digest(),
            variant,
            maze: Digest::of(&maze.identity_bytes()),
            seed: 0,
        },
        maze: Arc::new(maze.clone()),
        rules: Arc::clone(rules),
    }
}

/// Plays a match.
pub fn play(
    runtime: &Runtime,
    robot: &CompiledRobot,
    spec: &MatchSpec,
    recording: &mut Recording,
) -> (Verdict, FuelUse) {
    let ran = runtime.run(robot, spec, recording);
    let (result, usage) = ran.expect("the host works");
    (result.verdict, usage.fuel)
}
