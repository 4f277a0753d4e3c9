//! The layers of the sandbox on Linux, none of which needs privileges: namespaces, an empty root
//! folder, landlock, no capabilities, seccomp. Each is used where the kernel has it.

mod calls;
mod capabilities;
mod confine;
mod files;
mod filter;
mod inherited;
mod namespaces;
mod outside;
mod root;
#[cfg(test)]
mod table;

pub use confine::confine;
pub use filter::forbid_system_calls;
pub use inherited::{close_inherited, die_with_parent};
pub use namespaces::{Isolation, isolate};
