//! Compile time: small files that are a lot of work for a compiler, or large ones.
//!
//! Each is a harmless robot with one more core module, which nobody instantiates and
//! which has to be compiled all the same.

use super::binary::{body, core_module, leb128, section, vector};
use super::case::{Case, harmless, refused};
use crate::composite::Composite;

/// The cases 70 to 78.
pub fn cases() -> Vec<Case> {
    let bomb = |numbers, name: &str, told: &str, make: fn() -> Vec<u8>| {
        let reason = format!("the file has {told}...)");
        Case::new(numbers, name, refused("over-limit", &reason), move || {
            beside(&make())
        })
    };
    vec![
        bomb(
            &[70],
            "1000-nested-loops",
            "65 loops inside each other, and the limit is 64 (",
            || nested_loops(1000),
        ),
        bomb(
            &[70],
            "10000-nested-loops",
            "65 loops inside each other, and the limit is 64 (",
            || nested_loops(10_000),
        ),
        bomb(
            &[71],
            "10000-locals-with-branches",
            "64006400 variables times blocks in a function, and the limit is 64000000 (",
            || locals_with_branches(10_000),
        ),
        Case::new(
            &[71],
            "50000-locals-in-a-function",
            refused(
                "invalid",
                "the component is not valid: too many locals: locals exceed maximum at byte ...",
            ),
            || {
                beside(&function(
                    &[leb128(1), leb128(50_000), vec![I32]].concat(),
                    &[],
                ))
            },
        ),
        bomb(
            &[72],
            "a-wall-of-br-tables",
            "1884002 bytes in a function, and the limit is 1048576 (",
            br_tables,
        ),
        bomb(
            &[73],
            "a-million-functions",
            "1000002 functions, and the limit is 60000 (",
            million_functions,
        ),
        bomb(
            &[74],
            "a-function-of-7-mb",
            "7500002 bytes in a function, and the limit is 1048576 (",
            || function(NO_LOCALS, &CONST_DROP.repeat(2_500_000)),
        ),
        bomb(
            &[75],
            "calls-with-1000-parameters",
            "1000 parameters and results of one function or block, and the limit is 200 (",
            many_parameters,
        ),
        bomb(
            &[76],
            "a-constant-expression-of-a-megabyte",
            "1050003 bytes in a constant expression, and the limit is 200 (",
            huge_constant,
        ),
        bomb(
            &[77],
            "a-million-globals",
            "1000000 items of one kind in a core module, and the limit is 100000 (",
            million_globals,
        ),
        bomb(
            &[77],
            "a-million-exports",
            "1000000 items of one kind in a core module, and the limit is 100000 (",
            million_exports,
        ),
        bomb(
            &[77],
            "a-million-types",
            "1000000 function types in a core module, and the limit is 5000 (",
            million_types,
        ),
        bomb(
            &[78],
            "a-block-of-simd",
            "4500008 bytes in a function, and the limit is 1048576 (",
            simd,
        ),
        // What is large and no bomb.
        Case::new(&[74], "a-function-of-100-kb", harmless(), || {
            beside(&function(NO_LOCALS, &CONST_DROP.repeat(33_000)))
        }),
    ]
}

/// A harmless robot with one more module.
fn beside(module: &[u8]) -> Vec<u8> {
    const CORE_MODULE_SECTION: u8 = 1;
    [
        Composite::default().component(),
        section(CORE_MODULE_SECTION, module),
    ]
    .concat()
}

const TYPES: u8 = 1;
const FUNCTIONS: u8 = 3;
const MEMORIES: u8 = 5;
const GLOBALS: u8 = 6;
const EXPORTS: u8 = 7;
const CODE: u8 = 10;

const I32: u8 = 0x7f;
const V128: u8 = 0x7b;
const END: u8 = 0x0b;

/// No groups of locals.
const NO_LOCALS: &[u8] = &[0];

/// `i32.const 0`, `drop`
const CONST_DROP: [u8; 3] = [0x41, 0, 0x1a];

/// A module with a memory and a function of one `i32`, with these groups of locals and
/// this code.
fn function(locals: &[u8], code: &[u8]) -> Vec<u8> {
    typed_function(&[0x60, 1, I32, 0], locals, code)
}

fn typed_function(of_type: &[u8], locals: &[u8], code: &[u8]) -> Vec<u8> {
    core_module(&[
        (TYPES, vector(1, of_type)),
        (FUNCTIONS, vector(1, &[0])),
        (MEMORIES, vector(1, &[0, 1])),
        (CODE, vector(1, &body(locals, code))),
    ])
}

