//! How much time a unit of fuel buys: the slowest instructions beside the flood robot.
//!
//! Fuel is what ends a match, and time is what an organiser pays. Each mix is a robot
//! whose only step is an endless loop of one kind of work; it ends when the fuel of the
//! step is used up, so its time over its fuel is the price of that work.

use std::sync::Arc;
use std::time::{Duration, Instant};

use wasmouse_core::game::{FaultKind, FuelLimit, Ruleset, SandboxLimits, Verdict};
use wasmouse_engine::admission::{CONTROLLER_EXPORTS, JOURNAL_IMPORT, componentize};
use wasmouse_engine::{Limits, Recording, Runtime};

use super::stage;

/// Work that takes more than so many times the time of flood for its fuel is priced
/// too low.
const RATIO_MAX: f64 = 10.0;

/// Fuel of the step that is timed: at least this, and so much that it takes [`TIMED`].
const STEP_FUEL: u64 = 10_000_000;
const STEP_FUEL_MAX: u64 = 2_000_000_000;
const TIMED: Duration = Duration::from_millis(40);

/// Pages of the memory of all mixes: 192 MiB, more than any cache.
const PAGES: u32 = 3072;

/// A kind of work.
struct Mix {
    name: &'static str,
    /// What `start` does.
    prepare: &'static str,
    /// One turn of the loop.
    turn: &'static str,
    /// How often it is written in the loop.
    unroll: usize,
    /// Fields of the module.
    fields: &'static str,
}

const fn mix(name: &'static str, turn: &'static str) -> Mix {
    Mix {
        name,
        prepare: "",
        turn,
        unroll: 32,
        fields: "",
    }
}

/// Fills 128 MiB with a permutation of its words that is one cycle, in an order that no
/// prefetcher follows.
const CYCLE: &str = "
    (loop $fill
        (i32.store (local.get $i)
            (i32.and
                (i32.add (i32.mul (local.get $i) (i32.const 1664525)) (i32.const 1013904220))
                (i32.const 0x7fffffc)))
        (local.set $i (i32.add (local.get $i) (i32.const 4)))
        (br_if $fill (i32.lt_u (local.get $i) (i32.const 0x8000000))))";

const RANDOM: &str = "
    (local.set $i (i32.xor (local.get $i) (i32.shl (local.get $i) (i32.const 13))))
    (local.set $i (i32.xor (local.get $i) (i32.shr_u (local.get $i) (i32.const 17))))
    (local.set $i (i32.xor (local.get $i) (i32.shl (local.get $i) (i32.const 5))))";

