//! The languages that compile to core modules: C, C++, Zig, AssemblyScript, WebAssembly text.

use std::fs;

use super::{Project, is_complete, prebuilt, project};

/// What replaces the check of the variant in the robot in Zig: a mistake for each.
const ZIG_MISTAKES: &str = include_str!("zig/mistakes.zig");

/// The fault of a robot with a mistake, as `run` shows it.
#[track_caller]
fn fault_of(project: &Project) -> String {
    project.build();
    let ran = project.wasmouse("run mouse.wasm test_maze_01");
    ran.stdout + &ran.stderr
}

/// Checks the prebuilt robot against the component that was just built.
#[track_caller]
fn is_prebuilt(project: &Project, language: &str) {
    let component = fs::read(project.component()).expect("a component");
    prebuilt::is_current(language, &component);
}

#[track_caller]
fn check_fault(project: &Project, expected: &str) {
    let fault = fault_of(project);
    assert!(fault.contains(expected), "{expected}: {fault}");
}

#[test]
fn c_drives_as_flood() {
    let Some(project) = project("c", "c_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    is_prebuilt(&project, "c");
    project.succeed("make test");
    project.patch(
        "src/robot.c",
        "  if (tracker.run == RUN_SPEED)",
        "  robot_assert(tracker.steps_left > 990);\n  if (tracker.run == RUN_SPEED)",
    );
    let line = project.line_of("src/robot.c", "robot_assert");
    let expected = format!("assertion failed: tracker.steps_left > 990 (src/robot.c:{line})");
    check_fault(&project, &expected);
    // A trap has no message of the robot's, but a line.
    project.patch(
        "src/robot.c",
        "robot_assert(tracker.steps_left > 990);",
        "static volatile unsigned rest; rest = 7 % (tracker.steps_left - 990);",
    );
    let line = project.line_of("src/robot.c", "rest = 7 %");
    let fault = fault_of(&project);
    for part in [
        "divided by zero in step 11".to_owned(),
        format!("failed at src/robot.c:{line}:"),
    ] {
        assert!(fault.contains(&part), "{part}: {fault}");
    }
}

#[test]
fn cpp_drives_as_flood() {
    let Some(project) = project("cpp", "cpp_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    is_prebuilt(&project, "cpp");
    project.succeed("make test");
    project.patch(
        "src/robot.cpp",
        "    if (tracker.run() == Run::speed)",
        "    if (tracker.steps_left() < 990) robot_panic(\"ten steps are enough\");\n    \
         if (tracker.run() == Run::speed)",
    );
    let line = project.line_of("src/robot.cpp", "ten steps are enough");
    check_fault(
        &project,
        &format!("ten steps are enough (src/robot.cpp:{line})"),
    );
}

#[test]
fn zig_drives_as_flood() {
    let Some(project) = project("zig", "zig_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    is_prebuilt(&project, "zig");
    project.succeed("python3 -m ziglang build test");
    let check = "        if (briefing.variant != 0) wasmouse.fail(@src(), \"this robot has only the \
                 variant 0\");\n";
    project.patch("src/robot.zig", check, ZIG_MISTAKES);
    project.build();
    for (variant, message, place) in [
        (1, "index out of bounds: index 1000, len 3", "an index"),
        (2, "integer overflow", "an overflow"),
        (3, "reached unreachable code", "the unreachable"),
        (4, "attempt to use null value", "a null"),
        (5, "integer does not fit in destination type", "a cast"),
        (6, "I give up", "a panic"),
        (7, "division by zero", "a division"),
    ] {
        let ran = project.wasmouse(&format!("run mouse.wasm:{variant} test_maze_01"));
        let fault = ran.stdout + &ran.stderr;
        let line = project.line_of("src/robot.zig", &format!("// {place}"));
        for part in [
            format!("panicked: {message} in `start`"),
            format!("failed at src/robot.zig:{line}:"),
        ] {
            assert!(fault.contains(&part), "{part}: {fault}");
        }
    }
    let ran = project.wasmouse("run mouse.wasm:8 test_maze_01");
    let line = project.line_of("src/robot.zig", "only the variants 0 to 7");
    let expected = format!("only the variants 0 to 7 (robot.zig:{line}:");
    let fault = ran.stdout + &ran.stderr;
    assert!(fault.contains(&expected), "{fault}");
}

#[test]
fn assemblyscript_drives_as_flood() {
    let Some(project) = project("assemblyscript", "assemblyscript_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    is_prebuilt(&project, "assemblyscript");
    project.succeed("npm test");
    project.patch(
        "assembly/robot.ts",
        "    if (this.tracker.run == Run.Speed)",
        "    if (this.tracker.stepsLeft < 997) throw new Error(\"three steps are enough\");\n    \
         if (this.tracker.run == Run.Speed)",
    );
    let line = project.line_of("assembly/robot.ts", "three steps are enough");
    check_fault(
        &project,
        &format!("three steps are enough (assembly/robot.ts:{line}:"),
    );
}

#[test]
fn wat_drives_as_the_wall_follower() {
    let Some(project) = project("wat", "wat_drives_as_the_wall_follower") else {
        return;
    };
    is_complete(&project, "wall-follower", true);
    is_prebuilt(&project, "wat");
    project.patch(
        "robot.wat",
        "(if (i32.gt_u (local.get $variant) (i32.const 1))",
        "(if (i32.const 1)",
    );
    check_fault(&project, "the wall follower has the variants 0 and 1");
}

/// The templates have the header that is generated from the WIT.
#[test]
fn templates_have_the_header_of_the_interface() {
    let root = xtask::repository();
    let header = fs::read_to_string(root.join("wit/wasmouse.h")).expect("the header");
    for language in ["c", "cpp"] {
        let copy = format!("example-robots/languages/{language}/wasmouse/wasmouse.h");
        let text = fs::read_to_string(root.join(&copy)).expect("a copy");
        assert!(text == header, "copy wit/wasmouse.h to {copy}");
    }
}

/// With `--target=wasm32-wasi` there is a standard library, and what it asks of an operating system
/// is answered inside the robot.
#[test]
fn c_has_its_library_when_asked() {
    let Some(project) = project("c", "c_has_its_library_when_asked") else {
        return;
    };
    project.patch("compile_flags.txt", "wasm32-unknown-unknown", "wasm32-wasi");
    project.patch(
        "src/robot.c",
        "#include \"wasmouse/robot.h\"",
        "#include <stdio.h>\n#include \"wasmouse/robot.h\"",
    );
    project.patch(
        "src/robot.c",
        "  tracker_init(&tracker, briefing);",
        "  printf(\"a budget of %u\\n\", briefing->budget);\n  tracker_init(&tracker, briefing);",
    );
    project.build();
    project.drives_as("flood", &["test_maze_01".to_owned()]);
    let ran = project.wasmouse("run mouse.wasm test_maze_01 --log");
    let log = ran.stdout + &ran.stderr;
    assert!(log.contains("a budget of 1000"), "{log}");
}

/// The constructors of global objects run once, before `start`.
#[test]
fn cpp_has_its_library_when_asked() {
    let Some(project) = project("cpp", "cpp_has_its_library_when_asked") else {
        return;
    };
    project.patch("compile_flags.txt", "wasm32-unknown-unknown", "wasm32-wasi");
    project.patch(
        "src/robot.cpp",
        "using namespace wasmouse;",
        "#include <vector>\nusing namespace wasmouse;\nstatic std::vector<int> table = {1, 2, 3};",
    );
    project.patch(
        "src/robot.cpp",
        "    tracker = Tracker(briefing);",
        "    table.push_back(4);\n    robot_assert(table.size() == 4);\n    \
         tracker = Tracker(briefing);",
    );
    project.build();
    project.drives_as("flood", &["test_maze_01".to_owned()]);
}
