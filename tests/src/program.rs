//! [`Program`]: the `wasmouse` binary under a path of its own, so that all its processes
//! can be distinguished from all others, whoever their parents are.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A folder with a link to the binary. Processes are found in `/proc`, where there is
/// one; elsewhere there seem to be none.
#[derive(Debug)]
pub struct Program {
    folder: TempDir,
    path: PathBuf,
}

impl Program {
    /// The binary in a new folder.
    ///
    /// # Errors
    ///
    /// When the folder cannot be made.
    pub fn new(wasmouse: &Path) -> io::Result<Self> {
        // Beside the binary, so that a link to it is enough.
        let parent = wasmouse.parent().unwrap_or(Path::new("."));
        let folder = tempfile::Builder::new()
            .prefix("wasmouse-")
            .tempdir_in(parent.canonicalize()?)?;
        let path = folder.path().join("wasmouse");
        if fs::hard_link(wasmouse, &path).is_err() {
            fs::copy(wasmouse, &path)?;
        }
        Ok(Self { folder, path })
    }

    /// The folder, which may be used for other files too.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A call of it in its folder, with nothing on its standard input.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.path);
        command.current_dir(self.folder()).stdin(Stdio::null());
        command
    }

    /// The numbers of its processes.
    pub fn processes(&self) -> Vec<u32> {
        let Ok(entries) = fs::read_dir("/proc") else {
            return Vec::new();
        };
        entries
            .filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
            .filter(|process| {
                fs::read_link(format!("/proc/{process}/exe"))
                    .is_ok_and(|executable| executable == self.path)
            })
            .collect()
    }

    /// Waits until all its processes have ended, kills those that stay, and counts them.
    pub fn left_behind(&self) -> usize {
        /// How long workers may outlive their supervisor.
        const GRACE: Duration = Duration::from_secs(2);
        let begin = Instant::now();
        loop {
            let left = self.processes().len();
            if left == 0 || begin.elapsed() > GRACE {
                self.kill_all();
                return left;
            }
            thread::sleep(Duration::from_millis(2));
        }
    }

    /// Kills all its processes.
    pub fn kill_all(&self) {
        for process in self.processes() {
            signal(process, "KILL");
        }
    }
}

/// Sends a signal, by its name without `SIG`, if the process is still there.
pub fn signal(process: u32, name: &str) {
    // The system's own command, because the standard library has none.
    let _ = Command::new("kill")
        .args([format!("-{name}"), process.to_string()])
        .stderr(Stdio::null())
        .status();
}