fn mixes() -> Vec<Mix> {
    let random_load = "
        (local.set $i (i32.add (i32.mul (local.get $i) (i32.const 1664525)) (i32.const 1013904223)))
        (local.set $j (i32.add (local.get $j)
            (i32.load (i32.and (local.get $i) (i32.const 0x7fffffc)))))";
    let random_store = "
        (local.set $i (i32.add (i32.mul (local.get $i) (i32.const 1664525)) (i32.const 1013904223)))
        (i32.store (i32.and (local.get $i) (i32.const 0x7fffffc)) (local.get $j))";
    let funcs = "(func $f (param i32) (result i32) local.get 0)
        (func $g (param i32) (result i32) local.get 0)
        (type $t (func (param i32) (result i32)))
        (table 2 funcref) (elem (i32.const 0) $f $g)";
    vec![
        mix(
            "integer additions",
            "(local.set $i (i32.add (local.get $i) (local.get $j)))",
        ),
        mix(
            "integer divisions",
            "(local.set $x (i64.div_u (i64.const -1) (i64.or (local.get $x) (i64.const 1))))",
        ),
        mix(
            "signed remainders",
            "(local.set $x (i64.add (i64.rem_s (i64.const -7) (i64.or (local.get $x) (i64.const 3))) (i64.const 5)))",
        ),
        mix(
            "float divisions",
            "(local.set $d (f64.div (f64.const 1.7) (local.get $d)))",
        ),
        mix("square roots", "(local.set $d (f64.sqrt (local.get $d)))"),
        mix(
            "denormal products",
            "(local.set $d (f64.mul
                (f64.div (f64.const 0x1p-1040) (f64.add (local.get $d) (f64.const 0x1p-1030)))
                (f64.const 0x1p-1022)))",
        ),
        mix(
            "minima of floats",
            "(local.set $d (f64.min (local.get $d) (f64.const 0.3)))",
        ),
        mix(
            "float additions",
            "(local.set $d (f64.add (local.get $d) (f64.const 1e-300)))",
        ),
        mix(
            "float products",
            "(local.set $d (f64.mul (local.get $d) (f64.const 1.0000001)))",
        ),
        mix(
            "vector additions of floats",
            "(local.set $v (f64x2.add (local.get $v) (local.get $v)))",
        ),
        mix(
            "float comparisons",
            "(local.set $j (f64.lt (local.get $d) (f64.const 1e-300)))(local.set $d (f64.convert_i32_s (local.get $j)))",
        ),
        mix("roundings", "(local.set $d (f64.nearest (local.get $d)))"),
        mix(
            "conversions",
            "(local.set $x (i64.trunc_f64_s (local.get $d)))(local.set $d (f64.convert_i64_u (local.get $x)))",
        ),
        mix(
            "bit counts",
            "(local.set $x (i64.popcnt (local.get $x)))(local.set $x (i64.clz (local.get $x)))",
        ),
        mix(
            "vector divisions",
            "(local.set $v (f64x2.div (v128.const f64x2 1.7 1.9) (local.get $v)))",
        ),
        mix(
            "vector square roots",
            "(local.set $v (f64x2.sqrt (local.get $v)))",
        ),
        mix(
            "vector products of 64 bits",
            "(local.set $v (i64x2.mul (local.get $v) (local.get $v)))",
        ),
        mix(
            "vector shifts of bytes",
            "(local.set $v (i8x16.shr_s (local.get $v) (local.get $j)))",
        ),
        mix(
            "vector counts of bits",
            "(local.set $v (i8x16.popcnt (local.get $v)))",
        ),
        mix(
            "vector conversions",
            "(local.set $v (i32x4.trunc_sat_f32x4_u (local.get $v)))",
        ),
        mix(
            "vector minima",
            "(local.set $v (f32x4.min (local.get $v) (local.get $v)))",
        ),
        mix(
            "vector nearest",
            "(local.set $v (f64x2.nearest (local.get $v)))",
        ),
        mix(
            "globals",
            "(global.set $g (i32.add (global.get $g) (i32.const 1)))",
        ),
        mix(
            "selects",
            "(local.set $i (select (local.get $i) (local.get $j) (local.get $i)))",
        ),
        mix("random loads", random_load),
        mix("random stores", random_store),
        Mix {
            prepare: CYCLE,
            ..mix(
                "loads that wait for each other",
                "(local.set $i (i32.load (local.get $i)))",
            )
        },
        mix(
            "a load of each page",
            "(local.set $i (i32.and (i32.add (local.get $i) (i32.const 4096)) (i32.const 0x7ffffff)))(local.set $j (i32.load (local.get $i)))",
        ),
        mix(
            "a store to each page",
            "(local.set $i (i32.and (i32.add (local.get $i) (i32.const 4096)) (i32.const 0x7ffffff)))(i32.store (local.get $i) (local.get $j))",
        ),
        mix(
            "misaligned stores and loads",
            "(i64.store (i32.const 4093) (local.get $x))(local.set $x (i64.load (i32.const 4090)))",
        ),
        Mix {
            fields: funcs,
            ..mix("calls", "(local.set $i (call $f (local.get $i)))")
        },
        Mix {
            fields: funcs,
            ..mix(
                "indirect calls",
                "(local.set $i (call_indirect (type $t) (local.get $i) (i32.and (local.get $i) (i32.const 1))))",
            )
        },
        Mix {
            fields: "(func $tail (return_call $tail))",
            unroll: 1,
            ..mix("tail calls", "(call $tail)")
        },
        Mix {
            fields: "(func $deep (param i32) (if (local.get 0) (then (call $deep (i32.sub (local.get 0) (i32.const 1))))))",
            unroll: 1,
            ..mix("deep recursion", "(call $deep (i32.const 5000))")
        },
        Mix {
            prepare: "",
            ..mix(
                "branch tables",
                concat!(
                    "(block $b (block $a (br_table $a $b $a $b $a (i32.and (local.get $i) (i32.const 3)))))",
                    "(local.set $i (i32.add (local.get $i) (i32.const 1)))"
                ),
            )
        },
        Mix {
            unroll: 8,
            ..mix("branches on chance", "")
        },
        mix("memory.size", "(local.set $i (memory.size))"),
        mix(
            "memory.grow by nothing",
            "(local.set $i (memory.grow (i32.const 0)))",
        ),
        mix(
            "memory.grow that fails",
            "(local.set $i (memory.grow (i32.const 500)))",
        ),
        mix(
            "memory.fill of nothing",
            "(memory.fill (i32.const 0) (i32.const 1) (i32.const 0))",
        ),
        mix(
            "memory.fill of 1 byte",
            "(memory.fill (i32.const 0) (i32.const 1) (i32.const 1))",
        ),
        mix(
            "memory.fill of 64 KiB",
            "(memory.fill (i32.const 0) (i32.const 1) (i32.const 65536))",
        ),
        mix(
            "memory.fill of all",
            "(memory.fill (i32.const 0) (i32.const 1) (i32.const 0xc000000))",
        ),
        mix(
            "memory.copy of nothing",
            "(memory.copy (i32.const 0) (i32.const 1) (i32.const 0))",
        ),
        mix(
            "memory.copy of 1 byte",
            "(memory.copy (i32.const 0) (i32.const 1) (i32.const 1))",
        ),
        mix(
            "memory.copy of 16 MiB, overlapping",
            "(memory.copy (i32.const 1) (i32.const 0) (i32.const 0x1000000))",
        ),
        Mix {
            fields: "(data $d \"abcdefgh\")",
            ..mix(
                "memory.init of nothing",
                "(memory.init $d (i32.const 0) (i32.const 0) (i32.const 0))",
            )
        },
        Mix {
            fields: "(data $d \"abcdefgh\")",
            ..mix(
                "memory.init of 8 bytes",
                "(memory.init $d (i32.const 0) (i32.const 0) (i32.const 8))",
            )
        },
        Mix {
            fields: "(data $d \"abcdefgh\")",
            ..mix("data.drop", "(data.drop $d)")
        },
        Mix {
            fields: funcs,
            ..mix(
                "table.get and table.set",
                "(table.set (i32.const 0) (table.get (i32.const 1)))",
            )
        },
        Mix {
            fields: funcs,
            ..mix("table.size", "(local.set $i (table.size))")
        },
        Mix {
            fields: funcs,
            ..mix(
                "table.grow by nothing",
                "(local.set $i (table.grow (ref.null func) (i32.const 0)))",
            )
        },
        Mix {
            fields: funcs,
            ..mix(
                "table.fill of nothing",
                "(table.fill (i32.const 0) (ref.null func) (i32.const 0))",
            )
        },
        Mix {
            fields: funcs,
            ..mix(
                "table.copy of nothing",
                "(table.copy (i32.const 0) (i32.const 0) (i32.const 0))",
            )
        },
        Mix {
            fields: funcs,
            ..mix(
                "table.copy of 2",
                "(table.copy (i32.const 0) (i32.const 0) (i32.const 2))",
            )
        },
        Mix {
            fields: "(func $f) (table 2 funcref) (elem $e func $f $f)",
            ..mix(
                "table.init of 2",
                "(table.init $e (i32.const 0) (i32.const 0) (i32.const 2))",
            )
        },
        Mix {
            fields: "(func $f) (table 2 funcref) (elem $e func $f $f)",
            ..mix("elem.drop", "(elem.drop $e)")
        },
        Mix {
            fields: "(func $f) (elem declare func $f)",
            ..mix("ref.func", "(local.set $r (ref.func $f))")
        },
        mix(
            "journal: log of nothing",
            "(call $log (i32.const 0) (i32.const 0) (i32.const 0))",
        ),
        mix(
            "journal: log of 60 KB",
            "(call $log (i32.const 0) (i32.const 0) (i32.const 60000))",
        ),
        mix(
            "journal: log of 100 bytes",
            "(call $log (i32.const 0) (i32.const 0) (i32.const 100))",
        ),
        mix(
            "journal: paint",
            "(call $paint (i32.const 1) (i32.const 1) (i32.const 1))",
        ),
    ]
}

