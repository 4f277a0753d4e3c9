//! A robot that takes very long for its fuel.

use crate::module::Module;

/// The robot: each load needs the value of the one before and finds nothing in any cache, so a
/// step of a few million units of fuel takes a tenth of a second, and a match minutes.
pub fn pointer_chaser() -> Vec<u8> {
    Module {
        memory: r#"(memory (export "memory") 4096)"#,
        // Pages that were never written are all the same one, which is in the cache.
        start: "(memory.fill (i32.const 4096) (i32.const 1) (i32.const 0x0ffff000))",
        next: "(local $i i32) (local $left i32)
            (local.set $left (i32.const 1000000))
            (loop $chase
                (local.set $i (i32.and (i32.const 0x0ffffffc)
                    (i32.add (i32.mul (local.get $i) (i32.const 1664525))
                        (i32.add (i32.const 1013904223) (i32.load (local.get $i))))))
                (local.set $left (i32.sub (local.get $left) (i32.const 1)))
                (br_if $chase (local.get $left)))
            ;; turn right, move 0: it never hits a wall and never arrives
            (i32.store8 offset=24 (i32.const 0) (i32.const 0))
            (i32.store8 offset=25 (i32.const 0) (i32.const 2))
            (i32.store8 offset=26 (i32.const 0) (i32.const 0))
            i32.const 24",
        ..Module::default()
    }
    .component()
}
