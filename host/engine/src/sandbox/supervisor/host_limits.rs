//! Whether the host has what a worker may use: memory and processor time.

/// Whether the operating system would give this process that much memory now. It may have less,
/// by a limit of its own that workers inherit or by what other processes use; a worker that
/// runs out of memory then says nothing about its robot.
#[cfg(unix)]
pub(super) fn can_provide(bytes: u64) -> bool {
    let Ok(length) = usize::try_from(bytes) else {
        return false;
    };
    let (protection, flags) = (
        libc::PROT_READ | libc::PROT_WRITE,
        libc::MAP_PRIVATE | libc::MAP_ANONYMOUS,
    );
    // SAFETY: it asks for a new mapping wherever there is room, and nothing uses it before it is
    // removed again.
    unsafe {
        let mapped = libc::mmap(std::ptr::null_mut(), length, protection, flags, -1, 0);
        mapped != libc::MAP_FAILED && libc::munmap(mapped, length) == 0
    }
}

/// Whether a worker may use that much processor time, in seconds, and does not inherit a lower
/// limit, which then ends it in the same way.
#[cfg(unix)]
pub(super) fn allows_processor_time(seconds: u64) -> bool {
    use rustix::process::{Resource, getrlimit};

    let limit = getrlimit(Resource::Cpu);
    // A worker cannot raise the maximum.
    let of_both = [limit.current, limit.maximum].into_iter().flatten();
    of_both.min().is_none_or(|lowest| lowest >= seconds)
}

/// Elsewhere workers have no limits on processor time.
#[cfg(not(unix))]
pub(super) const fn allows_processor_time(_: u64) -> bool {
    true
}

/// The same for Windows, where memory has to be committed.
#[cfg(windows)]
pub(super) fn can_provide(bytes: u64) -> bool {
    use windows_sys::Win32::System::Memory::{
        MEM_COMMIT, MEM_RELEASE, MEM_RESERVE, PAGE_READWRITE, VirtualAlloc, VirtualFree,
    };

    let Ok(length) = usize::try_from(bytes) else {
        return false;
    };
    // SAFETY: it asks for new pages wherever there is room, and nothing uses them before they are
    // released again.
    unsafe {
        let kind = MEM_RESERVE | MEM_COMMIT;
        let pages = VirtualAlloc(std::ptr::null(), length, kind, PAGE_READWRITE);
        !pages.is_null() && VirtualFree(pages, 0, MEM_RELEASE) != 0
    }
}

#[cfg(all(test, target_pointer_width = "64"))]
mod tests {
    use super::can_provide;

    #[test]
    #[cfg(unix)]
    fn the_processor_time_that_is_allowed_is_that_of_the_lower_limit() {
        use super::allows_processor_time;
        use rustix::process::{Resource, getrlimit};

        assert!(allows_processor_time(0));
        let limit = getrlimit(Resource::Cpu);
        let lowest = limit.current.into_iter().chain(limit.maximum).min();
        let is_unlimited = lowest.is_none();
        assert_eq!(allows_processor_time(u64::MAX), is_unlimited);
    }

    #[test]
    fn no_host_has_all_memory() {
        assert!(can_provide(1 << 20));
        assert!(!can_provide(1 << 60));
    }
}
