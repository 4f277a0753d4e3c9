//! [`Admitter`]: admits untrusted files. Workers examine a file, compile it, and load the code.

use std::sync::Arc;

use wasmouse_core::Digest;
use wasmtime::Engine;

use super::super::protocol::{Compiled, Loaded};
use super::super::role::Role;
use super::compiler::{Compiler, Findings, Wanted};
use super::monitor::Kill;
use super::pool::Pool;
use super::robot::SandboxedRobot;
use crate::admission::{Inspection, Rejection, ResourceRequirements, check_size};
use crate::error::InfrastructureError;
use crate::runtime::{Cache, CacheEntry, CacheUse, CompiledCode, Destination};

/// How often a robot is loaded when its worker ends for reasons that may not be the robot's.
const TRIES: u32 = 4;

/// Admits files on behalf of the supervisor.
pub(super) struct Admitter<'a> {
    pub(super) pool: &'a Pool,
    pub(super) cache: Option<&'a Cache>,
    /// Names what compiled code is for; compiles nothing.
    pub(super) engine: &'a Engine,
}

impl Admitter<'_> {
    /// Admits a file as a robot.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is rejected.
    pub(super) fn admit(
        &self,
        bytes: &[u8],
    ) -> Result<Result<SandboxedRobot, Rejection>, InfrastructureError> {
        match self.try_admit(bytes) {
            // Perhaps the machine lacks what idle workers have.
            Err(InfrastructureError::Worker { .. } | InfrastructureError::Store(_))
                if self.pool.end_idle() =>
            {
                self.try_admit(bytes)
            }
            admitted => admitted,
        }
    }

    fn try_admit(
        &self,
        bytes: &[u8],
    ) -> Result<Result<SandboxedRobot, Rejection>, InfrastructureError> {
        if let Err(rejection) = check_size(bytes, &self.pool.limits) {
            return Ok(Err(rejection));
        }
        let digest = Digest::of(bytes);
        let entry = self.entry(&digest);
        if let Some(entry) = &entry
            && let Some(code) = entry.open_code()
        {
            match self.load(&digest, Arc::new(code), CacheUse::Hit)? {
                Attempt::Loaded(robot) => return Ok(Ok(robot)),
                Attempt::Rejected(rejection) => return Ok(Err(rejection)),
                // The entry may be damaged, or of another build; the file is compiled again.
                Attempt::Damaged | Attempt::Unloadable(_) => entry.forget_code(),
            }
        }
        if let Some(rejection) = entry.as_ref().and_then(CacheEntry::rejection) {
            return Ok(Err(rejection));
        }
        let rejected = |rejection: Rejection| {
            if let Some(entry) = &entry {
                entry.keep_rejection(&rejection);
            }
            Ok(Err(rejection))
        };
        let (findings, cache) = match self.compile(bytes, entry.as_ref())? {
            Ok(compiled) => compiled,
            Err(rejection) => return rejected(rejection),
        };
        let code = match (findings.examined.result, findings.code) {
            (Compiled::Rejected(text), _) => return rejected(text.into()),
            (Compiled::Code { .. }, Some(code)) => code,
            _ => return Err(compile_failed("it sent no code".into())),
        };
        match self.load(&digest, Arc::new(code), cache)? {
            Attempt::Loaded(robot) => Ok(Ok(robot)),
            // The code is what the compile worker made of this file a moment ago, so what is
            // wrong with it is wrong with the file.
            Attempt::Rejected(rejection) | Attempt::Unloadable(rejection) => rejected(rejection),
            Attempt::Damaged => Err(compile_failed(
                "its code was damaged as soon as it was written".into(),
            )),
        }
    }

    /// Examines a file as [`Admitter::admit`] does, and reports everything.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub(super) fn inspect(&self, bytes: &[u8]) -> Result<Inspection, InfrastructureError> {
        let mut inspection = Inspection::new(bytes);
        if let Err(rejection) = check_size(bytes, &self.pool.limits) {
            inspection.rejection = Some(rejection);
            return Ok(inspection);
        }
        let wanted = Wanted {
            code: false,
            description: true,
            backtraces: false,
        };
        let temporary = || Destination::temporary();
        let findings = match self.compiler().examine(bytes, wanted, &temporary)? {
            Ok(findings) => findings,
            Err(rejection) => {
                inspection.rejection = Some(rejection);
                return Ok(inspection);
            }
        };
        inspection.kind = findings.examined.kind;
        inspection.shape = findings.examined.shape;
        inspection.wit = findings.examined.wit;
        match findings.examined.result {
            Compiled::Rejected(text) => inspection.rejection = Some(text.into()),
            Compiled::NotWanted | Compiled::Code { .. } => match self.admit(bytes)? {
                Ok(robot) => inspection.requirements = robot.requirements,
                Err(rejection) => inspection.rejection = Some(rejection),
            },
        }
        Ok(inspection)
    }

    fn entry(&self, digest: &Digest) -> Option<CacheEntry<'_>> {
        let cache = self.cache?;
        Some(cache.entry(self.engine, &self.pool.limits, digest))
    }

    const fn compiler(&self) -> Compiler<'_> {
        Compiler {
            starter: &self.pool.starter,
            limits: &self.pool.limits,
        }
    }

    /// Compiles a file into the cache, or into a temporary file where that fails.
    fn compile(
        &self,
        bytes: &[u8],
        entry: Option<&CacheEntry<'_>>,
    ) -> Result<Result<(Findings, CacheUse), Rejection>, InfrastructureError> {
        let wanted = Wanted {
            code: true,
            description: false,
            backtraces: false,
        };
        let compiler = self.compiler();
        let uncached = |cache: CacheUse| {
            let examined = compiler.examine(bytes, wanted, &|| Destination::temporary())?;
            Ok(examined.map(|findings| (findings, cache)))
        };
        let Some(entry) = entry else {
            return uncached(CacheUse::Off);
        };
        let cached = || entry.destination();
        match compiler.examine(bytes, wanted, &cached) {
            Ok(examined) => Ok(examined.map(|findings| (findings, CacheUse::Stored))),
            // The cache has no room; perhaps there is some elsewhere.
            Err(InfrastructureError::Store(reason)) => {
                let error = entry.failure(reason);
                uncached(CacheUse::Failed(error.to_string()))
            }
            Err(error) => Err(error),
        }
    }

    /// Has a worker load the code.
    fn load(
        &self,
        digest: &Digest,
        code: Arc<CompiledCode>,
        cache: CacheUse,
    ) -> Result<Attempt, InfrastructureError> {
        let mut tries = 0;
        // The first worker may have run other robots.
        let mut worker = self.pool.take(digest)?;
        loop {
            tries += 1;
            let exit = match worker.load(digest, &code) {
                Ok(loaded) => {
                    // A worker that has read anything else is not used for another robot.
                    let requirements = match loaded {
                        Some(Loaded::Damaged) => return Ok(Attempt::Damaged),
                        Some(Loaded::Unloadable(text)) => {
                            return Ok(Attempt::Unloadable(text.into()));
                        }
                        Some(Loaded::Failed(reason)) => {
                            return Err(InfrastructureError::Worker {
                                role: Role::Run.name(),
                                reason,
                            });
                        }
                        Some(Loaded::Rejected(text)) => return Ok(Attempt::Rejected(text.into())),
                        Some(Loaded::Ready(requirements)) => requirements,
                        None => None,
                    };
                    self.pool.put(worker);
                    let robot = robot(digest, code, cache, requirements);
                    return Ok(Attempt::Loaded(robot));
                }
                Err(error) => worker.reap(&error),
            };
            if exit.killed == Some(Kill::Cancelled) {
                return Err(InfrastructureError::Cancelled);
            }
            // A worker that has run nothing else was ended by this code.
            if tries > 1 && exit.is_crash() && !exit.is_out_of_memory() {
                let reason = format!("makes code that crashes the worker that loads it ({exit})");
                return Ok(Attempt::Rejected(Rejection::Uncompilable(reason.into())));
            }
            if tries == TRIES || (tries > 1 && !exit.is_kill()) {
                return Err(InfrastructureError::Worker {
                    role: Role::Run.name(),
                    reason: exit.to_string(),
                });
            }
            worker = self.pool.start()?;
        }
    }
}

/// What came of loading compiled code.
enum Attempt {
    Loaded(SandboxedRobot),
    /// It cannot be a robot.
    Rejected(Rejection),
    /// The engine does not take the code.
    Unloadable(Rejection),
    /// The code is not what it was.
    Damaged,
}

fn robot(
    digest: &Digest,
    code: Arc<CompiledCode>,
    cache: CacheUse,
    requirements: Option<ResourceRequirements>,
) -> SandboxedRobot {
    SandboxedRobot {
        digest: *digest,
        code,
        cache,
        requirements,
        account: Arc::default(),
    }
}

fn compile_failed(reason: String) -> InfrastructureError {
    InfrastructureError::Worker {
        role: Role::Compile.name(),
        reason,
    }
}
