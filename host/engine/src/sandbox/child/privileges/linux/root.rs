//! [`replace`]: an empty root folder.

use std::ffi::CStr;
use std::ptr;

/// Where the empty folder is mounted for a moment. It exists wherever workers start: they are
/// started through it.
const PLACE: &CStr = c"/proc";

/// Replaces the root by an empty folder that cannot be written, in a mount namespace of its own.
/// Says whether it could.
pub(super) fn replace() -> bool {
    let change = libc::MS_REC | libc::MS_PRIVATE;
    let flags = libc::MS_RDONLY | libc::MS_NOSUID | libc::MS_NODEV | libc::MS_NOEXEC;
    // SAFETY: texts that end in zero, numbers, and a process that has no open folder.
    unsafe {
        // Nothing of this gets to the mount namespace that this one was copied from.
        libc::mount(ptr::null(), c"/".as_ptr(), ptr::null(), change, ptr::null()) == 0
            && libc::mount(
                c"none".as_ptr(),
                PLACE.as_ptr(),
                c"tmpfs".as_ptr(),
                flags,
                c"size=4k,nr_inodes=2".as_ptr().cast(),
            ) == 0
            && libc::chdir(PLACE.as_ptr()) == 0
            && (exchange() || cover())
    }
}

/// Makes the working directory, where something is mounted, the root, and removes the old one.
///
/// # Safety
///
/// Nothing may be open below the old root that is still needed.
unsafe fn exchange() -> bool {
    let here = c".".as_ptr();
    // SAFETY: as above, and texts that end in zero. The old root is mounted on the new one for a
    // moment, and taken away from there.
    unsafe {
        libc::syscall(libc::SYS_pivot_root, here, here) == 0
            && libc::umount2(here, libc::MNT_DETACH) == 0
    }
}

/// The same where the old root cannot be removed, because it is the one that the kernel started
/// with: covers it.
///
/// # Safety
///
/// As [`exchange`].
unsafe fn cover() -> bool {
    let (here, none) = (c".".as_ptr(), ptr::null());
    // SAFETY: as above, and texts that end in zero.
    unsafe {
        libc::mount(here, c"/".as_ptr(), none, libc::MS_MOVE, none.cast()) == 0
            && libc::chroot(here) == 0
    }
}
