//! [`componentize`]: all of the conversion.

use super::encode::{encode, with_robot_types};
use super::error::ComponentizeError;
use super::module::Module;
use super::names::Names;
use super::preview1;
use super::rename::with_full_names;

/// Wraps a core module into a component.
///
/// The module has to export the functions of `controller` and its memory, and may import
/// functions of `journal`: under their full names
/// ([`CONTROLLER_EXPORTS`](super::CONTROLLER_EXPORTS), [`JOURNAL_IMPORT`](super::JOURNAL_IMPORT)),
/// or under plain ones ([`PLAIN_EXPORTS`](super::PLAIN_EXPORTS),
/// [`PLAIN_JOURNAL`](super::PLAIN_JOURNAL)). Bindings generators use the full names and embed type
/// information as well (custom sections named `component-type*`); of that, only
/// the string encoding is used, so languages without a generator take part on
/// the same terms. Strings are UTF-8 where nothing is said.
///
/// Modules that import WASI preview 1 get what answers it inside of the component, and import
/// nothing but the journal afterwards.
///
/// The same module always gives the same component.
///
/// # Errors
///
/// [`ComponentizeError`] says what kind of file it is and what is missing;
/// [`ComponentizeError::hint`] says what to do.
///
/// ```
/// use wasmouse_engine::admission::{ComponentizeError, componentize};
///
/// let empty = b"\0asm\x01\0\0\0";
/// let error = componentize(empty).expect_err("an empty module is no robot");
/// assert!(matches!(error, ComponentizeError::NotARobot { .. }));
/// ```
pub fn componentize(core_module: &[u8]) -> Result<Vec<u8>, ComponentizeError> {
    let module = Module::of(core_module)?;
    let names = Names::of(&module)?;
    let has_preview1 = module.imports_from(preview1::MODULE);
    // Moved from stage to stage: a module may be as large as the largest file.
    let full = with_full_names(module.untyped, names)?;
    if has_preview1 {
        return preview1::encode(full, module.types, names.patch());
    }
    encode(&with_robot_types(full, module.types, names.patch()))
}
