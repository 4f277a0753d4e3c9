//! The raw bindings of `wit/robot.wit`: types, imports, and the macro that exports a robot.
//!
//! Hidden: the crate root re-exports the types one by one, [`journal`](crate::journal)
//! wraps the imports, and [`export_robot!`](crate::export_robot) uses the export macro.
//! Nothing else should name this module.

#[rustfmt::skip]
#[expect(
    clippy::allow_attributes,
    missing_docs,
    reason = "a generated file, compared with the output of its generator byte by byte"
)]
mod generated;
mod panics;
pub mod runtime;

pub use generated::{export, exports, wasmouse};
#[cfg(target_arch = "wasm32")]
pub use panics::report_panics;