impl Mix {
    fn component(&self) -> Vec<u8> {
        let turns = if self.turn.is_empty() {
            let branch = format!(
                "{RANDOM}(if (i32.and (local.get $i) (i32.const 1))
                    (then (local.set $j (i32.add (local.get $j) (i32.const 3))))
                    (else (local.set $j (i32.xor (local.get $j) (i32.const 5)))))"
            );
            branch.repeat(self.unroll)
        } else {
            self.turn.repeat(self.unroll)
        };
        let journal = JOURNAL_IMPORT;
        let [start, next_move] = CONTROLLER_EXPORTS;
        let (fields, prepare) = (self.fields, self.prepare);
        let module = format!(
            r#"(module
                (import "{journal}" "log" (func $log (param i32 i32 i32)))
                (import "{journal}" "paint" (func $paint (param i32 i32 i32)))
                (memory (export "memory") {PAGES} {PAGES})
                (global $g (mut i32) (i32.const 0))
                {fields}
                (func (export "{start}")
                    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)
                    (local $i i32) {prepare})
                (func (export "{next_move}")
                    (param i32 i32 i32) (result i32)
                    (local $i i32) (local $j i32) (local $x i64) (local $d f64)
                    (local $v v128) (local $r funcref)
                    (local.set $i (i32.const 12345)) (local.set $j (i32.const 3))
                    (local.set $d (f64.const 1.3)) (local.set $x (i64.const 977))
                    (local.set $i (i32.and (local.get $i) (i32.const -4)))
                    (loop $forever {turns} (br $forever))
                    unreachable))"#
        );
        let module = wat::parse_str(&module).unwrap_or_else(|error| panic!("{error}\n{module}"));
        componentize(&module).expect("it exports what a robot exports")
    }
}

