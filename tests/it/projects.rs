//! Robot projects and result files, as a robot's author uses them.

use std::fs::{self, File};
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

use serde_json::Value;

use crate::binary::{Ran, ran, wasmouse};
use crate::hostile::{Module, wasm};

fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = wasmouse();
    command
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env("WASMOUSE_CACHE", folder.join("cache"))
        // The target folder of this repository may be in use by the cargo that runs this test.
        .env("CARGO_TARGET_DIR", folder.join("target"));
    command
}

/// Changes the time at which a file was last written.
fn written(path: &Path, at: SystemTime) {
    let file = File::options().append(true).open(path).expect("a file");
    file.set_modified(at).expect("its time can be set");
}

#[test]
fn a_project_is_built_and_played() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let Ran { status, stderr, .. } = ran(&mut command(folder, "new mouse"));
    assert!(status.success(), "{stderr}");
    let component = folder.join("mouse/mouse.wasm");
    assert!(!component.exists(), "`new` builds nothing");
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command(folder, "run mouse test_maze_01"));
    assert!(status.success(), "{stdout}{stderr}");
    assert!(
        stdout.contains("mouse ") && stdout.contains("finished"),
        "{stdout}"
    );
    assert!(component.is_file(), "the component is beside its sources");

    // A component that is as new as its sources is played without a word about it.
    let play = "run mouse/mouse.wasm test_maze_01";
    let Ran { stderr, .. } = ran(&mut command(folder, play));
    assert!(!stderr.contains("warning"), "{stderr}");
    let later = SystemTime::now() + Duration::from_secs(60);
    written(&folder.join("mouse/src/lib.rs"), later);
    let Ran { status, stderr, .. } = ran(&mut command(folder, play));
    assert!(status.success(), "{stderr}");
    let warning = "warning: `mouse/mouse.wasm` is older than `mouse/src/lib.rs`";
    assert!(stderr.contains(warning), "{stderr}");
    assert!(stderr.contains("wasmouse build mouse"), "{stderr}");
}

#[test]
fn a_build_shows_what_a_match_costs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("bot.wasm"), wasm(&Module::default().wat())).expect("a file");
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command(folder, "build bot.wasm"));
    assert!(status.success(), "{stdout}{stderr}");
    for part in [
        "bot.component.wasm\n  size     ",
        " bytes (limit 33,554,432)\n  imports  nothing\n",
        "\n  match    test_maze_01: ",
        "\n  match    gen:division:20:1: ",
        "\n  fuel     start ",
        "\n  class    compiled: 1,000 such steps take ",
    ] {
        assert!(stdout.contains(part), "{part}: {stdout}");
    }
    let Ran { stdout, .. } = ran(&mut command(folder, "build bot.wasm --no-match"));
    assert!(!stdout.contains("match"), "{stdout}");
}

#[test]
fn a_build_that_watches_builds_again_until_it_is_interrupted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let module = folder.join("bot.wasm");
    fs::write(&module, "nothing").expect("a file");
    let mut build = command(folder, "build bot.wasm --watch --no-match");
    let mut child = build
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("wasmouse can be started");
    let stderr = child.stderr.take().expect("stderr is piped");
    let mut lines = BufReader::new(stderr).lines().map(|it| it.expect("a line"));
    // What does not compile is reported, and not the end.
    let report: Vec<String> = lines
        .by_ref()
        .take_while(|it| !it.contains("Ctrl-C"))
        .collect();
    assert!(report.concat().contains("error: "), "{report:?}");
    fs::write(&module, wasm(&Module::default().wat())).expect("a file");
    let report: Vec<String> = lines
        .by_ref()
        .take_while(|it| !it.contains("Ctrl-C"))
        .collect();
    assert!(report.is_empty(), "{report:?}");
    assert!(folder.join("bot.component.wasm").is_file());
    #[cfg(unix)]
    {
        wasmouse_tests::program::signal(child.id(), "INT");
        let status = child.wait().expect("it ends");
        assert_eq!(status.code(), Some(130));
    }
    #[cfg(not(unix))]
    child.kill().expect("it runs");
}

#[test]
fn a_file_of_json_lines_has_a_match_in_each_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let play = "run flood dfs gen:tree:12:1..=6 --html page.html --json --force -o";
    let (lines, whole) = (format!("{play} all.jsonl"), format!("{play} all.json"));
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command(folder, &lines));
    assert!(status.success(), "{stderr}");
    assert_eq!(
        ran(&mut command(folder, &whole)).stdout,
        stdout,
        "--json stays as it is"
    );
    let file = fs::read_to_string(folder.join("all.json")).expect("results");
    assert_eq!(file, stdout, "-o has what --json prints");
    let results: Value = serde_json::from_str(&file).expect("JSON");
    let lines = fs::read_to_string(folder.join("all.jsonl")).expect("results");
    let lines: Vec<Value> = lines
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let matches = results["matches"].as_array().expect("matches");
    assert_eq!(matches.len(), 12);
    for entry in matches {
        assert!(lines.contains(entry), "{entry}");
    }
    assert!(folder.join("page.html").is_file());
}

/// An existing file is replaced only when its replacement is complete.
#[test]
fn a_failed_contest_keeps_the_old_results() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for name in ["old.json", "old.jsonl", "old.html"] {
        fs::write(folder.join(name), "precious").expect("a file");
    }
    let Ran { status, .. } = ran(&mut command(
        folder,
        "run flood missing.txt -o old.json --html old.html --force",
    ));
    assert_eq!(status.code(), Some(3));
    // Without --force, what is there stays.
    for arguments in ["-o old.json", "-o old.jsonl", "--html old.html"] {
        let line = format!("run flood test_maze_01 {arguments}");
        let Ran { status, stderr, .. } = ran(&mut command(folder, &line));
        assert!(!status.success(), "{line}");
        assert!(stderr.contains("--force"), "{stderr}");
    }
    for name in ["old.json", "old.jsonl", "old.html"] {
        let kept = fs::read_to_string(folder.join(name)).expect("a file");
        assert_eq!(kept, "precious", "{name}");
    }
    let line = "run flood test_maze_01 -o old.json --html old.html --force";
    assert!(ran(&mut command(folder, line)).status.success());
    assert!(
        fs::read_to_string(folder.join("old.json"))
            .expect("a file")
            .starts_with('{')
    );
    let left: Vec<_> = fs::read_dir(folder).expect("a folder").flatten().collect();
    assert_eq!(
        left.len(),
        4,
        "no temporary file is left, only the cache: {left:?}"
    );
}

#[test]
fn a_contest_that_nobody_finishes_has_its_own_exit_code() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let robot = Module::default().component();
    fs::write(folder.join("ahead.wasm"), robot).expect("a file");
    let code = |line: &str| ran(&mut command(folder, line)).status.code();
    assert_eq!(code("run ahead.wasm test_maze_01"), Some(6));
    assert_eq!(code("run ahead.wasm flood test_maze_01"), Some(0));
}
