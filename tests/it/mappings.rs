//! No memory of a robot is writable and executable, whatever it is mapped from.

#![cfg(target_os = "linux")]

use std::fs;

use wasmouse_engine::Limits;

use crate::hostile::{Engine, Module};

/// wasmtime keeps the initial memory of a robot in an anonymous file, which each instance maps
/// as a private copy. A second mapping of it that is shared or executable would be a way to
/// change what other matches find in their memory, or to run it.
#[test]
fn images_of_memories_are_private_and_never_executable() {
    let engine = Engine::new(Limits::default());
    let text = "x".repeat(100_000);
    let with_image = Module {
        memory: r#"(memory (export "memory") 4)"#,
        rest: &format!(r#"(data (i32.const 4096) "{text}")"#),
        ..Module::default()
    };
    let robot = engine.admit(&with_image.component());
    let robot = robot.expect("a robot without imports");
    engine.play_admitted(&robot);
    let maps = fs::read_to_string("/proc/self/maps").expect("Linux has it");
    let mut images = 0;
    for line in maps.lines() {
        let protection = line.split_whitespace().nth(1).expect("a protection");
        let is_both = protection.contains('w') && protection.contains('x');
        assert!(!is_both, "{line}");
        if line.contains("memfd:wasm-memory-image") {
            images += 1;
            assert!(
                protection.ends_with('p') && !protection.contains('x'),
                "{line}"
            );
        }
    }
    // The slot of the match keeps the image for the next one, as long as the robot is there.
    assert!(images > 0, "no image is mapped:\n{maps}");
}
