//! [`without_debug_information`]: of what a compiler wrote about its sources, a robot keeps the
//! lines of the project's own files and nothing else.

use std::borrow::Cow;
use std::path::Path;

use wasmparser::{BinaryReaderError, Parser, Payload};

use super::lines::{Sections, own_lines};

/// The custom sections of DWARF begin like this. The names of functions are elsewhere and stay,
/// for backtraces and profiles.
const PREFIX: &str = ".debug_";

/// A module without debug information, and what it was.
struct Stripped<'a> {
    module: Vec<u8>,
    debug: Sections<'a>,
    /// The length of the code section, whose begin is address 0 of debug information.
    code_bytes: u64,
}

/// The same module with no more debug information than the lines of files in `folder`, for
/// backtraces. What is no core module stays as it is: whoever reads it next says what is wrong.
pub fn without_debug_information<'a>(binary: &'a [u8], folder: &Path) -> Cow<'a, [u8]> {
    if Parser::is_core_wasm(binary)
        && let Ok(stripped) = strip(binary)
    {
        let mut module = stripped.module;
        if !stripped.debug.is_empty() {
            // What cannot be read was of no use.
            let lines = own_lines(&stripped.debug, stripped.code_bytes, folder);
            for (name, data) in lines.unwrap_or_default() {
                add_custom_section(&mut module, name, &data);
            }
        }
        return Cow::Owned(module);
    }
    Cow::Borrowed(binary)
}

fn strip(module: &[u8]) -> Result<Stripped<'_>, BinaryReaderError> {
    let mut stripped = Stripped {
        module: Vec::with_capacity(module.len()),
        debug: Sections::new(),
        code_bytes: 0,
    };
    // Where the section begins, with its header, that ends next.
    let mut begin = 0_usize;
    for payload in Parser::new(0).parse_all(module) {
        let payload = payload?;
        let end = match &payload {
            Payload::Version { range, .. } => range.end,
            // The bodies of functions are within their section.
            Payload::CodeSectionEntry(_) | Payload::End(_) => continue,
            section => match section.as_section() {
                Some((_, range)) => range.end,
                None => continue,
            },
        };
        let end = usize::try_from(end).map_or(module.len(), |end| end.min(module.len()));
        match &payload {
            Payload::CustomSection(section) if section.name().starts_with(PREFIX) => {
                stripped.debug.insert(section.name(), section.data());
            }
            payload => {
                if let Payload::CodeSectionStart {
                    unchecked_range: range,
                    ..
                } = payload
                {
                    stripped.code_bytes = range.end - range.start;
                }
                stripped.module.extend_from_slice(&module[begin..end]);
            }
        }
        begin = end;
    }
    Ok(stripped)
}

/// Appends a custom section, whose number is 0.
fn add_custom_section(module: &mut Vec<u8>, name: &str, data: &[u8]) {
    let name = [&number(name.len()), name.as_bytes()].concat();
    module.push(0);
    module.extend(number(name.len() + data.len()));
    module.extend(name);
    module.extend(data);
}

/// LEB128.
fn number(mut value: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let low = u8::try_from(value & 0x7f).expect("seven bits");
        value >>= 7;
        if value == 0 {
            bytes.push(low);
            return bytes;
        }
        bytes.push(low | 0x80);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &[u8] = b"\0asm\x01\0\0\0";
    /// One function type, one function, its body, and a custom section with the name `name`.
    const SECTIONS: &[u8] =
        b"\x01\x04\x01\x60\0\0\x03\x02\x01\0\x0a\x04\x01\x02\0\x0b\0\x06\x04name\0";
    const DEBUG: &[u8] = b"\0\x0d\x0b.debug_infoX";

    fn stripped(binary: &[u8]) -> Cow<'_, [u8]> {
        without_debug_information(binary, Path::new("."))
    }

    #[test]
    fn only_debug_information_goes() {
        let module = [HEADER, SECTIONS].concat();
        assert_eq!(stripped(&module), module);
        let debug = [HEADER, DEBUG, SECTIONS, DEBUG].concat();
        assert_eq!(stripped(&debug), module);
    }

    #[test]
    fn what_is_no_module_stays() {
        for binary in [b"(module)".as_slice(), b"", &[HEADER, b"\x01\x7f"].concat()] {
            assert_eq!(stripped(binary), binary);
        }
    }

    #[test]
    fn added_sections_are_read_again() {
        for length in [0, 1, 100, 200, 20_000] {
            let mut module = [HEADER, SECTIONS].concat();
            add_custom_section(&mut module, ".debug_line", &vec![7; length]);
            let read = strip(&module).unwrap();
            assert_eq!(read.debug[".debug_line"].len(), length);
            assert_eq!(read.code_bytes, 4);
        }
    }
}
