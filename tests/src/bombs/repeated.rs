//! Functions of a module again and again.

use wasmparser::{Parser, Payload};

/// The core module with each of its functions that many times, in the place of a small one that
/// would need more copies than a file may have modules. `None` when it is no core module, or cannot
/// be read.
pub fn with_repeated_functions(module: &[u8], times: u32) -> Option<Vec<u8>> {
    let mut repeated = wasm_encoder::Module::new();
    let mut code = wasm_encoder::CodeSection::new();
    let mut bodies = 0;
    for payload in Parser::new(0).parse_all(module) {
        match payload.ok()? {
            Payload::FunctionSection(section) => {
                let mut functions = wasm_encoder::FunctionSection::new();
                for _ in 0..times {
                    for ty in section.clone() {
                        functions.function(ty.ok()?);
                    }
                }
                repeated.section(&functions);
            }
            Payload::CodeSectionStart { count, .. } => bodies = count.checked_mul(times)?,
            Payload::CodeSectionEntry(body) => {
                for _ in 0..times {
                    code.raw(body.as_bytes());
                    bodies = bodies.checked_sub(1)?;
                }
                if bodies == 0 {
                    repeated.section(&code);
                }
            }
            payload => {
                if let Some((id, range)) = payload.as_section() {
                    let [start, end] = [range.start, range.end].map(usize::try_from);
                    let data = module.get(start.ok()?..end.ok()?)?;
                    repeated.section(&wasm_encoder::RawSection { id, data });
                }
            }
        }
    }
    Some(repeated.finish())
}
