//! Sandbox setup: the privileges that a worker drops before it reads untrusted bytes.
//!
//! The order matters: descriptors and limits first, then whatever needs files or
//! threads (the engine), then landlock, which holds for the calling thread and those
//! it starts, then the threads, then seccomp for all of them.

#[cfg(not(target_os = "linux"))]
mod elsewhere;
#[cfg(unix)]
mod limits;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(not(unix))]
mod no_limits;

#[cfg(not(target_os = "linux"))]
pub use elsewhere::{close_inherited, die_with_parent, forbid_files, forbid_system_calls};
#[cfg(unix)]
pub use limits::set_limits;
#[cfg(target_os = "linux")]
pub use linux::{close_inherited, die_with_parent, forbid_files, forbid_system_calls};
#[cfg(not(unix))]
pub use no_limits::set_limits;
