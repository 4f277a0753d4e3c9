//! The files of the cache: what identifies an entry, and the header that binds the entry to it.
//!
//! An entry is a header and a payload. The header names everything that the payload belongs to
//! and the payload's digest, and ends in a digest of itself, so an entry that is damaged, or
//! that was put under the name of another one, is never used. The digests have no secret: who
//! can write to the folder can make entries, which is why the folder and every file in it must
//! belong to the user (see `cache_folder`).

use std::hash::{Hash, Hasher};
use std::io::{self, Read};

use sha2::{Digest as _, Sha256};
use wasmouse_core::{Digest, DigestBuilder};
use wasmtime::Engine;

use super::config::engine_id;
use crate::limits::Limits;

/// Raised with every change to what is stored, or to how it is.
const VERSION: &[u8; 16] = b"wasmouse.cache.2";

/// Bytes before the payload: version, kind, host, component, length and digest of the payload,
/// digest of all that.
pub(crate) const HEADER_BYTES: u64 = SEALED_BYTES as u64 + 32;

const SEALED_BYTES: usize = VERSION.len() + 8 + 32 + 32 + 8 + 32;

/// What an entry holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EntryKind {
    /// Compiled code.
    Code,
    /// Why a file is rejected.
    Rejection,
}

impl EntryKind {
    /// All kinds.
    pub(crate) const ALL: [Self; 2] = [Self::Code, Self::Rejection];

    /// The ending of the names of its files.
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::Code => "cwasm",
            Self::Rejection => "rejection",
        }
    }

    /// The largest payload, in bytes. Python robots have 60 MB of code.
    pub(crate) const fn bytes_max(self) -> u64 {
        match self {
            Self::Code => 512 << 20,
            Self::Rejection => 64 << 10,
        }
    }

    const fn tag(self) -> &'static [u8; 8] {
        match self {
            Self::Code => b"code....",
            Self::Rejection => b"rejected",
        }
    }
}

/// The identity of an entry: a file, and the host that compiled or rejected it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct EntryKey {
    /// Everything but the file that decides what comes of it.
    host: Digest,
    component: Digest,
}

impl EntryKey {
    /// The identity of what that engine makes of a file under these limits.
    ///
    /// The build is part of it: it has the checks, and what it makes of a core module.
    pub(crate) fn new(engine: &Engine, limits: &Limits, component: &Digest) -> Self {
        let mut wasmtime = Sha256Hasher(Sha256::new());
        engine.precompile_compatibility_hash().hash(&mut wasmtime);
        let wasmtime: [u8; 32] = wasmtime.0.finalize().into();
        let limits = postcard::to_stdvec(limits).expect("numbers can be written to memory");
        let host = DigestBuilder::new("wasmouse.cache-host.1")
            .bytes(env!("CARGO_PKG_VERSION").as_bytes())
            .bytes(env!("WASMOUSE_BUILD_ID").as_bytes())
            .bytes(engine_id().as_str().as_bytes())
            .digest(&Digest::from_bytes(wasmtime))
            .bytes(&limits)
            .finish();
        Self {
            host,
            component: *component,
        }
    }

    /// The name of its file.
    pub(crate) fn file_name(&self, kind: EntryKind) -> String {
        let name = DigestBuilder::new("wasmouse.cache-entry.1")
            .digest(&self.host)
            .digest(&self.component)
            .finish();
        format!("{name}.{}", kind.extension())
    }
}

/// The payload that a header announces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Payload {
    /// In bytes.
    pub(crate) length: u64,
    pub(crate) digest: Digest,
}

impl Payload {
    /// The header of the payload under that identity.
    pub(crate) fn header(&self, kind: EntryKind, key: &EntryKey) -> Vec<u8> {
        let mut header = self.sealed(kind, key);
        let seal = Digest::of(&header);
        header.extend_from_slice(seal.as_bytes());
        header
    }

    /// Reads the header of an entry that must be of that kind and identity; `None` when it is
    /// anything else.
    ///
    /// # Errors
    ///
    /// When it cannot be read.
    pub(crate) fn read(
        from: &mut impl Read,
        kind: EntryKind,
        key: &EntryKey,
    ) -> io::Result<Option<Self>> {
        let mut header = vec![0; SEALED_BYTES + 32];
        from.read_exact(&mut header)?;
        let (sealed, _) = header.split_at(SEALED_BYTES);
        let (rest, digest) = sealed.split_at(SEALED_BYTES - 32);
        let length = &rest[rest.len() - 8..];
        let payload = Self {
            length: u64::from_le_bytes(length.try_into().expect("8 bytes")),
            digest: Digest::from_bytes(digest.try_into().expect("32 bytes")),
        };
        // All of it follows from what was asked for, so there is nothing else to look at.
        Ok((payload.header(kind, key) == header).then_some(payload))
    }

    fn sealed(&self, kind: EntryKind, key: &EntryKey) -> Vec<u8> {
        let mut sealed = Vec::with_capacity(SEALED_BYTES + 32);
        sealed.extend_from_slice(VERSION);
        sealed.extend_from_slice(kind.tag());
        sealed.extend_from_slice(key.host.as_bytes());
        sealed.extend_from_slice(key.component.as_bytes());
        sealed.extend_from_slice(&self.length.to_le_bytes());
        sealed.extend_from_slice(self.digest.as_bytes());
        sealed
    }
}

/// Lets a value that only knows `Hash` go into a stable digest.
struct Sha256Hasher(Sha256);

impl Hasher for Sha256Hasher {
    fn write(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    fn finish(&self) -> u64 {
        let digest: [u8; 32] = self.0.clone().finalize().into();
        let (first, _) = digest.split_at(8);
        u64::from_le_bytes(first.try_into().expect("8 of 32 bytes"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::AdmissionLimits;
    use crate::runtime::new_compiler;

    fn key(limits: &Limits, component: &[u8]) -> EntryKey {
        let engine = new_compiler(limits).expect("an engine");
        EntryKey::new(&engine, limits, &Digest::of(component))
    }

    #[test]
    fn headers_are_read_by_their_own_identity_alone() {
        let limits = Limits::default();
        let ours = key(&limits, b"ours");
        let payload = Payload {
            length: 7,
            digest: Digest::of(b"payload"),
        };
        let header = payload.header(EntryKind::Code, &ours);
        assert_eq!(header.len() as u64, HEADER_BYTES);
        let read = |bytes: &[u8], kind, key: &EntryKey| {
            Payload::read(&mut &bytes[..], kind, key).expect("enough bytes")
        };
        assert_eq!(read(&header, EntryKind::Code, &ours), Some(payload));
        assert_eq!(read(&header, EntryKind::Rejection, &ours), None);
        assert_eq!(
            read(&header, EntryKind::Code, &key(&limits, b"theirs")),
            None
        );
        for place in 0..header.len() {
            let mut damaged = header.clone();
            damaged[place] ^= 1;
            assert_eq!(read(&damaged, EntryKind::Code, &ours), None, "byte {place}");
        }
    }

    #[test]
    fn limits_are_part_of_the_identity() {
        let limits = Limits::default();
        let stricter = Limits {
            admission: AdmissionLimits {
                functions_max: 1,
                ..AdmissionLimits::DEFAULT
            },
            ..limits
        };
        assert_ne!(key(&limits, b"a"), key(&stricter, b"a"));
    }
}
