//! Robots admitted to a contest.
//!
//! A file that is rejected is no failure here: the contest goes on without it and the report says
//! why.

use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use wasmouse_core::Digest;
use wasmouse_engine::{AdmittedRobot, CacheUse, InfrastructureError, LocalExecutor, Trust};

use super::failure::Failure;
use super::output::message;
use super::robots::{RobotSpec, unique_names};
use crate::contest::{Entrant, NotAdmitted};
use crate::report::escape::for_terminal;

/// Reads the robots and asks the executor to admit them.
///
/// # Errors
///
/// When a file cannot be read, or two robots have the same name, or the sandbox is not what is
/// required. A robot that is not admitted is an entrant all the same, with the reason.
pub fn load(specs: &[RobotSpec], executor: &LocalExecutor) -> Result<Vec<Entrant>, Failure> {
    let names = unique_names(specs)?;
    let bytes_max = executor.limits().admission.component_bytes_max;
    let mut entrants: Vec<Entrant> = Vec::with_capacity(specs.len());
    for (spec, name) in specs.iter().zip(names) {
        let bytes = spec.read(bytes_max)?;
        let digest = Digest::of(&bytes);
        // One file takes part once for each variant, and is admitted once.
        let known = entrants.iter().find(|it| it.digest == digest);
        let admission = match known {
            Some(known) => known.admission.clone(),
            None => admit(executor, &bytes, spec.trust())?,
        };
        let same = |it: &&Entrant| it.digest == digest && it.variant == spec.variant();
        if let Some(twin) = entrants.iter().find(same) {
            message!(
                "warning: `{}` is the same robot as `{}`; they share their results",
                for_terminal(&name),
                for_terminal(&twin.name)
            );
        }
        entrants.push(Entrant {
            name,
            digest,
            variant: spec.variant(),
            admission,
        });
    }
    Ok(entrants)
}

/// Asks the executor to admit a robot, and reports what the user should know about that.
///
/// # Errors
///
/// When a complete sandbox is required and there is none. Every other failure of the host is
/// about this robot alone.
pub fn admit(
    executor: &LocalExecutor,
    bytes: &[u8],
    trust: Trust,
) -> Result<Result<Arc<AdmittedRobot>, NotAdmitted>, Failure> {
    // A bug that a file may bring about is no reason to end a contest.
    let admission = panic::catch_unwind(AssertUnwindSafe(|| executor.admit(bytes, trust)));
    warn_about_sandbox(executor);
    Ok(match admission {
        Ok(Ok(Ok(robot))) => {
            if let CacheUse::Failed(reason) = robot.cache_use() {
                message!("warning: {}; robots are compiled again each time", reason);
            }
            Ok(Arc::new(robot))
        }
        Ok(Ok(Err(rejection))) => Err(NotAdmitted::Rejected(Arc::new(rejection))),
        Ok(Err(error @ InfrastructureError::IncompleteSandbox { .. })) => {
            return Err(setup_failure(&error));
        }
        Ok(Err(error)) => Err(NotAdmitted::Failed(error.to_string().into())),
        Err(_) => Err(NotAdmitted::Failed(
            "wasmouse panicked, which is a bug".into(),
        )),
    })
}

/// Warns once where workers do not have every layer of the sandbox.
pub fn warn_about_sandbox(executor: &LocalExecutor) {
    static WARNED: AtomicBool = AtomicBool::new(false);
    if let Some(sandbox) = executor.sandbox()
        && !sandbox.is_complete()
        && !WARNED.swap(true, Ordering::Relaxed)
    {
        message!(
            "warning: this system has no {}, so untrusted robots run in processes with fewer \
             restrictions; --require-sandbox refuses to run them",
            sandbox.missing()
        );
    }
}

/// An executor that cannot start.
pub fn setup_failure(error: &InfrastructureError) -> Failure {
    let hint = match error {
        InfrastructureError::IncompleteSandbox { .. } => {
            "use Linux 5.13 or later with landlock and seccomp, or leave --require-sandbox out"
        }
        InfrastructureError::Engine(_) | InfrastructureError::Thread(_) => {
            "try fewer threads with --jobs"
        }
        _ => "--trust runs robots without worker processes",
    };
    Failure::internal(error).hint(hint)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::robots::resolve;
    use super::*;

    /// Whatever is wrong with the workers, robots that need none play.
    #[cfg(unix)]
    #[test]
    fn a_robot_that_cannot_be_admitted_costs_nobody_else_anything() {
        use wasmouse_core::game::Ruleset;
        use wasmouse_engine::sandbox::{Executable, PATIENCE, WorkerOptions};
        use wasmouse_engine::{Control, Isolation};

        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("bot.wasm"), "perhaps a robot").expect("a file");
        let path = folder.path().to_str().expect("UTF-8");
        let workers = WorkerOptions {
            executable: Executable::at("/bin/false"),
            patience: PATIENCE,
            require_sandbox: false,
            control: Control::default(),
        };
        let rules = Arc::new(Ruleset::default());
        let executor = LocalExecutor::new(rules, 1, None, Isolation::Workers(workers));
        let specs = [path, "flood"].map(|it| resolve(it).expect("a robot"));
        let entrants = load(&specs.concat(), &executor).expect("both are entrants");
        let Err(NotAdmitted::Failed(reason)) = &entrants[0].admission else {
            panic!("it was not even examined");
        };
        let reason = reason.as_guest();
        assert!(reason.starts_with("run worker failed: "), "{reason:?}");
        assert!(entrants[1].admission.is_ok());
    }
}
