//! How deep a robot can call before its stack overflows: a verdict that depends on the sizes of
//! stack frames, and so on the target that code is compiled for.

use wasmouse_engine::Limits;

use crate::hostile::{Engine, Module};

/// Types of the parameters, and how many: few are in registers, many in the frame.
const TYPES: [&str; 3] = ["i32", "f64", "v128"];
const PARAMETERS: [usize; 4] = [1, 4, 12, 24];

/// The fuel that each function below has used when the stack overflows, in the order of
/// [`robots`].
#[cfg(target_arch = "x86_64")]
const FUEL: [u64; 12] = [
    76_368, 104_728, 87_256, 75_344, 65_455, 114_556, 138_184, 103_036, 65_462, 93_512, 89_572,
    61_752,
];

/// On the other architecture, whose results have another engine id for that reason.
#[cfg(target_arch = "aarch64")]
const FUEL: [u64; 12] = [
    76_361, 104_728, 100_696, 85_756, 65_455, 114_528, 138_108, 127_308, 65_454, 93_512, 89_572,
    74_352,
];

/// Robots that call themselves for ever, with their names.
fn robots() -> Vec<(String, Vec<u8>)> {
    let robots = TYPES.iter().flat_map(|ty| {
        PARAMETERS.map(|count| (format!("recursion-{ty}-{count}"), recursion(ty, count)))
    });
    robots.collect()
}

/// A function with that many parameters that uses all of them after it has called itself.
fn recursion(ty: &str, count: usize) -> Vec<u8> {
    let (add, number): (_, fn(usize) -> String) = match ty {
        "i32" => ("i32.add", |it| format!("(i32.const {it})")),
        "f64" => ("f64.add", |it| format!("(f64.const {it})")),
        _ => ("i32x4.add", |it| format!("(i32x4.splat (i32.const {it}))")),
    };
    let arguments: String = (0..count)
        .map(|at| format!("({add} (local.get {at}) {})", number(at + 1)))
        .collect();
    let sum = (0..count).fold(format!("(call $deeper {arguments})"), |sum, at| {
        format!("({add} {sum} (local.get {at}))")
    });
    let parameters = format!("(param {ty})").repeat(count);
    let first: String = (0..count).map(number).collect();
    Module {
        rest: &format!("(func $deeper {parameters} (result {ty}) {sum})"),
        next: &format!("(drop (call $deeper {first})) unreachable"),
        ..Module::default()
    }
    .component()
}

/// Frames have the sizes that the engine id stands for, whatever the processor is. If this fails
/// with a change to the engine, its revision has to be raised.
#[test]
fn stacks_overflow_where_they_do_on_other_machines() {
    let engine = Engine::new(Limits::default());
    let found = robots().into_iter().map(|(name, robot)| {
        let record = engine.play(&robot).record;
        assert_eq!(record.verdict.title(), "fault: stack-overflow", "{name}");
        record.fuel.steps
    });
    assert_eq!(found.collect::<Vec<u64>>(), FUEL);
}
