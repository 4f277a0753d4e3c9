//! The languages that compile to core modules: C, C++, Zig, AssemblyScript, WebAssembly text.

use super::{Project, is_complete, project};

/// The fault of a robot with a mistake, as `run` shows it.
#[track_caller]
fn fault_of(project: &Project) -> String {
    project.build();
    let ran = project.wasmouse("run mouse.wasm test_maze_01");
    ran.stdout + &ran.stderr
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
    project.succeed("make test");
    project.patch(
        "src/robot.c",
        "  if (tracker.run == RUN_SPEED)",
        "  robot_assert(tracker.steps_left > 990);\n  if (tracker.run == RUN_SPEED)",
    );
    check_fault(
        &project,
        "assertion failed: tracker.steps_left > 990 (src/robot.c:49)",
    );
}

#[test]
fn cpp_drives_as_flood() {
    let Some(project) = project("cpp", "cpp_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    project.succeed("make test");
    project.patch(
        "src/robot.cpp",
        "    if (tracker.run() == Run::speed)",
        "    if (tracker.steps_left() < 990) robot_panic(\"ten steps are enough\");\n    \
         if (tracker.run() == Run::speed)",
    );
    check_fault(&project, "ten steps are enough (src/robot.cpp:20)");
}

#[test]
fn zig_drives_as_flood() {
    let Some(project) = project("zig", "zig_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    project.succeed("python3 -m ziglang build test");
    // A safety check has no line, but the function is in the backtrace.
    project.patch(
        "src/robot.zig",
        "        const pose = robot.tracker.pose;",
        "        const pose = robot.tracker.pose;\n        \
         const table = [_]u32{ 1, 2, 3 };\n        \
         if (table[1000 - robot.tracker.steps_left] == 0) unreachable;",
    );
    let fault = fault_of(&project);
    assert!(
        fault.contains("index out of bounds: index 3, len 3"),
        "{fault}"
    );
    assert!(fault.contains("driveToGoal"), "{fault}");
    project.patch(
        "src/robot.zig",
        "if (table[1000 - robot.tracker.steps_left] == 0) unreachable;",
        "if (robot.tracker.steps_left < 997) wasmouse.fail(@src(), \"three steps, not {d}\");",
    );
    project.patch(
        "src/robot.zig",
        "const table = [_]u32{ 1, 2, 3 };\n        ",
        "",
    );
    check_fault(&project, "three steps, not {d} (robot.zig:");
}

#[test]
fn assemblyscript_drives_as_flood() {
    let Some(project) = project("assemblyscript", "assemblyscript_drives_as_flood") else {
        return;
    };
    is_complete(&project, "flood", true);
    project.succeed("npm test");
    project.patch(
        "assembly/robot.ts",
        "    if (this.tracker.run == Run.Speed)",
        "    if (this.tracker.stepsLeft < 997) throw new Error(\"three steps are enough\");\n    \
         if (this.tracker.run == Run.Speed)",
    );
    check_fault(&project, "three steps are enough (assembly/robot.ts:30:39)");
}

#[test]
fn wat_drives_as_the_wall_follower() {
    let Some(project) = project("wat", "wat_drives_as_the_wall_follower") else {
        return;
    };
    is_complete(&project, "wall-follower", true);
    project.patch(
        "robot.wat",
        "(if (i32.gt_u (local.get $variant) (i32.const 1))",
        "(if (i32.const 1)",
    );
    check_fault(&project, "the wall follower has the variants 0 and 1");
}
