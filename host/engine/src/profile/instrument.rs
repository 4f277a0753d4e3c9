//! [`instrument`]: a component whose functions announce each call and each return.
//!
//! The engine asks its host at the beginning of every function whether the match may go on
//! (epochs), and fuel is exact at these points. So each function becomes a new one behind a wrapper
//! of its index:
//!
//! ```wat
//! (func $wrapper (param ...) (result ...)    ;; asks: the call begins
//!   (call $body (local.get 0) ...)           ;; asks too, which means nothing
//!   (call $leave))                           ;; asks: the call has ended
//! ```
//!
//! Functions keep their indices, because new ones follow after the old ones. So everything but three
//! sections is copied as it is, and the component around the modules does not change at all. The
//! names of wrappers say which they are.

use wasmparser::{
    BinaryReader, BinaryReaderError, CustomSectionReader, ExportSectionReader, ExternalKind,
    FunctionSectionReader, ImportSectionReader, KnownCustom, Name, NameSectionReader, TypeRef,
    TypeSectionReader,
};

/// Ids of sections.
mod section {
    pub const CUSTOM: u8 = 0;
    pub const TYPE: u8 = 1;
    pub const IMPORT: u8 = 2;
    pub const FUNCTION: u8 = 3;
    pub const EXPORT: u8 = 7;
    pub const CODE: u8 = 10;
    /// In components.
    pub const CORE_MODULE: u8 = 1;
    pub const COMPONENT: u8 = 4;
}

/// Magic number and version, of modules and components.
const HEADER_BYTES: usize = 8;

/// What the beginning of a function means, by its name in an instrumented module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// A call of a function begins.
    Enter {
        /// Index in [`Instrumented::functions`].
        function: usize,
    },
    /// The call that began last has ended.
    Leave,
}

/// The name of the function that marks the end of a call.
const LEAVE: &str = "leave";

/// How names of wrappers begin; the index of the function follows.
const ENTER: &str = "enter ";

impl Mark {
    /// The meaning of a function of that name; `None` for all that are no marks.
    pub(super) fn of(name: &str) -> Option<Self> {
        if name == LEAVE {
            return Some(Self::Leave);
        }
        let function = name.strip_prefix(ENTER)?.parse().ok()?;
        Some(Self::Enter { function })
    }
}

/// A function that announces its calls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Function {
    /// Its name in the name section, or else in the exports, as it is there.
    pub(super) name: Option<String>,
    /// Its index in its module.
    pub(super) index: u32,
    /// The module in the component, counted from 0.
    pub(super) module: u32,
    /// How many parameters it has.
    pub(super) parameters: u64,
}

/// Why a component has no instrumented form: it is not valid.
#[derive(Debug, thiserror::Error)]
#[error("failed to instrument the robot: {0}")]
pub(crate) struct NotInstrumented(String);

impl From<BinaryReaderError> for NotInstrumented {
    fn from(error: BinaryReaderError) -> Self {
        Self(error.to_string())
    }
}

type Result<T> = std::result::Result<T, NotInstrumented>;

/// A component whose functions announce their calls.
pub(super) struct Instrumented {
    /// The component.
    pub(super) component: Vec<u8>,
    /// All functions, of all modules.
    pub(super) functions: Vec<Function>,
}

/// Makes all functions of a valid component announce their calls.
///
/// # Errors
///
/// When the component is not valid.
pub(super) fn instrument(component: &[u8]) -> Result<Instrumented> {
    let mut writer = Writer::default();
    let component = writer.component(component)?;
    Ok(Instrumented {
        component,
        functions: writer.functions,
    })
}

#[derive(Default)]
struct Writer {
    functions: Vec<Function>,
    modules: u32,
}

impl Writer {
    fn component(&mut self, bytes: &[u8]) -> Result<Vec<u8>> {
        let mut out = bytes[..HEADER_BYTES.min(bytes.len())].to_vec();
        for section in sections(bytes)? {
            let (id, content) = section;
            match id {
                section::CORE_MODULE => write_section(&mut out, id, &self.module(content)?),
                section::COMPONENT => write_section(&mut out, id, &self.component(content)?),
                _ => write_section(&mut out, id, content),
            }
        }
        Ok(out)
    }

