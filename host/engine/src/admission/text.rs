//! [`to_binary`]: WebAssembly text, turned into its binary form.
//!
//! The text is untrusted, and this is one more parser for it to attack, so it runs where files
//! are examined and nowhere else: in the compile worker, for a file of someone else. Text has a
//! size limit of its own, because its tree takes up to 70 times its size. The parser rejects deep
//! nesting; what else takes too long ends with the processor time of the worker.
//!
//! Functions keep their names, and short texts their lines, so a backtrace names the line.
//!
//! [`place_of`] finds the place in the text for what validation says about the binary form.

use std::path::Path;

use wasmparser::{Parser as BinaryParser, Payload};
use wast::Wat;
use wast::core::{EncodeOptions, FuncKind, GenerateDwarf, ModuleField, ModuleKind};
use wast::parser::{self, ParseBuffer};
use wast::token::Span;

use super::binary::without_mark;
use crate::limits::Limits;

/// The name of the text in backtraces. A robot's own file name is not a part of the robot.
const FILE: &str = "robot.wat";

/// The longest text whose lines are recorded, in bytes: longer ones were generated.
const LINES_BYTES_MAX: usize = 256 << 10;

/// The longest line in such a text, in bytes. For each instruction, the encoder searches the
/// rest of its line.
const LINE_BYTES_MAX: usize = 2_000;

/// The longest excerpt in a message, in characters.
const EXCERPT_CHARS_MAX: usize = 40;

/// Why a text cannot be turned into binary form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextError {
    /// The text is larger than the limits allow.
    #[error("WebAssembly text of more than {max} bytes")]
    TooLarge {
        /// The limit in bytes.
        max: u64,
    },
    /// The text is not UTF-8.
    #[error("WebAssembly text that is not UTF-8: line {line}")]
    NotUtf8 {
        /// The first such line, from 1.
        line: usize,
    },
    /// The text does not follow the grammar, or names what it does not define.
    #[error("malformed WebAssembly text: {place}: {message}{near}", near = .place.near())]
    Malformed {
        /// Where.
        place: TextPlace,
        /// What is wrong there.
        message: String,
    },
    /// The text follows the grammar and its module is not valid.
    #[error("invalid WebAssembly text: {place}: {message}{near}", near = .place.near())]
    Invalid {
        /// Where.
        place: TextPlace,
        /// What is wrong there.
        message: String,
    },
}

impl TextError {
    /// What the author of the text can do.
    pub const fn hint(&self) -> &'static str {
        match self {
            Self::TooLarge { .. } => {
                "text of that size was generated: use the binary form (.wasm) that it comes from"
            }
            Self::NotUtf8 { .. } => "save the file as UTF-8",
            Self::Malformed { .. } => {
                "the text format is described at https://webassembly.github.io/spec/core/text"
            }
            Self::Invalid { .. } => {
                "operands have to be on the stack in the types that the instruction takes"
            }
        }
    }
}

/// A place in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPlace {
    /// From 1.
    pub line: usize,
    /// In bytes, from 1.
    pub column: usize,
    /// What stands there, up to the end of the line, at most 40 characters: text of the guest
    /// without control characters.
    pub excerpt: String,
}

impl TextPlace {
    fn of(text: &str, span: Span) -> Self {
        let (line, column) = span.linecol_in(text);
        let rest = text.get(span.offset()..).unwrap_or_default();
        let rest = rest.lines().next().unwrap_or_default().trim_end();
        let mut excerpt: String = rest
            .chars()
            .take(EXCERPT_CHARS_MAX)
            .map(|it| if it.is_control() { ' ' } else { it })
            .collect();
        if excerpt.len() < rest.len() {
            excerpt.push_str("...");
        }
        Self {
            line: line + 1,
            column: column + 1,
            excerpt,
        }
    }

    /// How a message ends that quotes the place.
    fn near(&self) -> String {
        match self.excerpt.as_str() {
            "" => String::new(),
            excerpt => format!(", at `{excerpt}`"),
        }
    }
}

