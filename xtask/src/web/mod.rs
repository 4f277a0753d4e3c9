//! `cargo xtask web`: builds the player of web pages, or says what of it is stale.
//!
//! The player is a script, its style sheet, and the core as WebAssembly. The result is in
//! `host/web/prebuilt`, so that nobody needs Node to build wasmouse. `project` installs what the
//! script is built and tested with, `core` compiles the core, and `browser` runs the tests.

mod browser;
mod core;
mod project;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::sources::{files_sha256, sha256};
use project::Project;

pub use browser::{REQUIRED_VARIABLE, test};

/// `host/web/prebuilt/manifest.toml`.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    /// The hash of what script and style sheet are made of.
    script_sources_sha256: String,
    /// The hash of what the core is made of.
    core_sources_sha256: String,
    /// The compiler of the core.
    toolchain: String,
    #[serde(rename = "file")]
    files: Vec<Entry>,
}

/// A built file.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    /// Unit: bytes.
    size_bytes: usize,
    /// SHA-256, lowercase hexadecimal.
    sha256: String,
}

const CORE: &str = "core.wasm";

const SCRIPT: [&str; 2] = ["player.css", "player.js"];

/// Files and folders of which script and style sheet are built.
const SCRIPT_SOURCES: [&str; 4] = [
    "host/web/build.mjs",
    "host/web/package.json",
    "host/web/package-lock.json",
    "host/web/src",
];

/// Those of which the core is built. What the profile says is in the manifest of the workspace,
/// which changes for other reasons, too; rebuilding compares the bytes.
const CORE_SOURCES: [&str; 4] = [
    "host/core/Cargo.toml",
    "host/core/src",
    "host/web/core/Cargo.toml",
    "host/web/core/src",
];

/// Builds everything and writes the manifest.
///
/// # Errors
///
/// A line that says what failed.
pub fn rebuild(root: &Path) -> Result<(), String> {
    let folder = prebuilt(root);
    fs::create_dir_all(&folder).map_err(text)?;
    Project::install(root)?.build(&folder)?;
    core::build(root, &folder.join(CORE))?;
    let manifest = describe(root, core::toolchain()?).map_err(text)?;
    let body = toml::to_string(&manifest).expect("plain data has a TOML form");
    let body = format!(
        "# Written by `cargo xtask web`, like the files beside it; see CONTRIBUTING.md.\n{body}"
    );
    fs::write(manifest_path(root), body).map_err(text)
}

/// Says on stdout whether the built files are those of the sources.
///
/// # Errors
///
/// When they are not.
pub fn check(root: &Path) -> Result<(), String> {
    let problems = problems(root).map_err(text)?;
    if problems.is_empty() {
        println!("the player of web pages is that of the sources");
        return Ok(());
    }
    for problem in &problems {
        println!("{problem}");
    }
    Err("the player of web pages is stale; run `cargo xtask web`".to_owned())
}

/// What does not fit between the sources, the manifest and the built files: one line each.
///
/// # Errors
///
/// When the manifest or a source cannot be read.
pub fn problems(root: &Path) -> io::Result<Vec<String>> {
    let listed = load(root)?;
    let found = describe(root, listed.toolchain.clone())?;
    let mut problems = Vec::new();
    if listed.script_sources_sha256 != found.script_sources_sha256 {
        problems.push("web: the sources of the script have changed".to_owned());
    }
    if listed.core_sources_sha256 != found.core_sources_sha256 {
        problems.push("web: the sources of the core have changed".to_owned());
    }
    for entry in &found.files {
        if !listed.files.contains(entry) {
            problems.push(format!("web: `{}` is another file", entry.name));
        }
    }
    Ok(problems)
}

