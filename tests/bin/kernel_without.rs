//! Runs a program as on a kernel that lacks something: `kernel-without FEATURE... --
//! PROGRAM ARGUMENT...`, where a feature is `landlock`,
//! `seccomp` or `namespaces`.
//!
//! The system calls of the features fail with ENOSYS, for the program and for everything
//! that it starts.

use std::io;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let split = arguments.iter().position(|it| it == "--");
    let (features, command) = arguments.split_at(split.unwrap_or(arguments.len()));
    let [_, program, arguments @ ..] = command else {
        return Err(io::Error::other("no program"));
    };
    run(features, program, arguments)
}

#[cfg(target_os = "linux")]
fn run(features: &[String], program: &str, arguments: &[String]) -> io::Result<()> {
    use seccompiler::{BpfProgram, SeccompAction, SeccompFilter};
    use std::collections::BTreeMap;
    use std::os::unix::process::CommandExt as _;

    let mut calls = BTreeMap::new();
    for feature in features {
        let missing: &[i64] = match feature.as_str() {
            "landlock" => &[
                libc::SYS_landlock_create_ruleset,
                libc::SYS_landlock_add_rule,
                libc::SYS_landlock_restrict_self,
            ],
            "seccomp" => &[libc::SYS_seccomp],
            "namespaces" => &[libc::SYS_unshare],
            other => return Err(io::Error::other(format!("no feature `{other}`"))),
        };
        calls.extend(missing.iter().map(|call| (*call, Vec::new())));
    }
    let arch = std::env::consts::ARCH
        .try_into()
        .map_err(io::Error::other)?;
    let missing = SeccompAction::Errno(libc::ENOSYS.cast_unsigned());
    let filter = SeccompFilter::new(calls, SeccompAction::Allow, missing, arch);
    let filter: BpfProgram = filter
        .and_then(TryInto::try_into)
        .map_err(io::Error::other)?;
    seccompiler::apply_filter(&filter).map_err(io::Error::other)?;
    Err(std::process::Command::new(program).args(arguments).exec())
}

#[cfg(not(target_os = "linux"))]
fn run(_: &[String], _: &str, _: &[String]) -> io::Result<()> {
    Err(io::Error::other("only Linux has these features"))
}