impl std::fmt::Display for TextPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// The binary form of WebAssembly text: of a core module or a component, which may still be
/// invalid. The same text always gives the same bytes.
///
/// # Errors
///
/// [`TextError`] says where the text is malformed.
///
/// ```
/// use wasmouse_engine::Limits;
/// use wasmouse_engine::admission::{TextError, to_binary};
///
/// let limits = Limits::default();
/// let binary = to_binary(b"(module)", &limits).expect("a module without anything in it");
/// assert!(binary.starts_with(b"\0asm\x01\0\0\0"));
/// let error = to_binary(b"(module\n  (fun))", &limits).expect_err("there is no `fun`");
/// assert!(error.to_string().contains("line 2, column 4"), "{error}");
/// ```
pub fn to_binary(bytes: &[u8], limits: &Limits) -> Result<Vec<u8>, TextError> {
    let max = limits.admission.text_bytes_max;
    if u64::try_from(bytes.len()).unwrap_or(u64::MAX) > max {
        return Err(TextError::TooLarge { max });
    }
    let text = as_str(bytes)?;
    let has_lines =
        text.len() <= LINES_BYTES_MAX && text.lines().all(|it| it.len() <= LINE_BYTES_MAX);
    let malformed = |error: &wast::Error| TextError::Malformed {
        place: TextPlace::of(text, error.span()),
        message: error.message().replace(char::is_control, " "),
    };
    let buffer = buffer(text, has_lines).map_err(|error| malformed(&error))?;
    let mut wat = parser::parse::<Wat<'_>>(&buffer).map_err(|error| malformed(&error))?;
    let mut options = EncodeOptions::new();
    if has_lines {
        options.dwarf(Path::new(FILE), text, GenerateDwarf::Lines);
    }
    options
        .encode_wat(&mut wat)
        .map_err(|error| malformed(&error))
}

fn as_str(bytes: &[u8]) -> Result<&str, TextError> {
    let bytes = without_mark(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        let line = valid.iter().filter(|it| **it == b'\n').count() + 1;
        TextError::NotUtf8 { line }
    })
}

fn buffer(text: &str, has_lines: bool) -> Result<ParseBuffer<'_>, wast::Error> {
    let mut buffer = ParseBuffer::new(text)?;
    buffer.track_instr_spans(has_lines);
    Ok(buffer)
}

/// The place in a text of what is at that offset of its binary form, a core module; `None` when
/// it is no instruction.
pub(super) fn place_of(bytes: &[u8], binary: &[u8], byte: u64) -> Option<TextPlace> {
    let text = as_str(bytes).ok()?;
    let (function, instruction) = instruction(binary, byte)?;
    let buffer = buffer(text, true).ok()?;
    let Wat::Module(module) = parser::parse(&buffer).ok()? else {
        return None;
    };
    let ModuleKind::Text(fields) = module.kind else {
        return None;
    };
    let mut functions = fields.iter().filter_map(|field| match field {
        ModuleField::Func(function) => match &function.kind {
            FuncKind::Inline { expression, .. } => Some((function.span, expression)),
            FuncKind::Import(..) => None,
        },
        _ => None,
    });
    let (whole, expression) = functions.nth(function)?;
    let spans = expression.instr_spans.as_deref().unwrap_or_default();
    // The `end` of a function stands nowhere: what is wrong there is wrong with all of it.
    let span = spans.get(instruction).copied().unwrap_or(whole);
    Some(TextPlace::of(text, span))
}

/// The number of the function, of those with code, and of the instruction in it.
fn instruction(binary: &[u8], byte: u64) -> Option<(usize, usize)> {
    let bodies = BinaryParser::new(0)
        .parse_all(binary)
        .map_while(Result::ok)
        .filter_map(|payload| match payload {
            Payload::CodeSectionEntry(body) => Some(body),
            _ => None,
        });
    let (function, body) = bodies
        .enumerate()
        .find(|(_, body)| body.range().contains(&byte))?;
    let begun = body
        .get_operators_reader()
        .ok()?
        .into_iter_with_offsets()
        .map_while(Result::ok)
        .take_while(|(_, offset)| *offset <= byte);
    Some((function, begun.count().checked_sub(1)?))
}

#[cfg(test)]
mod tests;
