//! The README: its tutorial and its examples are run as they stand there.

use std::env;
use std::path::Path;
use std::process::Command;

use crate::binary;

const README: &str = include_str!("../../README.md");

/// The shell blocks of the README with this word behind `sh`.
fn blocks(kind: &str) -> Vec<&'static str> {
    blocks_of(README, kind)
}

fn blocks_of(text: &'static str, kind: &str) -> Vec<&'static str> {
    let opening = format!("```sh {kind}\n");
    text.split(&opening)
        .skip(1)
        .map(|rest| rest.split("```").next().expect("split yields one part"))
        .collect()
}

/// Runs a script with `wasmouse` on the path and returns what it printed.
fn run(script: &str, folder: &Path) -> String {
    let wasmouse = binary::path();
    let bin = wasmouse.parent().expect("the binary is in a folder");
    let old = env::var_os("PATH").unwrap_or_default();
    let paths = std::iter::once(bin.to_owned()).chain(env::split_paths(&old));
    let path = env::join_paths(paths).expect("no colon in the paths");
    let output = Command::new("sh")
        .args(["-euc", script])
        .current_dir(folder)
        .env("PATH", path)
        .env("WASMOUSE_CACHE", folder.join("cache"))
        // The target folder of this repository may be in use by the cargo that
        // runs this test.
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .output()
        .expect("a shell");
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{script}\n{stdout}\n{stderr}");
    stdout
}

#[test]
fn the_tutorial_works_to_the_letter() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let blocks = blocks("tutorial");
    assert!(blocks.len() >= 2, "the README has its tutorial");
    let printed: Vec<String> = blocks
        .iter()
        .map(|block| run(block, folder.path()))
        .collect();
    let score = printed[0].lines().find(|line| line.contains("my-robot  "));
    let score = score.expect("a line with the match");
    assert!(score.contains("finished"), "{score}");
    let mut lines = printed[1].lines();
    let standing = lines.find(|line| line.contains("my-robot ") && !line.contains("gen:"));
    let standing = standing.expect("a line of the standings");
    let columns: Vec<&str> = standing.split_whitespace().collect();
    assert_eq!(columns[2..5], ["20", "20", "0"], "{standing}");
    assert!(printed[1].contains("is admitted"), "{}", printed[1]);
    assert!(folder.path().join("result.html").is_file());

    // The project's own test, which needs no WebAssembly.
    let test = "cd my-robot && cargo test";
    assert!(run(test, folder.path()).contains("finishes_the_first_maze ... ok"));
}

/// The commands of the page about pictures, among them the one that makes the picture of the README.
#[test]
fn pictures_are_drawn_as_documented() {
    const PICTURES: &str = include_str!("../../docs/PICTURES.md");
    const SHOWN: &[u8] = include_bytes!("../../docs/images/match.gif");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let blocks = blocks_of(PICTURES, "pictures");
    assert_eq!(blocks.len(), 5);
    for block in blocks {
        run(block, folder.path());
    }
    let made = std::fs::read(folder.path().join("docs/images/match.gif")).expect("made");
    let frames = |bytes: &[u8]| {
        let mut decoder = gif::DecodeOptions::new()
            .read_info(bytes)
            .expect("a GIF file");
        let size = (decoder.width(), decoder.height());
        let mut count = 0;
        while decoder.read_next_frame().expect("valid").is_some() {
            count += 1;
        }
        (size, count)
    };
    assert_eq!(
        frames(SHOWN),
        frames(&made),
        "make the picture of the README again"
    );
    assert!(SHOWN.len() < 700_000, "{} bytes", SHOWN.len());
    for picture in [
        "end.svg",
        "known.png",
        "moments.png",
        "both.gif",
        "margins.png",
    ] {
        assert!(folder.path().join(picture).is_file(), "{picture}");
    }
}

#[test]
fn matches_are_watched_as_documented() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for block in blocks("watch") {
        run(block, folder.path());
    }
    for file in ["page.html", "match.gif", "end.svg", "scores.svg"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
}

/// What the page says an audit prints, it prints.
#[test]
fn replays_are_kept_and_audited_as_documented() {
    const REPLAYS: &str = include_str!("../../docs/REPLAYS.md");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let blocks = blocks_of(REPLAYS, "replay");
    assert_eq!(blocks.len(), 3);
    let printed: Vec<String> = blocks
        .iter()
        .map(|block| run(block, folder.path()))
        .collect();
    let audit = printed.last().expect("three blocks");
    for line in audit.lines() {
        assert!(REPLAYS.contains(line.trim_end()), "{line}");
    }
    assert_eq!(audit.lines().count(), 5);
}

#[test]
fn the_examples_work_to_the_letter() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let blocks = blocks("example");
    assert!(blocks.len() >= 2, "the README has examples");
    for block in blocks {
        run(block, folder.path());
    }
    assert!(folder.path().join("results.json").is_file());
}

#[test]
fn a_contest_works_to_the_letter() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let blocks = blocks("contest");
    assert!(blocks.len() >= 3, "the README has a contest");
    let printed: Vec<String> = blocks
        .iter()
        .map(|block| run(block, folder.path()))
        .collect();
    assert!(printed[0].contains("   1  flood"), "{}", printed[0]);
    assert!(printed[0].contains(", 0 left to play"), "{}", printed[0]);
    assert!(printed[1].contains("part-2.db: "), "{}", printed[1]);
    assert!(printed[2].contains("as committed to"), "{}", printed[2]);
    assert!(folder.path().join("cup/contest.html").is_file());
    assert!(folder.path().join("standings.md").is_file());
}

#[test]
fn the_first_command_of_the_readme_is_the_demo() {
    assert!(README.contains("```sh\ncargo run --release -- demo\n```"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = binary::wasmouse()
        .arg("demo")
        .current_dir(folder.path())
        .output()
        .expect("the program can be run");
    assert!(output.status.success(), "{output:?}");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.contains("   1  champion:fast "), "{printed}");
    assert!(printed.contains("Best run: `champion:fast`"), "{printed}");
    assert!(folder.path().join("wasmouse-demo.html").is_file());
}