/// Loops inside each other, each of which may go on.
fn nested_loops(count: usize) -> Vec<u8> {
    // loop; at its end: local.get 0, br_if 0, end
    let code = [
        [0x03, 0x40].repeat(count),
        [0x20, 0, 0x0d, 0, END].repeat(count),
    ]
    .concat();
    function(NO_LOCALS, &code)
}

/// Each local is set or not, and all of them are used.
fn locals_with_branches(count: usize) -> Vec<u8> {
    let mut code = Vec::new();
    for local in 1..=count {
        let local = leb128(local);
        // block, local.get 0, br_if 0, local.get 0, local.set, end
        code.extend([0x02, 0x40, 0x20, 0, 0x0d, 0, 0x20, 0, 0x21]);
        code.extend(&local);
        code.push(END);
    }
    for local in 1..=count {
        // i32.const 0, local.get, i32.store
        code.extend([0x41, 0, 0x20]);
        code.extend(leb128(local));
        code.extend([0x36, 2, 0]);
    }
    function(&[leb128(1), leb128(count), vec![I32]].concat(), &code)
}

/// Blocks inside each other, and tables of branches to all of them.
fn br_tables() -> Vec<u8> {
    const BLOCKS: usize = 1000;
    const TABLES: usize = 1000;
    let labels: Vec<u8> = (0..BLOCKS).flat_map(leb128).collect();
    // block, local.get 0, br_table with a default of 0, end
    let table = [
        vec![0x02, 0x40, 0x20, 0, 0x0e],
        vector(BLOCKS, &labels),
        vec![0, END],
    ]
    .concat();
    let code = [
        [0x02, 0x40].repeat(BLOCKS),
        table.repeat(TABLES),
        vec![END; BLOCKS],
    ]
    .concat();
    function(NO_LOCALS, &code)
}

fn million_functions() -> Vec<u8> {
    const COUNT: usize = 1_000_000;
    core_module(&[
        (TYPES, vector(1, &[0x60, 0, 0])),
        (FUNCTIONS, vector(COUNT, &vec![0; COUNT])),
        (CODE, vector(COUNT, &body(NO_LOCALS, &[]).repeat(COUNT))),
    ])
}

/// A function with as many parameters as there can be, which calls itself.
fn many_parameters() -> Vec<u8> {
    const COUNT: usize = 1000;
    let of_type = [vec![0x60], vector(COUNT, &[I32; COUNT]), vec![0]].concat();
    let arguments: Vec<u8> = (0..COUNT)
        .flat_map(|local| [vec![0x20], leb128(local)].concat())
        .collect();
    let call = [arguments, vec![0x10, 0]].concat();
    typed_function(&of_type, NO_LOCALS, &call.repeat(1000))
}

/// 0 + 1 + 1 + ...
fn huge_constant() -> Vec<u8> {
    let sum = [vec![0x41, 0], [0x41, 1, 0x6a].repeat(350_000), vec![END]].concat();
    core_module(&[(GLOBALS, vector(1, &[vec![I32, 0], sum].concat()))])
}

fn million_globals() -> Vec<u8> {
    const COUNT: usize = 1_000_000;
    core_module(&[(
        GLOBALS,
        vector(COUNT, &[I32, 1, 0x41, 0, END].repeat(COUNT)),
    )])
}

fn million_exports() -> Vec<u8> {
    const COUNT: usize = 1_000_000;
    let exports: Vec<u8> = (0..COUNT)
        .flat_map(|at| {
            let name = format!("{at:x}");
            [vector(name.len(), name.as_bytes()), vec![3, 0]].concat()
        })
        .collect();
    core_module(&[
        (GLOBALS, vector(1, &[I32, 0, 0x41, 0, END])),
        (EXPORTS, vector(COUNT, &exports)),
    ])
}

fn million_types() -> Vec<u8> {
    const COUNT: usize = 1_000_000;
    core_module(&[(TYPES, vector(COUNT, &[0x60, 1, I32, 0].repeat(COUNT)))])
}

/// One block of a million SIMD operators.
fn simd() -> Vec<u8> {
    // local.get 1; again and again local.get 1, i8x16.swizzle, ...; local.set 1
    let step = [0x20, 1, 0xfd, 0x0e, 0x20, 1, 0xfd, 0xd5, 0x01];
    let code = [vec![0x20, 1], step.repeat(500_000), vec![0x21, 1]].concat();
    function(&[1, 1, V128], &code)
}
