//! Costs: loops of operators that may take longer than their fuel implies.
//!
//! Each uses up the fuel of a step; the table of the corpus shows how many nanoseconds a
//! unit of it took.

use super::case::{Case, out_of_match_fuel, out_of_step_fuel};
use crate::module::Module;

/// A robot that does one thing for ever.
#[derive(Clone, Copy)]
struct Endless {
    numbers: &'static [u8],
    name: &'static str,
    memory: &'static str,
    rest: &'static str,
    /// May use the locals `$i` (i32) and `$f` (f64).
    body: &'static str,
    megabytes_max: u64,
    is_long: bool,
}

const SMALL: Endless = Endless {
    numbers: &[],
    name: "",
    memory: r#"(memory (export "memory") 1 1)"#,
    rest: "",
    body: "",
    megabytes_max: super::MEGABYTES_MAX,
    is_long: false,
};

const LARGE: Endless = Endless {
    memory: r#"(memory (export "memory") 4096)"#,
    megabytes_max: super::memory::ALL_MEMORY,
    ..SMALL
};

const ENDLESS: [Endless; 15] = [
    Endless {
        numbers: &[12],
        name: "indirect-calls-in-a-loop",
        rest: "(type $action (func)) (table 1 funcref) (elem (i32.const 0) $idle) (func $idle)",
        body: "(call_indirect (type $action) (i32.const 0))",
        ..SMALL
    },
    Endless {
        numbers: &[15],
        name: "fill-of-one-page",
        body: "(memory.fill (i32.const 0) (i32.const 0) (i32.const 65536))",
        ..SMALL
    },
    Endless {
        name: "fill-of-one-byte",
        body: "(memory.fill (i32.const 0) (i32.const 0) (i32.const 1))",
        ..SMALL
    },
    Endless {
        numbers: &[16],
        name: "overlapping-copies-of-all-memory",
        body: "(memory.copy (i32.const 1) (i32.const 0) (i32.const 0x0fffffff))",
        ..LARGE
    },
    Endless {
        numbers: &[17],
        name: "grow-by-nothing",
        body: "(drop (memory.grow (i32.const 0)))",
        ..SMALL
    },
    Endless {
        numbers: &[18],
        name: "failing-growth",
        body: "(drop (memory.grow (i32.const 1)))",
        ..SMALL
    },
    Endless {
        numbers: &[18],
        name: "failing-table-growth",
        rest: "(table 1 1 funcref)",
        body: "(drop (table.grow 0 (ref.null func) (i32.const 1)))",
        ..SMALL
    },
    Endless {
        numbers: &[19],
        name: "denormal-storm",
        body: "(local.set $f (f64.mul
            (f64.div (f64.const 0x1p-1040) (f64.add (local.get $f) (f64.const 0x1p-1030)))
            (f64.const 0x1p-1022)))",
        is_long: true,
        ..SMALL
    },
    Endless {
        numbers: &[19],
        name: "nan-storm",
        body: "(local.set $f
            (f64.sqrt (f64.add (local.get $f) (f64.const nan:0x4000000000001))))",
        ..SMALL
    },
    Endless {
        name: "division-storm",
        body: "(local.set $i (i32.wrap_i64 (i64.rem_u (i64.const -1)
            (i64.extend_i32_u (i32.or (local.get $i) (i32.const 3))))))",
        ..SMALL
    },
    Endless {
        name: "cache-missing-loads",
        body: "(local.set $i (i32.and (i32.const 0x0ffffffc)
            (i32.add (i32.mul (local.get $i) (i32.const 1664525))
                (i32.add (i32.const 1013904223) (i32.load (local.get $i))))))",
        ..LARGE
    },
    Endless {
        name: "memory-init-for-ever",
        rest: r#"(data $d "0123456789abcdef")"#,
        body: "(memory.init $d (i32.const 0) (i32.const 0) (i32.const 16))",
        ..SMALL
    },
    Endless {
        name: "table-fill-for-ever",
        rest: "(table 100000 funcref)",
        body: "(table.fill 0 (i32.const 0) (ref.null func) (i32.const 100000))",
        ..SMALL
    },
    Endless {
        name: "table-copy-for-ever",
        rest: "(table 100000 funcref)",
        body: "(table.copy (i32.const 1) (i32.const 0) (i32.const 99999))",
        ..SMALL
    },
    Endless {
        name: "table-init-for-ever",
        rest: "(table 1 funcref) (elem $e func $idle) (func $idle)",
        body: "(table.init $e (i32.const 0) (i32.const 0) (i32.const 1))",
        ..SMALL
    },
];

/// Of the cases 12 to 19 those that are about time, and more of the kind.
pub fn cases() -> Vec<Case> {
    let endless = ENDLESS.into_iter().map(Endless::case);
    endless.chain([fill_each_step()]).collect()
}

impl Endless {
    fn case(self) -> Case {
        let expected = out_of_step_fuel();
        let mut case = Case::new(self.numbers, self.name, expected, move || self.component());
        case.megabytes_max = self.megabytes_max;
        case.is_long = self.is_long;
        case.seconds(if self.is_long { 300 } else { 60 })
    }

    fn component(self) -> Vec<u8> {
        let Self {
            memory, rest, body, ..
        } = self;
        let next =
            format!("(local $f f64) (local $i i32) (loop $forever {body} br $forever) unreachable");
        Module {
            memory,
            rest,
            next: &next,
            ..Module::default()
        }
        .component()
    }
}

/// Ends, and comes again with every step until the fuel of the match is used up.
fn fill_each_step() -> Case {
    let expected = out_of_match_fuel(75);
    Case::new(&[15], "fill-of-all-memory-each-step", expected, || {
        Module {
            memory: LARGE.memory,
            next: "(memory.fill (i32.const 0) (i32.const 1) (i32.const 0x10000000))
                (i32.store (i32.const 16) (i32.const 0x010100)) i32.const 16",
            ..Module::default()
        }
        .component()
    })
    .megabytes(LARGE.megabytes_max)
}
