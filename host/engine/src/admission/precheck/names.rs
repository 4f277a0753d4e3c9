//! What a file calls a function: for rejections; read only when there is one.

use wasmparser::{Encoding, ExternalKind, KnownCustom, Name, Parser, Payload};

/// A name that is shown is cut after this many characters.
const SHOWN_CHARS: usize = 64;

/// The name of a function of the core module with that number, counted in the order
/// of the file: from its name section, or one under which it is exported.
///
/// The file has not been validated to its end, so anything may be wrong in it; then
/// there is no name.
pub(super) fn function_name(bytes: &[u8], module: u32, function: u32) -> Option<String> {
    let mut modules = 0_u32;
    let mut exported = None;
    for payload in Parser::new(0).parse_all(bytes) {
        let payload = payload.ok()?;
        if let Payload::Version {
            encoding: Encoding::Module,
            ..
        } = payload
        {
            modules += 1;
        }
        if modules != module + 1 {
            continue;
        }
        match payload {
            Payload::ExportSection(section) => {
                exported = section
                    .into_iter()
                    .map_while(Result::ok)
                    .find(|export| export.kind == ExternalKind::Func && export.index == function)
                    .map(|export| shown(export.name));
            }
            Payload::CustomSection(section) => {
                if let KnownCustom::Name(names) = section.as_known()
                    && let Some(name) = names
                        .into_iter()
                        .map_while(Result::ok)
                        .find_map(|names| in_section(names, function))
                {
                    return Some(name);
                }
            }
            Payload::End(_) => break,
            _ => {}
        }
    }
    exported
}

fn in_section(names: Name<'_>, function: u32) -> Option<String> {
    let Name::Function(names) = names else {
        return None;
    };
    names
        .into_iter()
        .map_while(Result::ok)
        .find(|naming| naming.index == function)
        .map(|naming| shown(naming.name))
}

fn shown(name: &str) -> String {
    name.chars().take(SHOWN_CHARS).collect()
}
