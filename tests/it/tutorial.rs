//! The README's tutorial: from nothing to a robot with a score.

use std::process::Command;

use crate::binary::{stdout_of, wasmouse};

#[test]
fn a_new_robot_builds_and_passes_its_tests() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // The project has a target folder of its own: the one of this repository
    // may be in use by the cargo that runs this test.
    let target = folder.path().join("target");
    let new = stdout_of(
        wasmouse()
            .args(["new", "my-robot"])
            .current_dir(folder.path()),
    );
    assert!(new.contains("wasmouse build my-robot"), "{new}");

    let built = stdout_of(
        wasmouse()
            .args(["build", "my-robot"])
            .current_dir(folder.path())
            .env("CARGO_TARGET_DIR", &target),
    );
    assert!(built.starts_with("my-robot/my-robot.wasm: "), "{built}");
    assert!(built.ends_with("imports nothing\n"), "{built}");
    let project = folder.path().join("my-robot");
    assert!(project.join("my-robot.wasm").is_file());

    let tests = stdout_of(
        Command::new(env!("CARGO"))
            .arg("test")
            .current_dir(&project)
            .env("CARGO_TARGET_DIR", &target),
    );
    assert!(tests.contains("finishes_the_first_maze ... ok"), "{tests}");
}
