//! Whether the names of a module are those of a robot.

use super::super::names::list_escaped;
use super::super::version::{self, with_patch};
use super::error::ComponentizeError;
use super::module::Module;
use super::preview1;

/// The names under which a core module exports the functions of `controller`,
/// in the order of the WIT. Another compatible version may stand in them.
pub const CONTROLLER_EXPORTS: [&str; 2] = version::CONTROLLER_FUNCTIONS;

/// The module name under which a core module imports the functions of `journal`. The
/// version is that of the exports.
pub const JOURNAL_IMPORT: &str = version::JOURNAL;

/// Checks the exports and imports by name, and returns the patch version of the interface that
/// they belong to.
///
/// # Errors
///
/// What is missing or foreign.
pub(super) fn check(module: &Module) -> Result<u64, ComponentizeError> {
    let patch = check_exports(module)?;
    check_imports(module, patch)?;
    Ok(patch)
}

/// Are the exports there that make a module a robot? Returns the patch version of
/// the interface that they belong to.
fn check_exports(module: &Module) -> Result<u64, ComponentizeError> {
    let has = |name: &str| module.exports.contains(name);
    let interfaces = module.exports.iter().filter_map(|name| {
        let (interface, _) = name.split_once('#')?;
        Some(interface)
    });
    let patch = interfaces
        .clone()
        .filter_map(|name| version::of_interface(name, Some("controller")))
        .find_map(version::patch);
    let Some(patch) = patch else {
        let imports = module.imports.iter().map(|(module, _)| module.as_str());
        if let Some(found) = version::other(interfaces.chain(imports)) {
            let found = found.to_owned();
            return Err(ComponentizeError::OtherVersion { found });
        }
        return Err(ComponentizeError::NotARobot {
            types: match module.types {
                Some(_) => "with component types",
                None => "without component types",
            },
            exports: list_escaped(&module.exports),
        });
    };
    // The answer of `next-move` is returned through memory.
    let [start, next_move] = CONTROLLER_EXPORTS.map(|name| with_patch(name, patch));
    match [start, next_move, "memory".to_owned()]
        .into_iter()
        .find(|name| !has(name))
    {
        None => Ok(patch),
        Some(name) => Err(ComponentizeError::MissingExport { name }),
    }
}

fn check_imports(module: &Module, patch: u64) -> Result<(), ComponentizeError> {
    let journal = with_patch(JOURNAL_IMPORT, patch);
    let foreign = |(module, name): &&(String, String)| {
        *module != journal && !(module == preview1::MODULE && preview1::answers(name))
    };
    let Some((module, name)) = module.imports.iter().find(foreign) else {
        return Ok(());
    };
    if let Some(found) = version::other([module.as_str()]) {
        let found = found.to_owned();
        return Err(ComponentizeError::OtherVersion { found });
    }
    if version::is_compatible(module, "journal") {
        let message = format!("it imports `{module}`, where its exports need `{journal}`");
        return Err(ComponentizeError::Mismatch { message });
    }
    Err(ComponentizeError::ForeignImport {
        module: module.escape_debug().to_string(),
        name: name.escape_debug().to_string(),
    })
}
