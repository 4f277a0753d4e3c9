//! [`Step`]: one external command, named and timed on stderr.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// A command that has to succeed.
#[derive(Debug)]
pub struct Step {
    name: String,
    command: Command,
}

impl Step {
    /// A step that runs `program` in the repository's root folder.
    pub fn new(name: impl Into<String>, root: &Path, program: impl AsRef<OsStr>) -> Self {
        let mut command = Command::new(program);
        command.current_dir(root);
        Self {
            name: name.into(),
            command,
        }
    }

    /// A step that runs the cargo that runs us.
    pub fn cargo(name: impl Into<String>, root: &Path) -> Self {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        Self::new(name, root, cargo)
    }

    /// The same step with more arguments.
    #[must_use]
    pub fn args<A: AsRef<OsStr>>(mut self, arguments: impl IntoIterator<Item = A>) -> Self {
        self.command.args(arguments);
        self
    }

    /// The same step with a variable in its environment.
    #[must_use]
    pub fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        self.command.env(name, value);
        self
    }

    /// Runs the command; its output goes where ours goes.
    ///
    /// # Errors
    ///
    /// A line that names the step, when the command cannot be run or fails.
    pub fn run(mut self) -> Result<(), String> {
        eprintln!("==> {}", self.name);
        let begin = Instant::now();
        let status = self
            .command
            .status()
            .map_err(|error| format!("step `{}` cannot run: {error}", self.name))?;
        let seconds = begin.elapsed().as_secs_f64();
        if !status.success() {
            return Err(format!(
                "step `{}` failed after {seconds:.1} s ({status})",
                self.name
            ));
        }
        eprintln!("    {}: {seconds:.1} s", self.name);
        Ok(())
    }
}

/// Where cargo puts what it builds.
pub fn target_folder(root: &Path) -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        // A relative folder counts from the root, where all steps run.
        Some(folder) => root.join(folder),
        None => root.join("target"),
    }
}

/// The `wasmouse` binary that `cargo build` leaves.
pub fn wasmouse_binary(root: &Path) -> PathBuf {
    let name = format!("wasmouse{}", std::env::consts::EXE_SUFFIX);
    target_folder(root).join("debug").join(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failing_step_is_named() {
        let root = Path::new(".");
        assert_eq!(Step::cargo("version", root).args(["-V"]).run(), Ok(()));
        let failed = Step::cargo("nonsense", root).args(["--no-such-flag"]).run();
        let message = failed.unwrap_err();
        assert!(message.starts_with("step `nonsense` failed"), "{message}");
        let missing = Step::new("missing", root, "no-such-program-here").run();
        let message = missing.unwrap_err();
        assert!(
            message.starts_with("step `missing` cannot run"),
            "{message}"
        );
    }
}
