//! End-to-end tests, one module per topic.
//!
//! Tests that need material from outside the repository find it through
//! [`shared`] and say `skipped: ...` where it is absent.

/// The `wasmouse` binary.
use wasmouse_tests::binary;

/// The cache of compiled robots, damaged and unusable.
mod cache;
/// The champion's promises: it finishes, its proofs hold, its training is clean.
mod champion;
/// What commands print, and how they fail.
mod cli;
/// What workers cannot do, tried from inside.
mod confinement;
/// The rules: recorded games and games written by hand.
mod conformance;
/// The core: few dependencies, and compiled for WebAssembly.
mod core_crate;
/// The same bytes from the same contest.
mod determinism;
/// Every bundled robot: native and component alike, and who has to finish.
mod every_robot;
/// Processes killed, disks full, compiled robots damaged.
mod faults;
/// Maze files: reading, round trips, and a survey counted in another way.
mod formats;
/// A short run of every fuzz target.
mod fuzz;
/// Robots in WebAssembly text, and a good one beside them.
mod hostile;
/// Ctrl-C in a contest.
mod interrupt;
/// Imports between the folders of the host.
mod layers;
/// Memory of the process, however many matches are played.
mod memory;
/// Minnett's robot in generated mazes.
mod minnett;
/// The prebuilt robots against their sources and their manifest.
mod prebuilt;
/// The check before compilation: limits, bombs, proposals.
mod precheck;
/// The README's tutorial and examples, run as they stand there.
mod readme;
/// `cargo xtask reference`: the numbers on its page.
mod reference;
/// Files that are no robots, and the reasons.
mod refusals;
/// The example robots, natively, in mazes of every size and shape.
mod robots_native;
/// The SDK's testing arena against the recorded vectors and the host's simulation.
mod sdk_arena;
/// Where the shared material is.
mod shared;
/// Optimal paths and the floor of the official mazes.
mod solver;
/// Closed pipes, full disks and terminals.
mod streams;
/// Robots that fail, and the verdicts on them.
mod verdicts;
/// Recorded results played again, and contests played twice.
mod verify;
/// The WIT against its history, and the SDK's bindings against the WIT.
mod wit;
/// A robot written with `wit-bindgen` alone.
mod without_sdk;
/// Robots in worker processes.
mod workers;
