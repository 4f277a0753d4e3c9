//! `cargo xtask wasi`: builds what keeps WASI inside robots, or says what of it is stale.
//!
//! The builder is a program of the tests, because it has dependencies that this crate must
//! not have.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::sources::{files_sha256, sha256};
use crate::step::Step;

/// `host/engine/wasi/prebuilt/manifest.toml`.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    /// The hash of everything that the files are made of.
    sources_sha256: String,
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

/// What is built.
const FILES: [&str; 3] = ["adapter.wasm", "preview1.wasm", "preview2.wasm"];

/// Builds everything and writes the manifest.
///
/// # Errors
///
/// A line that says what failed.
pub fn rebuild(root: &Path) -> Result<(), String> {
    Step::cargo("wasi", root)
        .args(["run", "--package", "wasmouse-tests", "--bin", "wasi"])
        .run()?;
    Step::new("format the generated source", root, "rustfmt")
        .args(["--edition", "2024", GENERATED])
        .run()?;
    let manifest = describe(root).map_err(|error| error.to_string())?;
    let body = toml::to_string(&manifest).expect("plain data has a TOML form");
    let text = format!(
        "# Written by `cargo xtask wasi`, like the files beside it; see CONTRIBUTING.md.\n{body}"
    );
    fs::write(manifest_path(root), text).map_err(|error| error.to_string())
}

/// Says on stdout whether the built files are those of the sources.
///
/// # Errors
///
/// When they are not.
pub fn check(root: &Path) -> Result<(), String> {
    let problems = problems(root).map_err(|error| error.to_string())?;
    if problems.is_empty() {
        println!("the built files are those of the sources");
        return Ok(());
    }
    for problem in &problems {
        println!("{problem}");
    }
    Err("built files are stale; run `cargo xtask wasi`".to_owned())
}

/// What does not fit between the sources, the manifest and the built files: one line each.
///
/// # Errors
///
/// When the manifest or a source cannot be read.
pub fn problems(root: &Path) -> io::Result<Vec<String>> {
    let path = manifest_path(root);
    let text = fs::read_to_string(&path)?;
    let listed: Manifest = toml::from_str(&text).map_err(io::Error::other)?;
    let found = describe(root)?;
    let mut problems = Vec::new();
    if listed.sources_sha256 != found.sources_sha256 {
        problems.push("wasi: its sources have changed".to_owned());
    }
    for entry in &found.files {
        if !listed.files.contains(entry) {
            problems.push(format!("wasi: `{}` is another file", entry.name));
        }
    }
    Ok(problems)
}

fn describe(root: &Path) -> io::Result<Manifest> {
    let entry = |name: &str| {
        let bytes = fs::read(prebuilt(root).join(name))?;
        Ok(Entry {
            name: name.to_owned(),
            size_bytes: bytes.len(),
            sha256: sha256(&bytes),
        })
    };
    let files: io::Result<_> = FILES.into_iter().map(entry).collect();
    Ok(Manifest {
        sources_sha256: files_sha256(root, &SOURCES.map(Path::new))?,
        files: files?,
    })
}

/// A source that is generated from the WIT.
const GENERATED: &str = "host/engine/wasi/guest/src/missing.rs";

/// Files and folders from which everything is built.
const SOURCES: [&str; 9] = [
    "host/engine/wasi/guest",
    "host/engine/wasi/wit",
    "host/engine/wasi/preview1.wat",
    "host/engine/wasi/preview1-shell.wat",
    "host/engine/wasi/preview2-shell.wat",
    "host/engine/wasi/types.wat",
    "host/engine/wasi/journal.wat",
    "tests/src/wasi.rs",
    "wit/robot.wit",
];

fn prebuilt(root: &Path) -> PathBuf {
    root.join("host/engine/wasi/prebuilt")
}

fn manifest_path(root: &Path) -> PathBuf {
    prebuilt(root).join("manifest.toml")
}
