//! End-to-end tests, one module per topic.
//!
//! Tests that need material from outside the repository find it through [`shared`] and are
//! reported as ignored where it is absent.

/// The `wasmouse` binary.
use wasmouse_tests::binary;

/// The page of the binary interface and the C header.
mod abi;
/// What admission admits, compiled and loaded by the engine.
mod admitted;
/// The cache of compiled robots: damaged, unusable, writable by others.
mod cache;
/// The champion: it finishes, its proofs hold, it was not trained on test mazes.
mod champion;
/// Release archives, installers, workflows, and scripts for graders.
mod ci;
/// The command line: output, files, exit codes.
mod cli;
/// Comparisons of robots: valid documents, and the figures of the reference page.
mod comparisons;
/// The rules: recorded matches and matches written by hand.
mod conformance;
/// Contests: killed, in shards, changed, watched, with hidden mazes.
mod contest;
/// Contest files: mistakes, the schema, the template, the documentation.
mod contest_file;
/// Reports of contests: snapshots, the JSON against its schema, the web page against a validator.
mod contest_report;
mod contest_text;
/// The core: few dependencies, and compiled for WebAssembly.
mod core_crate;
/// The hostile corpus, in this process.
mod corpus;
/// The same results from any number of jobs, in process and in workers.
mod determinism;
/// The same results on other processors, in an emulator.
mod emulation;
/// Every bundled robot: the same match natively, correct maps, and who must finish.
mod every_robot;
/// A failing robot: its own words, a match step by step, backtraces.
mod explain;
/// Killed processes, full disks, damaged files.
mod faults;
/// Results of every bundled robot, compared with a table to the last unit of fuel.
mod fingerprints;
/// Maze files: reading, round trips, and a survey counted in another way.
mod formats;
/// `wasmouse grade`: rubrics, robots of every kind, and all formats.
mod grade;
/// Text from outside: which code may take it out of its type.
mod guest_text;
/// Robots in WebAssembly text, and a good robot that plays after them.
mod hostile;
/// Names of files that mean something to a terminal or in a report.
mod hostile_names;
/// Ctrl-C during a contest.
mod interrupt;
/// Robots in every language, built with the real tools.
mod languages;
/// Imports between the folders of the host.
mod layers;
/// How the memory of this process is mapped after matches.
mod mappings;
/// Mazes, rules and match specifications for the other modules.
mod matches;
/// Memory use over many matches.
mod memory;
/// Minnett's robot in generated mazes.
mod minnett;
/// Good robots in a contest with every hostile one.
mod mixed_contest;
/// Pictures and plots: snapshots, pixels, animated files, hostile text.
mod pictures;
/// Where the objects in a JSON document are.
mod pointers;
/// The prebuilt robots against their sources and their manifest.
mod prebuilt;
/// The check before compilation: limits, bombs, proposals.
mod precheck;
/// Profiles: sums, names, faults, workers.
mod profile;
/// Robot projects, and files of results.
mod projects;
/// The commands of the README.
mod readme;
/// The depth of recursion, which depends on what code is compiled for.
mod recursion;
/// The page that compares the bundled robots with the published reports.
mod reference;
/// Rejections that depend on the limits or the version.
mod rejections;
/// Replays: written, audited, damaged.
mod replay;
/// The results document against its JSON Schema.
mod results_schema;
/// The example robots, natively, in mazes of every size and shape.
mod robots_native;
/// What workers cannot do, tried from inside.
mod sandbox;
/// The SDK's testing arena against the recorded matches and the host's simulation.
mod sdk_arena;
/// Where the shared material is.
mod shared;
/// A host that runs short of memory or descriptors during a match.
mod shortage;
/// Robots that take very long for their fuel.
mod slow;
/// Contests on hosts that lack memory, descriptors or cores.
#[cfg(unix)]
mod small_hosts;
/// Optimal paths and the oracle scores of the official mazes.
mod solver;
/// Stores whose writers are killed, and two writers.
mod store;
/// Results on standard output, and pipes that close.
mod streams;
/// Programs that fill the terminal, on a terminal.
mod terminals;
/// WebAssembly text as a robot.
mod text;
/// Pipes, links and hostile names in folders of submissions.
mod untrusted_files;
/// Verdicts that depend on the limits, and panics.
mod verdicts;
/// `wasmouse verify`: the same, reformatted, changed, or from another version.
mod verify;
/// Robots with WASI inside: what each function answers, and what cannot be reached.
mod wasi;
/// Web pages with a player: current, small, nothing hidden.
mod web;
/// The WIT against its history, and the SDK's bindings against the WIT.
mod wit;
/// A robot written with `wit-bindgen` alone.
mod without_sdk;
/// Robots in worker processes: the same results, whatever happens to the workers.
mod workers;
