//! [`isolate`]: namespaces of the worker's own, so that it can neither see nor name what belongs
//! to others: processes, networks, shared memory, mounts.

use std::io;

use rustix::process::setsid;

use super::inherited::die_with_parent;
use super::outside;

/// Whether this process has namespaces of its own.
#[derive(Clone, Copy, Debug)]
pub struct Isolation(pub(super) bool);

/// Everything but the user namespace.
const OTHERS: libc::c_int = libc::CLONE_NEWPID
    | libc::CLONE_NEWNET
    | libc::CLONE_NEWIPC
    | libc::CLONE_NEWNS
    | libc::CLONE_NEWUTS
    | libc::CLONE_NEWCGROUP;

/// Gives this process namespaces of its own, where the kernel allows that. It must have one
/// thread, and nobody may rely on its process number: the caller goes on in a child, because
/// a process cannot change its own process namespace. The process that was started stays
/// outside, ends as the child ends, and is the one that the supervisor watches and kills.
///
/// No user is mapped into the user namespace, so files of this process's user are not its own
/// there either.
///
/// # Errors
///
/// When the machine has no process for the child.
pub fn isolate() -> io::Result<Isolation> {
    be_killed_first();
    // A user namespace gives the right to make the others; root needs none, and may have to do
    // without where the administrator has forbidden user namespaces.
    let isolated = unshare(libc::CLONE_NEWUSER | OTHERS) || unshare(OTHERS);
    // Changing credentials may have cleared it.
    die_with_parent();
    if isolated {
        outside::leave()?;
        // Away from the terminal. The process outside leads a group already.
        let _ = setsid();
    }
    Ok(Isolation(isolated))
}

fn unshare(flags: libc::c_int) -> bool {
    // SAFETY: the call takes a number, and of what it separates, none is memory or descriptors.
    unsafe { libc::unshare(flags) == 0 }
}

/// When the machine runs out of memory, a worker ends before anything else does.
fn be_killed_first() {
    // Without `/proc`, the kernel chooses.
    let _ = std::fs::write("/proc/self/oom_score_adj", "1000");
}
