//! What a worker has from the process that started it: descriptors, and that one's life.

use rustix::process::{Signal, set_parent_process_death_signal};

/// Closes every descriptor but the three standard ones. To be called first, when no
/// other has an owner in this process.
pub fn close_inherited() {
    close_descriptors(3, u32::MAX);
}

/// Closes the descriptors from `first` to `last`, both included. The process must not use
/// them afterwards.
pub(super) fn close_descriptors(first: u32, last: u32) {
    // SAFETY: the call takes numbers only, and the callers close what nothing owns or what
    // is never used again. Every kernel with landlock knows the call.
    unsafe { libc::syscall(libc::SYS_close_range, first, last, 0_u32) };
}

/// Has the kernel kill this process when the thread that started it ends, also when
/// that was killed.
pub fn die_with_parent() {
    // Where the kernel does not allow it, or the parent has ended by now, the end of the input
    // still ends the worker.
    let _ = set_parent_process_death_signal(Some(Signal::KILL));
}
