//! The check of a file before anything of it is compiled.
//!
//! [`precheck`] reads a component or core module once, validates it with exactly the
//! proposals that the engine has, and measures on the way ([`Measure`]) what would
//! make compiling or instantiating it take too long or too much memory. It compiles
//! and runs nothing, knows no engine, and takes time proportional to the size of the
//! file: whatever validation does more than once is limited before it begins.
//!
//! # What real robots have
//!
//! Measured on a robot that drives straight on, built with componentize-py 0.25.1
//! (18.3 MB), jco 1.35 with QuickJS (1.6 MB) and componentize-js 0.23 (12.0 MB).
//! Compiling them took 15, 2.7 and 18 s of CPU and 350, 97 and 413 MB.
//!
//! | measure | limit | Python | QuickJS | StarlingMonkey |
//! |---|---|---|---|---|
//! | core instances | 64 | 38 | 11 | 3 |
//! | component depth | 100 | 2 | 4 | 2 |
//! | component items | 10,000 | 1,790 | 1,500 | 121 |
//! | the same, instantiated | 20,000 | 3,374 | 1,849 | 143 |
//! | values in lowered functions | 20,000 | 35 | 408 | 35 |
//! | parts of a type | 2,000 | 66 | 63 | 19 |
//! | bytes in a name | 2,000 | 162 | 78 | 51 |
//! | items of one kind | 100,000 | 4,955 | 5,290 | 10,000 |
//! | function types | 5,000 | 509 | 127 | 141 |
//! | functions | 60,000 | 13,486 | 1,710 | 12,675 |
//! | parameters and results | 200 | 19 | 14 | 18 |
//! | locals | 12,000 | 273 | 86 | 122 |
//! | bytes in a function | 1,048,576 | 426,843 | 54,010 | 171,628 |
//! | blocks inside each other | 4,000 | 781 | 281 | 456 |
//! | loops inside each other | 64 | 6 | 21 | 6 |
//! | operands | 500 | 54 | 15 | 64 |
//! | targets of a `br_table` | 20,000 | 3,202 | 254 | 453 |
//! | blocks of a function | 40,000 | 14,002 | 5,810 | 17,716 |
//! | variables times blocks | 64,000,000 | 315,600 | 952,840 | 19,394,640 |
//! | values carried | 80,000 | 9,773 | 8,879 | 24,146 |
//! | estimated MiB, one function | 600 | 184 | 79 | 290 |
//! | estimated ms, one function | 20,000 | 2,521 | 663 | 5,017 |
//! | estimated ms, the file | 65,000 | 22,813 | 4,772 | 41,471 |
//!
//! # What the estimate is worth
//!
//! Generators of bad files, each pushing one or two terms, were compiled with
//! wasmtime 48 on one thread, and the terms were raised to what they took. Of files
//! within the limits, those that come nearest to their estimate reach nine tenths of
//! it: indirect calls, arithmetic after a long chain of blocks, and values that are
//! spilled. The most that one function within the limits was seen to take is 11 s
//! and 425 MB. Checking alone, with a process for it, takes 0.2 s for the Python robot in
//! a release build, and 0.01 s for one in C. Whatever the estimate misses, the process that compiles has its own
//! limits on time and memory.

mod component;
mod expansion;
mod flow;
mod function;
mod measure;
mod module;
mod names;
mod parts;

use wasmparser::{Encoding, Parser, Payload, ValidPayload, Validator, WasmFeatures};

pub use measure::{FunctionPlace, Measure, Measures, Place};

use super::{Refusal, Shape};
use crate::sim::Limits;
use component::Components;
use function::Functions;
use measure::Gauge;
use module::Module;

/// The proposals that a robot may use: those that `engine::compiler_config` leaves on.
/// What this lets through by mistake, the engine refuses when it compiles.
const FEATURES: WasmFeatures = WasmFeatures::WASM2
    .union(WasmFeatures::TAIL_CALL)
    .union(WasmFeatures::EXTENDED_CONST)
    .union(WasmFeatures::MULTI_MEMORY)
    .union(WasmFeatures::COMPONENT_MODEL)
    .difference(WasmFeatures::GC_TYPES);