    fn module(&mut self, bytes: &[u8]) -> Result<Vec<u8>> {
        let module = Module::read(bytes)?;
        if module.defined.is_empty() {
            return Ok(bytes.to_vec());
        }
        let first = self.functions.len();
        let number = self.modules;
        self.modules += 1;
        for (at, &signature) in module.defined.iter().enumerate() {
            let index = module.imported + u32::try_from(at).unwrap_or(u32::MAX);
            self.functions.push(Function {
                name: module.name(index),
                index,
                module: number,
                parameters: module.parameters[signature as usize],
            });
        }

        let mut out = bytes[..HEADER_BYTES].to_vec();
        for (id, content) in sections(bytes)? {
            match id {
                // Names and debug information are about the functions as they were.
                section::CUSTOM => {}
                section::TYPE => write_section(&mut out, id, &module.types(content)?),
                section::FUNCTION => write_section(&mut out, id, &module.signatures()),
                section::CODE => write_section(&mut out, id, &module.code(content)?),
                _ => write_section(&mut out, id, content),
            }
        }
        write_section(&mut out, section::CUSTOM, &module.names(first));
        Ok(out)
    }
}

/// What has to be known of a module.
#[derive(Default)]
struct Module {
    /// Parameters of each type.
    parameters: Vec<u64>,
    /// How many functions are imported.
    imported: u32,
    /// The types of the functions that are defined.
    defined: Vec<u32>,
    named: Vec<(u32, String)>,
    exported: Vec<(u32, String)>,
}

impl Module {
    fn read(bytes: &[u8]) -> Result<Self> {
        let mut module = Self::default();
        for (id, content) in sections(bytes)? {
            let reader = BinaryReader::new(content, 0);
            match id {
                section::TYPE => {
                    for signature in TypeSectionReader::new(reader)?.into_iter_err_on_gc_types() {
                        module.parameters.push(signature?.params().len() as u64);
                    }
                }
                section::IMPORT => {
                    for import in ImportSectionReader::new(reader)?.into_imports() {
                        if matches!(import?.ty, TypeRef::Func(_)) {
                            module.imported += 1;
                        }
                    }
                }
                section::FUNCTION => {
                    let signatures = FunctionSectionReader::new(reader)?;
                    module.defined = signatures.into_iter().collect::<wasmparser::Result<_>>()?;
                }
                section::EXPORT => {
                    for export in ExportSectionReader::new(reader)? {
                        let export = export?;
                        if export.kind == ExternalKind::Func {
                            module.exported.push((export.index, export.name.to_owned()));
                        }
                    }
                }
                // Names are optional: those that cannot be read are not there.
                section::CUSTOM => module.named.extend(function_names(content)),
                _ => {}
            }
        }
        module.named.sort_by_key(|(index, _)| *index);
        module.exported.sort_by_key(|(index, _)| *index);
        let is_known = |it: &&u32| (**it as usize) < module.parameters.len();
        if let Some(unknown) = module.defined.iter().find(|it| !is_known(it)) {
            let message = format!("there is no type {unknown}");
            return Err(NotInstrumented(message));
        }
        Ok(module)
    }

    fn name(&self, index: u32) -> Option<String> {
        [&self.named, &self.exported].into_iter().find_map(|names| {
            let found = names.binary_search_by_key(&index, |(index, _)| *index);
            found.ok().map(|at| names[at].1.clone())
        })
    }

    /// Index of the first function that is a body.
    fn first_body(&self) -> u64 {
        u64::from(self.imported) + self.defined.len() as u64
    }

    /// Index of the function that marks the end of a call.
    fn leave(&self) -> u64 {
        self.first_body() + self.defined.len() as u64
    }

    /// The types, and that of [`LEAVE`].
    fn types(&self, content: &[u8]) -> Result<Vec<u8>> {
        let (count, rest) = split_count(content)?;
        let mut out = Vec::with_capacity(content.len() + 8);
        write_u64(&mut out, count + 1);
        out.extend_from_slice(rest);
        // A function without parameters and results.
        out.extend_from_slice(&[0x60, 0, 0]);
        Ok(out)
    }

    fn signatures(&self) -> Vec<u8> {
        let mut out = Vec::new();
        write_u64(&mut out, 2 * self.defined.len() as u64 + 1);
        for &signature in self.defined.iter().chain(&self.defined) {
            write_u64(&mut out, signature.into());
        }
        write_u64(&mut out, self.parameters.len() as u64);
        out
    }

