//! [`CompiledCode`]: compiled code in a file, between a compile worker, the cache
//! and the workers that run it.
//!
//! The process in between never loads it, and never holds more than a piece of it: the
//! code of an interpreter has 60 MB.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use sha2::{Digest as _, Sha256};
use tempfile::NamedTempFile;
use wasmouse_core::Digest;

/// Bytes before the code: its digest.
pub(crate) const HEADER_BYTES: u64 = 32;

/// Compiled code, and what it has to be.
#[derive(Debug)]
pub(crate) struct CompiledCode {
    /// Locked while it is read: descriptors share their position.
    file: Mutex<File>,
    pub(crate) length: u64,
    pub(crate) digest: Digest,
}

impl CompiledCode {
    /// The code in a file of the cache, unread; `None` when there is not even a header.
    pub(crate) fn open(path: &Path) -> Option<Self> {
        let mut file = File::open(path).ok()?;
        let mut digest = [0; 32];
        file.read_exact(&mut digest).ok()?;
        let length = file.metadata().ok()?.len().checked_sub(HEADER_BYTES)?;
        Some(Self {
            file: Mutex::new(file),
            length,
            digest: Digest::from_bytes(digest),
        })
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
    path: Option<PathBuf>,
    hasher: Sha256,
    length: u64,
}

impl Destination {
    /// A new file in that folder, to be kept under that name.
    pub(crate) fn kept(folder: &Path, path: PathBuf) -> io::Result<Self> {
        Self::new(NamedTempFile::new_in(folder)?, Some(path))
    }

    /// A file that is deleted when nobody uses it any more.
    pub(crate) fn temporary() -> io::Result<Self> {
        Self::new(NamedTempFile::new()?, None)
    }

    fn new(mut file: NamedTempFile, path: Option<PathBuf>) -> io::Result<Self> {
        file.write_all(&[0; HEADER_BYTES as usize])?;
        Ok(Self {
            file,
            path,
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
        let digest = Digest::from_bytes(self.hasher.finalize().into());
        if digest != *expected {
            return Ok(None);
        }
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(digest.as_bytes())?;
        let file = match self.path {
            Some(path) => self.file.persist(path)?,
            None => self.file.into_file(),
        };
        Ok(Some(CompiledCode {
            file: Mutex::new(file),
            length: self.length,
            digest,
        }))
    }
}
