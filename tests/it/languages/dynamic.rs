//! The languages that bring a runtime and need WASI: Go, Python, JavaScript, TypeScript.
//!
//! Most of them are slow to build, so each is built as few times as possible.

use std::fs;

use super::{NAME, Project, generated_mazes, is_complete, official_mazes, project};

/// The contest mazes, 100 generated ones, and the largest that cost most. Playing them takes less time than compiling the robot
/// once.
fn all_mazes() -> Vec<String> {
    let largest = vec!["gen:division:20:1..=3".to_owned()];
    [official_mazes(), generated_mazes(), largest].concat()
}

/// The number of the only line of a file that contains a text.
#[track_caller]
fn line_of(project: &Project, file: &str, text: &str) -> usize {
    let source = fs::read_to_string(project.folder().join(file)).expect("a file of the project");
    let lines: Vec<usize> = (1..)
        .zip(source.lines())
        .filter(|(_, line)| line.contains(text))
        .map(|(number, _)| number)
        .collect();
    assert_eq!(lines.len(), 1, "{file}: {text}");
    lines[0]
}

/// Checks that a match of the built robot in that variant ends with this panic, and that the line
/// with `place` in a source is the one that is shown.
#[track_caller]
fn check_panic(project: &Project, variant: u32, message: &str, file: &str, place: &str) {
    let ran = project.wasmouse(&format!("run {NAME}.wasm:{variant} test_maze_01"));
    let shown = ran.stdout + &ran.stderr;
    let line = line_of(project, file, place);
    let expected = format!("{message} ({file}:{line}");
    assert!(shown.contains(&expected), "{expected}: {shown}");
}

/// Two plays are the same to the last unit of fuel.
#[track_caller]
fn is_deterministic(project: &Project) {
    let play = || project.records(&format!("{NAME}.wasm"), &["test_maze_01".to_owned()]);
    assert_eq!(play(), play());
}

#[test]
fn go_drives_as_flood() {
    let Some(project) = project("go", "go_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    is_deterministic(&project);
    project.succeed("go vet ./...");
    project.succeed("go test ./...");
    let unknown = "this robot has only variant 0";
    check_panic(&project, 1, unknown, "robot.go", unknown);
    // An error of the runtime, in the middle of a match.
    project.patch(
        "robot.go",
        "\tnews := f.tracker.Observe(sensors)\n",
        "\tif f.tracker.StepsLeft() < 990 {\n\t\t_ = f.goal[f.tracker.StepsLeft()]\n\t}\n\
         \tnews := f.tracker.Observe(sensors)\n",
    );
    project.build();
    let message = "runtime error: index out of range [989] with length 4";
    check_panic(&project, 0, message, "robot.go", "_ = f.goal[");
}

#[test]
fn javascript_drives_as_flood() {
    let Some(project) = project("javascript", "javascript_drives_as_flood") else {
        return;
    };
    project.build();
    project.drives_as("flood", &all_mazes());
    is_deterministic(&project);
    project.succeed("npm test");
    let unknown = "RangeError: this robot has only variant 0";
    check_panic(&project, 1, unknown, "src/robot.js", "has only variant 0");
    project.patch(
        "src/robot.js",
        "    const news = this.tracker.observe(sensors);\n",
        "    if (this.tracker.stepsLeft < 990) this.tracker.missing();\n    \
         const news = this.tracker.observe(sensors);\n",
    );
    project.build();
    let message = "TypeError: not a function";
    check_panic(
        &project,
        0,
        message,
        "src/robot.js",
        "this.tracker.missing()",
    );
}

#[test]
fn typescript_drives_as_flood() {
    let Some(project) = project("typescript", "typescript_drives_as_flood") else {
        return;
    };
    project.build();
    project.drives_as("flood", &all_mazes());
    is_deterministic(&project);
    project.succeed("npm test");
    let unknown = "RangeError: this robot has only variant 0";
    check_panic(&project, 1, unknown, "src/robot.ts", "has only variant 0");
    let doctor = project.wasmouse("doctor typescript");
    assert!(doctor.status.success(), "{}", doctor.stdout);
}

#[test]
fn python_drives_as_flood() {
    let Some(project) = project("python", "python_drives_as_flood") else {
        return;
    };
    project.build();
    project.drives_as("flood", &all_mazes());
    is_deterministic(&project);
    project.succeed("python3 -m unittest");
    let unknown = "ValueError: this robot has only variant 0";
    check_panic(&project, 1, unknown, "robot.py", "has only variant 0");
    let doctor = project.wasmouse("doctor python");
    assert!(doctor.status.success(), "{}", doctor.stdout);
}

/// JavaScript on the other engine.
#[test]
fn starlingmonkey_drives_as_flood() {
    let test = "starlingmonkey_drives_as_flood";
    let Some(project) = project("starlingmonkey", test) else {
        return;
    };
    project.build();
    project.drives_as("flood", &all_mazes());
    is_deterministic(&project);
    let unknown = "RangeError: this robot has only variant 0";
    check_panic(&project, 1, unknown, "src/robot.js", "has only variant 0");
}
