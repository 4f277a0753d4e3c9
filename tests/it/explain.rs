//! What people see of a robot that fails: what it wrote itself, a match step by step, and where it
//! was in its code.

use std::fs;
use std::path::{Path, PathBuf};

use insta::{Settings, assert_snapshot};
use tempfile::TempDir;
use wasmouse_tests::binary::{Ran, ran, wasmouse};
use wasmouse_tests::module::{IMPORT_LOG, Module};

/// A robot that drives on, writes a traceback in its fourth step as Python does, and traps.
fn failing() -> Vec<u8> {
    Module {
        imports: IMPORT_LOG,
        rest: r#"(global $step (mut i32) (i32.const 0))
            (data (i32.const 32) "Traceback (most recent call last):")
            (data (i32.const 66) "  File \"app.py\", line 8, in plan")
            (data (i32.const 98) "ValueError: \1b[31mboom")
            (func $plan
                (call $log (i32.const 3) (i32.const 32) (i32.const 34))
                (call $log (i32.const 3) (i32.const 66) (i32.const 32))
                (call $log (i32.const 3) (i32.const 98) (i32.const 21))
                unreachable)"#,
        next: "(global.set $step (i32.add (global.get $step) (i32.const 1)))
            (call $log (i32.const 1) (i32.const 98) (i32.const 10))
            (if (i32.eq (global.get $step) (i32.const 4)) (then (call $plan)))
            i32.const 16",
        ..Module::default()
    }
    .component()
}

fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("failing.wasm"), failing()).expect("a file");
    folder
}

/// Runs a command line in that folder.
fn run(folder: &TempDir, arguments: &str) -> Ran {
    let mut command = wasmouse();
    command
        .args(arguments.split_whitespace())
        .current_dir(folder.path())
        .env("WASMOUSE_CACHE", folder.path().join("cache"));
    ran(&mut command)
}

#[track_caller]
fn check(name: &str, text: &str) {
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| assert_snapshot!(format!("explain-{name}"), text));
}

/// The same in the sandbox and in this process.
#[test]
fn a_match_is_explained_step_by_step() {
    let folder = folder();
    let line = "run failing.wasm test_maze_01 --ascii --explain";
    let sandboxed = run(&folder, line);
    assert_eq!(sandboxed.status.code(), Some(4));
    check(
        "failing",
        &format!("{}\n---\n{}", sandboxed.stdout, sandboxed.stderr),
    );
    let trusted = run(&folder, &format!("{line} --trust"));
    assert_eq!(trusted.stdout, sandboxed.stdout);
    let explanation = sandboxed.stdout.split_once("\n Step ").expect("steps").1;
    for line in explanation.lines().take_while(|it| !it.is_empty()) {
        assert!(line.chars().count() <= 80, "{line}");
    }

    let bundled = run(&folder, "run flood test_maze_01 --explain");
    assert_eq!(bundled.status.code(), Some(0), "{}", bundled.stderr);
    for part in ["\nstart ", "-- speed run --", "reset", "\nfuel: "] {
        assert!(bundled.stdout.contains(part), "{part}: {}", bundled.stdout);
    }
    let two = run(&folder, "run flood test_maze_01 tree-16 --explain");
    assert_eq!(two.status.code(), Some(2));
    assert!(
        two.stderr.contains("--explain is about one match"),
        "{}",
        two.stderr
    );
}

/// What the robot wrote names the fault, wherever faults are explained, and cannot control what it
/// is shown on.
#[test]
fn what_a_robot_wrote_goes_with_its_fault() {
    let folder = folder();
    let Ran { stderr, .. } = run(
        &folder,
        "run failing.wasm test_maze_01 --log --html page.html",
    );
    let first = "seed 0: ValueError: \\u{1b}[31mboom; executed `unreachable`";
    assert!(stderr.contains(first), "{stderr}");
    let quoted = "\n  | Traceback (most recent call last):\n  |   File \"app.py\", line 8, in plan\n  \
                  | ValueError: \\u{1b}[31mboom\n";
    assert!(stderr.contains(quoted), "{stderr}");
    let logged = "\n     4 fault   ValueError: \\u{1b}[31mboom; executed";
    assert!(stderr.contains(logged), "{stderr}");
    let page = fs::read_to_string(folder.path().join("page.html")).expect("a page");
    let pre = "<pre>Traceback (most recent call last):\n  File &quot;app.py&quot;, line 8, in plan\n\
               ValueError: \\u{1b}[31mboom\n</pre>";
    assert!(page.contains(pre), "{page}");
    assert!(!page.contains('\u{1b}') && !stderr.contains('\u{1b}'));

    // Records do not depend on it.
    let json = run(&folder, "run failing.wasm test_maze_01 --json").stdout;
    assert!(!json.contains("ValueError"), "{json}");
}

/// The files of a folder and what is in them.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let bytes = fs::read(&path).expect("a file");
        files.push((path, bytes));
    }
    files.sort();
    files
}

/// Only the code of a large robot is kept for backtraces; a damaged entry changes nothing.
#[test]
fn backtraces_of_large_robots_are_compiled_once() {
    let mut large = failing();
    // A custom section of 2 MiB: its length in LEB128, then a name of one byte.
    large.extend([0, 0x80, 0x80, 0x80, 0x01, 1, b'x']);
    large.resize(large.len() + (2 << 20) - 2, 0);
    let entries = |robot: &[u8]| {
        let folder = folder();
        fs::write(folder.path().join("failing.wasm"), robot).expect("a file");
        let first = run(&folder, "run failing.wasm test_maze_01").stderr;
        assert!(first.contains(": plan at offset"), "{first}");
        let cache = folder.path().join("cache");
        let kept = files(&cache);
        assert_eq!(run(&folder, "run failing.wasm test_maze_01").stderr, first);
        assert!(files(&cache) == kept, "nothing was compiled again");
        for (path, mut bytes) in kept.clone() {
            if let Some(last) = bytes.last_mut() {
                *last ^= 1;
            }
            fs::write(path, bytes).expect("a file");
        }
        assert_eq!(run(&folder, "run failing.wasm test_maze_01").stderr, first);
        kept.len()
    };
    assert_eq!(entries(&large), entries(&failing()) + 1);
}
