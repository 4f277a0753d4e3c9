//! [`leave`]: goes on in a child process, inside a new process namespace. The process outside
//! waits for it and ends as it ended.
//!
//! The child is the first process of its namespace. The kernel ignores signals to such a process
//! that it has no handler for, unless the kernel sends them for a fault or nothing can block them.
//! Two others end workers: an abort, and the signal for used up processor time. They get a
//! handler that exits with a code, which the process outside turns into the signal again.

use std::io::{self, PipeReader};
use std::os::fd::AsRawFd as _;
use std::ptr;

use super::inherited::{close_descriptors, die_with_parent};

/// Signals that the child reports by its exit code.
const BY_CODE: [libc::c_int; 2] = [libc::SIGABRT, libc::SIGXCPU];

/// What shells add to the number of a signal to make an exit code.
const CODE_OF_SIGNAL: libc::c_int = 128;

/// Forks, and returns in the child. The process must have one thread.
///
/// # Errors
///
/// When the machine gives no process or no pipe.
pub(super) fn leave() -> io::Result<()> {
    let (alive, end) = io::pipe()?;
    // SAFETY: the process has one thread, so the child has no lock that nobody will release.
    let child = unsafe { libc::fork() };
    match child {
        -1 => Err(io::Error::last_os_error()),
        0 => {
            drop(end);
            enter(&alive)
        }
        child => {
            let kept = end.as_raw_fd().cast_unsigned();
            // So that pipes end when the child ends. Nothing of Rust's runs here any more.
            close_descriptors(0, kept.saturating_sub(1));
            close_descriptors(kept + 1, u32::MAX);
            wait(child)
        }
    }
}

/// The first things that the child does.
fn enter(alive: &PipeReader) -> io::Result<()> {
    die_with_parent();
    // If the process outside ended before that call, the other end of its pipe is closed.
    let mut pipe = libc::pollfd {
        fd: alive.as_raw_fd(),
        events: 0,
        revents: 0,
    };
    // SAFETY: the structure lives until the call returns, which it does at once.
    if unsafe { libc::poll(&raw mut pipe, 1, 0) } != 0 {
        return Err(io::Error::other("the process outside has ended"));
    }
    for signal in BY_CODE {
        // SAFETY: the handler makes one system call.
        unsafe { libc::signal(signal, exit_with_code as *const () as libc::sighandler_t) };
    }
    Ok(())
}

extern "C" fn exit_with_code(signal: libc::c_int) {
    // SAFETY: ends the process.
    unsafe { libc::_exit(CODE_OF_SIGNAL + signal) };
}

/// Waits for the child and ends as it ended.
fn wait(child: libc::pid_t) -> ! {
    let mut status = 0;
    // SAFETY: the child belongs to this process, which does nothing else.
    let waited = unsafe { libc::waitpid(child, &raw mut status, 0) };
    if waited != child {
        // It is interrupted by no signal that does not end this process.
        exit(1);
    }
    if libc::WIFSIGNALED(status) {
        die_of(libc::WTERMSIG(status));
    }
    let code = libc::WEXITSTATUS(status);
    if BY_CODE.contains(&(code - CODE_OF_SIGNAL)) {
        die_of(code - CODE_OF_SIGNAL);
    }
    exit(code)
}

fn die_of(signal: libc::c_int) -> ! {
    // SAFETY: numbers, and a set that lives until the calls return; the process ends by this.
    unsafe {
        libc::signal(signal, libc::SIG_DFL);
        let mut set = std::mem::zeroed();
        libc::sigemptyset(&raw mut set);
        libc::sigaddset(&raw mut set, signal);
        libc::sigprocmask(libc::SIG_UNBLOCK, &raw const set, ptr::null_mut());
        libc::raise(signal);
    }
    exit(CODE_OF_SIGNAL + signal)
}

fn exit(code: libc::c_int) -> ! {
    // SAFETY: ends the process, without running what Rust would do at its end: that is for the
    // child.
    unsafe { libc::_exit(code) }
}
