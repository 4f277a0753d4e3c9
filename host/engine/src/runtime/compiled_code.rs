//! [`CompiledCode`]: compiled code in a file, between a compile worker, the cache
//! and the workers that run it.
//!
//! The process in between never loads it, and never holds more than a piece of it: the
//! code of an interpreter has 60 MB.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write};
use std::sync::{Mutex, PoisonError};

use sha2::{Digest as _, Sha256};
use tempfile::NamedTempFile;
use wasmouse_core::Digest;

use super::cache_folder::CacheFolder;
use super::entry::{EntryKey, EntryKind, HEADER_BYTES, Payload};

/// Compiled code, and what it has to be.
#[derive(Debug)]
pub(crate) struct CompiledCode {
    /// Locked while it is read: descriptors share their position.
    file: Mutex<File>,
    pub(crate) length: u64,
    pub(crate) digest: Digest,
}

impl CompiledCode {
    /// The code in an entry of the cache, unread.
    pub(super) const fn new(file: File, payload: Payload) -> Self {
        Self {
            file: Mutex::new(file),
            length: payload.length,
            digest: payload.digest,
        }
    }

    /// Writes all of it; the reader on the other side compares the digest.
    ///
    /// # Errors
    ///
    /// When the file cannot be read to its length, or the other side is gone.
    pub(crate) fn send(&self, to: &mut impl Write) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(HEADER_BYTES))?;
        let sent = io::copy(&mut (&*file).take(self.length), to)?;
        if sent == self.length {
            Ok(())
        } else {
            Err(io::Error::other("a file of compiled code is cut off"))
        }
    }
}

/// A file that code is being written to.
pub(crate) struct Destination {
    file: NamedTempFile,
    /// Where it goes in the end; `None` for code that is not kept.
    entry: Option<(CacheFolder, EntryKey)>,
    hasher: Sha256,
    length: u64,
}

impl Destination {
    /// A new file in that folder, to be kept as that entry.
    pub(super) fn kept(folder: CacheFolder, key: EntryKey) -> io::Result<Self> {
        Self::new(folder.draft()?, Some((folder, key)))
    }

    /// A file that is deleted when nobody uses it any more.
    pub(crate) fn temporary() -> io::Result<Self> {
        Self::new(NamedTempFile::new()?, None)
    }

    fn new(mut file: NamedTempFile, entry: Option<(CacheFolder, EntryKey)>) -> io::Result<Self> {
        file.write_all(&[0; HEADER_BYTES as usize])?;
        Ok(Self {
            file,
            entry,
            hasher: Sha256::new(),
            length: 0,
        })
    }

    /// Adds a piece.
    pub(crate) fn write(&mut self, piece: &[u8]) -> io::Result<()> {
        self.hasher.update(piece);
        self.length += piece.len() as u64;
        self.file.write_all(piece)
    }

    /// Puts the file in its place when the code is what it should be; `None` when not.
    pub(crate) fn finish(mut self, expected: &Digest) -> io::Result<Option<CompiledCode>> {
        let payload = Payload {
            length: self.length,
            digest: Digest::from_bytes(self.hasher.finalize().into()),
        };
        if payload.digest != *expected {
            return Ok(None);
        }
        let file = match self.entry {
            Some((folder, key)) => {
                self.file.seek(SeekFrom::Start(0))?;
                let header = payload.header(EntryKind::Code, &key);
                self.file.write_all(&header)?;
                folder.keep(self.file, EntryKind::Code, &key)?
            }
            None => self.file.into_file(),
        };
        Ok(Some(CompiledCode::new(file, payload)))
    }
}
