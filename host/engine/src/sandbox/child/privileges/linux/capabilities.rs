//! [`drop_all`]: no capabilities, in any set, for good.

use std::io;

/// The version of the sets that has 64 capabilities, in two halves.
const VERSION_3: u32 = 0x2008_0522;

/// There are no more capabilities than a set has room for.
const CAPABILITIES_MAX: libc::c_ulong = 63;

#[repr(C)]
struct Header {
    version: u32,
    process: libc::c_int,
}

#[repr(C)]
#[derive(Clone, Copy, Default)]
struct Half {
    effective: u32,
    permitted: u32,
    inheritable: u32,
}

/// Empties the bounding, ambient, inheritable, permitted and effective sets of the calling
/// thread. Says whether it has none afterwards.
pub(super) fn drop_all() -> bool {
    for capability in 0..=CAPABILITIES_MAX {
        // Fails for a number that the kernel does not know, and where the process has no right
        // to change that set: then the set does not matter either, since `no_new_privs` keeps
        // programs from adding capabilities.
        let _ = prctl(libc::PR_CAPBSET_DROP, capability);
    }
    let clear = libc::c_ulong::from(libc::PR_CAP_AMBIENT_CLEAR_ALL.cast_unsigned());
    let _ = prctl(libc::PR_CAP_AMBIENT, clear);
    let header = Header {
        version: VERSION_3,
        process: 0,
    };
    let none = [Half::default(); 2];
    // SAFETY: the structures are those of that version, and live until the call returns.
    unsafe { libc::syscall(libc::SYS_capset, &raw const header, none.as_ptr()) == 0 }
}

fn prctl(option: libc::c_int, argument: libc::c_ulong) -> io::Result<()> {
    let zero: libc::c_ulong = 0;
    // SAFETY: both options take numbers.
    match unsafe { libc::prctl(option, argument, zero, zero, zero) } {
        0 => Ok(()),
        _ => Err(io::Error::last_os_error()),
    }
}
