//! [`forbid_system_calls`]: seccomp, made of the lists in `calls`.

use std::collections::BTreeMap;
use std::process;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch,
};

use super::super::super::super::role::Role;
use super::calls::{ALLOWED, Arguments, FATAL, FATAL_HERE};

/// Forbids all system calls but those that the role needs from here on, for all
/// threads. Says whether it could.
pub fn forbid_system_calls(role: Role) -> bool {
    let (Some(fatal), Some(allowed)) = (fatal_filter(), allowing_filter(role)) else {
        return false;
    };
    // The kernel asks both and does the worse. The second one cannot be added to later.
    [fatal, allowed]
        .iter()
        .all(|filter| seccompiler::apply_filter_all_threads(filter).is_ok())
}

type Rules = BTreeMap<i64, Vec<SeccompRule>>;

/// Kills the process for some calls.
fn fatal_filter() -> Option<BpfProgram> {
    let mut rules: Rules = FATAL
        .iter()
        .chain(FATAL_HERE)
        .map(|(_, number)| (*number, Vec::new()))
        .collect();
    // A process; a thread is only refused. What `clone3` is asked for is in memory, where a
    // filter cannot look, so that is refused for both.
    let thread = libc::CLONE_THREAD.cast_unsigned().into();
    let process = when(&[(0, SeccompCmpOp::MaskedEq(thread), 0)])?;
    rules.insert(libc::SYS_clone, vec![process]);
    program(rules, SeccompAction::Allow, SeccompAction::KillProcess)
}

/// Has all calls fail but those that the role needs.
fn allowing_filter(role: Role) -> Option<BpfProgram> {
    let mut rules = Rules::new();
    for call in ALLOWED {
        if call.roles.contains(&role) {
            rules.insert(call.number, arguments(call.arguments, role)?);
        }
    }
    let deny = SeccompAction::Errno(libc::EPERM.cast_unsigned());
    program(rules, deny, SeccompAction::Allow)
}

fn program(rules: Rules, otherwise: SeccompAction, matched: SeccompAction) -> Option<BpfProgram> {
    let arch: TargetArch = std::env::consts::ARCH.try_into().ok()?;
    SeccompFilter::new(rules, otherwise, matched, arch)
        .ok()?
        .try_into()
        .ok()
}

/// The ioctl by which a pool finds the pages that a robot wrote.
const PAGEMAP_SCAN: u64 = 0xc060_6610;

/// Any of these rules allows the call; none means any arguments.
fn arguments(arguments: Arguments, role: Role) -> Option<Vec<SeccompRule>> {
    use SeccompCmpOp::{Eq, MaskedEq};

    let rules = match arguments {
        Arguments::Any => Vec::new(),
        Arguments::StandardError => vec![when(&[(0, Eq, 2)])?],
        Arguments::PrivateMemory => {
            let protection = (2, MaskedEq(bits(libc::PROT_EXEC)), 0);
            // Memory that is shared could be mapped twice, to be written here and run there.
            let (mask, kind) = match role {
                Role::Compile => (libc::MAP_TYPE | libc::MAP_ANONYMOUS, PRIVATE_ANONYMOUS),
                Role::Run | Role::Backtrace => (libc::MAP_TYPE, libc::MAP_PRIVATE),
            };
            vec![when(&[protection, (3, MaskedEq(bits(mask)), bits(kind))])?]
        }
        Arguments::Protection => {
            // Memory may be written, or executed, but never both.
            let both = MaskedEq(bits(libc::PROT_WRITE | libc::PROT_EXEC));
            let mut allowed = vec![0, libc::PROT_WRITE];
            if role != Role::Compile {
                allowed.push(libc::PROT_EXEC);
            }
            let rules = allowed
                .iter()
                .map(|protection| when(&[(2, both.clone(), bits(*protection))]));
            rules.collect::<Option<_>>()?
        }
        Arguments::Moving => vec![when(&[(3, Eq, bits(libc::MREMAP_MAYMOVE))])?],
        Arguments::Advice => vec![when(&[(2, Eq, bits(libc::MADV_DONTNEED))])?],
        Arguments::Sealable => {
            let flags = u64::from(libc::MFD_CLOEXEC | libc::MFD_ALLOW_SEALING);
            vec![when(&[(1, Eq, flags)])?]
        }
        Arguments::Seal => vec![when(&[(1, Eq, bits(libc::F_ADD_SEALS))])?],
        Arguments::PagemapScan => vec![when(&[(1, Eq, PAGEMAP_SCAN)])?],
        Arguments::Waiting => {
            let flags = libc::FUTEX_PRIVATE_FLAG | libc::FUTEX_CLOCK_REALTIME;
            let operation = MaskedEq(bits(!flags));
            let rules = FUTEX_OPERATIONS
                .iter()
                .map(|allowed| when(&[(1, operation.clone(), bits(*allowed))]));
            rules.collect::<Option<_>>()?
        }
        // An abort signals the process itself.
        Arguments::Itself => vec![when(&[(0, Eq, process::id().into())])?],
    };
    Some(rules)
}

const PRIVATE_ANONYMOUS: libc::c_int = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS;

/// What locks and channels need.
const FUTEX_OPERATIONS: [libc::c_int; 3] =
    [libc::FUTEX_WAIT, libc::FUTEX_WAKE, libc::FUTEX_WAIT_BITSET];

/// The bits of an argument that is an `int`. The kernel looks at 32 of them.
fn bits(value: libc::c_int) -> u64 {
    u64::from(value.cast_unsigned())
}

/// A call with these arguments: index, comparison, value. Of each argument, the lower half is
/// compared: the kernel takes no more than that for what is compared here.
fn when(conditions: &[(u8, SeccompCmpOp, u64)]) -> Option<SeccompRule> {
    let conditions: Result<Vec<SeccompCondition>, _> = conditions
        .iter()
        .map(|(index, operator, value)| {
            SeccompCondition::new(*index, SeccompCmpArgLen::Dword, operator.clone(), *value)
        })
        .collect();
    SeccompRule::new(conditions.ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_filters_can_be_made() {
        assert!(fatal_filter().is_some());
        for role in Role::ALL {
            assert!(allowing_filter(role).is_some(), "{role:?}");
        }
    }
}
