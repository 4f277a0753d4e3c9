//! [`without_debug_information`]: what a compiler wrote about source lines does not go into a
//! robot. It is larger than the code, and has the folders of the machine that compiled it.

use std::borrow::Cow;

use wasmparser::{BinaryReaderError, Parser, Payload};

/// The custom sections of DWARF begin like this. The names of functions are elsewhere and stay,
/// for backtraces and profiles.
const PREFIX: &str = ".debug_";

/// The same module without debug information. What is no core module stays as it is: whoever
/// reads it next says what is wrong.
pub fn without_debug_information(binary: &[u8]) -> Cow<'_, [u8]> {
    if Parser::is_core_wasm(binary)
        && let Ok(stripped) = strip(binary)
    {
        return Cow::Owned(stripped);
    }
    Cow::Borrowed(binary)
}

fn strip(module: &[u8]) -> Result<Vec<u8>, BinaryReaderError> {
    let mut stripped = Vec::with_capacity(module.len());
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
        let is_debug =
            matches!(&payload, Payload::CustomSection(it) if it.name().starts_with(PREFIX));
        if !is_debug {
            stripped.extend_from_slice(&module[begin..end]);
        }
        begin = end;
    }
    Ok(stripped)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &[u8] = b"\0asm\x01\0\0\0";
    /// One function type, one function, its body, and a custom section with the name `name`.
    const SECTIONS: &[u8] =
        b"\x01\x04\x01\x60\0\0\x03\x02\x01\0\x0a\x04\x01\x02\0\x0b\0\x06\x04name\0";
    const DEBUG: &[u8] = b"\0\x0d\x0b.debug_infoX";

    #[test]
    fn only_debug_information_goes() {
        let module = [HEADER, SECTIONS].concat();
        assert_eq!(without_debug_information(&module), module);
        let debug = [HEADER, DEBUG, SECTIONS, DEBUG].concat();
        assert_eq!(without_debug_information(&debug), module);
    }

    #[test]
    fn what_is_no_module_stays() {
        for binary in [b"(module)".as_slice(), b"", &[HEADER, b"\x01\x7f"].concat()] {
            assert_eq!(without_debug_information(binary), binary);
        }
    }
}
