//! Standard output and standard error in unusual states: closed, full, a terminal.

#[cfg(target_os = "linux")]
use std::fs::File;
#[cfg(target_os = "linux")]
use std::process::Command;
use std::process::Stdio;

#[cfg(target_os = "linux")]
use crate::binary::path;
use crate::binary::wasmouse;

/// Commands that print more than a pipe holds, and some that print little.
const PRINTING: [&[&str]; 8] = [
    &[
        "run",
        "flood",
        "gen:tree:12:1..=200",
        "--json",
        "--no-cache",
    ],
    &["run", "flood", "test_maze_01", "--no-cache"],
    &["robots"],
    &["inspect", "flood", "--no-cache"],
    &["maze", "show", "test_maze_01"],
    &["man"],
    &["completions", "bash"],
    &["run", "--help"],
];

#[test]
fn a_closed_pipe_is_quiet_and_no_success() {
    for arguments in PRINTING {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = wasmouse()
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(writer)
            .output()
            .expect("the program runs");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            (output.status.code(), &*stderr),
            (Some(141), ""),
            "{arguments:?}"
        );
    }
}

/// A file that is not a robot.
const NO_ROBOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");

#[test]
fn messages_may_be_lost() {
    // Unknown mazes and rejected robots are reported on standard error.
    for (arguments, code) in [
        (&["maze", "show", "missing"][..], 3),
        (&["run", "flood", "--seed", "-1"], 2),
        (
            &[
                "run",
                "--robot",
                NO_ROBOT,
                "-m",
                "test_maze_01",
                "--no-cache",
            ],
            4,
        ),
    ] {
        let mut child = wasmouse()
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(child.stderr.take());
        let status = child.wait().expect("the program ends");
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

/// What cannot be printed is not lost without a word, and files are written all the same.
#[cfg(target_os = "linux")]
#[test]
fn results_files_are_complete_without_standard_output() {
    let shell = |script: &str| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let output = Command::new("bash")
            .args(["-c", script])
            .current_dir(folder.path())
            .env("WASMOUSE", path())
            .stdin(Stdio::null())
            .output()
            .expect("there is bash");
        let stderr = String::from_utf8(output.stderr).expect("text");
        let json = std::fs::read_to_string(folder.path().join("a.json"));
        let html = std::fs::read_to_string(folder.path().join("a.html"));
        (output.status.code(), stderr, json.ok(), html.ok())
    };
    let run = "$WASMOUSE run flood dfs gen:tree:12:1..=20 --no-cache -o a.json --html a.html";
    let (code, _, expected_json, expected_html) = shell(run);
    assert_eq!(code, Some(0));
    assert!(expected_json.is_some() && expected_html.is_some());
    let pipe = "| head -1; exit ${PIPESTATUS[0]}";
    for (json, redirection, code, message) in [
        (
            "",
            ">&-",
            5,
            "error: failed to write to standard output: it is closed",
        ),
        (
            "--json",
            ">&-",
            5,
            "error: failed to write to standard output: it is closed",
        ),
        (
            "",
            ">/dev/full",
            5,
            "error: failed to write to standard output: No space left",
        ),
        (
            "--json",
            ">/dev/full",
            5,
            "error: failed to write to standard output: No space left",
        ),
        ("--json", pipe, 141, ""),
    ] {
        let found = shell(&format!("{run} {json} {redirection}"));
        let what = format!("{json} {redirection}: {}", found.1);
        assert_eq!(found.0, Some(code), "{what}");
        assert!(found.1.contains(message), "{what}");
        assert_eq!(found.1.contains("error"), code == 5, "{what}");
        assert!(found.2 == expected_json, "{what}");
        assert!(found.3 == expected_html, "{what}");
    }
    // A reader that reads everything is no failure.
    assert_eq!(
        shell(&format!("{run} | cat; exit ${{PIPESTATUS[0]}}")).0,
        Some(0)
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_internal_error() {
    let full = || {
        File::options()
            .write(true)
            .open("/dev/full")
            .expect("Linux has it")
    };
    for arguments in PRINTING {
        let output = wasmouse()
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(full())
            .output()
            .expect("the program runs");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(5), "{arguments:?}: {stderr}");
        let reported = stderr.starts_with("error: failed to write to standard output: ");
        assert!(reported, "{arguments:?}: {stderr}");
    }
    // And when that cannot be reported either.
    let status = wasmouse()
        .args(["robots"])
        .stdout(full())
        .stderr(full())
        .status()
        .expect("the program runs");
    assert_eq!(status.code(), Some(5));
}

/// Runs a command line on a terminal of its own and returns what it shows there;
/// `None` where `script` is missing.
#[cfg(target_os = "linux")]
fn on_a_terminal(arguments: &str, variables: &[(&str, &str)]) -> Option<String> {
    let line = format!("'{}' {arguments}", path().display());
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &line, "/dev/null"])
        .stdin(Stdio::null())
        .env_remove("NO_COLOR")
        .env("TERM", "xterm-256color")
        .envs(variables.iter().copied())
        .output();
    let Ok(output) = output else {
        println!("skipped: there is no `script` that makes a terminal");
        return None;
    };
    assert!(output.status.success(), "{arguments}: {output:?}");
    Some(String::from_utf8(output.stdout).expect("text"))
}

#[cfg(target_os = "linux")]
#[test]
fn colour_is_for_terminals_that_want_it() {
    const SHOW: &str = "maze show test_maze_01 --path steps";
    let Some(coloured) = on_a_terminal(SHOW, &[]) else {
        return;
    };
    assert!(coloured.contains("\u{1b}["), "{coloured}");
    for variable in [("NO_COLOR", "1"), ("TERM", "dumb")] {
        let plain = on_a_terminal(SHOW, &[variable]).expect("there is `script`");
        assert!(!plain.contains('\u{1b}'), "{variable:?}: {plain}");
        assert!(plain.contains('─'), "{plain}");
    }
    // An empty NO_COLOR does not count.
    let coloured = on_a_terminal(SHOW, &[("NO_COLOR", "")]).expect("there is `script`");
    assert!(coloured.contains("\u{1b}["), "{coloured}");
}