    fn code(&self, content: &[u8]) -> Result<Vec<u8>> {
        const LOCAL_GET: u8 = 0x20;
        const CALL: u8 = 0x10;
        const END: u8 = 0x0b;
        let (count, bodies) = split_count(content)?;
        if count != self.defined.len() as u64 {
            let message = "functions and bodies differ in number";
            return Err(NotInstrumented(message.to_owned()));
        }
        let mut out = Vec::with_capacity(content.len() * 2);
        write_u64(&mut out, 2 * count + 1);
        for (body, &signature) in (self.first_body()..).zip(&self.defined) {
            // No locals.
            let mut wrapper = vec![0];
            for parameter in 0..self.parameters[signature as usize] {
                wrapper.push(LOCAL_GET);
                write_u64(&mut wrapper, parameter);
            }
            for function in [body, self.leave()] {
                wrapper.push(CALL);
                write_u64(&mut wrapper, function);
            }
            wrapper.push(END);
            write_u64(&mut out, wrapper.len() as u64);
            out.extend_from_slice(&wrapper);
        }
        out.extend_from_slice(bodies);
        out.extend_from_slice(&[2, 0, END]);
        Ok(out)
    }

    /// A name section with the marks. `first` is the index of the module's first function in
    /// [`Instrumented::functions`].
    fn names(&self, first: usize) -> Vec<u8> {
        const FUNCTION_NAMES: u8 = 1;
        let mut names = Vec::new();
        write_u64(&mut names, self.defined.len() as u64 + 1);
        for (index, function) in (u64::from(self.imported)..).zip(first..first + self.defined.len())
        {
            write_u64(&mut names, index);
            write_text(&mut names, &format!("{ENTER}{function}"));
        }
        write_u64(&mut names, self.leave());
        write_text(&mut names, LEAVE);
        let mut out = Vec::new();
        write_text(&mut out, "name");
        write_section(&mut out, FUNCTION_NAMES, &names);
        out
    }
}

/// The names of functions in a custom section, if it is the one with names.
fn function_names(content: &[u8]) -> Vec<(u32, String)> {
    let mut names = Vec::new();
    let Ok(custom) = CustomSectionReader::new(BinaryReader::new(content, 0)) else {
        return names;
    };
    let KnownCustom::Name(subsections) = custom.as_known() else {
        return names;
    };
    let subsections: NameSectionReader<'_> = subsections;
    for subsection in subsections.into_iter().map_while(wasmparser::Result::ok) {
        if let Name::Function(functions) = subsection {
            let functions = functions.into_iter().map_while(wasmparser::Result::ok);
            names.extend(functions.map(|it| (it.index, it.name.to_owned())));
        }
    }
    names
}

/// The sections of a module or a component: their ids and contents.
fn sections(bytes: &[u8]) -> Result<Vec<(u8, &[u8])>> {
    let mut reader = BinaryReader::new(bytes, 0);
    reader.read_bytes(HEADER_BYTES)?;
    let mut sections = Vec::new();
    while !reader.eof() {
        let id = reader.read_u8()?;
        let length = reader.read_var_u32()?;
        sections.push((id, reader.read_bytes(length as usize)?));
    }
    Ok(sections)
}

/// The number at the beginning of a section, and the rest.
fn split_count(content: &[u8]) -> Result<(u64, &[u8])> {
    let mut reader = BinaryReader::new(content, 0);
    let count = reader.read_var_u32()?;
    let rest = reader.read_bytes(reader.bytes_remaining())?;
    Ok((count.into(), rest))
}

fn write_section(out: &mut Vec<u8>, id: u8, content: &[u8]) {
    out.push(id);
    write_u64(out, content.len() as u64);
    out.extend_from_slice(content);
}

fn write_text(out: &mut Vec<u8>, text: &str) {
    write_u64(out, text.len() as u64);
    out.extend_from_slice(text.as_bytes());
}

/// Writes a number in LEB128.
fn write_u64(out: &mut Vec<u8>, mut number: u64) {
    loop {
        let low = (number & 0x7f) as u8;
        number >>= 7;
        if number == 0 {
            out.push(low);
            return;
        }
        out.push(low | 0x80);
    }
}
