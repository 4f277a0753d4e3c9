//! Collects what `wasmouse new` puts into a project: the SDK and the WIT.
//!
//! The SDK is not on crates.io, so a new project gets a copy, and a copy cannot
//! refer to this workspace: its manifest is written out in full here.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let host = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let root = host.parent().expect("host is a folder in the repository");
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    for input in ["Cargo.toml", "guest-sdk", "wit/robot.wit"] {
        println!("cargo::rerun-if-changed={}", root.join(input).display());
    }

    let manifest = output.join("sdk-Cargo.toml");
    fs::write(&manifest, standalone_manifest(root)).expect("the output folder is writable");
    let mut files = vec![("wasmouse-sdk/Cargo.toml".to_owned(), manifest)];
    collect(&root.join("guest-sdk/src"), "wasmouse-sdk/src", &mut files);
    files.push(("wit/robot.wit".to_owned(), root.join("wit/robot.wit")));
    files.sort();

    let mut table = "&[\n".to_owned();
    for (name, path) in &files {
        writeln!(table, "    ({name:?}, include_str!({path:?})),").expect("writing to a string");
    }
    table.push_str("]\n");
    fs::write(output.join("vendor.rs"), table).expect("the output folder is writable");
}

/// All files below `folder`, under the name that they get in a project.
fn collect(folder: &Path, name: &str, files: &mut Vec<(String, PathBuf)>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("a readable folder").path();
        let file_name = path.file_name().expect("an entry has a name");
        let name = format!("{name}/{}", file_name.to_string_lossy());
        if path.is_dir() {
            collect(&path, &name, files);
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
