//! Types: nesting, large types, and proposals that are off.

use super::binary::section;
use super::case::{Case, harmless, invalid, over_limit, rejected};
use crate::composite::Composite;
use crate::module::Module;

/// The cases 62 to 67.
pub fn cases() -> Vec<Case> {
    [nesting(), types(), proposals()]
        .into_iter()
        .flatten()
        .collect()
}

/// A robot with more fields in its component.
fn with_fields(fields: &str) -> Vec<u8> {
    Composite {
        after: fields,
        ..Composite::default()
    }
    .component()
}

fn nesting() -> Vec<Case> {
    vec![
        Case::new(
            &[62],
            "1000-core-instances",
            over_limit("999 core instances", 64),
            || {
                let instances = "(core instance (instantiate $none))".repeat(997);
                with_fields(&format!("(core module $none) {instances}"))
            },
        ),
        Case::new(
            &[62],
            "2000-core-instances",
            over_limit("2002 core instances", 64),
            || {
                let instances = "(core instance (instantiate $none))".repeat(2000);
                with_fields(&format!("(core module $none) {instances}"))
            },
        ),
        Case::new(
            &[63],
            "exponential-core-instances",
            over_limit("1073741826 core instances", 64),
            || exponential("(core module $m) (core instance (instantiate $m))"),
        ),
        Case::new(
            &[63],
            "exponential-instances",
            over_limit("2147483697 component items after instantiation", 20000),
            || exponential(""),
        ),
        Case::new(
            &[64],
            "components-nested-1000-deep",
            over_limit("101 nested components", 100),
            || nested(1000),
        ),
        Case::new(&[64], "components-nested-12-deep", harmless(), || {
            nested(12)
        }),
        Case::new(
            &[64],
            "types-nested-1000-deep",
            invalid("component type nesting is too deep"),
            || nested_types(1000),
        ),
        Case::new(
            &[64],
            "types-nested-200000-deep",
            invalid("component type nesting is too deep"),
            || nested_types(200_000),
        ),
    ]
}

/// Components of which each instantiates the one inside it twice, 30 times; the
/// innermost has these fields.
fn exponential(innermost: &str) -> Vec<u8> {
    const LEVELS: usize = 30;
    let mut text = format!("(component $c0 {innermost})");
    for level in 1..=LEVELS {
        let below = level - 1;
        text = format!(
            "(component $c{level} {text}
                (instance (instantiate $c{below})) (instance (instantiate $c{below})))"
        );
    }
    with_fields(&format!("{text} (instance (instantiate $c{LEVELS}))"))
}

/// A robot with a component inside a component, and so on. The text format does not
/// nest that deep.
fn nested(levels: usize) -> Vec<u8> {
    const COMPONENT: &[u8] = b"\0asm\x0d\0\x01\0";
    const COMPONENT_SECTION: u8 = 4;
    let mut file = COMPONENT.to_vec();
    for _ in 1..levels {
        file = [COMPONENT, &section(COMPONENT_SECTION, &file)].concat();
    }
    [with_fields(""), section(COMPONENT_SECTION, &file)].concat()
}

/// A robot with the type of a component that has the type of a component, and so on.
fn nested_types(levels: usize) -> Vec<u8> {
    const TYPE_SECTION: u8 = 7;
    // A component type with one declaration, which is a type.
    let mut types = vec![1];
    types.extend([0x41, 1, 1].repeat(levels));
    // And one with none.
    types.extend([0x41, 0]);
    [with_fields(""), section(TYPE_SECTION, &types)].concat()
}