/// Checks, and builds again what can be built here: the bytes have to be those that are there.
/// Says on stderr what cannot.
///
/// # Errors
///
/// When the files are stale, or other bytes were built.
pub fn verify(root: &Path) -> Result<(), String> {
    eprintln!("==> web");
    check(root)?;
    let folder = project::folder(root).join("built");
    fs::create_dir_all(&folder).map_err(text)?;
    match Project::install(root) {
        Ok(project) => {
            project.check_types()?;
            project.build(&folder)?;
            for name in SCRIPT {
                compare(root, &folder, name)?;
            }
        }
        Err(reason) => eprintln!("skipped building the script of web pages: {reason}"),
    }
    let built_with = load(root).map_err(text)?.toolchain;
    match core::toolchain() {
        Ok(toolchain) if toolchain == built_with => {
            core::build(root, &folder.join(CORE))?;
            compare(root, &folder, CORE)
        }
        Ok(toolchain) => {
            eprintln!("skipped building the core of web pages: {toolchain} is not {built_with}");
            Ok(())
        }
        Err(reason) => {
            eprintln!("skipped building the core of web pages: {reason}");
            Ok(())
        }
    }
}

fn compare(root: &Path, folder: &Path, name: &str) -> Result<(), String> {
    let built = fs::read(folder.join(name)).map_err(text)?;
    let kept = fs::read(prebuilt(root).join(name)).map_err(text)?;
    if built == kept {
        return Ok(());
    }
    let folder = folder.display();
    Err(format!(
        "`{name}` of web pages was built to other bytes, in `{folder}`; run `cargo xtask web`"
    ))
}

fn load(root: &Path) -> io::Result<Manifest> {
    let text = fs::read_to_string(manifest_path(root))?;
    toml::from_str(&text).map_err(io::Error::other)
}

fn describe(root: &Path, toolchain: String) -> io::Result<Manifest> {
    let entry = |name: &str| {
        let bytes = fs::read(prebuilt(root).join(name))?;
        Ok(Entry {
            name: name.to_owned(),
            size_bytes: bytes.len(),
            sha256: sha256(&bytes),
        })
    };
    let files: io::Result<_> = [CORE].into_iter().chain(SCRIPT).map(entry).collect();
    Ok(Manifest {
        script_sources_sha256: files_sha256(root, &SCRIPT_SOURCES.map(Path::new))?,
        core_sources_sha256: files_sha256(root, &CORE_SOURCES.map(Path::new))?,
        toolchain,
        files: files?,
    })
}

fn prebuilt(root: &Path) -> PathBuf {
    root.join("host/web/prebuilt")
}

fn manifest_path(root: &Path) -> PathBuf {
    prebuilt(root).join("manifest.toml")
}

fn text(error: io::Error) -> String {
    error.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A repository that is just large enough.
    fn repository() -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        for file in SCRIPT_SOURCES.iter().chain(&CORE_SOURCES) {
            match Path::new(file).extension() {
                Some(_) => write(file, "source"),
                None => write(&format!("{file}/file"), "source"),
            }
        }
        for name in [CORE].iter().chain(&SCRIPT) {
            write(&format!("host/web/prebuilt/{name}"), name);
        }
        let manifest = describe(root.path(), "rustc 1.2.3".to_owned()).unwrap();
        write(
            "host/web/prebuilt/manifest.toml",
            &toml::to_string(&manifest).unwrap(),
        );
        root
    }

    #[test]
    fn what_is_current_has_no_problems() {
        let root = repository();
        assert_eq!(problems(root.path()).unwrap(), [""; 0]);
        assert_eq!(load(root.path()).unwrap().toolchain, "rustc 1.2.3");
    }

    #[test]
    fn what_is_stale_is_named() {
        for (file, problem) in [
            (
                "host/web/src/file",
                "web: the sources of the script have changed",
            ),
            (
                "host/core/src/file",
                "web: the sources of the core have changed",
            ),
            (
                "host/web/prebuilt/player.js",
                "web: `player.js` is another file",
            ),
        ] {
            let root = repository();
            fs::write(root.path().join(file), "changed").unwrap();
            assert_eq!(problems(root.path()).unwrap(), [problem]);
        }
    }

    #[test]
    fn other_bytes_are_an_error() {
        let root = repository();
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(CORE), CORE).unwrap();
        assert_eq!(compare(root.path(), folder.path(), CORE), Ok(()));
        fs::write(folder.path().join(CORE), "other").unwrap();
        let error = compare(root.path(), folder.path(), CORE).unwrap_err();
        assert!(error.contains("other bytes"), "{error}");
    }
}
