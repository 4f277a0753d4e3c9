//! Finds a compiler for the target of a robot: rustup's, or a packaged one.
//!
//! [`Probe::run`] looks at the machine, [`plan`] decides (a pure function, so
//! that every kind of machine is a test), and [`Toolchain::find`] carries the
//! decision out. Compiling itself is the work of [`super::package`].

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::target::Target;
use crate::cli::failure::Failure;
use crate::cli::output::message;
use crate::report::text::{Text, text};

/// How to get a target.
fn install_hint(target: Target) -> Text {
    let rustup = text!(
        "with rustup:             rustup target add {}",
        target.name()
    );
    match target {
        Target::Freestanding => text!(
            "{}\n\
             on Debian or Ubuntu:     apt-get install --no-install-recommends rustc-web \
             rust-web-src lld-22\n                         \
             (wasmouse then finds it automatically)",
            rustup
        ),
        Target::Preview1 | Target::Preview2 => rustup,
    }
}

/// A compiler outside rustup that can build for [`Target::Freestanding`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packaged {
    rustc: PathBuf,
    linker: PathBuf,
    /// Whether the standard library has to be compiled from source.
    build_std: bool,
}

/// What this machine has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Probe {
    /// Whether the compiler that cargo uses in this folder has the target.
    has_target: bool,
    /// Whether rustup can be asked to add it.
    has_rustup: bool,
    packaged: Option<Packaged>,
}

/// What to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Plan {
    /// Build with the compiler that cargo uses anyway.
    AsIs,
    /// Ask rustup, then look again.
    AskRustup,
    /// Build with a packaged compiler.
    UsePackaged(Packaged),
    /// Explain how to install one.
    GiveUp,
}

/// Chooses the least surprising option: the compiler that is installed, then
/// rustup, then a packaged compiler.
fn plan(probe: &Probe, rustup_was_asked: bool) -> Plan {
    match probe {
        Probe {
            has_target: true, ..
        } => Plan::AsIs,
        Probe {
            has_rustup: true, ..
        } if !rustup_was_asked => Plan::AskRustup,
        Probe {
            packaged: Some(packaged),
            ..
        } => Plan::UsePackaged(packaged.clone()),
        _ => Plan::GiveUp,
    }
}

/// How to run cargo so that it compiles for a target.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Toolchain {
    /// Arguments for `cargo build`.
    pub arguments: Vec<OsString>,
    /// Variables for cargo's environment.
    pub environment: Vec<(&'static str, OsString)>,
}

impl Toolchain {
    /// Finds the toolchain for a crate in `folder`, which may choose its own with
    /// a `rust-toolchain.toml`. Asks rustup to add the target where it is
    /// missing, and says so on stderr.
    ///
    /// # Errors
    ///
    /// Fails with the ways to install the target when there is none.
    pub fn find(folder: &Path, target: Target) -> Result<Self, Failure> {
        let probe = Probe::run(folder, target);
        match plan(&probe, false) {
            Plan::AskRustup => {
                let probe = if add_target(folder, target) {
                    Probe::run(folder, target)
                } else {
                    probe
                };
                Self::from_plan(plan(&probe, true), target)
            }
            plan => Self::from_plan(plan, target),
        }
    }

    /// Checks that there is one, or that rustup could add it.
    ///
    /// # Errors
    ///
    /// As [`Toolchain::find`].
    pub fn check(folder: &Path) -> Result<(), Failure> {
        let target = Target::of(folder)?;
        match plan(&Probe::run(folder, target), false) {
            Plan::AsIs | Plan::AskRustup | Plan::UsePackaged(_) => Ok(()),
            plan @ Plan::GiveUp => Self::from_plan(plan, target).map(|_| ()),
        }
    }

