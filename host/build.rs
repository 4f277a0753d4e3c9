//! Collects what `wasmouse new` puts into a project: the SDK and the WIT for Rust, and the
//! example robot of every other language.
//!
//! The SDK is not on crates.io, so a new project gets a copy, and a copy cannot
//! refer to this workspace: its manifest is written out in full here.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The folder with an example robot for each language but Rust.
const LANGUAGES: &str = "example-robots/languages";

/// The folder in there that is no example robot: the components of those that are small.
const PREBUILT: &str = "prebuilt";

/// What is left in an example robot's folder by building it, and is no part of a new project.
const BUILT: [&str; 9] = [
    "node_modules",
    ".venv",
    "__pycache__",
    ".zig-cache",
    "zig-out",
    "zig-pkg",
    "build",
    "target",
    "dist",
];

fn main() {
    let host = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let root = host.parent().expect("host is a folder in the repository");
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    for input in ["Cargo.toml", "guest-sdk", "wit/robot.wit", LANGUAGES] {
        println!("cargo::rerun-if-changed={}", root.join(input).display());
    }

    let manifest = output.join("sdk-Cargo.toml");
    fs::write(&manifest, standalone_manifest(root)).expect("the output folder is writable");
    let mut files = vec![("wasmouse-sdk/Cargo.toml".to_owned(), manifest)];
    collect(&root.join("guest-sdk/src"), "wasmouse-sdk/src", &mut files);
    files.push(("wit/robot.wit".to_owned(), root.join("wit/robot.wit")));
    files.sort();

    fs::write(output.join("vendor.rs"), table(&files)).expect("the output folder is writable");
    let languages = languages(&root.join(LANGUAGES));
    fs::write(output.join("languages.rs"), languages).expect("the output folder is writable");
}

/// The files as an expression of Rust: a slice of names and contents.
fn table(files: &[(String, PathBuf)]) -> String {
    let mut table = "&[\n".to_owned();
    for (name, path) in files {
        writeln!(table, "    ({name:?}, include_str!({path:?})),").expect("writing to a string");
    }
    table.push_str("]\n");
    table
}

/// The example robots as an expression of Rust: a slice of languages and their files.
fn languages(folder: &Path) -> String {
    let entries = fs::read_dir(folder).expect("a folder of the repository");
    let mut folders: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.is_dir() && !path.ends_with(PREBUILT))
        .collect();
    folders.sort();
    let mut table_of_tables = "&[\n".to_owned();
    for folder in folders {
        let language = folder.file_name().expect("an entry has a name");
        let language = language.to_string_lossy();
        let mut files = Vec::new();
        collect(&folder, "", &mut files);
        files.retain(|(name, _)| Path::new(name).extension().is_none_or(|it| it != "wasm"));
        files.sort();
        let files = table(&files);
        writeln!(table_of_tables, "({language:?}, {files}),").expect("writing to a string");
    }
    table_of_tables.push_str("]\n");
    table_of_tables
}

/// All files below `folder` that are not the result of a build, under the name that they get in a
/// project.
fn collect(folder: &Path, name: &str, files: &mut Vec<(String, PathBuf)>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("a readable folder").path();
        let file_name = path.file_name().expect("an entry has a name");
        let file_name = file_name.to_string_lossy();
        let name = match name {
            "" => file_name.to_string(),
            folder => format!("{folder}/{file_name}"),
        };
        if path.is_dir() {
            if !BUILT.contains(&&*file_name) {
                collect(&path, &name, files);
            }
        } else {
            files.push((name, path));
        }
    }
}

/// The SDK's manifest with the workspace's values in place of `KEY.workspace`.
fn standalone_manifest(root: &Path) -> String {
    let read =
        |path: &str| fs::read_to_string(root.join(path)).expect("a manifest of the repository");
    let workspace = read("Cargo.toml");
    let sdk = read("guest-sdk/Cargo.toml");
    let mut section = "";
    let mut lines = Vec::new();
    for line in sdk.lines() {
        if line.starts_with('[') {
            section = line.trim_matches(['[', ']']);
        }
        match line.strip_suffix(".workspace = true") {
            // The lints of the workspace are for those who change the SDK.
            _ if section == "lints" => {}
            Some(key) => lines.push(workspace_value(&workspace, section, key)),
            None => lines.push(line),
        }
    }
    lines.join("\n").trim_end().to_owned() + "\n"
}

/// The line `KEY = ...` of `[workspace.SECTION]`.
fn workspace_value<'a>(workspace: &'a str, section: &str, key: &str) -> &'a str {
    let header = format!("[workspace.{section}]");
    workspace
        .lines()
        .skip_while(|line| *line != header)
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .find(|line| {
            line.strip_prefix(key)
                .is_some_and(|rest| rest.starts_with(" = "))
        })
        .unwrap_or_else(|| panic!("the workspace's Cargo.toml has no `{key}` under {header}"))
}
