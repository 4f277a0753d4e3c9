//! [`Candidate`]: a file of one generator or of two, with its parameters.

use std::fmt;

use wasm_encoder::{Component, RawSection};
use wasmouse_engine::admission::BinaryKind;

use super::generators::Generator;
use crate::bombs::with_repeated_functions;

/// How often the functions of a second module are in a file to begin with.
const FUNCTIONS_TIMES: u32 = 8;

/// What one generator makes.
#[derive(Clone, Debug)]
struct Part {
    generator: Generator,
    parameters: Vec<u32>,
    /// How often each of its functions is in its module.
    functions_times: u32,
    /// How often the module is in the file.
    modules: u32,
}

impl Part {
    fn make(&self) -> Vec<u8> {
        (self.generator.make)(&self.parameters)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{:?}", self.generator.name, self.parameters)?;
        if self.functions_times > 1 {
            write!(f, ", functions {} times", self.functions_times)?;
        }
        if self.modules > 1 {
            write!(f, ", {} modules", self.modules)?;
        }
        Ok(())
    }
}

/// A file of one generator, or with the modules of two, the first of which is compiled first.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    before: Option<Part>,
    last: Part,
}

impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(before) = &self.before {
            write!(f, "{before}, then ")?;
        }
        self.last.fmt(f)
    }
}

impl Candidate {
    /// A file of that generator with the parameters to begin with.
    pub(super) fn of(generator: Generator) -> Self {
        Self {
            before: None,
            last: Part {
                generator,
                parameters: generator.start.to_vec(),
                functions_times: 1,
                modules: 1,
            },
        }
    }

    /// A file with the last module of this one and then that of another one, if both are core
    /// modules.
    pub(super) fn followed_by(&self, other: &Self) -> Option<Self> {
        let parts = [&self.last, &other.last];
        let are_modules = parts
            .into_iter()
            .all(|part| BinaryKind::of(&part.make()) == BinaryKind::CoreModule);
        are_modules.then(|| Self {
            before: Some(self.last.clone()),
            last: Part {
                functions_times: FUNCTIONS_TIMES,
                ..other.last.clone()
            },
        })
    }

    /// The bytes of the file. `None` when functions cannot be repeated, because it is not a core
    /// module.
    pub(super) fn file(&self) -> Option<Vec<u8>> {
        let mut component = Component::new();
        for part in self.before.iter().chain([&self.last]) {
            let mut data = part.make();
            if BinaryKind::of(&data) != BinaryKind::CoreModule {
                let is_alone = self.before.is_none() && part.functions_times * part.modules == 1;
                return is_alone.then_some(data);
            }
            if part.functions_times > 1 {
                data = with_repeated_functions(&data, part.functions_times)?;
            }
            for _ in 0..part.modules {
                // A core module.
                component.section(&RawSection { id: 1, data: &data });
            }
        }
        Some(component.finish())
    }

    /// Multiplies one of the parameters by that many eighths.
    pub(super) fn change(&mut self, at: u32, eighths: u32) {
        let mut parameters: Vec<&mut u32> = self.last.parameters.iter_mut().collect();
        if let Some(before) = &mut self.before {
            parameters.extend(&mut before.parameters);
            parameters.push(&mut self.last.functions_times);
        }
        let at = usize::try_from(at).unwrap_or(0) % parameters.len();
        let value = u64::from(*parameters[at]) * u64::from(eighths) / 8;
        *parameters[at] = u32::try_from(value).unwrap_or(u32::MAX).max(1);
    }

    /// The same file with each function of the last module that many times.
    pub(super) fn repeated(&self, functions_times: u32) -> Self {
        let mut candidate = self.clone();
        candidate.last.functions_times = functions_times;
        candidate
    }

    /// The same file with the last module that many times, and its functions once.
    pub(super) fn copied(&self, modules: u32) -> Self {
        let mut candidate = self.repeated(1);
        candidate.last.modules = modules;
        candidate
    }
}
