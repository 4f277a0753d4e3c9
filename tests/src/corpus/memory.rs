//! Memory: linear memories, tables and segments, as many and as large as they get.

use super::case::{Case, fault, fault_in, harmless, out_of_start_fuel, over_limit, rejected};
use crate::composite::Composite;
use crate::module::{DRIVE_ON, Module};

/// The cases 24 to 34.
pub fn cases() -> Vec<Case> {
    [
        memories(),
        tables(),
        proposals(),
        segments(),
        instantiation(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A robot with that memory and these fields.
fn with(memory: &str, rest: &str) -> Vec<u8> {
    Module {
        memory,
        rest,
        ..Module::default()
    }
    .component()
}

const MEMORY: &str = r#"(memory (export "memory") 1)"#;

/// The most that a robot that uses all of its memory makes of the host, in MiB.
pub(super) const ALL_MEMORY: u64 = 450;

fn memories() -> Vec<Case> {
    let over = |mib: u64| format!("exceeded the memory limit: requested {mib} MiB, limit 256 MiB");
    vec![
        Case::new(
            &[24],
            "initial-memory-of-4-gib",
            over_limit(
                "4294967296 bytes of one linear memory at the start",
                268435456,
            ),
            || with(r#"(memory (export "memory") 65536)"#, ""),
        )
        .shown(),
        Case::new(
            &[24],
            "initial-memory-one-page-over",
            over_limit(
                "268500992 bytes of one linear memory at the start",
                268435456,
            ),
            || with(r#"(memory (export "memory") 4097)"#, ""),
        ),
        Case::new(
            &[25],
            "growth-to-the-maximum-in-core-start",
            harmless(),
            || {
                with(MEMORY, "(func $begin
                (loop $again (br_if $again (i32.lt_u (memory.grow (i32.const 1)) (i32.const 4094)))))
                (start $begin)")
            },
        ),
        Case::new(
            &[25],
            "growth-over-the-maximum-in-core-start",
            fault_in("instantiate", 0, "out-of-memory", &over(257)),
            || {
                with(
                    MEMORY,
                    "(func $begin
                (loop $again (drop (memory.grow (i32.const 1))) (br $again)))
                (start $begin)",
                )
            },
        ),
        Case::new(
            &[25],
            "growth-to-4-gib-at-once",
            fault("out-of-memory", &over(4096)),
            || {
                Module {
                    next: "(drop (memory.grow (i32.const 65535))) i32.const 16",
                    ..Module::default()
                }
                .component()
            },
        ),
        Case::new(
            &[25],
            "growth-beyond-all-addresses",
            fault("out-of-memory", &over(4097)),
            || {
                Module {
                    next: "(drop (memory.grow (i32.const 65536))) i32.const 16",
                    ..Module::default()
                }
                .component()
            },
        ),
        Case::new(
            &[26],
            "many-memories-each-under-the-limit",
            fault_in("instantiate", 0, "out-of-memory", &over(257)),
            || {
                with(
                    r#"(memory (export "memory") 2)"#,
                    &"(memory 1024)".repeat(5),
                )
            },
        ),
        Case::new(
            &[26],
            "9-memories",
            over_limit("9 linear memories", 8),
            || with(MEMORY, &"(memory 1)".repeat(8)),
        ),
        Case::new(&[27], "touching-every-page", harmless(), || {
            Module {
                memory: r#"(memory (export "memory") 4096)"#,
                next: "(local $at i32)
                    (loop $again
                        (i32.store offset=4092 (local.get $at) (i32.const 1))
                        (local.set $at (i32.add (local.get $at) (i32.const 4096)))
                        (br_if $again (i32.lt_u (local.get $at) (i32.const 0x10000000))))
                    i32.const 16",
                ..Module::default()
            }
            .component()
        })
        .megabytes(ALL_MEMORY),
    ]
}

fn tables() -> Vec<Case> {
    vec![
        Case::new(
            &[28],
            "table-of-10-million",
            over_limit("10000000 elements of one table at the start", 100000),
            || with(MEMORY, "(table 10000000 funcref)"),
        ),
        Case::new(
            &[28],
            "tables-over-the-limit-together",
            fault_in(
                "instantiate",
                0,
                "table-limit",
                "exceeded the table limit: requested 120000 elements, limit 100000",
            ),
            || with(MEMORY, "(table 60000 funcref) (table 60000 funcref)"),
        ),
        Case::new(
            &[29],
            "table-growth-for-ever",
            fault(
                "table-limit",
                "exceeded the table limit: requested 100001 elements, limit 100000",
            ),
            || {
                Module {
                rest: "(table 1 funcref)",
                next: "(loop $again (drop (table.grow 0 (ref.null func) (i32.const 1))) (br $again))
                    unreachable",
                ..Module::default()
            }
            .component()
            },
        ),
        Case::new(
            &[29],
            "table-growth-to-a-billion-at-once",
            fault(
                "table-limit",
                "exceeded the table limit: requested 1000000000 elements, limit 100000",
            ),
            || {
                Module {
                    rest: "(table 0 funcref)",
                    next: "(drop (table.grow 0 (ref.null func) (i32.const 1000000000))) i32.const 16",
                    ..Module::default()
                }
                .component()
            },
        ),
        Case::new(&[30], "100-tables", over_limit("100 tables", 16), || {
            with(MEMORY, &"(table 1 funcref)".repeat(100))
        }),
    ]
}

fn proposals() -> Vec<Case> {
    [
        ("64-bit-memory", "(memory i64 1)", "memory64"),
        ("shared-memory", "(memory 1 1 shared)", "threads"),
        (
            "memory-with-pages-of-a-byte",
            "(memory 1 (pagesize 1))",
            "custom page sizes",
        ),
        ("64-bit-table", "(table i64 1 funcref)", "memory64"),
    ]
    .into_iter()
    .map(|(name, field, words)| {
        Case::new(
            &[31],
            name,
            rejected(
                "proposal",
                &format!("the file uses {words} at byte ..., a proposal that is off: ..."),
            ),
            move || {
                Module {
                    rest: field,
                    ..Module::default()
                }
                .core()
            },
        )
    })
    .collect()
}

fn segments() -> Vec<Case> {
    vec![
        Case::new(
            &[32],
            "data-behind-the-memory",
            fault_in(
                "instantiate",
                0,
                "out-of-bounds",
                "accessed memory out of bounds",
            ),
            || with(MEMORY, r#"(data (i32.const 65535) "xy")"#),
        ),
        Case::new(
            &[32],
            "data-at-the-end-of-the-address-space",
            fault_in(
                "instantiate",
                0,
                "out-of-bounds",
                "accessed memory out of bounds",
            ),
            || with(MEMORY, r#"(data (i32.const -1) "xy")"#),
        ),
        Case::new(
            &[32],
            "elements-behind-the-table",
            fault_in(
                "instantiate",
                0,
                "out-of-bounds",
                "accessed a table out of bounds",
            ),
            || {
                with(
                    MEMORY,
                    "(table 1 funcref) (elem (i32.const 1) $idle) (func $idle)",
                )
            },
        ),
        Case::new(&[33], "100000-data-segments", harmless(), || {
            // All but the one that every robot here has.
            with(MEMORY, &r#"(data (i32.const 99) "x")"#.repeat(99_999))
        }),
        Case::new(
            &[33],
            "100001-data-segments",
            over_limit("100001 items of one kind in a core module", 100000),
            || {
                Module {
                    rest: &r#"(data (i32.const 99) "x")"#.repeat(100_000),
                    ..Module::default()
                }
                .core()
            },
        ),
        Case::new(
            &[33],
            "passive-segments-and-their-drops",
            harmless(),
            || {
                let drops: String = (1..1000).map(|at| format!("(data.drop {at})")).collect();
                Module {
                    rest: &r#"(data "x")"#.repeat(1000),
                    next: &format!("{drops} {DRIVE_ON}"),
                    ..Module::default()
                }
                .component()
            },
        ),
        // Two bytes of a file that would be a quarter of a gigabyte as an image.
        Case::new(&[34], "sparse-image", harmless(), || {
            with(
                r#"(memory (export "memory") 4096)"#,
                r#"(data (i32.const 0) "a") (data (i32.const 0x0ff00000) "b")"#,
            )
        }),
        Case::new(&[34], "sparse-image-of-many-bytes", harmless(), || {
            let data: String = (0..4095)
                .map(|page| format!(r#"(data (i32.const {}) "x")"#, page * 65536 + 40_000))
                .collect();
            with(r#"(memory (export "memory") 4096)"#, &data)
        }),
    ]
}

/// What the compiler makes of the host for a function that prepares 100,000 elements, in MiB.
const ELEMENTS_MEMORY: u64 = 900;

/// A file that a limit on elements rejects before it comes to its fuel.
fn too_many_elements() -> serde_json::Value {
    rejected("over-limit", "the file has ...")
}

/// What is prepared for each match before anything runs.
fn instantiation() -> Vec<Case> {
    let functions = |count| format!("(func $f) (elem func {})", "$f ".repeat(count));
    let into_imported = |count| {
        format!(
            r#"(import "env" "table" (table 0 funcref)) (func $f)
            (elem (table 0) (i32.const 0) func {})"#,
            "$f ".repeat(count)
        )
    };
    let data = |distance: usize| {
        let text = "x".repeat(512 << 10);
        let segments: String = (0..60)
            .map(|at| {
                format!(
                    r#"(data (i32.const {}) "{text}")"#,
                    (1 << 16) + at * distance
                )
            })
            .collect();
        with(r#"(memory (export "memory") 4096)"#, &segments)
    };
    vec![
        Case::new(
            &[33],
            "100000-passive-elements-in-60-instances",
            out_of_start_fuel("instantiate"),
            move || instances(60, &functions(100_000)),
        )
        .or(too_many_elements())
        .megabytes(ELEMENTS_MEMORY),
        Case::new(
            &[33],
            "1000-passive-elements-in-60-instances",
            harmless(),
            move || instances(60, &functions(1000)),
        ),
        Case::new(
            &[33],
            "60-instances-that-fill-one-table",
            out_of_start_fuel("instantiate"),
            move || instances(60, &into_imported(90_000)),
        )
        .or(too_many_elements())
        .megabytes(ELEMENTS_MEMORY),
        // Too far apart for an image, so they are copied for each match.
        Case::new(
            &[33],
            "30-mib-of-data-in-60-segments",
            out_of_start_fuel("instantiate"),
            move || data(4 << 20),
        )
        .megabytes(ALL_MEMORY),
        Case::new(
            &[33],
            "30-mib-of-data-in-one-image",
            harmless(),
            move || data(512 << 10),
        )
        .megabytes(ALL_MEMORY),
    ]
}

/// A robot beside that many instances of a module with these fields.
fn instances(count: usize, fields: &str) -> Vec<u8> {
    let instance = r#"(core instance (instantiate $many (with "env" (instance $libc))))"#;
    Composite {
        before: &format!("(core module $many {fields}) {}", instance.repeat(count)),
        memory: r#"(memory (export "memory") 1) (table (export "table") 90000 funcref)"#,
        ..Composite::default()
    }
    .component()
}
