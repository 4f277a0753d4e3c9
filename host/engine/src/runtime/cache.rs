//! [`Cache`]: compiled robots on disk, and rejected files.
//!
//! Compiling takes milliseconds for a small robot and ten seconds for a large
//! interpreter; loading what was compiled before takes microseconds. A file that the compiler
//! gives up on costs as much each time, so rejections are kept too. An entry is bound to the
//! file that it is about and to everything that decides what comes of it (`entry`), and is
//! written atomically to a folder that nobody else can change (`cache_folder`): loading machine
//! code is only safe when this host made it.

use std::io::{self, Read as _, Write as _};
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use wasmouse_core::{Digest, GuestText};
use wasmtime::Engine;
use wasmtime::component::Component;

use super::artefact;
use super::cache_folder::{CacheFolder, SIZE_MAX_DEFAULT};
use super::compiled_code::{CompiledCode, Destination};
use super::entry::{EntryKey, EntryKind, Payload};
use crate::admission::Rejection;
use crate::error::InfrastructureError;
use crate::limits::Limits;

/// A folder of compiled robots and rejections.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: CacheFolder,
}

impl Cache {
    /// What a cache may take unless [`Cache::with_size_max`] says otherwise: 2 GiB, in bytes.
    pub const SIZE_MAX_DEFAULT: u64 = SIZE_MAX_DEFAULT;

    /// The cache in that folder, which is created private to the user.
    ///
    /// # Errors
    ///
    /// When the folder cannot be created, belongs to another user, or others may write to it:
    /// they could put machine code there.
    pub fn open(folder: impl Into<PathBuf>) -> Result<Self, InfrastructureError> {
        let path = folder.into();
        match CacheFolder::open(&path) {
            Ok(folder) => Ok(Self { folder }),
            Err(error) => Err(InfrastructureError::Cache {
                path,
                reason: error.to_string(),
            }),
        }
    }

    /// The same cache, which takes at most that many bytes: whenever something is stored,
    /// entries that were not used for the longest time are removed until the rest fits. With 0
    /// nothing stays.
    #[must_use]
    pub fn with_size_max(self, bytes: u64) -> Self {
        Self {
            folder: self.folder.with_size_max(bytes),
        }
    }

    /// What that engine keeps about that file under these limits.
    pub(crate) fn entry<'a>(
        &'a self,
        engine: &'a Engine,
        limits: &Limits,
        component: &Digest,
    ) -> CacheEntry<'a> {
        CacheEntry {
            folder: &self.folder,
            engine,
            key: EntryKey::new(engine, limits, component),
        }
    }
}

/// What is kept, or can be kept, about one file.
pub(crate) struct CacheEntry<'a> {
    folder: &'a CacheFolder,
    engine: &'a Engine,
    key: EntryKey,
}

/// A rejection as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredRejection {
    name: GuestText,
    reason: GuestText,
    hint: GuestText,
}

impl CacheEntry<'_> {
    /// The compiled form, when an intact one is there.
    pub(crate) fn load(&self) -> Option<Component> {
        let code = self.payload(EntryKind::Code)?;
        // SAFETY: the bytes are what `store` or a compile worker of this build wrote for this
        // file: the folder and the entry are the user's alone, and the header, whose digest
        // includes that of the code, names the file and all that the code depends on.
        let loaded = unsafe { artefact::load(self.engine, &code) }.ok();
        let loaded = loaded.map(|(component, _)| component);
        if loaded.is_none() {
            self.forget_code();
        }
        loaded
    }

    /// The compiled code, unread and unchecked, when there is some.
    pub(crate) fn open_code(&self) -> Option<CompiledCode> {
        let (file, payload) = self.folder.entry(EntryKind::Code, &self.key)?;
        Some(CompiledCode::new(file, payload))
    }

    /// A place for compiled code.
    pub(crate) fn destination(&self) -> io::Result<Destination> {
        Destination::kept(self.folder.clone(), self.key)
    }

    /// Removes the compiled code: it is damaged.
    pub(crate) fn forget_code(&self) {
        self.folder.forget(EntryKind::Code, &self.key);
    }

    /// Why the file was rejected, when it was.
    pub(crate) fn rejection(&self) -> Option<Rejection> {
        let bytes = self.payload(EntryKind::Rejection)?;
        let StoredRejection { name, reason, hint } = postcard::from_bytes(&bytes).ok()?;
        Some(Rejection::Reported { name, reason, hint })
    }

    /// Keeps a rejection for the next time, if it would be the same then. One that depends on
    /// the load of the machine is not kept.
    pub(crate) fn keep_rejection(&self, rejection: &Rejection) {
        if !rejection.is_repeatable() {
            return;
        }
        let stored = StoredRejection {
            name: rejection.name().into(),
            reason: rejection.reason(),
            hint: rejection.hint().into(),
        };
        let bytes = postcard::to_stdvec(&stored).expect("texts can be written to memory");
        if bytes.len() as u64 <= EntryKind::Rejection.bytes_max() {
            // Without it, the file is examined again.
            let _ = self.write(EntryKind::Rejection, &bytes);
        }
    }

    /// Keeps a compiled component for the next time.
    pub(crate) fn store(
        &self,
        component: &Component,
        startup_fuel: u64,
    ) -> Result<(), InfrastructureError> {
        let code = component
            .serialize()
            .map_err(|error| self.failure(format!("{error:#}")))?;
        self.write(EntryKind::Code, &artefact::seal(code, startup_fuel))
            .map_err(|error| self.failure(error.to_string()))
    }

    /// The error of a cache that cannot keep something.
    pub(crate) fn failure(&self, reason: String) -> InfrastructureError {
        InfrastructureError::Cache {
            path: self.folder.path().to_owned(),
            reason,
        }
    }

    /// The payload of an intact entry.
    fn payload(&self, kind: EntryKind) -> Option<Vec<u8>> {
        let (file, payload) = self.folder.entry(kind, &self.key)?;
        let mut bytes = Vec::new();
        let read = file.take(payload.length).read_to_end(&mut bytes);
        if read.is_ok() && Digest::of(&bytes) == payload.digest {
            return Some(bytes);
        }
        self.folder.forget(kind, &self.key);
        None
    }

    fn write(&self, kind: EntryKind, bytes: &[u8]) -> io::Result<()> {
        let payload = Payload {
            length: bytes.len() as u64,
            digest: Digest::of(bytes),
        };
        let mut draft = self.folder.draft()?;
        draft.write_all(&payload.header(kind, &self.key))?;
        draft.write_all(bytes)?;
        self.folder.keep(draft, kind, &self.key).map(drop)
    }
}
