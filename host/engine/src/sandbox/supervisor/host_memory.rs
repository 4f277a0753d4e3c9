//! Whether the host has the memory that a worker may use.

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

/// Elsewhere workers have no limits on memory.
#[cfg(not(unix))]
pub(super) const fn can_provide(_: u64) -> bool {
    true
}

#[cfg(all(test, target_pointer_width = "64"))]
mod tests {
    use super::can_provide;

    #[test]
    fn no_host_has_all_memory() {
        assert!(can_provide(1 << 20));
        assert!(!can_provide(1 << 60));
    }
}
