//! [`Cache`]: compiled robots on disk.
//!
//! Compiling takes milliseconds for a small robot and ten seconds for a large
//! interpreter; loading what was compiled before takes microseconds. An entry
//! is named by the content of the component and everything that wasmtime says
//! decides the code, is written atomically, and carries a digest that is checked
//! before wasmtime sees the bytes: loading machine code is only safe when this
//! host made it. The folder is private to the user for the same reason.

use std::fs;
use std::hash::{Hash, Hasher};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};
use wasmtime::Engine;
use wasmtime::component::Component;

use wasmouse_core::Digest;

use super::artefact;
use super::compiled_code::{CompiledCode, Destination};
use crate::error::InfrastructureError;

/// A folder of compiled robots.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

const DIGEST_BYTES: usize = 32;

impl Cache {
    /// The cache in that folder, which is created private to the user.
    ///
    /// # Errors
    ///
    /// When the folder cannot be created, or others may write to it: they could
    /// put machine code there.
    pub fn open(folder: impl Into<PathBuf>) -> Result<Self, InfrastructureError> {
        let folder = folder.into();
        match private_folder(&folder) {
            Ok(()) => Ok(Self { folder }),
            Err(error) => Err(InfrastructureError::Cache {
                path: folder,
                reason: error.to_string(),
            }),
        }
    }

    /// The compiled form of that component, when an intact one is there.
    pub(crate) fn load(&self, engine: &Engine, component: &Digest) -> Option<Component> {
        let path = self.entry(engine, component);
        let bytes = fs::read(&path).ok()?;
        let loaded = checked_payload(&bytes).and_then(|payload| {
            // SAFETY: the bytes are what `store` wrote: the folder is private to
            // this user, the digest fits, and the name includes wasmtime's own
            // hash of everything that the code depends on.
            let loaded = unsafe { artefact::load(engine, payload) }.ok()?;
            Some(loaded.0)
        });
        if loaded.is_none() {
            // Damaged, by a crash or a bad disk: make room for a good one. If
            // that fails the next `store` replaces it.
            let _ = fs::remove_file(&path);
        }
        loaded
    }

    /// The compiled code of that component, unread and unchecked, when there is some.
    pub(crate) fn open_code(&self, engine: &Engine, component: &Digest) -> Option<CompiledCode> {
        CompiledCode::open(&self.entry(engine, component))
    }

    /// A place for the compiled code of that component.
    pub(crate) fn destination(
        &self,
        engine: &Engine,
        component: &Digest,
    ) -> io::Result<Destination> {
        Destination::kept(&self.folder, self.entry(engine, component))
    }

    /// Removes what is kept of that component: it is damaged.
    pub(crate) fn forget(&self, engine: &Engine, component: &Digest) {
        // If that fails the next one replaces it.
        let _ = fs::remove_file(self.entry(engine, component));
    }

    /// The error of a cache that cannot keep something.
    pub(crate) fn failure(&self, reason: String) -> InfrastructureError {
        InfrastructureError::Cache {
            path: self.folder.clone(),
            reason,
        }
    }

    /// Keeps a compiled component for the next time.
    pub(crate) fn store(
        &self,
        engine: &Engine,
        digest: &Digest,
        component: &Component,
        startup_fuel: u64,
    ) -> Result<(), InfrastructureError> {
        let path = self.entry(engine, digest);
        let failed = |reason: String| InfrastructureError::Cache {
            path: path.clone(),
            reason,
        };
        let code = component
            .serialize()
            .map_err(|error| failed(format!("{error:#}")))?;
        let payload = artefact::seal(code, startup_fuel);
        write_atomically(&self.folder, &path, &payload).map_err(|error| failed(error.to_string()))
    }

    /// The file for that component compiled by that engine.
    fn entry(&self, engine: &Engine, component: &Digest) -> PathBuf {
        let mut hasher = Sha256Hasher(Sha256::new());
        engine.precompile_compatibility_hash().hash(&mut hasher);
        hasher.0.update(component.as_bytes());
        let key: [u8; DIGEST_BYTES] = hasher.0.finalize().into();
        self.folder.join(format!("{}.cwasm", Digest::of(&key)))
    }
}

fn checked_payload(bytes: &[u8]) -> Option<&[u8]> {
    let (digest, payload) = bytes.split_at_checked(DIGEST_BYTES)?;
    (Digest::of(payload).as_bytes() == digest).then_some(payload)
}

fn write_atomically(folder: &Path, path: &Path, payload: &[u8]) -> io::Result<()> {
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(Digest::of(payload).as_bytes())?;
    file.write_all(payload)?;
    file.persist(path)?;
    Ok(())
}

#[cfg(unix)]
fn private_folder(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::{DirBuilderExt as _, PermissionsExt as _};

    fs::DirBuilder::new()
        .recursive(true)
        .mode(0o700)
        .create(folder)?;
    let mode = fs::metadata(folder)?.permissions().mode();
    if mode & 0o022 != 0 {
        return Err(io::Error::other(format!(
            "others may write to it (mode {:o}); `chmod go-w` it or name another folder",
            mode & 0o777
        )));
    }
    Ok(())
}

#[cfg(not(unix))]
fn private_folder(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)
}

/// Lets a value that only knows `Hash` go into a stable digest.
struct Sha256Hasher(Sha256);

impl Hasher for Sha256Hasher {
    fn write(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    fn finish(&self) -> u64 {
        let digest: [u8; DIGEST_BYTES] = self.0.clone().finalize().into();
        let (first, _) = digest.split_at(8);
        u64::from_le_bytes(first.try_into().expect("8 of 32 bytes"))
    }
}
