//! Modules made by wasm-smith: those that are a part of the repository.
//!
//! `tests/smith` makes them, a workspace of its own, because wasm-smith wants other
//! features of shared dependencies. [`Smith`] is a pipe to that program.

use std::io::{self, Read as _, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// The modules as the program wrote them for the seeds from 1: lengths and modules.
const RECORDED: &[u8] = include_bytes!("smith.bin");

/// The modules that are a part of the repository.
pub(super) fn recorded() -> Vec<&'static [u8]> {
    let mut modules = Vec::new();
    let mut rest = RECORDED;
    while let Some((length, behind)) = rest.split_first_chunk() {
        let length = u32::from_le_bytes(*length) as usize;
        let (module, behind) = behind.split_at(length);
        modules.push(module);
        rest = behind;
    }
    modules
}

/// The program that makes more.
pub struct Smith {
    child: Child,
    to: ChildStdin,
    from: ChildStdout,
}

impl Smith {
    /// Starts the program.
    ///
    /// # Errors
    ///
    /// When it is not there.
    pub fn start(program: &Path) -> io::Result<Self> {
        let mut child = Command::new(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(io::Error::other("it has no pipes"));
        };
        Ok(Self { child, to, from })
    }

    /// The module of that seed.
    ///
    /// # Errors
    ///
    /// When the program is gone.
    pub fn module(&mut self, seed: u64) -> io::Result<Vec<u8>> {
        self.to.write_all(&seed.to_le_bytes())?;
        let mut length = [0; 4];
        self.from.read_exact(&mut length)?;
        let mut module = vec![0; u32::from_le_bytes(length) as usize];
        self.from.read_exact(&mut module)?;
        Ok(module)
    }
}

impl Drop for Smith {
    fn drop(&mut self) {
        // It may have ended by itself; nothing has to stay behind.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
