//! Sandbox setup: the privileges that a worker drops before it reads untrusted bytes.
//!
//! The order matters. Descriptors, limits and namespaces come first, because a user namespace
//! needs a process with one thread; then whatever needs files (the engine); then [`confine`]
//! for the one thread there is: an empty root folder, landlock, no capabilities, all of which
//! threads inherit; then the other threads; then seccomp for all of them.

#[cfg(not(target_os = "linux"))]
mod elsewhere;
#[cfg(unix)]
mod limits;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(not(unix))]
mod no_limits;

#[cfg(not(target_os = "linux"))]
pub use elsewhere::{
    Isolation, close_inherited, confine, die_with_parent, forbid_system_calls, isolate,
};
#[cfg(unix)]
pub use limits::set_limits;
#[cfg(target_os = "linux")]
pub use linux::{
    Isolation, close_inherited, confine, die_with_parent, forbid_system_calls, isolate,
};
#[cfg(not(unix))]
pub use no_limits::set_limits;
