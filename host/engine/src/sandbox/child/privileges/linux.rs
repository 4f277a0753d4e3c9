//! Landlock and seccomp, both without privileges.

use std::collections::BTreeMap;
use std::process;

use landlock::{
    ABI, Access as _, AccessFs, AccessNet, Ruleset, RulesetAttr as _, RulesetStatus, Scope,
};
use rustix::process::{Signal, set_parent_process_death_signal};
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch,
};

use super::super::super::role::Role;

/// Closes every descriptor but the three standard ones. To be called first, when no
/// other has an owner in this process.
pub fn close_inherited() {
    let (first, last, flags) = (3_u32, u32::MAX, 0_u32);
    // SAFETY: the call takes numbers only, and the process has just begun, so nothing
    // in it owns a descriptor. Every kernel with landlock knows the call.
    unsafe { libc::syscall(libc::SYS_close_range, first, last, flags) };
}

/// Has the kernel kill this process when the thread that started it ends, also when
/// that was killed.
pub fn die_with_parent() {
    // Where the kernel does not allow it, or the parent has ended by now, the end of the input
    // still ends the worker.
    let _ = set_parent_process_death_signal(Some(Signal::KILL));
}

/// Forbids every file, TCP, and signals and sockets to other processes, for this
/// thread and those it starts. Says whether it could.
pub fn forbid_files() -> bool {
    // Newer kernels forbid more; an older one forbids what it can, and every one that
    // knows landlock at all forbids files.
    let abi = ABI::V6;
    let restricted = Ruleset::default()
        .handle_access(AccessFs::from_all(abi))
        .and_then(|ruleset| ruleset.handle_access(AccessNet::from_all(abi)))
        .and_then(|ruleset| ruleset.scope(Scope::from_all(abi)))
        .and_then(|ruleset| ruleset.create())
        .and_then(|ruleset| ruleset.restrict_self());
    restricted.is_ok_and(|status| status.ruleset != RulesetStatus::NotEnforced)
}

/// Forbids all system calls but those that the role needs from here on, for all
/// threads. Says whether it could.
pub fn forbid_system_calls(role: Role) -> bool {
    let Some(filter) = filter(role) else {
        return false;
    };
    seccompiler::apply_filter_all_threads(&filter).is_ok()
}

/// A forbidden call fails with EPERM.
fn filter(role: Role) -> Option<BpfProgram> {
    let arch: TargetArch = std::env::consts::ARCH.try_into().ok()?;
    let deny = SeccompAction::Errno(libc::EPERM.cast_unsigned());
    SeccompFilter::new(rules(role)?, deny, SeccompAction::Allow, arch)
        .ok()?
        .try_into()
        .ok()
}

/// Calls that both roles need, with any arguments: to use the descriptors they
/// have, for memory, for waiting on their own threads, to end.
const ALWAYS: [libc::c_long; 26] = [
    libc::SYS_read,
    libc::SYS_write,
    libc::SYS_writev,
    libc::SYS_close,
    libc::SYS_munmap,
    libc::SYS_mremap,
    libc::SYS_madvise,
    libc::SYS_brk,
    libc::SYS_futex,
    libc::SYS_sched_yield,
    libc::SYS_sched_getaffinity,
    libc::SYS_membarrier,
    libc::SYS_rseq,
    libc::SYS_set_robust_list,
    libc::SYS_nanosleep,
    libc::SYS_clock_nanosleep,
    libc::SYS_clock_gettime,
    libc::SYS_restart_syscall,
    libc::SYS_getrandom,
    libc::SYS_gettid,
    libc::SYS_getpid,
    libc::SYS_rt_sigaction,
    libc::SYS_rt_sigprocmask,
    libc::SYS_rt_sigreturn,
    libc::SYS_sigaltstack,
    libc::SYS_exit,
];

/// Calls for the anonymous files that hold a robot's initial memory.
const MEMORY_FILES: [libc::c_long; 5] = [
    libc::SYS_memfd_create,
    libc::SYS_ftruncate,
    libc::SYS_fstat,
    libc::SYS_lseek,
    libc::SYS_pwrite64,
];

/// The ioctl by which a pool finds the pages that a robot wrote.
const PAGEMAP_SCAN: u64 = 0xc060_6610;

fn rules(role: Role) -> Option<BTreeMap<i64, Vec<SeccompRule>>> {
    let mut rules: BTreeMap<i64, Vec<SeccompRule>> = BTreeMap::new();
    for call in ALWAYS {
        rules.insert(call, Vec::new());
    }
    rules.insert(libc::SYS_exit_group, Vec::new());
    // An abort signals the process itself.
    let own = u64::from(process::id());
    rules.insert(libc::SYS_tgkill, vec![when(&[(0, SeccompCmpOp::Eq, own)])?]);
    // Memory may be written, or executed, but never both; and compiled code is written
    // elsewhere than it runs.
    let mut protections = vec![protection(0)?, protection(libc::PROT_WRITE)?];
    if role != Role::Compile {
        protections.push(protection(libc::PROT_EXEC)?);
    }
    for call in [libc::SYS_mmap, libc::SYS_mprotect] {
        rules.insert(call, protections.clone());
    }
    if role != Role::Compile {
        for call in MEMORY_FILES {
            rules.insert(call, Vec::new());
        }
        let seal = u64::try_from(libc::F_ADD_SEALS).ok()?;
        rules.insert(libc::SYS_fcntl, vec![when(&[(1, SeccompCmpOp::Eq, seal)])?]);
        let scan = when(&[(1, SeccompCmpOp::Eq, PAGEMAP_SCAN)])?;
        rules.insert(libc::SYS_ioctl, vec![scan]);
    }
    Some(rules)
}

fn bits(protection: libc::c_int) -> u64 {
    u64::from(protection.cast_unsigned())
}

/// Memory whose protection has exactly these of the bits for writing and executing.
fn protection(exactly: libc::c_int) -> Option<SeccompRule> {
    let mask = bits(libc::PROT_WRITE | libc::PROT_EXEC);
    when(&[(2, SeccompCmpOp::MaskedEq(mask), bits(exactly))])
}

/// A call with these arguments: index, comparison, value.
fn when(conditions: &[(u8, SeccompCmpOp, u64)]) -> Option<SeccompRule> {
    let conditions: Result<Vec<SeccompCondition>, _> = conditions
        .iter()
        .map(|(index, operator, value)| {
            SeccompCondition::new(*index, SeccompCmpArgLen::Qword, operator.clone(), *value)
        })
        .collect();
    SeccompRule::new(conditions.ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_filters_can_be_made() {
        for role in Role::ALL {
            assert!(filter(role).is_some(), "{role:?}");
        }
    }
}
