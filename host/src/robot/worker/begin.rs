//! [`confined`]: how a worker begins its work, the same in every role.

use std::io;
use std::sync::mpsc;
use std::thread;

use super::confine::{self, Role};
use super::wire::Sandbox;

/// Gives up what the role does not need, and then works on a thread with a stack of
/// that many bytes. Whatever needs files has to exist by now; `threads` starts the other
/// threads of the process.
///
/// # Errors
///
/// When the machine gives no threads, or the work fails.
pub(super) fn confined<W>(
    role: Role,
    stack_bytes: usize,
    threads: impl FnOnce() -> io::Result<()>,
    work: W,
) -> io::Result<()>
where
    W: FnOnce(Sandbox) -> io::Result<()> + Send + 'static,
{
    let landlock = confine::forbid_files();
    // Threads begin before they are forbidden, and after what holds only for threads
    // that begin later.
    threads()?;
    let (begin, wait) = mpsc::sync_channel(1);
    let worker = thread::Builder::new()
        .name(role.name().into())
        .stack_size(stack_bytes)
        .spawn(move || match wait.recv() {
            Ok(sandbox) => work(sandbox),
            Err(_) => Ok(()),
        })?;
    let seccomp = confine::forbid_system_calls(role);
    // The receiver waits for nothing else.
    let _ = begin.send(Sandbox { landlock, seccomp });
    worker
        .join()
        .unwrap_or_else(|_| Err(io::Error::other("a thread of the worker panicked")))
}
