//! [`sandboxed`]: how a worker starts, the same in every role.

use std::io;
use std::sync::mpsc;
use std::thread;

use super::super::role::{Role, SandboxStatus};
use super::privileges;

/// Drops the privileges that the role does not need, and then works on a thread with a stack
/// of that many bytes. Whatever needs files has to exist by now; `threads` starts the other
/// threads of the process.
///
/// The order matters. Landlock and the loss of capabilities hold for the calling thread and the
/// threads that it starts later; seccomp is applied to all threads at once and forbids starting
/// more. So: those, then all threads, then seccomp, and only then the work.
///
/// # Errors
///
/// When the machine gives no threads, or the work fails.
pub(super) fn sandboxed<W>(
    (role, isolation): (Role, privileges::Isolation),
    stack_bytes: usize,
    threads: impl FnOnce() -> io::Result<()>,
    work: W,
) -> io::Result<()>
where
    W: FnOnce(SandboxStatus) -> io::Result<()> + Send + 'static,
{
    let confined = privileges::confine(isolation);
    threads()?;
    let (begin, wait) = mpsc::sync_channel(1);
    let worker = thread::Builder::new()
        .name(role.name().into())
        .stack_size(stack_bytes)
        .spawn(move || match wait.recv() {
            Ok(sandbox) => work(sandbox),
            Err(_) => Ok(()),
        })?;
    let seccomp = privileges::forbid_system_calls(role);
    // The thread is waiting for this and nothing else, so the send cannot fail.
    let _ = begin.send(SandboxStatus {
        seccomp,
        ..confined
    });
    worker
        .join()
        .unwrap_or_else(|_| Err(io::Error::other("a thread of the worker panicked")))
}