    fn from_plan(plan: Plan, target: Target) -> Result<Self, Failure> {
        match plan {
            Plan::AsIs => Ok(Self::default()),
            Plan::UsePackaged(packaged) => {
                message!(
                    "using the packaged compiler {} with {}",
                    Text::of_path(&packaged.rustc),
                    Text::of_path(&packaged.linker)
                );
                Ok(Self::from_packaged(&packaged))
            }
            Plan::AskRustup | Plan::GiveUp => Err(Failure::input(format_args!(
                "no Rust compiler for {} on this machine",
                target.name()
            ))
            .hint(install_hint(target))),
        }
    }

    fn from_packaged(packaged: &Packaged) -> Self {
        let mut toolchain = Self {
            arguments: Vec::new(),
            environment: vec![
                ("RUSTC", packaged.rustc.clone().into()),
                (
                    "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER",
                    packaged.linker.clone().into(),
                ),
            ],
        };
        if packaged.build_std {
            // `-Z` needs a nightly compiler or this variable; it is only used to
            // compile the standard library that fits this very compiler.
            toolchain.environment.push(("RUSTC_BOOTSTRAP", "1".into()));
            toolchain
                .arguments
                .push("-Zbuild-std=std,panic_abort".into());
        }
        toolchain
    }
}

impl Probe {
    fn run(folder: &Path, target: Target) -> Self {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let library = sysroot(&rustc, folder).map(|sysroot| target_library(&sysroot, target));
        // A packaged compiler brings neither the C library of WASI nor its linker.
        let packaged = || Packaged::probe(folder, &[Path::new("/usr/bin"), Path::new("/bin")]);
        Self {
            has_target: library.is_some_and(|library| library.is_dir()),
            has_rustup: quiet("rustup", folder).arg("--version").status().is_ok(),
            packaged: (target == Target::Freestanding).then(packaged).flatten(),
        }
    }
}

impl Packaged {
    fn probe(folder: &Path, bin_folders: &[&Path]) -> Option<Self> {
        let rustc = bin_folders
            .iter()
            .map(|bin| bin.join("rustc"))
            .find(|rustc| rustc.is_file())?;
        let sysroot = sysroot(rustc.as_os_str(), folder)?;
        let build_std = !target_library(&sysroot, Target::Freestanding).is_dir();
        let library_source = sysroot.join("lib/rustlib/src/rust/library/std/Cargo.toml");
        if build_std && !library_source.is_file() {
            return None;
        }
        let linker = bin_folders.iter().find_map(|bin| newest_wasm_ld(bin))?;
        Some(Self {
            rustc,
            linker,
            build_std,
        })
    }
}

/// Where a compiler with this sysroot keeps the target's standard library.
fn target_library(sysroot: &Path, target: Target) -> PathBuf {
    sysroot.join("lib/rustlib").join(target.name()).join("lib")
}

/// Where a compiler looks for standard libraries; `None` if it cannot be run.
fn sysroot(rustc: &std::ffi::OsStr, folder: &Path) -> Option<PathBuf> {
    let output = quiet(rustc, folder)
        .args(["--print", "sysroot"])
        .stdout(Stdio::piped())
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(PathBuf::from(text.trim_end()))
}

/// `wasm-ld` if there is one, else the `wasm-ld-N` with the greatest `N`:
/// distributions install it under a versioned name.
fn newest_wasm_ld(bin: &Path) -> Option<PathBuf> {
    let plain = bin.join("wasm-ld");
    if plain.is_file() {
        return Some(plain);
    }
    let version = |name: &str| name.strip_prefix("wasm-ld-")?.parse::<u32>().ok();
    std::fs::read_dir(bin)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|name| Some((version(&name)?, name)))
        .max()
        .map(|(_, name)| bin.join(name))
}

/// Asks rustup for the target; says on stderr what happens.
fn add_target(folder: &Path, target: Target) -> bool {
    message!("adding the target {} with rustup", target.name());
    // rustup's stdout is talk, and ours is data.
    let status: io::Result<_> = quiet("rustup", folder)
        .args(["target", "add", target.name()])
        .stderr(Stdio::inherit())
        .status();
    let added = status.is_ok_and(|status| status.success());
    if !added {
        message!("rustup could not add the target");
    }
    added
}

