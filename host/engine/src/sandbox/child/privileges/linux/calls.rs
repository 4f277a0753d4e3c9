//! The system calls that a worker may make once it is confined, and those that end it.
//!
//! SECURITY.md says why for each; a test compares the two. A call that is in neither list fails
//! with `EPERM`.

use super::super::super::super::role::Role;

/// A system call that is allowed.
pub(super) struct Allowed {
    /// Its constant, for the test.
    #[cfg_attr(not(test), expect(dead_code, reason = "only the test reads it"))]
    pub(super) constant: &'static str,
    pub(super) number: libc::c_long,
    pub(super) roles: &'static [Role],
    pub(super) arguments: Arguments,
}

/// With which arguments a call is allowed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Arguments {
    Any,
    /// `writev`: standard error.
    StandardError,
    /// `mmap`: private memory, not executable; in the compile worker, without a file.
    PrivateMemory,
    /// `mprotect`: not executable; in the workers that run robots, executable and not
    /// writable.
    Protection,
    /// `mremap`: to a place that the kernel chooses.
    Moving,
    /// `madvise`: to give pages back.
    Advice,
    /// `memfd_create`: a file that can be sealed.
    Sealable,
    /// `fcntl`: to seal a file.
    Seal,
    /// `ioctl`: to find the pages that a robot wrote.
    PagemapScan,
    /// `futex`: to wait and to wake.
    Waiting,
    /// `tgkill`: the process itself.
    Itself,
}

const EVERY: &[Role] = &Role::ALL;
const RUNNING: &[Role] = &[Role::Run, Role::Backtrace];

macro_rules! allowed {
    ($($constant:ident: $roles:ident, $arguments:ident;)*) => {
        &[$(Allowed {
            constant: stringify!($constant),
            number: libc::$constant,
            roles: $roles,
            arguments: Arguments::$arguments,
        }),*]
    };
}

/// Calls that workers have been seen to make, or that their libraries need elsewhere.
pub(super) const ALLOWED: &[Allowed] = allowed! {
    SYS_read: EVERY, Any;
    SYS_write: EVERY, Any;
    SYS_writev: EVERY, StandardError;
    SYS_close: EVERY, Any;
    SYS_mmap: EVERY, PrivateMemory;
    SYS_munmap: EVERY, Any;
    SYS_mprotect: EVERY, Protection;
    SYS_mremap: EVERY, Moving;
    SYS_madvise: EVERY, Advice;
    SYS_brk: EVERY, Any;
    SYS_memfd_create: RUNNING, Sealable;
    SYS_fcntl: RUNNING, Seal;
    SYS_ioctl: RUNNING, PagemapScan;
    SYS_membarrier: RUNNING, Any;
    SYS_futex: EVERY, Waiting;
    SYS_sched_yield: EVERY, Any;
    SYS_sched_getaffinity: EVERY, Any;
    SYS_clock_gettime: EVERY, Any;
    SYS_clock_nanosleep: RUNNING, Any;
    SYS_restart_syscall: EVERY, Any;
    SYS_getrandom: EVERY, Any;
    SYS_rseq: EVERY, Any;
    SYS_set_robust_list: EVERY, Any;
    SYS_sigaltstack: EVERY, Any;
    SYS_rt_sigaction: EVERY, Any;
    SYS_rt_sigprocmask: EVERY, Any;
    SYS_rt_sigreturn: EVERY, Any;
    SYS_gettid: EVERY, Any;
    SYS_getpid: EVERY, Any;
    SYS_tgkill: EVERY, Itself;
    SYS_exit: EVERY, Any;
    SYS_exit_group: EVERY, Any;
};

/// System calls that end the process: their constants, for the test, and their numbers.
pub(super) type Fatal = [(&'static str, libc::c_long)];

macro_rules! fatal {
    ($($constant:ident)*) => {
        &[$((stringify!($constant), libc::$constant)),*]
    };
}

/// Calls that nothing in a worker makes unless it has been taken over: none of them is ever a
/// library that asks for something unexpected.
pub(super) const FATAL: &Fatal = fatal! {
    SYS_execve SYS_execveat
    SYS_ptrace SYS_process_vm_readv SYS_process_vm_writev SYS_kcmp SYS_pidfd_getfd
    SYS_pidfd_send_signal
    SYS_socket SYS_socketpair SYS_bind SYS_connect SYS_listen SYS_accept SYS_accept4
    SYS_sendto SYS_sendmsg SYS_sendmmsg SYS_recvfrom SYS_recvmsg SYS_recvmmsg
    SYS_unshare SYS_setns SYS_mount SYS_umount2 SYS_pivot_root SYS_chroot SYS_open_tree
    SYS_move_mount SYS_fsopen SYS_fsconfig SYS_fsmount SYS_fspick SYS_mount_setattr
    SYS_name_to_handle_at SYS_open_by_handle_at
    SYS_add_key SYS_request_key SYS_keyctl
    SYS_bpf SYS_perf_event_open SYS_userfaultfd
    SYS_io_uring_setup SYS_io_uring_enter SYS_io_uring_register
    SYS_init_module SYS_finit_module SYS_delete_module SYS_kexec_load SYS_kexec_file_load
    SYS_reboot SYS_swapon SYS_swapoff SYS_acct SYS_quotactl
    SYS_personality SYS_remap_file_pages SYS_shmat SYS_memfd_secret
    SYS_setuid SYS_setgid SYS_setreuid SYS_setregid SYS_setresuid SYS_setresgid SYS_setgroups
    SYS_setfsuid SYS_setfsgid SYS_capset
};

/// The same, of calls that only this architecture has.
#[cfg(target_arch = "x86_64")]
pub(super) const FATAL_HERE: &Fatal = fatal! {
    SYS_fork SYS_vfork SYS_modify_ldt SYS_ioperm SYS_iopl
};

/// The same, of calls that only this architecture has.
#[cfg(not(target_arch = "x86_64"))]
pub(super) const FATAL_HERE: &Fatal = &[];