fn types() -> Vec<Case> {
    let before = |name: &str, numbers, expected, text: fn() -> String| {
        Case::new(numbers, name, expected, move || with_fields(&text()))
    };
    vec![
        before("record-of-10000-fields", &[65], harmless(), || {
            let fields: String = (0..10_000)
                .map(|at| format!(r#"(field "f{at}" u8)"#))
                .collect();
            format!("(type (record {fields}))")
        }),
        before(
            "record-of-10001-fields",
            &[65],
            invalid("record field size is out of bounds"),
            || {
                let fields: String = (0..10_001)
                    .map(|at| format!(r#"(field "f{at}" u8)"#))
                    .collect();
                format!("(type (record {fields}))")
            },
        ),
        before(
            "doubling-tuples",
            &[65],
            over_limit("... parts of component types to compare", 1_000_000),
            || {
                let mut text = "(type $t0 (tuple u8 u8))".to_owned();
                for level in 1..40 {
                    let below = level - 1;
                    text += &format!("(type $t{level} (tuple $t{below} $t{below}))");
                }
                text
            },
        ),
        Case::new(
            &[65],
            "tuples-between-inner-components",
            over_limit("8192 parts in a component type", 2000),
            || tuples(12),
        ),
        before(
            "chain-of-10000-types",
            &[66],
            over_limit("10043 component items", 10000),
            || {
                let mut text = "(type $t0 (list u8))".to_owned();
                for level in 1..10_000 {
                    let below = level - 1;
                    text += &format!("(type $t{level} (list $t{below}))");
                }
                text
            },
        ),
        before("chain-of-100-types", &[66], harmless(), || {
            let mut text = "(type $t0 (list u8))".to_owned();
            for level in 1..99 {
                let below = level - 1;
                text += &format!("(type $t{level} (list $t{below}))");
            }
            text
        }),
    ]
}

/// A function between two inner components whose parameter is a tuple of 2 to the
/// power of that many bytes: what connects them is compiled.
fn tuples(levels: usize) -> Vec<u8> {
    let mut types = "(type $t0 (tuple u8 u8))".to_owned();
    for level in 1..levels {
        let below = level - 1;
        types += &format!("(type $t{level} (tuple $t{below} $t{below}))");
    }
    let top = levels - 1;
    with_fields(&format!(
        r#"(component $a {types}
            (core module $m (memory (export "memory") 1)
                (func (export "realloc") (param i32 i32 i32 i32) (result i32) i32.const 0)
                (func (export "f") (param i32)))
            (core instance $m (instantiate $m))
            (alias core export $m "memory" (core memory $memory))
            (alias core export $m "realloc" (core func $realloc))
            (func (export "f") (param "x" $t{top})
                (canon lift (core func $m "f") (memory $memory) (realloc $realloc))))
        (instance $a (instantiate $a))
        (component $b {types}
            (import "f" (func $f (param "x" $t{top})))
            (core module $libc (memory (export "memory") 1))
            (core instance $libc (instantiate $libc))
            (alias core export $libc "memory" (core memory $memory))
            (core func $f (canon lower (func $f) (memory $memory)))
            (core instance $own (export "f" (func $f)))
            (core module $m (import "own" "f" (func (param i32))))
            (core instance (instantiate $m (with "own" (instance $own)))))
        (alias export $a "f" (func $f))
        (instance (instantiate $b (with "f" (func $f))))"#
    ))
}

/// Proposals that are off, in modules and in components.
fn proposals() -> Vec<Case> {
    let module = |name: &str, reason: &str, field: &'static str| {
        let reason = format!("the file uses {reason} at byte ..., a proposal that is off: ...");
        Case::new(&[67], name, rejected("proposal", &reason), move || {
            Module {
                rest: field,
                ..Module::default()
            }
            .core()
        })
    };
    let component = |name: &str, reason: &str, field: &'static str| {
        let reason = format!("the file uses {reason} at byte ..., a proposal that is off: ...");
        Case::new(&[67], name, rejected("proposal", &reason), move || {
            with_fields(field)
        })
    };
    vec![
        module(
            "gc-struct",
            "garbage collection",
            "(type (struct (field i32)))",
        ),
        module(
            "gc-array-of-a-gigabyte",
            "garbage collection",
            "(type $a (array (mut i8)))
            (func (drop (array.new_default $a (i32.const 0x40000000))))",
        ),
        module(
            "typed-function-references",
            "typed function references",
            "(type $f (func)) (func (param (ref $f)))",
        ),
        module("exception-tag", "exceptions", "(tag)"),
        module(
            "exception-throw",
            "exceptions",
            "(tag $t) (func (throw $t))",
        ),
        module(
            "stack-switching",
            "stack switching",
            "(type $f (func)) (type $c (cont $f))",
        ),
        module(
            "atomic-wait",
            "threads",
            "(func (drop (memory.atomic.wait32
            (i32.const 0) (i32.const 0) (i64.const -1))))",
        ),
        module(
            "relaxed-simd",
            "relaxed SIMD",
            "(func (param v128) (drop
            (f32x4.relaxed_madd (local.get 0) (local.get 0) (local.get 0))))",
        ),
        module(
            "wide-arithmetic",
            "wide arithmetic",
            "(func (param i64 i64) (i64.mul_wide_u (local.get 0) (local.get 1)) drop drop)",
        ),
        component("stream-type", "component model async", "(type (stream u8))"),
        component("future-type", "component model async", "(type (future u8))"),
        component(
            "error-context",
            "component model async",
            "(core func (canon error-context.drop))",
        ),
        component(
            "new-thread",
            "threads",
            "(core type $f (func (param i32)))
            (core func (canon thread.spawn-ref $f))",
        ),
        component(
            "waitable-set",
            "component model async",
            "(core func (canon waitable-set.new))",
        ),
        component(
            "asynchronous-lift",
            "component model async",
            r#"(func (canon lift (core func $robot
            "wasmouse:robot/controller@VERSION#start") async))"#,
        ),
        component(
            "asynchronous-lower",
            "component model async",
            "(core func (canon lower (func $start) async (memory $memory)))",
        ),
        component(
            "values",
            "component model values",
            r#"(type (component (import "v" (value u8))))"#,
        ),
        component(
            "component-start",
            "component model values",
            r#"(core module $s (func (export "go"))) (core instance $s (instantiate $s))
            (func $go (canon lift (core func $s "go"))) (start $go)"#,
        ),
        component(
            "fixed-length-list",
            "component model lists of fixed length",
            "(type (list u8 1000000))",
        ),
        component("map-type", "component model maps", "(type (map string u8))"),
    ]
}
