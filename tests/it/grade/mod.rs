//! `wasmouse grade`: rubrics, robots of every kind, and all formats, with the real binary.

mod bad_rubrics;
mod formats;
mod interrupted;
mod outcomes;
mod teacher;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use wasmouse_engine::bundled::find;

use crate::binary::wasmouse;
use crate::hostile::Module;

/// Six mazes, and a criterion of each kind that needs no file.
const RUBRIC: &str = r#"
version = 1
name = "Test"
pass_percent = 50

[[mazes]]
set = "official"
paths = ["test_maze_01"]

[[mazes]]
set = "generated"
paths = ["gen:tree:12:1..=6"]

[[criteria]]
name = "finishes"
points = 4
mazes = "official"
finished_percent = 100

[[criteria]]
name = "is fast"
points = 3
mean_score = 1
none = 100

[[criteria]]
name = "never fails"
points = 2
faults = 0

[[criteria]]
name = "keeps up"
points = 1
mazes = ["generated", "test_maze_01"]
no_worse_than = "dfs"
"#;

/// A folder with the rubric in it.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    write(folder.path(), "rubric.toml", RUBRIC);
    folder
}

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("in the folder")).expect("a folder");
    fs::write(&path, bytes).expect("a file");
    path
}

fn component(name: &str) -> &'static [u8] {
    find(name).expect("it is bundled").component
}

/// A robot that panics with these bytes, in the text format of WebAssembly.
fn panicking(message: &str, length: usize) -> Vec<u8> {
    let import = r#"(import "wasmouse:robot/journal@VERSION" "panic"
        (func $panic (param i32 i32)))"#;
    Module {
        imports: import,
        rest: &format!("(data (i32.const 100) \"{message}\")"),
        next: &format!("(call $panic (i32.const 100) (i32.const {length})) unreachable"),
        ..Module::default()
    }
    .component()
}

/// The command in a folder, with nothing of the user's environment.
fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = wasmouse();
    command
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env_clear()
        .env("HOME", folder.join("home"));
    command
}

fn json(path: &Path) -> Value {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
    serde_json::from_slice(&bytes).unwrap_or_else(|error| panic!("{path:?}: {error}"))
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
}