/// A command in `folder` that says nothing.
fn quiet(program: impl AsRef<std::ffi::OsStr>, folder: &Path) -> Command {
    let mut command = Command::new(program);
    command
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    fn packaged(build_std: bool) -> Packaged {
        Packaged {
            rustc: "/usr/bin/rustc".into(),
            linker: "/usr/bin/wasm-ld-22".into(),
            build_std,
        }
    }

    #[track_caller]
    fn check(
        has_target: bool,
        has_rustup: bool,
        has_packaged: bool,
        first: &Plan,
        after_rustup: &Plan,
    ) {
        let probe = Probe {
            has_target,
            has_rustup,
            packaged: has_packaged.then(|| packaged(true)),
        };
        assert_eq!(plan(&probe, false), *first);
        assert_eq!(plan(&probe, true), *after_rustup);
    }

    #[test]
    fn every_kind_of_machine_has_a_plan() {
        let use_packaged = Plan::UsePackaged(packaged(true));
        for has_rustup in [false, true] {
            for has_packaged in [false, true] {
                check(true, has_rustup, has_packaged, &Plan::AsIs, &Plan::AsIs);
            }
        }
        check(false, true, true, &Plan::AskRustup, &use_packaged);
        check(false, true, false, &Plan::AskRustup, &Plan::GiveUp);
        check(false, false, true, &use_packaged, &use_packaged);
        check(false, false, false, &Plan::GiveUp, &Plan::GiveUp);
    }

    #[test]
    fn giving_up_tells_the_ways() {
        for target in Target::ALL {
            let failure = Toolchain::from_plan(Plan::GiveUp, target).unwrap_err();
            let failure = failure.to_string();
            let rustup = format!("rustup target add {}", target.name());
            assert!(failure.contains(&rustup), "{failure}");
            let debian = "apt-get install --no-install-recommends rustc-web";
            let is_packaged = target == Target::Freestanding;
            assert_eq!(failure.contains(debian), is_packaged, "{failure}");
        }
    }

    #[test]
    fn the_packaged_compiler_builds_std_only_where_it_must() {
        let from_source = Toolchain::from_packaged(&packaged(true));
        assert_eq!(from_source.arguments, ["-Zbuild-std=std,panic_abort"]);
        assert!(
            from_source
                .environment
                .contains(&("RUSTC_BOOTSTRAP", "1".into()))
        );
        let ready = Toolchain::from_packaged(&packaged(false));
        assert!(ready.arguments.is_empty());
        assert_eq!(
            ready.environment,
            [
                ("RUSTC", "/usr/bin/rustc".into()),
                (
                    "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER",
                    "/usr/bin/wasm-ld-22".into()
                ),
            ]
        );
    }

    #[test]
    fn the_newest_linker_is_found() {
        let bin = tempfile::tempdir().unwrap();
        assert_eq!(newest_wasm_ld(bin.path()), None);
        for name in ["wasm-ld-9", "wasm-ld-22", "wasm-ld-x", "lld-23"] {
            std::fs::write(bin.path().join(name), "").unwrap();
        }
        assert_eq!(
            newest_wasm_ld(bin.path()),
            Some(bin.path().join("wasm-ld-22"))
        );
        std::fs::write(bin.path().join("wasm-ld"), "").unwrap();
        assert_eq!(newest_wasm_ld(bin.path()), Some(bin.path().join("wasm-ld")));
    }

    #[test]
    fn a_compiler_that_is_not_there_has_no_sysroot() {
        let here = Path::new(".");
        assert_eq!(sysroot("/nonexistent/rustc".as_ref(), here), None);
        let empty = tempfile::tempdir().unwrap();
        assert_eq!(Packaged::probe(here, &[empty.path()]), None);
    }
}
