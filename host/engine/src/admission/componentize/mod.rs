//! Turns core WebAssembly modules into robot components.
//!
//! Compilers produce core modules; a match takes components. [`componentize`] closes
//! the gap in process, so that neither contestants nor the host need another
//! tool. It only looks at the shape of a module: whether the component that
//! comes out may take part is decided by admission, and the size of what comes
//! in has to be limited by the caller.
//!
//! Submissions pass through here, so the types that a module says it has are
//! never decoded: `wit-parser` recurses for ever on some of them (packages that
//! need each other), which would end the host. There is one world a robot can
//! have, and every module is wrapped as that.
//!
//! `module` reads a module, `names` decides whether its names are those of a robot, `rename`
//! replaces plain ones, `encode` makes the component, and `convert` is the four in order. `preview1`
//! is for modules with WASI.

mod convert;
mod encode;
mod error;
mod module;
mod names;
mod preview1;
mod rename;

pub use convert::componentize;
pub use encode::ROBOT_WIT;
pub use error::ComponentizeError;
pub use names::{CONTROLLER_EXPORTS, JOURNAL_IMPORT, PLAIN_EXPORTS, PLAIN_JOURNAL};

#[cfg(test)]
mod tests;
