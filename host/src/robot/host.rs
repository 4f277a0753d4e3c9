//! [`Host`]: admits files as robots and gives them an engine to run on.

use std::borrow::Cow;

use wasmtime::component::{Component, InstancePre, Linker};
use wasmtime::{Engine, Store};

use super::bindings::RobotPre;
use super::componentize::{BinaryKind, componentize};
use super::guest::{self, Guest};
use super::refusal::CONTROLLER;
use super::shape::{self, Shape};
use super::{Cache, Digest, HostError, Refusal, controller, engine, over_limit};
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
        let engine = engine::new_engine(&limits, matches.max(1))?;
        let linker = guest::linker(&engine)?;
        Ok(Self {
            engine,
            linker,
            cache,
            limits,
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
        let component = self.read(bytes)?;
        check_names(&component.shape)?;
        let digest = Digest::of(bytes);
        let (compiled, cache) = self.compile(&component.bytes, &digest)?;
        let pre = self.link(&compiled)?;
        Ok(Robot { pre, digest, cache })
    }

    /// What the file is, before it is compiled.
    pub(super) fn read<'a>(&self, bytes: &'a [u8]) -> Result<ReadComponent<'a>, Refusal> {
        let size = u64::try_from(bytes.len()).unwrap_or(u64::MAX);
        let max = self.limits.component_bytes_max;
        if size > max {
            return Err(Refusal::TooLarge { max });
        }
        let kind = shape::binary_kind(bytes)?;
        let bytes = match kind {
            BinaryKind::CoreModule => Cow::Owned(componentize(bytes)?),
            BinaryKind::Component | BinaryKind::Other => Cow::Borrowed(bytes),
        };
        let shape = Shape::read(&bytes)?;
        Ok(ReadComponent { kind, bytes, shape })
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
            .map_err(|error| over_limit::refusal(&error, &self.limits))
    }

    fn link(&self, component: &Component) -> Result<RobotPre<Guest>, Refusal> {
        let wrong_type = |error: wasmtime::Error| Refusal::WrongType(format!("{error:#}"));
        let pre: InstancePre<Guest> = self.linker.instantiate_pre(component).map_err(wrong_type)?;
        controller::check_types(component)?;
        RobotPre::new(pre).map_err(wrong_type)
    }
}

/// A file read as a component.
pub(super) struct ReadComponent<'a> {
    /// What the file was.
    pub(super) kind: BinaryKind,
    /// The component: the file's bytes, or what was made of its core module.
    pub(super) bytes: Cow<'a, [u8]>,
    /// Its imports and exports.
    pub(super) shape: Shape,
}

/// Imports and exports by name, for refusals that say what to do; their types
/// are checked when linking.
fn check_names(shape: &Shape) -> Result<(), Refusal> {
    let unknown = |name: &&String| !is_known_import(name);
    if let Some(name) = shape.imports.iter().find(unknown) {
        return Err(Refusal::UnknownImport(name.clone()));
    }
    if !shape.exports.iter().any(|name| name == CONTROLLER) {
        return Err(Refusal::NoController(shape.exports.clone()));
    }
    Ok(())
}

/// The interface `types` holds no functions, but its types are imported by every
/// component that uses them.
fn is_known_import(name: &str) -> bool {
    name == guest::JOURNAL || name == "wasmouse:robot/types@0.1.0"
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
