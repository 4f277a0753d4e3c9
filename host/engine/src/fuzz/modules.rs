//! Robots around random modules, made by wasm-smith.

use std::sync::LazyLock;

use arbitrary::Unstructured;
use wasm_smith::{Config, Module};

use crate::admission::{CONTROLLER_EXPORTS, JOURNAL_IMPORT};

/// The parameters of `start`: the 14 numbers of the briefing.
const START_PARAMETERS: &str = "(param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)";

const NEXT_TYPE: &str = "(param i32 i32 i32) (result i32)";

/// A robot file. An odd first byte gives a module whose random code is called directly and
/// seldom returns a pointer to an action; an even one gives a module that makes an action of
/// whatever number the random code returns, and so drives.
pub(super) fn robot(bytes: &[u8]) -> Option<Vec<u8>> {
    static DIRECT: LazyLock<Config> = LazyLock::new(|| config(CONTROLLER_EXPORTS));
    static DRIVEN: LazyLock<Config> = LazyLock::new(|| config(["start", "next"]));
    let (&choice, entropy) = bytes.split_first()?;
    let module = |config: &Config| {
        let module = Module::new(config.clone(), &mut Unstructured::new(entropy));
        module.map(|module| module.to_bytes()).ok()
    };
    if choice % 2 == 1 {
        module(&DIRECT)
    } else {
        Some(drive(&module(&DRIVEN)?))
    }
}

/// Adds the functions of a robot, which call those that the random module exports.
fn drive(module: &[u8]) -> Vec<u8> {
    let text = wasmprinter::print_bytes(module).expect("wasm-smith makes valid modules");
    let exported = |name: &str| {
        let start = format!("(export \"{name}\" (func ");
        let (_, rest) = text.split_once(&start).expect("it has the export");
        rest.split_once(')').expect("the text is balanced").0
    };
    let (start, next) = (exported("start"), exported("next"));
    let arguments: String = (0..14).map(|it| format!("local.get {it} ")).collect();
    let [start_name, next_name] = CONTROLLER_EXPORTS;
    let robot = format!(
        r#"(func (export "{start_name}") {START_PARAMETERS} {arguments} call {start})
           (func (export "{next_name}") {NEXT_TYPE} (local $number i32)
             (local.set $number
               (call {next} (local.get 0) (local.get 1) (local.get 2)))
             ;; a reset now and then, else a turn and an advance of -3 to 4
             (i32.store8 (i32.const 16) (i32.eq
               (i32.and (local.get $number) (i32.const 31)) (i32.const 31)))
             (i32.store8 (i32.const 17) (i32.rem_u
               (i32.shr_u (local.get $number) (i32.const 5)) (i32.const 3)))
             (i32.store8 (i32.const 18) (i32.sub
               (i32.and (i32.shr_u (local.get $number) (i32.const 8)) (i32.const 7))
               (i32.const 3)))
             i32.const 16)"#
    );
    let end = text.rfind(')').expect("the text is balanced");
    let text = format!("{}{robot})", &text[..end]);
    wat::parse_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// What the engine has turned on, with the exports of a robot under these names.
fn config([start, next]: [&str; 2]) -> Config {
    let parse = |text: String| Some(wat::parse_str(text).expect("valid text"));
    Config {
        exports: parse(format!(
            r#"(module
                (memory (export "memory") 1 20)
                (func (export "{start}") {START_PARAMETERS})
                (func (export "{next}") {NEXT_TYPE} i32.const 16))"#
        )),
        available_imports: parse(format!(
            r#"(module (import "{JOURNAL_IMPORT}" "log" (func (param i32 i32 i32))))"#
        )),
        max_funcs: 12,
        max_instructions: 200,
        max_memories: 1,
        max_memory32_bytes: 20 << 16,
        max_tables: 1,
        max_table_elements: 1000,
        exceptions_enabled: false,
        gc_enabled: false,
        memory64_enabled: false,
        custom_page_sizes_enabled: false,
        relaxed_simd_enabled: false,
        shared_everything_threads_enabled: false,
        threads_enabled: false,
        wide_arithmetic_enabled: false,
        compact_imports_enabled: false,
        custom_descriptors_enabled: false,
        // External references are a part of the proposal for garbage collection.
        reference_types_enabled: false,
        ..Config::default()
    }
}

/// A robot in text that drives straight on, with imports and with code in `start`.
#[cfg(test)]
pub(super) fn parse_robot(imports: &str, start: &str) -> Vec<u8> {
    let [start_name, next_name] = CONTROLLER_EXPORTS;
    let text = format!(
        r#"(module
            {imports}
            (memory (export "memory") 1)
            ;; the action at 16: move, straight, 1
            (data (i32.const 16) "\00\01\01")
            (func (export "{start_name}") {START_PARAMETERS} {start})
            (func (export "{next_name}") {NEXT_TYPE} i32.const 16))"#
    );
    wat::parse_str(text).expect("valid text")
}
