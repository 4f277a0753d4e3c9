//! Pinned packages of Python and Node, in folders below `target`, each with a stamp of what was
//! installed.

use std::env;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Where packages come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ecosystem {
    /// PyPI; a package is `NAME==VERSION`.
    Python,
    /// The registry of npm; a package is `NAME@VERSION`.
    Node,
}

impl Ecosystem {
    /// Where the programs of packages are that were installed into `folder`.
    pub fn programs(self, folder: &Path) -> PathBuf {
        match self {
            Self::Python if cfg!(windows) => folder.join("Scripts"),
            Self::Python => folder.join("bin"),
            Self::Node => folder.join("node_modules/.bin"),
        }
    }

    /// Installs packages into a folder, unless its stamp says that they are there. One without a
    /// wheel for this machine takes none of the others with it.
    ///
    /// # Errors
    ///
    /// A line about the first command that failed.
    pub fn install(self, packages: &[&str], folder: &Path) -> Result<(), String> {
        let stamp = folder.join("installed.txt");
        let expected: String = packages.iter().map(|it| format!("{it}\n")).collect();
        if fs::read_to_string(&stamp).is_ok_and(|text| text == expected) {
            return Ok(());
        }
        fs::create_dir_all(folder).map_err(|error| error.to_string())?;
        match self {
            Self::Python => {
                let python = if cfg!(windows) { "python" } else { "python3" };
                quiet(Command::new(python).args(["-m", "venv"]).arg(folder))?;
                let python = self.programs(folder).join("python");
                let install = |package: &&str| {
                    quiet(
                        Command::new(&python)
                            .args(["-m", "pip", "install", "--quiet"])
                            .args(["--disable-pip-version-check", "--only-binary", ":all:"])
                            .arg(package),
                    )
                };
                let results: Vec<_> = packages.iter().map(install).collect();
                results.into_iter().collect::<Result<(), _>>()?;
            }
            Self::Node => {
                quiet(
                    npm()
                        .arg("install")
                        .args(NPM_OPTIONS)
                        .arg("--prefix")
                        .arg(folder)
                        .args(packages),
                )?;
            }
        }
        fs::write(stamp, expected).map_err(|error| error.to_string())
    }
}

/// No scripts: a package may not run anything as it is installed.
pub const NPM_OPTIONS: [&str; 4] = ["--no-audit", "--no-fund", "--ignore-scripts", "--silent"];

/// A command that runs npm.
pub fn npm() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

/// Says on stderr that a test is skipped, in a line that is not captured with the test's output.
///
/// # Panics
///
/// When the variable `required` is set: then nothing may be skipped.
pub fn skip(test: &str, reason: &str, required: &str) {
    let line = format!("skipped {test}: {reason}");
    let is_required = env::var_os(required).is_some_and(|it| !it.is_empty());
    assert!(!is_required, "{line} ({required} is set)");
    // `eprintln!` would be captured.
    let _ = writeln!(io::stderr(), "{line}");
}

/// Runs a command without its output.
///
/// # Errors
///
/// When it cannot run or fails: a line that ends with the last one that it wrote to stderr.
pub fn quiet(command: &mut Command) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("`{program}` cannot run: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    let last = stderr.trim().lines().last().unwrap_or("no message");
    Err(format!("`{program}` failed ({}): {last}", output.status))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_fails_is_named_with_its_last_line() {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let error = quiet(Command::new(cargo).arg("--no-such-flag")).unwrap_err();
        assert!(error.contains("failed (exit"), "{error}");
        let error = quiet(&mut Command::new("no-such-program-here")).unwrap_err();
        assert!(
            error.starts_with("`no-such-program-here` cannot run"),
            "{error}"
        );
    }

    #[test]
    fn what_is_stamped_is_not_installed_again() {
        let folder = tempfile::tempdir().unwrap();
        let packages = ["no-such-package==1.2.3"];
        fs::write(
            folder.path().join("installed.txt"),
            "no-such-package==1.2.3\n",
        )
        .unwrap();
        assert_eq!(Ecosystem::Python.install(&packages, folder.path()), Ok(()));
    }
}
