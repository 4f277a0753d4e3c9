//! Bombs of component types: small ones that are large when they are written out, and are
//! compared or copied again and again.

use std::fmt::Write as _;

use super::modules::{count, parse};

/// A tuple of two tuples of two tuples, named `$t`: 2^levels values.
fn doubled(levels: u32) -> String {
    let mut types = String::from("(type $t0 (tuple u8 u8))");
    for level in 1..levels.max(1) {
        let before = level - 1;
        write!(types, "(type $t{level} (tuple $t{before} $t{before}))")
            .expect("a string takes everything");
    }
    write!(types, "(type $t (tuple $t{}))", levels.max(1) - 1).expect("a string takes everything");
    types
}

/// An instance whose exports are functions of a doubled tuple.
fn functions(functions: u32) -> String {
    (0..functions)
        .map(|at| format!(r#"(export "f{at}" (func (param "p" $t)))"#))
        .collect()
}

/// Instance types inside of one component type, each with a function of a doubled tuple.
pub fn declared_instances(instances: u32, levels: u32) -> Vec<u8> {
    let instance = "(type (instance (alias outer 1 $t (type $t))
        (export \"f\" (func (param \"p\" $t)))))";
    parse(&format!(
        "(component (type (component {} {})))",
        doubled(levels),
        instance.repeat(count(instances))
    ))
}

/// Components that are instantiated with an instance whose type is large.
pub fn compared_instances(instances: u32, exports: u32, levels: u32) -> Vec<u8> {
    let ty = format!(
        "{} (type $i (instance {}))",
        doubled(levels),
        functions(exports)
    )
    .replace(
        "(type $i (instance ",
        "(type $i (instance (alias outer 1 $t (type $t)) ",
    );
    parse(&format!(
        r#"(component {ty}
            (import "i" (instance $i (type $i)))
            (component $c (alias outer 1 $i (type $i)) (import "i" (instance (type $i))))
            {})"#,
        r#"(instance (instantiate $c (with "i" (instance $i))))"#.repeat(count(instances))
    ))
}

/// Exports of instances whose types are large.
pub fn exported_instances(instances: u32, exports: u32, levels: u32) -> Vec<u8> {
    let ty = format!(
        "{} (type $i (instance {}))",
        doubled(levels),
        functions(exports)
    )
    .replace(
        "(type $i (instance ",
        "(type $i (instance (alias outer 1 $t (type $t)) ",
    );
    let mut text = format!(r#"{ty} (import "i" (instance $i (type $i)))"#);
    for at in 0..instances {
        write!(text, r#"(export "e{at}" (instance $i))"#).expect("a string takes everything");
    }
    parse(&format!("(component {text})"))
}

/// Instance types that each have the one before twice.
pub fn doubled_instances(levels: u32) -> Vec<u8> {
    let mut types = String::from("(type $i0 (instance))");
    for level in 1..=levels {
        let before = level - 1;
        write!(
            types,
            r#"(type $i{level} (instance (alias outer 1 $i{before} (type $b))
                (export "a" (instance (type $b))) (export "b" (instance (type $b)))))"#
        )
        .expect("a string takes everything");
    }
    parse(&format!("(component {types})"))
}

/// Component types that each import and export the one before.
pub fn nested_component_types(levels: u32) -> Vec<u8> {
    let mut types = String::from("(type $c0 (component))");
    for level in 1..=levels {
        let before = level - 1;
        write!(
            types,
            r#"(type $c{level} (component (alias outer 1 $c{before} (type $b))
                (import "a" (component (type $b))) (export "b" (component (type $b)))))"#
        )
        .expect("a string takes everything");
    }
    parse(&format!("(component {types})"))
}

/// A component with a module type that is declared again and again.
pub fn module_types(types: u32, exports: u32) -> Vec<u8> {
    let exports: String = (0..exports)
        .map(|at| format!(r#"(export "{at}" (func))"#))
        .collect();
    let ty = format!("(core type (module {exports}))");
    parse(&format!("(component {})", ty.repeat(count(types))))
}

/// Resources that are defined, and functions that drop them.
pub fn resources(resources: u32) -> Vec<u8> {
    let mut text = String::new();
    for at in 0..resources {
        write!(
            text,
            "(type $r{at} (resource (rep i32))) (core func (canon resource.drop $r{at}))"
        )
        .expect("a string takes everything");
    }
    parse(&format!("(component {text})"))
}

/// Functions that one component lifts and another one lowers, with strings in other encodings
/// on both sides.
pub fn adapters(functions: u32, parameters: u32) -> Vec<u8> {
    let parameters: String = (0..parameters)
        .map(|at| format!(r#"(param "p{at}" string)"#))
        .collect();
    let (mut lifted, mut imports, mut lowered) = (String::new(), String::new(), String::new());
    let flat = "i32 i32 ".repeat(parameters.matches("string").count());
    let flat = if flat.len() > 16 * 4 { "i32" } else { &flat };
    let (mut used, mut given) = (String::new(), String::new());
    for at in 0..functions {
        write!(
            lifted,
            r#"(func (export "f{at}") {parameters} (canon lift (core func $i "f{at}")
                (memory (core memory $i "memory")) (realloc (core func $i "realloc"))
                string-encoding=utf16))"#
        )
        .expect("a string takes everything");
        write!(imports, r#"(import "f{at}" (func $f{at} {parameters}))"#)
            .expect("a string takes everything");
        write!(
            lowered,
            r#"(core func $l{at} (canon lower (func $f{at}) (memory (core memory $i "memory"))
                string-encoding=latin1+utf16))"#
        )
        .expect("a string takes everything");
    }
    let core: String = (0..functions)
        .map(|at| format!(r#"(func (export "f{at}") (param {flat}))"#))
        .collect();
    for at in 0..functions {
        write!(used, r#"(import "l" "f{at}" (func (param {flat})))"#)
            .expect("a string takes everything");
        write!(given, r#"(export "f{at}" (func $l{at}))"#).expect("a string takes everything");
    }
    let arguments: String = (0..functions)
        .map(|at| format!(r#"(with "f{at}" (func $a "f{at}"))"#))
        .collect();
    parse(&format!(
        r#"(component
            (component $a
                (core module $m (memory (export "memory") 1)
                    (func (export "realloc") (param i32 i32 i32 i32) (result i32) i32.const 0)
                    {core})
                (core instance $i (instantiate $m)) {lifted})
            (component $b {imports}
                (core module $m (memory (export "memory") 1))
                (core instance $i (instantiate $m)) {lowered}
                (core module $u {used})
                (core instance (instantiate $u (with "l" (instance {given})))))
            (instance $a (instantiate $a))
            (instance (instantiate $b {arguments})))"#
    ))
}
