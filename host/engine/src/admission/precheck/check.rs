//! [`precheck`]: reads a file once and compares what it holds with the limits.

use wasmparser::{Encoding, Parser, Payload, ValidPayload, Validator};

use super::super::place::FunctionPlace;
use super::super::proposal::{FEATURES, Proposal};
use super::super::rejection::Rejection;
use super::component::Components;
use super::function::Functions;
use super::gauge::Gauge;
use super::measure::Measure;
use super::module::Module;
use super::names;
use super::shape::Shape;
use crate::limits::Limits;

/// Checks a component or a core module.
///
/// The names of the shape are those of a component; a core module has none.
///
/// # Errors
///
/// [`Rejection::OverLimit`] with the limit, the value and the place;
/// [`Rejection::Invalid`] when the file is malformed, and [`Rejection::Proposal`] when it uses a
/// proposal that is off.
///
/// ```
/// use wasmouse_engine::Limits;
/// use wasmouse_engine::admission::precheck::{Measure, precheck};
///
/// let shape = precheck(b"\0asm\x0d\0\x01\0", &Limits::default()).expect("an empty component");
/// assert_eq!(shape.measures.get(Measure::CoreInstances), 0);
/// ```
pub fn precheck(bytes: &[u8], limits: &Limits) -> Result<Shape, Rejection> {
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
        Err(rejection) => Err(check.locate(rejection, bytes)),
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
    fn file(&mut self, bytes: &[u8]) -> Result<(), Rejection> {
        let mut parser = Parser::new(0);
        parser.set_features(FEATURES);
        for payload in parser.parse_all(bytes) {
            self.payload(&payload?, bytes)?;
        }
        Ok(())
    }

    fn payload(&mut self, payload: &Payload<'_>, bytes: &[u8]) -> Result<(), Rejection> {
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
            (_, None) => {
                let validator = &mut self.validator;
                let gauge = &mut self.gauge;
                if self.components.section(payload, bytes, validator, gauge)? {
                    return Ok(());
                }
            }
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
            _ => Ok(()),
        }
    }

    fn begin(&mut self, encoding: Encoding, byte: u64) -> Result<(), Rejection> {
        match encoding {
            Encoding::Module => {
                self.module = Some(Module::default());
                self.modules += 1;
                self.gauge.add(Measure::Modules, 1, byte)
            }
            Encoding::Component => {
                self.is_component = true;
                self.components.begin(&mut self.gauge, byte)
            }
        }
    }

    fn end(&mut self, byte: u64) -> Result<(), Rejection> {
        let Some(module) = &mut self.module else {
            return self.components.end(&mut self.gauge, byte);
        };
        let requirements = module.end(&mut self.gauge, byte)?;
        self.module = None;
        if self.is_component {
            self.components.module(requirements);
            return Ok(());
        }
        // The component around it instantiates it once.
        requirements.check(&mut self.gauge, byte)
    }

    /// Adds to a rejection in which module and function it was found.
    fn locate(&self, mut rejection: Rejection, bytes: &[u8]) -> Rejection {
        if let Rejection::OverLimit { at, .. } = &mut rejection
            && self.module.is_some()
        {
            let module = self.modules - 1;
            at.module = self.is_component.then_some(module);
            at.function = self.function.map(|index| FunctionPlace {
                index,
                name: names::function_name(bytes, module, index),
            });
        }
        rejection
    }
}

impl From<wasmparser::BinaryReaderError> for Rejection {
    fn from(error: wasmparser::BinaryReaderError) -> Self {
        let byte = error.offset();
        if let Some(proposal) = Proposal::needed(&error) {
            return Self::Proposal {
                proposal,
                byte,
                place: None,
            };
        }
        // Some messages have a second line with the cause.
        let message = error.message().replace('\n', ": ");
        Self::Invalid {
            message,
            byte: Some(byte),
        }
    }
}
