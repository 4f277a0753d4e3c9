//! [`Runtime`]: an engine in this process, and the robots that were compiled for it.

use std::error::Error;
use std::io;

use wasmouse_core::Digest;
use wasmtime::component::{Component, InstancePre, Linker};
use wasmtime::{Engine, Store};

use super::artefact;
use super::bindings::{Robot, RobotPre};
use super::cache::Cache;
use super::compilers;
use super::config::{self, Clock};
use super::guest::{self, Guest};
use super::interface;
use super::limiter::Limiter;
use super::startup::startup_fuel;
use crate::admission::{Rejection, ResourceRequirements, examine};
use crate::error::InfrastructureError;
use crate::limits::Limits;

/// Everything that robots need to run in this process: one engine with its pool of
/// instances, the functions they may call, and the cache of compiled ones.
///
/// One runtime serves any number of robots and threads.
pub struct Runtime {
    engine: Engine,
    linker: Linker<Guest>,
    cache: Option<Cache>,
    limits: Limits,
}

/// A robot that has been admitted: compiled, checked, ready to be instantiated.
pub struct CompiledRobot {
    pre: RobotPre<Guest>,
    digest: Digest,
    /// What instantiating it costs besides the fuel of the code that runs.
    startup_fuel: u64,
    cache: CacheUse,
}

/// Where the compiled code of a robot came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CacheUse {
    /// There is no cache.
    Off,
    /// It was compiled before.
    Hit,
    /// It was compiled now and stored.
    Stored,
    /// It was compiled now and could not be stored: why. Harmless but slow.
    Failed(String),
}

/// Why a file is not admitted.
#[derive(Debug, thiserror::Error)]
pub enum AdmissionError {
    /// It cannot be a robot.
    #[error(transparent)]
    Rejected(#[from] Rejection),
    /// The host could not find out.
    #[error(transparent)]
    Host(#[from] InfrastructureError),
}

impl AdmissionError {
    /// What it means that the engine does not take a component: what the operating system
    /// refuses, above all memory for the code, is not the fault of the component. Nor is code
    /// that cannot be read back, because this build wrote it: memory ran out.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "used as a function in map_err"
    )]
    pub(crate) fn of_engine(error: wasmtime::Error) -> Self {
        let is_of_system = |cause: &(dyn Error + 'static)| {
            #[cfg(unix)]
            if cause.is::<rustix::io::Errno>() {
                return true;
            }
            cause.is::<io::Error>()
                || cause.is::<wasmtime::error::OutOfMemory>()
                || cause.is::<postcard::Error>()
        };
        if error.chain().any(is_of_system) {
            Self::Host(InfrastructureError::Load(format!("{error:#}")))
        } else {
            Self::Rejected(Rejection::Invalid {
                message: format!("{error:#}"),
                byte: None,
            })
        }
    }
}

/// A page of linear memory, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

impl Runtime {
    /// A runtime for robots under these limits, up to `matches` at the same time (at least
    /// 1), with compiled robots kept in `cache`.
    ///
    /// # Errors
    ///
    /// When the machine cannot give address space or threads.
    ///
    /// ```
    /// use wasmouse_engine::admission::Rejection;
    /// use wasmouse_engine::{AdmissionError, Limits, Runtime};
    ///
    /// let runtime = Runtime::new(Limits::default(), 1, None).expect("address space");
    /// let admitted = runtime.admit(b"");
    /// assert!(matches!(admitted, Err(AdmissionError::Rejected(Rejection::Empty))));
    /// ```
    pub fn new(
        limits: Limits,
        matches: u32,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        let runtime = Self::without_clock(limits, matches, cache)?;
        runtime.clock().start()?;
        Ok(runtime)
    }

    /// A runtime whose clock does not run yet, for a worker that is sandboxed before it
    /// starts a thread.
    pub(crate) fn without_clock(
        limits: Limits,
        matches: u32,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        let engine = config::new_engine(&limits, matches.max(1))?;
        Self::with_engine(engine, limits, cache)
    }

    /// A runtime for one match at a time that records where a robot was when it failed. Its
    /// clock does not run yet.
    pub(crate) fn for_backtraces(limits: Limits) -> Result<Self, InfrastructureError> {
        Self::with_engine(config::new_backtrace_engine(&limits)?, limits, None)
    }

    /// A runtime for one match at a time of robots that are instrumented. It has no clock.
    pub(crate) fn for_profiles(limits: Limits) -> Result<Self, InfrastructureError> {
        Self::with_engine(config::new_profile_engine(&limits)?, limits, None)
    }

    /// A runtime on an engine of any configuration.
    pub(crate) fn with_engine(
        engine: Engine,
        limits: Limits,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        Ok(Self {
            linker: guest::linker(&engine)?,
            engine,
            cache,
            limits,
        })
    }

    /// The clock that ends matches of a host that stalls, before it runs.
    pub(crate) fn clock(&self) -> Clock {
        Clock::of(&self.engine)
    }

