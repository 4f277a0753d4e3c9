//! Rejections that depend on the limits. The others are in the hostile corpus.

use crate::hostile::{Engine, Module, SMALL, wasm};

/// Compares name and reason of the rejection.
#[track_caller]
fn check(file: &[u8], expected: &str) {
    let engine = Engine::new(SMALL);
    let rejection = engine.admit(file).err().expect(expected);
    let found = format!("{}: {rejection}", rejection.name());
    // Where it was found depends on the encoder.
    let found = found.split(" (byte").next().unwrap_or(&found);
    assert_eq!(found, expected);
    engine.assert_unharmed();
}

#[test]
fn requirements_beyond_the_limits_are_rejected() {
    let many = |what: &str, count: usize| what.repeat(count);
    for (robot, expected) in [
        (
            Module {
                memory: r#"(memory (export "memory") 65)"#,
                ..Module::default()
            },
            "over-limit: the file has 4259840 bytes of one linear memory at the start, and the limit is 4194304",
        ),
        (
            Module {
                rest: "(table 1001 funcref)",
                ..Module::default()
            },
            "over-limit: the file has 1001 elements of one table at the start, and the limit is 1000",
        ),
        (
            Module {
                rest: &many("(memory 1)", 4),
                ..Module::default()
            },
            "over-limit: the file has 5 linear memories, and the limit is 4",
        ),
        (
            Module {
                rest: &many("(table 1 funcref)", 5),
                ..Module::default()
            },
            "over-limit: the file has 5 tables, and the limit is 4",
        ),
    ] {
        check(&robot.component(), expected);
    }
    let instances = "(core instance (instantiate $m))".repeat(9);
    let with_controller = format!(
        r#"(component (core module $m) {instances} (instance $empty)
            (export "wasmouse:robot/controller@0.1.0" (instance $empty)))"#
    );
    check(
        &wasm(&with_controller),
        "over-limit: the file has 9 core instances, and the limit is 8",
    );
}