/// Prints what each mix takes for its fuel, the slowest first.
pub fn print() {
    let flood = flood();
    println!(
        "\n{:<40} {:>10} {:>10}  (flood: {flood:.3} ns for a unit of fuel)",
        "time for fuel", "ns/fuel", "to flood"
    );
    let mut rows: Vec<(f64, &str)> = mixes()
        .iter()
        .map(|mix| (price(&mix.component(), mix.name), mix.name))
        .collect();
    rows.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (price, name) in rows {
        let ratio = price / flood;
        let verdict = if ratio <= RATIO_MAX { "" } else { "MISSED" };
        println!("{name:<40} {price:>10.3} {ratio:>9.1}x  {verdict}");
    }
}

/// Nanoseconds of a unit of fuel in matches of flood, which compute rather than call.
fn flood() -> f64 {
    let runtime = stage::runtime();
    let robot = stage::robot(&runtime, "flood");
    let rules = Arc::new(Ruleset::default());
    let mut recording = Recording::default();
    let mazes = stage::match_mazes();
    let specs: Vec<_> = mazes
        .iter()
        .map(|(_, maze)| stage::spec(&robot, (maze, 1), &rules))
        .collect();
    let mut best = f64::INFINITY;
    for _ in 0..50 {
        let (mut time, mut fuel) = (Duration::ZERO, 0);
        for spec in &specs {
            let begin = Instant::now();
            let (_, used) = stage::play(&runtime, &robot, spec, &mut recording);
            time += begin.elapsed();
            fuel += used.start + used.steps;
        }
        best = best.min(nanoseconds(time, fuel));
    }
    best
}

/// Nanoseconds of a unit of fuel in that robot's endless step.
fn price(component: &[u8], name: &str) -> f64 {
    let mut fuel = STEP_FUEL;
    while fuel < STEP_FUEL_MAX && time(component, fuel, name) < TIMED {
        fuel *= 4;
    }
    // What is around the step takes time too, and as much for less fuel.
    let least = |fuel| (0..3).map(|_| time(component, fuel, name)).min();
    let [short, long] = [fuel / 4, fuel].map(|fuel| least(fuel).unwrap_or_default());
    nanoseconds(long.saturating_sub(short), fuel - fuel / 4)
}

fn time(component: &[u8], step_fuel: u64, name: &str) -> Duration {
    let sandbox = SandboxLimits {
        step_fuel_max: step_fuel,
        ..SandboxLimits::default()
    };
    let rules = Arc::new(Ruleset {
        sandbox,
        ..Ruleset::default()
    });
    let limits = Limits::with_sandbox(sandbox);
    let runtime = Runtime::new(limits, 1, None).expect("address space for a match");
    let robot = match runtime.admit(component) {
        Ok(robot) => robot,
        Err(rejection) => panic!("{name}: {rejection}"),
    };
    let (_, maze) = stage::match_mazes().swap_remove(0);
    let spec = stage::spec(&robot, (&maze, 0), &rules);
    let mut recording = Recording::default();
    let begin = Instant::now();
    let (verdict, _) = stage::play(&runtime, &robot, &spec, &mut recording);
    let took = begin.elapsed();
    let Verdict::Fault { fault } = &verdict else {
        panic!("{name}: {verdict:?}");
    };
    assert_eq!(
        fault.kind,
        FaultKind::OutOfFuel(FuelLimit::Step),
        "{name}: {fault:?}"
    );
    took
}

fn nanoseconds(time: Duration, fuel: u64) -> f64 {
    time.as_secs_f64() * 1e9 / fuel as f64
}
