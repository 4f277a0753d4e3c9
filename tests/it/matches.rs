//! Matches for tests: rules, mazes, specifications, and variants of bundled robots.

use std::path::PathBuf;
use std::sync::Arc;

use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, SandboxLimits};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{self, Maze, format};
use wasmouse_core::record::{MatchKey, MatchSpec};
use wasmouse_engine::bundled::BundledRobot;
use wasmouse_engine::sandbox::{Executable, PATIENCE, WorkerOptions};
use wasmouse_engine::{Cache, Control, InfrastructureError, Limits, Sandboxed, engine_id};

/// Kinds of generated mazes, from corridors to open spaces.
pub const KINDS: [&str; 6] = [
    "division",
    "tree,loops=0",
    "tree,loops=12",
    "tree,loops=60",
    "braid",
    "stretches",
];

/// The default ruleset with these sandbox limits.
pub fn rules(sandbox: SandboxLimits) -> Arc<Ruleset> {
    Arc::new(Ruleset {
        sandbox,
        ..Ruleset::default()
    })
}

/// An executor whose workers are that program, with the default rules.
///
/// # Errors
///
/// When it cannot start a worker.
pub fn sandboxed(
    executable: impl Into<PathBuf>,
    cache: Option<Cache>,
) -> Result<Sandboxed, InfrastructureError> {
    let options = WorkerOptions {
        executable: Executable::at(executable),
        patience: PATIENCE,
        require_sandbox: false,
        control: Control::default(),
    };
    let rules = rules(SandboxLimits::default());
    Sandboxed::new(rules, Limits::default(), options, cache)
}

/// A worker program: the real one, except before matches with the seeds that are named in
/// `tests/bin/faulty_worker.rs`.
pub const WORKER: &str = env!("CARGO_BIN_EXE_faulty-worker");

/// A match of that robot.
pub fn spec(
    rules: &Arc<Ruleset>,
    robot: &Digest,
    maze: &Arc<Maze>,
    (variant, seed): (u32, u64),
) -> MatchSpec {
    MatchSpec {
        key: MatchKey {
            engine: engine_id().digest(),
            rules: rules.digest(),
            robot: *robot,
            variant,
            maze: maze.digest(),
            seed,
        },
        maze: Arc::clone(maze),
        rules: Arc::clone(rules),
    }
}

/// The bundled mazes by name.
pub fn bundled_mazes() -> Vec<(&'static str, Arc<Maze>)> {
    let mazes = maze::bundled().iter().map(|it| {
        let parsed = format::parse(it.text).expect("bundled mazes parse");
        (it.name, Arc::new(parsed.maze))
    });
    mazes.collect()
}

/// The mazes of a specification such as `gen:braid:12:1..=10`, by name.
pub fn generated_mazes(spec: &str) -> impl Iterator<Item = (String, Arc<Maze>)> + use<> {
    let spec: GenSpec = spec.parse().expect("a specification");
    spec.expand()
        .map(|it| (it.to_string(), Arc::new(it.generate())))
}

/// The variants of a bundled robot by number and name.
pub fn variants(robot: &BundledRobot) -> Vec<(u32, &'static str)> {
    if robot.variants.is_empty() {
        return vec![(0, "0")];
    }
    let variants = robot.variants.iter();
    variants.map(|it| (it.value, it.name)).collect()
}
