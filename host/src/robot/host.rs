//! [`Host`]: admits files as robots and gives them an engine to run on.

use wasmtime::component::{Component, InstancePre, Linker};
use wasmtime::{Engine, Store};

use super::bindings::RobotPre;
use super::engine::Clock;
use super::guest::{self, Guest};
use super::{Cache, Digest, HostError, Refusal, admission, controller, engine};
use crate::sim::Limits;

/// Everything that robots need to run in this process: one engine with its pool
/// of instances, the functions they may call, and the cache of compiled ones.
///
/// One host serves any number of robots and threads.
pub struct Host {
    engine: Engine,
    linker: Linker<Guest>,
    cache: Option<Cache>,
    limits: Limits,
}

/// A robot that has been admitted: compiled, checked, ready to be instantiated.
pub struct Robot {
    pub(super) pre: RobotPre<Guest>,
    digest: Digest,
    cache: CacheUse,
}

/// Where the compiled code of a robot came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CacheUse {
    /// The host has no cache.
    Off,
    /// It was compiled before.
    Hit,
    /// It was compiled now and kept.
    Stored,
    /// It was compiled now and could not be kept: why. Harmless but slow.
    Failed(String),
}

impl Host {
    /// A host for robots under these limits, up to `matches` at the same time
    /// (at least 1), with compiled robots kept in `cache`.
    ///
    /// # Errors
    ///
    /// When the machine cannot give address space or threads.
    ///
    /// ```
    /// use wasmouse::robot::{Host, Refusal};
    /// use wasmouse::sim::Limits;
    ///
    /// let host = Host::new(Limits::default(), 1, None).expect("address space for one match");
    /// assert!(matches!(host.admit(b""), Err(Refusal::Empty)));
    /// ```
    pub fn new(limits: Limits, matches: u32, cache: Option<Cache>) -> Result<Self, HostError> {
        let host = Self::without_clock(limits, matches, cache)?;
        host.clock().start()?;
        Ok(host)
    }

    /// A host whose clock does not run yet, for a worker that is confined before it
    /// starts a thread.
    pub(super) fn without_clock(
        limits: Limits,
        matches: u32,
        cache: Option<Cache>,
    ) -> Result<Self, HostError> {
        let engine = engine::new_engine(&limits, matches.max(1))?;
        Self::with_engine(engine, limits, cache)
    }

    /// A host for one match at a time that records where a robot was when it failed
    /// ([`Recorder::frames`](super::Recorder)). Its clock does not run yet.
    pub(super) fn explaining(limits: Limits) -> Result<Self, HostError> {
        Self::with_engine(engine::new_explainer(&limits)?, limits, None)
    }

    fn with_engine(
        engine: Engine,
        limits: Limits,
        cache: Option<Cache>,
    ) -> Result<Self, HostError> {
        Ok(Self {
            linker: guest::linker(&engine)?,
            engine,
            cache,
            limits,
        })
    }

    /// The clock that ends matches of a host that stands still, before it runs.
    pub(super) fn clock(&self) -> Clock {
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
    /// The code must come from a compile worker of this host: wasmtime trusts it.
    pub(super) unsafe fn load(&self, code: &[u8], digest: Digest) -> Result<Robot, Refusal> {
        // SAFETY: the caller's promise is the one that wasmtime asks for.
        let compiled = unsafe { Component::deserialize(&self.engine, code) }
            .map_err(|error| Refusal::Invalid(format!("{error:#}")))?;
        let pre = self.link(&compiled)?;
        Ok(Robot {
            pre,
            digest,
            cache: CacheUse::Off,
        })
    }

    /// The limits that robots are admitted and run under.
    pub const fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(super) fn store(&self, guest: Guest) -> Store<Guest> {
        Store::new(&self.engine, guest)
    }

    /// Admits the bytes of a component, or of a core module that can be turned
    /// into one, as a robot.
    ///
    /// # Errors
    ///
    /// The reason why the file is refused.
    pub fn admit(&self, bytes: &[u8]) -> Result<Robot, Refusal> {
        let component = admission::read(bytes, &self.limits)?;
        admission::check_names(&component.shape)?;
        let digest = Digest::of(bytes);
        let (compiled, cache) = self.compile(&component.bytes, &digest)?;
        let pre = self.link(&compiled)?;
        Ok(Robot { pre, digest, cache })
    }

    fn compile(&self, component: &[u8], digest: &Digest) -> Result<(Component, CacheUse), Refusal> {
        let Some(cache) = &self.cache else {
            return Ok((self.compile_now(component)?, CacheUse::Off));
        };
        if let Some(compiled) = cache.load(&self.engine, digest) {
            return Ok((compiled, CacheUse::Hit));
        }
        let compiled = self.compile_now(component)?;
        let cache_use = match cache.store(&self.engine, digest, &compiled) {
            Ok(()) => CacheUse::Stored,
            Err(error) => CacheUse::Failed(error.to_string()),
        };
        Ok((compiled, cache_use))
    }

    fn compile_now(&self, component: &[u8]) -> Result<Component, Refusal> {
        Component::from_binary(&self.engine, component)
            .map_err(|error| Refusal::Invalid(format!("{error:#}")))
    }

    fn link(&self, component: &Component) -> Result<RobotPre<Guest>, Refusal> {
        let wrong_type = |error: wasmtime::Error| Refusal::WrongType(format!("{error:#}"));
        let pre: InstancePre<Guest> = self.linker.instantiate_pre(component).map_err(wrong_type)?;
        controller::check_types(component)?;
        RobotPre::new(pre).map_err(wrong_type)
    }
}

impl Robot {
    /// The digest of the file that was admitted.
    pub const fn digest(&self) -> &Digest {
        &self.digest
    }

    pub(super) fn component(&self) -> &Component {
        self.pre.instance_pre().component()
    }

    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        &self.cache
    }
}
