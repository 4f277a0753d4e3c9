//! A host that is short of memory or descriptors: a match ends as it would otherwise, or as an
//! infrastructure error, and never in another way.

#![cfg(target_os = "linux")]

use std::fs;
use std::process::Command;

use wasmouse_engine::bundled::find;

use crate::hostile::Module;

/// What the program `shortage` prints of a robot.
fn outcome(file: &[u8], what: &str, moment: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("robot.wasm");
    fs::write(&path, file).expect("a file");
    let output = Command::new(env!("CARGO_BIN_EXE_shortage"))
        .args([what, moment])
        .arg(path)
        .output()
        .expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what} {moment}: {stderr}");
    String::from_utf8(output.stdout).expect("text")
}

/// Plays a robot with enough of everything, and then short of something, when it has to fail for
/// the host's reasons.
#[track_caller]
fn check(file: &[u8], what: &str, moment: &str) {
    let enough = outcome(file, "nothing", moment);
    assert!(enough.starts_with("played: "), "{enough}");
    let short = outcome(file, what, moment);
    assert!(short.starts_with("failed: "), "{what} {moment}: {short}");
}

/// Grows its memory by that many pages in its first step, and turns around if it cannot.
fn growing(pages: u32) -> Vec<u8> {
    Module {
        rest: r#"(data (i32.const 32) "\00\00\00") (global $at (mut i32) (i32.const 0))"#,
        next: &format!(
            "(if (i32.eqz (global.get $at)) (then
                (global.set $at (i32.const 16))
                (if (i32.eq (memory.grow (i32.const {pages})) (i32.const -1))
                    (then (global.set $at (i32.const 32))))))
             global.get $at"
        ),
        ..Module::default()
    }
    .component()
}

#[test]
fn growth_that_the_host_cannot_provide_is_not_played_on() {
    check(&growing(1000), "data", "before-match");
}

#[test]
fn growth_that_the_host_can_provide_is_the_same() {
    let growing = growing(100);
    let enough = outcome(&growing, "nothing", "before-match");
    assert_eq!(outcome(&growing, "data", "before-match"), enough);
}

#[test]
fn an_initial_memory_that_the_host_cannot_provide_is_no_fault() {
    let large = Module {
        memory: r#"(memory (export "memory") 1000)"#,
        ..Module::default()
    };
    check(&large.component(), "data", "before-match");
}

/// The image of a robot's memory takes a descriptor.
#[test]
fn a_lack_of_descriptors_is_no_fault() {
    for moment in ["before-admission", "before-match"] {
        check(&Module::default().component(), "descriptors", moment);
    }
    let flood = find("flood").expect("a bundled robot").component;
    check(flood, "descriptors", "before-match");
}
