//! Rust for the targets that have WASI: the standard library prints, tells the time and draws random
//! numbers, and the robot drives as the bundled one.

use std::fs;
use std::io;
use std::path::Path;

use wasmouse_tests::rust_wasi;

use super::{NAME, Project, generated_mazes, official_mazes, project};
use crate::binary::Ran;

/// Uses the standard library and leaves driving to the bundled robot.
const ROBOT: &str = include_str!("rust_std/robot.rs");

/// A project for the target of a kit, which `choose` makes its own, with [`ROBOT`] and the bundled robot as a module of it.
fn robot_for(
    kit: &'static str,
    choose: fn(&str, &Path) -> io::Result<()>,
    test: &str,
) -> Option<(Project, String)> {
    let project = project(kit, test)?;
    let target = rust_wasi::target_of(kit).expect("a kit of Rust");
    let folder = project.folder();
    choose(&target, &folder).expect("a file of the project");
    // Only one robot of a crate can be exported.
    let flood = rust_wasi::flood().replace("export_robot!(Flood);\n", "");
    let flood = flood.replace(" export_robot,", "");
    assert!(!flood.contains("export_robot"), "{flood}");
    fs::write(folder.join("src/flood.rs"), flood).expect("a module");
    fs::write(folder.join("src/lib.rs"), ROBOT).expect("a robot");
    Some((project, target))
}

/// What a match of the robot in `file` writes and how it ends.
fn shown(project: &Project, file: &str, seed: u32) -> String {
    let Ran { stdout, stderr, .. } =
        project.wasmouse(&format!("run {file} test_maze_01 --log --seed {seed}"));
    stdout + &stderr
}

/// Checks that the log has a line, with its step and level.
#[track_caller]
fn check_line(log: &str, line: &str) {
    let is_there = log.lines().any(|it| it.trim() == line);
    assert!(is_there, "{line}: {log}");
}

/// The order in which a map with random keys has its elements.
fn order(log: &str) -> String {
    let found = log.lines().find(|it| it.contains(" order "));
    let order = found.unwrap_or_else(|| panic!("{log}")).trim();
    assert_eq!(
        order.matches(|c: char| c.is_ascii_digit()).count(),
        9,
        "{order}"
    );
    order.to_owned()
}

/// What holds for both targets. Returns what the panics of the other variants are.
#[track_caller]
fn plays_with_wasi(project: &Project, target: &str) -> [String; 3] {
    // The project's own component, and the file that cargo writes.
    let Ran { status, stderr, .. } = project.wasmouse("build");
    assert!(status.success(), "{stderr}");
    let cargo = format!("cargo build --quiet --release --target {target}");
    project.succeed(&cargo);
    let folder = project.folder();
    let file = folder.with_file_name("target").join(target);
    let module = file.join("release").join(NAME).with_extension("wasm");
    fs::copy(module, folder.join("cargo.wasm")).expect("the file of cargo");
    let Ran { status, stderr, .. } =
        project.wasmouse("build cargo.wasm --no-match --output built.wasm");
    assert!(status.success(), "{stderr}");

    let maze = ["test_maze_01".to_owned()];
    let records = |file: &str| project.records(file, &maze);
    let (once, again) = (records("mouse.wasm"), records("mouse.wasm"));
    assert_eq!(once, again, "the same match has another trace or fuel");
    assert_eq!(
        once[0]["transcript"],
        records("built.wasm")[0]["transcript"]
    );
    project.drives_as("flood", &[official_mazes(), generated_mazes()].concat());

    let log = shown(project, "mouse.wasm", 0);
    check_line(&log, "0 info    variant 0");
    check_line(&log, "0 error   0 arguments, 0 variables");
    check_line(&log, "0 info    reading: NotFound, writing: NotFound");
    check_line(&log, "0 info    slept for 60 s");
    check_line(&log, "0 info    0 years after 1970");
    // Random numbers follow from the seed and from nothing else.
    assert_eq!(order(&log), order(&shown(project, "built.wasm", 0)));
    assert_ne!(order(&log), order(&shown(project, "mouse.wasm", 1)));
    [1, 2, 3].map(|variant| shown(project, &format!("mouse.wasm:{variant}"), 0))
}

#[track_caller]
fn check_panic(shown: &str, expected: &str) {
    let expected = format!("panicked: {expected}");
    assert!(shown.contains(&expected), "{expected}: {shown}");
}

#[test]
fn rust_has_its_standard_library_on_preview_1() {
    let test = "rust_has_its_standard_library_on_preview_1";
    let Some((project, target)) = robot_for("rust-wasip1", rust_wasi::choose, test) else {
        return;
    };
    let [exit, panic, network] = plays_with_wasi(&project, &target);
    check_panic(&exit, "exited with code 3: 0 arguments, 0 variables");
    let line = project.line_of("src/lib.rs", "table[\"missing\"]");
    check_panic(
        &panic,
        &format!("no entry found for key (src/lib.rs:{line}:"),
    );
    // The standard library does not even ask.
    check_line(&network, "0 info    no network: Unsupported");
    // A core module is a robot as it is.
    assert!(shown(&project, "cargo.wasm", 0).contains("finished"));
}

#[test]
fn rust_has_its_standard_library_on_preview_2() {
    let test = "rust_has_its_standard_library_on_preview_2";
    let Some((project, target)) = robot_for("rust-wasip2", rust_wasi::configure, test) else {
        return;
    };
    let [exit, panic, network] = plays_with_wasi(&project, &target);
    // `wasi:cli/exit` has success and failure only.
    check_panic(&exit, "exited with code 1: 0 arguments, 0 variables");
    let line = project.line_of("src/lib.rs", "table[\"missing\"]");
    check_panic(
        &panic,
        &format!("no entry found for key (src/lib.rs:{line}:"),
    );
    check_panic(
        &network,
        "called `wasi:sockets/tcp-create-socket#create-tcp-socket`",
    );
    // Between the robot and the fault is what answers WASI.
    let frames = network.split("(most recent call first):").nth(1);
    let first = frames.and_then(|it| it.trim_start().lines().next());
    assert_eq!(
        first.map(|it| it.ends_with("frames of the C library")),
        Some(true),
        "{network}"
    );
    // What cargo writes imports WASI, and the hint says what to do.
    let rejected = shown(&project, "cargo.wasm", 0);
    assert!(
        rejected.contains("`wasmouse build FILE.wasm`"),
        "{rejected}"
    );
}
