//! [`Module`]: small robots in WebAssembly text.
//!
//! Tests and the hostile corpus state the part of a robot that matters to them; the
//! rest is a harmless robot that drives on.

use wasmouse_engine::admission::{INTERFACE_VERSION, componentize};

/// Where [`Module`] keeps the action "straight, 1 cell" in its memory.
pub const DRIVE_ON: &str = "i32.const 16";

/// The parts of a robot in text. Each part is written in the text format, and what
/// is not given does what a harmless robot would do.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    /// Body of `start`.
    pub start: &'a str,
    /// Body of `next-move`; leaves a pointer to the action.
    pub next: &'a str,
    /// Imports of the module, which come first.
    pub imports: &'a str,
    /// The memory, which must be exported under the name `memory`.
    pub memory: &'a str,
    /// More fields of the module.
    pub rest: &'a str,
}

impl Default for Module<'_> {
    fn default() -> Self {
        Self {
            start: "",
            next: DRIVE_ON,
            imports: "",
            memory: r#"(memory (export "memory") 1)"#,
            rest: "",
        }
    }
}

/// The parameters of `start`: the 14 numbers of the briefing.
pub const START_PARAMETERS: &str =
    "(param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)";

/// The text with the version of the interface in place of `@VERSION`.
///
/// All texts of modules, components and messages in this crate write the version so. The
/// functions that take or make such a text replace it.
pub fn versioned(text: &str) -> String {
    text.replace("@VERSION", &format!("@{INTERFACE_VERSION}"))
}

/// `log` of the journal as a module imports it: level, pointer, length.
pub const IMPORT_LOG: &str = r#"(import "wasmouse:robot/journal@VERSION" "log"
    (func $log (param i32 i32 i32)))"#;

impl Module<'_> {
    /// The module as text.
    pub fn wat(&self) -> String {
        let Self {
            start,
            next,
            imports,
            memory,
            rest,
        } = self;
        versioned(&format!(
            r#"(module
                {imports}
                {memory}
                ;; the action at 16: move, straight, 1
                (data (i32.const 16) "\00\01\01")
                {rest}
                (func (export "wasmouse:robot/controller@VERSION#start")
                    {START_PARAMETERS} {start})
                (func (export "wasmouse:robot/controller@VERSION#next-move")
                    (param i32 i32 i32) (result i32) {next}))"#
        ))
    }

    /// The module in binary form.
    ///
    /// # Panics
    ///
    /// When the text is none of WebAssembly.
    #[track_caller]
    pub fn core(&self) -> Vec<u8> {
        wasm(&self.wat())
    }

    /// The module in binary form with DWARF debug information: its lines are those of the
    /// text, in a file of that name.
    ///
    /// # Panics
    ///
    /// When the text is none of WebAssembly.
    #[track_caller]
    pub fn core_with_lines(&self, file: &str) -> Vec<u8> {
        let mut parser = wat::Parser::new();
        parser.generate_dwarf(wat::GenerateDwarf::Lines);
        let module = parser.parse_str(Some(file.as_ref()), self.wat());
        module.unwrap_or_else(|error| panic!("{error}\n{}", self.wat()))
    }

    /// The robot: a component around the module.
    ///
    /// # Panics
    ///
    /// When the module does not become one.
    #[track_caller]
    pub fn component(&self) -> Vec<u8> {
        componentize(&self.core()).unwrap_or_else(|error| panic!("{error}\n{}", self.wat()))
    }
}

/// The binary form of a module or component in text.
///
/// # Panics
///
/// When the text is none of WebAssembly.
#[track_caller]
pub fn wasm(text: &str) -> Vec<u8> {
    let text = versioned(text);
    wat::parse_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}
