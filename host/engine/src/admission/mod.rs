//! Admission: whether a file can be a robot, decided before anything of it is compiled.
//!
//! [`examine`] is the one function that looks at a file, whoever calls it. [`precheck`]
//! measures a file so that compiling it is known to end; [`to_binary`] reads WebAssembly text, and
//! [`componentize`] turns a core module into a component. A file that fails is rejected with a [`Rejection`], which says why and
//! what to do.

mod binary;
mod componentize;
pub(crate) mod constant;
mod examine;
pub(crate) mod images;
mod inspection;
mod names;
mod outline;
mod place;
pub mod precheck;
mod proposal;
mod rejection;
mod shell;
mod text;
mod version;
pub mod wasi;

pub use binary::BinaryKind;
pub use componentize::{
    CONTROLLER_EXPORTS, ComponentizeError, JOURNAL_IMPORT, PLAIN_EXPORTS, PLAIN_JOURNAL, ROBOT_WIT,
    componentize,
};
pub(crate) use examine::check_size;
pub use examine::{Examination, examine};
pub use inspection::{Inspection, ResourceRequirements, world};
pub use outline::Outline;
pub use place::{FunctionPlace, Place};
pub use proposal::Proposal;
pub(crate) use rejection::OUT_OF_PROCESSOR_TIME;
pub use rejection::Rejection;
pub use text::{TextError, TextPlace, to_binary};
pub use version::VERSION as INTERFACE_VERSION;
pub(crate) use version::{CONTROLLER, JOURNAL};
