//! [`Target`]: what a robot in Rust is compiled for.
//!
//! It is what the manifest says (`target` in `[package.metadata.wasmouse]`), which leaves `cargo
//! test` alone. Otherwise it is the target that cargo would take without `--target`, if robots can be
//! built for it: `CARGO_BUILD_TARGET`, or `build.target` in the nearest `.cargo/config.toml`. Whoever
//! has set a target of an operating system there has set it for other programs, and robots are
//! built for the usual one.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use super::cargo_home::cargo_home;
use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// A target of robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// `wasm32-unknown-unknown`: without WASI, so nothing of it can be imported.
    #[default]
    Freestanding,
    /// `wasm32-wasip1`: a core module that imports preview 1.
    Preview1,
    /// `wasm32-wasip2`: a component that imports preview 2.
    Preview2,
}

/// The manifest of a project.
pub const MANIFEST: &str = "Cargo.toml";

/// The variable that takes precedence over configuration files.
const VARIABLE: &str = "CARGO_BUILD_TARGET";

impl Target {
    /// All of them, the usual one first.
    pub const ALL: [Self; 3] = [Self::Freestanding, Self::Preview1, Self::Preview2];

    /// What cargo and rustup call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Freestanding => "wasm32-unknown-unknown",
            Self::Preview1 => "wasm32-wasip1",
            Self::Preview2 => "wasm32-wasip2",
        }
    }

    /// The target of a project.
    ///
    /// # Errors
    ///
    /// When it is one for WebAssembly that robots cannot be built for, or a configuration file of
    /// cargo cannot be read.
    pub fn of(folder: &Path) -> Result<Self, Failure> {
        let manifest = folder.join(MANIFEST);
        if let Some(name) = fs::read_to_string(&manifest)
            .ok()
            .and_then(|it| chosen(&it))
        {
            let known = Self::ALL.into_iter().find(|it| it.name() == name);
            let place = text!("`{}`", Text::of_path(&manifest));
            return known.ok_or_else(|| not_for_robots(&place, &name));
        }
        if let Some(names) = env::var_os(VARIABLE) {
            let place = text!("the variable {}", VARIABLE);
            return Self::among(&[names.to_string_lossy().into_owned()], &place);
        }
        for file in configuration_files(folder) {
            let Ok(text) = fs::read_to_string(&file) else {
                continue;
            };
            let place = text!("`{}`", Text::of_path(&file));
            let names = names(&text).map_err(|error| {
                Failure::input(text!(
                    "failed to parse {}: {}",
                    place,
                    Text::of_lines(&error.to_string())
                ))
                .hint("it is a configuration of cargo, which says what robots are built for")
            })?;
            if let Some(names) = names {
                return Self::among(&names, &place);
            }
        }
        Ok(Self::default())
    }

    /// The first of some targets that robots are built for.
    fn among(names: &[String], place: &Text) -> Result<Self, Failure> {
        let known = |name: &String| Self::ALL.into_iter().find(|it| it.name() == name);
        if let Some(target) = names.iter().find_map(known) {
            return Ok(target);
        }
        match names.iter().find(|it| it.starts_with("wasm")) {
            None => Ok(Self::default()),
            Some(other) => Err(not_for_robots(place, other)),
        }
    }
}

fn not_for_robots(place: &Text, target: &str) -> Failure {
    Failure::input(text!(
        "{} chooses the target {}, which robots are not built for",
        place,
        target
    ))
    .hint(
        "robots are built for wasm32-unknown-unknown, or for wasm32-wasip1 or wasm32-wasip2, where \
         the standard library prints into the journal",
    )
}

/// The target that a manifest chooses. One that does not parse chooses none: cargo says why.
fn chosen(manifest: &str) -> Option<String> {
    let file: toml::Table = toml::from_str(manifest).ok()?;
    let metadata = file.get("package")?.get("metadata")?;
    let target = metadata.get("wasmouse")?.get("target")?;
    target.as_str().map(str::to_owned)
}

/// The targets that a configuration file of cargo chooses.
fn names(text: &str) -> Result<Option<Vec<String>>, toml::de::Error> {
    let file: toml::Table = toml::from_str(text)?;
    let target = file.get("build").and_then(|it| it.get("target"));
    Ok(target.map(|target| {
        let all = match target {
            toml::Value::Array(all) => all.as_slice(),
            one => std::slice::from_ref(one),
        };
        let name = |it: &toml::Value| it.as_str().map(str::to_owned);
        all.iter().filter_map(name).collect()
    }))
}

/// The files that cargo reads its configuration from, the one with the highest precedence first.
fn configuration_files(folder: &Path) -> Vec<PathBuf> {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let in_project = folder.ancestors().map(|it| it.join(".cargo"));
    in_project
        .chain(cargo_home())
        .flat_map(|it| [it.join("config"), it.join("config.toml")])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(configuration: &str, expected: Result<Target, &str>) {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("robots/bot");
        fs::create_dir_all(folder.path().join(".cargo")).unwrap();
        fs::create_dir_all(inner.join(".cargo")).unwrap();
        fs::write(folder.path().join(".cargo/config.toml"), configuration).unwrap();
        fs::write(inner.join(".cargo/config.toml"), "[net]\noffline = true\n").unwrap();
        match (Target::of(&inner), expected) {
            (Ok(target), Ok(expected)) => assert_eq!(target, expected),
            (Err(failure), Err(expected)) => {
                let failure = failure.to_string();
                assert!(failure.contains(expected), "{failure}");
            }
            (found, _) => panic!("{configuration}: {:?}", found.map_err(|it| it.to_string())),
        }
    }

    #[test]
    fn the_target_is_that_of_cargo() {
        if env::var_os(VARIABLE).is_some() {
            return;
        }
        for target in Target::ALL {
            let name = target.name();
            check(&format!("[build]\ntarget = \"{name}\"\n"), Ok(target));
            check(
                &format!("[build]\ntarget = [\"x86_64-unknown-linux-gnu\", \"{name}\"]\n"),
                Ok(target),
            );
        }
        let native = "[build]\ntarget = \"x86_64-unknown-linux-musl\"\n";
        check(native, Ok(Target::Freestanding));
        check("[build]\n", Ok(Target::Freestanding));
    }

    #[test]
    fn the_manifest_comes_first() {
        let folder = tempfile::tempdir().unwrap();
        let check = |target: &str| {
            let manifest = format!("[package.metadata.wasmouse]\ntarget = \"{target}\"\n");
            fs::write(folder.path().join(MANIFEST), manifest).unwrap();
            Target::of(folder.path())
        };
        for target in Target::ALL {
            assert_eq!(check(target.name()).ok(), Some(target));
        }
        let failure = check("x86_64-unknown-linux-gnu").unwrap_err().to_string();
        assert!(failure.contains("robots are not built for"), "{failure}");
    }

    #[test]
    fn other_targets_for_webassembly_are_rejected() {
        for name in [
            "wasm32-wasi",
            "wasm32-wasip3",
            "wasm32-unknown-emscripten",
            "wasm64-unknown-unknown",
        ] {
            let expected = format!("chooses the target {name}, which robots are not built for");
            check(&format!("build.target = \"{name}\"\n"), Err(&expected));
        }
        check("[build\n", Err("failed to parse"));
    }
}
