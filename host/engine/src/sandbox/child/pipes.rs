//! The standard streams of a worker as plain files, without the line buffering of the
//! standard library.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read};

/// What the supervisor sends and what it receives.
pub(super) struct Pipes {
    pub(super) from: BufReader<File>,
    pub(super) to: BufWriter<File>,
}

/// Bytes that are read and written at once.
const BUFFER_BYTES: usize = 64 << 10;

impl Pipes {
    /// The standard input and output of this process, which nothing else may use.
    pub(super) fn standard() -> io::Result<Self> {
        let (from, to) = standard_files()?;
        Ok(Self {
            from: BufReader::with_capacity(BUFFER_BYTES, from),
            to: BufWriter::with_capacity(BUFFER_BYTES, to),
        })
    }
}

#[cfg(unix)]
fn standard_files() -> io::Result<(File, File)> {
    use std::os::fd::AsFd as _;

    let from = io::stdin().as_fd().try_clone_to_owned()?;
    let to = io::stdout().as_fd().try_clone_to_owned()?;
    Ok((from.into(), to.into()))
}

#[cfg(windows)]
fn standard_files() -> io::Result<(File, File)> {
    use std::os::windows::io::AsHandle as _;

    let from = io::stdin().as_handle().try_clone_to_owned()?;
    let to = io::stdout().as_handle().try_clone_to_owned()?;
    Ok((from.into(), to.into()))
}

/// Reads that many bytes, allocating only for those that arrive.
pub(super) fn read_exactly(from: &mut impl Read, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(length).read_to_end(&mut bytes)?;
    if u64::try_from(bytes.len()).is_ok_and(|read| read == length) {
        Ok(bytes)
    } else {
        Err(io::ErrorKind::UnexpectedEof.into())
    }
}