/// Checks a component or a core module.
///
/// The names of the shape are those of a component; a core module has none.
///
/// # Errors
///
/// [`Refusal::OverLimit`] with the limit, the value and the place;
/// [`Refusal::Invalid`] when the file is malformed or uses a proposal that is off.
///
/// ```
/// use wasmouse::robot::precheck::{Measure, precheck};
/// use wasmouse::sim::Limits;
///
/// let shape = precheck(b"\0asm\x0d\0\x01\0", &Limits::default()).expect("an empty component");
/// assert_eq!(shape.measures.get(Measure::CoreInstances), 0);
/// ```
pub fn precheck(bytes: &[u8], limits: &Limits) -> Result<Shape, Refusal> {
    let mut check = Check {
        validator: Validator::new_with_features(FEATURES),
        gauge: Gauge::new(limits),
        components: Components::default(),
        functions: Functions::default(),
        module: None,
        is_component: false,
        modules: 0,
        function: None,
    };
    match check.file(bytes) {
        Ok(()) => Ok(Shape {
            imports: check.components.imports,
            exports: check.components.exports,
            measures: *check.gauge.found(),
        }),
        Err(refusal) => Err(check.locate(refusal, bytes)),
    }
}

/// A file that is being read.
struct Check<'a> {
    validator: Validator,
    gauge: Gauge<'a>,
    components: Components,
    functions: Functions,
    /// The core module that is open: there is never one inside another.
    module: Option<Module>,
    is_component: bool,
    /// Core modules that have begun.
    modules: u32,
    /// The function that is being checked.
    function: Option<u32>,
}

impl Check<'_> {
    fn file(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let mut parser = Parser::new(0);
        parser.set_features(FEATURES);
        for payload in parser.parse_all(bytes) {
            self.payload(&payload?)?;
        }
        Ok(())
    }

    fn payload(&mut self, payload: &Payload<'_>) -> Result<(), Refusal> {
        match (payload, &mut self.module) {
            (
                Payload::Version {
                    encoding, range, ..
                },
                _,
            ) => self.begin(*encoding, range.start)?,
            (Payload::CustomSection(section), _) => {
                self.gauge
                    .add(Measure::CustomSections, 1, section.range().start)?;
            }
            (Payload::End(_), _) => {}
            (_, Some(module)) => module.section(payload, &mut self.gauge)?,
            (_, None) => self.components.section(payload, &mut self.gauge)?,
        }
        match self.validator.payload(payload)? {
            ValidPayload::Func(function, body) => {
                self.function = Some(function.index);
                self.functions.check(function, &body, &mut self.gauge)?;
                self.function = None;
            }
            ValidPayload::Ok | ValidPayload::Parser(_) | ValidPayload::End(_) => {}
        }
        match payload {
            Payload::End(byte) => self.end(*byte),
            _ => self
                .components
                .validated(payload, self.validator.types(0), &mut self.gauge),
        }
    }

    fn begin(&mut self, encoding: Encoding, byte: u64) -> Result<(), Refusal> {
        match encoding {
            Encoding::Module => {
                self.module = Some(Module::default());
                self.modules += 1;
                Ok(())
            }
            Encoding::Component => {
                self.is_component = true;
                self.components.begin(&mut self.gauge, byte)
            }
        }
    }

    fn end(&mut self, byte: u64) -> Result<(), Refusal> {
        match self.module.take() {
            None => self.components.end(&mut self.gauge, byte),
            Some(module) if self.is_component => {
                self.components.module(module.needs);
                Ok(())
            }
            // The component around it instantiates it once.
            Some(module) => component::check_needs(&module.needs, &mut self.gauge, byte),
        }
    }

    /// Adds to a refusal in which module and function it was found.
    fn locate(&self, mut refusal: Refusal, bytes: &[u8]) -> Refusal {
        if let Refusal::OverLimit { at, .. } = &mut refusal
            && self.module.is_some()
        {
            let module = self.modules - 1;
            at.module = self.is_component.then_some(module);
            at.function = self.function.map(|index| FunctionPlace {
                index,
                name: names::function_name(bytes, module, index),
            });
        }
        refusal
    }
}

impl From<wasmparser::BinaryReaderError> for Refusal {
    fn from(error: wasmparser::BinaryReaderError) -> Self {
        // Some messages have a second line with the cause.
        let message = error.message().replace('\n', ": ");
        Self::Invalid(format!("{message} at byte {}", error.offset()))
    }
}
