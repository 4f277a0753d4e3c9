//! What the benchmarks play with: hosts, robots and mazes.

use wasmouse::maze::generate::GenSpec;
use wasmouse::maze::{Maze, bundled, format};
use wasmouse::robot::bundled::find;
use wasmouse::robot::componentize::componentize;
use wasmouse::robot::{
    Executable, Game, Host, Isolation, Outcome, PATIENCE, Recorder, Referee, Robot, Workers,
};
use wasmouse::sim::{Limits, Ruleset};

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

/// A host for that many matches at the same time, without a cache.
pub fn host(matches: u32) -> Host {
    Host::new(Limits::default(), matches, None).expect("address space for a few matches")
}

/// A referee for that many matches at the same time, without a cache, whose workers are
/// the binary that cargo built beside the benchmark.
pub fn referee(matches: u32) -> Referee {
    let workers = Workers {
        executable: Executable::at(env!("CARGO_BIN_EXE_wasmouse")),
        patience: PATIENCE,
        require_sandbox: false,
    };
    Referee::new(
        Ruleset::default(),
        matches,
        None,
        Isolation::Workers(workers),
    )
}

/// The component of the smallest robot.
pub fn driver() -> Vec<u8> {
    let module = wat::parse_str(DRIVER).expect("a constant module");
    componentize(&module).expect("it exports what a robot exports")
}

/// The bundled robot of that name.
pub fn robot(host: &Host, name: &str) -> Robot {
    let robot = find(name).expect("a bundled robot");
    host.admit(robot.component)
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
    specification.expand().collect()
}

/// Plays one match with seed 0.
pub fn play(
    host: &Host,
    robot: &Robot,
    (maze, setting): (&Maze, u32),
    rules: &Ruleset,
    recorder: &mut Recorder,
) -> Outcome {
    let game = Game {
        maze,
        rules,
        seed: 0,
        setting,
    };
    host.play(robot, &game, recorder).expect("the host works")
}