    /// A robot from compiled code, for a worker.
    ///
    /// # Errors
    ///
    /// When the robot needs more than the pool has, or has other types than the WIT.
    ///
    /// # Safety
    ///
    /// The code must come from a compile worker of this build: wasmtime trusts it.
    pub(crate) unsafe fn load(
        &self,
        code: &[u8],
        digest: Digest,
    ) -> Result<CompiledRobot, AdmissionError> {
        // SAFETY: the caller's promise is the one that wasmtime asks for.
        let (compiled, startup_fuel) =
            unsafe { artefact::load(&self.engine, code) }.map_err(AdmissionError::of_engine)?;
        let pre = self.link(&compiled)?;
        Ok(CompiledRobot {
            pre,
            digest,
            startup_fuel,
            cache: CacheUse::Off,
        })
    }

    /// The limits that robots are admitted and run under.
    pub const fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The account of one match.
    pub(crate) fn limiter(&self) -> Limiter {
        Limiter::new(&self.limits)
    }

    pub(crate) fn store(&self, guest: Guest) -> Store<Guest> {
        Store::new(&self.engine, guest)
    }

    /// Admits the bytes of a component, or of a core module that can be turned into one, as a
    /// robot.
    ///
    /// # Errors
    ///
    /// The reason why the file is rejected, or a failure of the host.
    pub fn admit(&self, bytes: &[u8]) -> Result<CompiledRobot, AdmissionError> {
        let component = examine(bytes, &self.limits).component?;
        let digest = Digest::of(bytes);
        let startup_fuel = startup_fuel(&component);
        let (compiled, cache) = self.compile(&component, &digest, startup_fuel)?;
        let pre = self.link(&compiled)?;
        Ok(CompiledRobot {
            pre,
            digest,
            startup_fuel,
            cache,
        })
    }

    /// A robot of a component that was examined before it was instrumented.
    pub(crate) fn admit_examined(&self, component: &[u8]) -> Result<CompiledRobot, AdmissionError> {
        Ok(CompiledRobot {
            pre: self.link(&self.compile_now(component)?)?,
            digest: Digest::of(component),
            startup_fuel: startup_fuel(component),
            cache: CacheUse::Off,
        })
    }

    fn compile(
        &self,
        component: &[u8],
        digest: &Digest,
        startup_fuel: u64,
    ) -> Result<(Component, CacheUse), AdmissionError> {
        let Some(cache) = &self.cache else {
            return Ok((self.compile_now(component)?, CacheUse::Off));
        };
        let entry = cache.entry(&self.engine, &self.limits, digest);
        if let Some(compiled) = entry.load() {
            return Ok((compiled, CacheUse::Hit));
        }
        let compiled = self.compile_now(component)?;
        let cache_use = match entry.store(&compiled, startup_fuel) {
            Ok(()) => CacheUse::Stored,
            Err(error) => CacheUse::Failed(error.to_string()),
        };
        Ok((compiled, cache_use))
    }

    fn compile_now(&self, component: &[u8]) -> Result<Component, AdmissionError> {
        compilers::start()?;
        Component::from_binary(&self.engine, component).map_err(AdmissionError::of_engine)
    }

    fn link(&self, component: &Component) -> Result<RobotPre<Guest>, Rejection> {
        let wrong_type = |error: wasmtime::Error| Rejection::WrongType(format!("{error:#}").into());
        let pre: InstancePre<Guest> = self.linker.instantiate_pre(component).map_err(wrong_type)?;
        interface::check_types(component)?;
        RobotPre::new(pre).map_err(wrong_type)
    }
}

impl CompiledRobot {
    /// The digest of the file that was admitted.
    pub const fn digest(&self) -> &Digest {
        &self.digest
    }

    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        &self.cache
    }

    /// What the robot requires before it does anything.
    pub fn requirements(&self) -> Option<ResourceRequirements> {
        let required = self.pre.instance_pre().component().resources_required()?;
        Some(ResourceRequirements {
            memories: required.num_memories,
            memory_bytes: required.max_initial_memory_size.unwrap_or(0) * PAGE_BYTES,
            tables: required.num_tables,
            table_elements: required.max_initial_table_size.unwrap_or(0),
        })
    }

    /// What instantiating it costs besides the fuel of the code that runs.
    pub(crate) const fn startup_fuel(&self) -> u64 {
        self.startup_fuel
    }

    pub(crate) fn instantiate(&self, store: &mut Store<Guest>) -> wasmtime::Result<Robot> {
        self.pre.instantiate(store)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_refuses_is_not_the_robots_fault() {
        let refused = io::Error::from(io::ErrorKind::OutOfMemory);
        let error = wasmtime::Error::from(refused).context("failed to map code");
        assert!(matches!(
            AdmissionError::of_engine(error),
            AdmissionError::Host(InfrastructureError::Load(_))
        ));
        let error = wasmtime::Error::msg("unknown import").context("failed to link");
        assert!(matches!(
            AdmissionError::of_engine(error),
            AdmissionError::Rejected(Rejection::Invalid { .. })
        ));
    }
}
