//! How a [`Supervisor`] admits strangers' robots: workers look at the file, compile it, and
//! load the code.

use std::sync::Arc;

use super::Role;
use super::compiler::{Compiler, Findings, Wanted};
use super::pool::PlayWorker;
use super::supervisor::{Supervisor, TRIES, play_failed};
use super::wire::{Compiled, Loaded, ToldRefusal};
use crate::robot::code::{Code, Destination};
use crate::robot::{CacheUse, Digest, HostError, Inspection, Needs, Refusal};

/// A robot that plays in workers.
pub struct RemoteRobot {
    pub(super) digest: Digest,
    pub(super) code: Arc<Code>,
    cache: CacheUse,
    needs: Option<Needs>,
}

impl RemoteRobot {
    /// The digest of the file that was admitted.
    pub const fn digest(&self) -> &Digest {
        &self.digest
    }

    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        &self.cache
    }

    /// What it needs before it does anything.
    pub const fn needs(&self) -> Option<Needs> {
        self.needs
    }
}

impl Supervisor {
    /// Admits a file as a robot.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is refused.
    pub fn admit(&self, bytes: &[u8]) -> Result<Result<RemoteRobot, Refusal>, HostError> {
        if let Err(refusal) = self.check_size(bytes) {
            return Ok(Err(refusal));
        }
        let digest = Digest::of(bytes);
        if let Some(code) = self.cached(&digest)
            && let Some(admitted) = self.load(&digest, Arc::new(code), CacheUse::Hit)?
        {
            return Ok(admitted);
        }
        let (findings, cache) = match self.compile(bytes, &digest)? {
            Ok(compiled) => compiled,
            Err(refusal) => return Ok(Err(refusal)),
        };
        let code = match (findings.examined.result, findings.code) {
            (Compiled::Refused(told), _) => return Ok(Err(told.into())),
            (Compiled::Code { .. }, Some(code)) => code,
            _ => return Err(compile_failed("it sent no code".into())),
        };
        let damaged = || compile_failed("its code is damaged as soon as it is written".into());
        self.load(&digest, Arc::new(code), cache)?
            .ok_or_else(damaged)
    }

    /// Looks at a file as [`Supervisor::admit`] would, and tells everything.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn inspect(&self, bytes: &[u8]) -> Result<Inspection, HostError> {
        let mut inspection = Inspection::new(bytes);
        if let Err(refusal) = self.check_size(bytes) {
            inspection.refusal = Some(refusal);
            return Ok(inspection);
        }
        let wanted = Wanted {
            code: false,
            description: true,
        };
        let passing = || Destination::passing();
        let findings = match self.compiler().examine(bytes, wanted, &passing)? {
            Ok(findings) => findings,
            Err(refusal) => {
                inspection.refusal = Some(refusal);
                return Ok(inspection);
            }
        };
        inspection.kind = findings.examined.kind;
        inspection.shape = findings.examined.shape;
        inspection.wit = findings.examined.wit;
        match findings.examined.result {
            Compiled::Refused(told) => inspection.refusal = Some(told.into()),
            Compiled::NotWanted | Compiled::Code { .. } => match self.admit(bytes)? {
                Ok(robot) => inspection.needs = robot.needs,
                Err(refusal) => inspection.refusal = Some(refusal),
            },
        }
        Ok(inspection)
    }

    fn check_size(&self, bytes: &[u8]) -> Result<(), Refusal> {
        let max = self.rules.limits.component_bytes_max;
        if bytes.is_empty() {
            return Err(Refusal::Empty);
        }
        if u64::try_from(bytes.len()).map_or(true, |size| size > max) {
            return Err(Refusal::TooLarge { max });
        }
        Ok(())
    }

    fn cached(&self, digest: &Digest) -> Option<Code> {
        self.cache.as_ref()?.open_code(&self.compiler, digest)
    }

    const fn compiler(&self) -> Compiler<'_> {
        Compiler {
            starter: &self.starter,
            limits: &self.rules.limits,
        }
    }

    /// Compiles a file into the cache, or into a passing file where that cannot be.
    fn compile(
        &self,
        bytes: &[u8],
        digest: &Digest,
    ) -> Result<Result<(Findings, CacheUse), Refusal>, HostError> {
        let wanted = Wanted {
            code: true,
            description: false,
        };
        let compiler = self.compiler();
        let passing = |cache: CacheUse| {
            let examined = compiler.examine(bytes, wanted, &|| Destination::passing())?;
            Ok(examined.map(|findings| (findings, cache)))
        };
        let Some(cache) = &self.cache else {
            return passing(CacheUse::Off);
        };
        let kept = || cache.destination(&self.compiler, digest);
        match compiler.examine(bytes, wanted, &kept) {
            Ok(examined) => Ok(examined.map(|findings| (findings, CacheUse::Stored))),
            // The cache has no room; perhaps there is some elsewhere.
            Err(HostError::Room(reason)) => {
                let error = cache.failure(reason);
                passing(CacheUse::Failed(error.to_string()))
            }
            Err(error) => Err(error),
        }
    }

    /// Has a worker load the code; `None` when the code is damaged.
    fn load(
        &self,
        digest: &Digest,
        code: Arc<Code>,
        cache: CacheUse,
    ) -> Result<Option<Result<RemoteRobot, Refusal>>, HostError> {
        let mut tries = 0;
        loop {
            tries += 1;
            let mut worker = match self.pool.take(digest) {
                // One that has the robot already would not say what it needs.
                Some(worker) => worker,
                None => PlayWorker::start(&self.starter, &self.rules)?,
            };
            match worker.load(digest, &code) {
                Ok(Some(Loaded::Damaged)) => {
                    self.pool.put(worker);
                    if let Some(cache) = &self.cache {
                        cache.forget(&self.compiler, digest);
                    }
                    return Ok(None);
                }
                Ok(Some(Loaded::Refused(told))) => {
                    self.pool.put(worker);
                    return Ok(Some(Err(told.into())));
                }
                Ok(loaded) => {
                    self.pool.put(worker);
                    let needs = match loaded {
                        Some(Loaded::Ready(needs)) => needs,
                        _ => None,
                    };
                    return Ok(Some(Ok(RemoteRobot {
                        digest: *digest,
                        code,
                        cache,
                        needs,
                    })));
                }
                Err(error) => {
                    let death = worker.bury(&error);
                    if tries == TRIES {
                        return Err(play_failed(death.to_string()));
                    }
                }
            }
        }
    }
}

fn compile_failed(reason: String) -> HostError {
    HostError::Worker {
        role: Role::Compile.name(),
        reason,
    }
}

impl From<ToldRefusal> for Refusal {
    fn from(told: ToldRefusal) -> Self {
        Self::Told {
            name: told.name,
            reason: told.reason,
            hint: told.hint,
        }
    }
}

impl From<Refusal> for ToldRefusal {
    fn from(refusal: Refusal) -> Self {
        Self {
            name: refusal.name().to_owned(),
            reason: refusal.to_string(),
            hint: refusal.hint().to_owned(),
        }
    }
}
