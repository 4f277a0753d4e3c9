//! Bad rubrics: each gets one message, and nothing is written.
//!
//! After a wanted change, `INSTA_UPDATE=always cargo test -p wasmouse-tests bad_rubrics` writes
//! the messages again.

use std::fmt::Write as _;
use std::fs;

use insta::{Settings, assert_snapshot};
use wasmouse::contest::grade::Rubric;

use super::{command, folder, text, write};
use crate::binary::{Ran, ran};

/// What is wrong, and a rubric with that.
pub const RUBRICS: &[(&str, &str)] = &[
    ("empty", ""),
    ("no TOML", "version 1"),
    ("a key twice", "version = 1\nversion = 1"),
    ("an open string", "version = 1\nname = \"Test"),
    (
        "no version",
        "[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"",
    ),
    ("another version", "version = 2\nweights = []"),
    ("a version in words", "version = \"one\""),
    (
        "no mazes",
        "version = 1\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "no criteria",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"",
    ),
    (
        "an empty list of criteria",
        "version = 1\ncriteria = []\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"",
    ),
    (
        "an empty list of mazes",
        "version = 1\nmazes = []\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "mazes as one table",
        "version = 1\n[mazes]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "unknown key at the top",
        "version = 1\npass_percnt = 3\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "unknown key in a set",
        "version = 1\n[[mazes]]\nset = \"a\"\npath = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "unknown key in a criterion",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfinish_percent = 3",
    ),
    (
        "unknown key in the rules",
        "version = 1\nrules.bse = \"udacity\"\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "no paths",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = []\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a path that is empty",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "standard input",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"-\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a number as a path",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [7]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a maze that does not exist",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"test_maze_1\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a specification that is wrong",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"test_maze_01\", \"gen:tree:13:1\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a file that is no maze",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"letter.txt\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "an illegal maze",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = [\"small.txt\"]\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "two sets of one name",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a set with an invisible name",
        "version = 1\n[[mazes]]\nset = \"a\\u202Eb\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "no seeds",
        "version = 1\nseeds.count = 0\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "too many seeds",
        "version = 1\n[seeds]\nfirst = 18446744073709551615\ncount = 2\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "rules that do not exist",
        "version = 1\nrules.base = \"udacty\"\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "rules of their own without a name",
        "version = 1\nrules.game.budget = 10\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a mark in percent and points",
        "version = 1\npass_percent = 50\npass_points = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a mark of 101 percent",
        "version = 1\npass_percent = 101\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a mark that nobody can reach",
        "version = 1\npass_points = 2\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "no name of a criterion",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nfaults = 0",
    ),
    (
        "two criteria of one name",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0\n[[criteria]]\nname = \"a\"\nfaults = 1",
    ),
    (
        "a criterion that expects nothing",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\npoints = 3",
    ),
    (
        "a criterion that expects two things",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = 3\nfaults = 0",
    ),
    (
        "criteria that are worth nothing",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\npoints = 0\nfaults = 0",
    ),
    (
        "negative points",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\npoints = -1\nfaults = 0",
    ),
    (
        "half a point",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\npoints = 0.5\nfaults = 0",
    ),
    (
        "more than 100 percent",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfinished_percent = 120",
    ),
    (
        "a negative score",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = -3",
    ),
    (
        "four decimals",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = 3.0001",
    ),
    (
        "no number",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = \"3\"",
    ),
    (
        "not a number",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = nan",
    ),
    (
        "half a fault",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0.5",
    ),
    (
        "`none` on the wrong side of a percentage",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfinished_percent = 90\nnone = 95",
    ),
    (
        "`none` on the wrong side of a score",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = 30\nnone = 30",
    ),
    (
        "`none` where there is no partial credit",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"gen:tree:12:1..=6\"\n[[criteria]]\nname = \"a\"\nno_worse_than = \"flood\"\nnone = 1",
    ),
    (
        "a key of another expectation",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nmean_score = 30\nbeats_percent = 50",
    ),
    (
        "a set that does not exist",
        "version = 1\n[[mazes]]\nset = \"official\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0\nmazes = [\"oficial\"]",
    ),
    (
        "a reference robot that does not exist",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nbeats = \"fload\"",
    ),
    (
        "a reference robot without that variant",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nbeats = \"flood:nosuch\"",
    ),
    (
        "a reference robot without a name",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nbeats = \"\"",
    ),
    (
        "too few mazes to tell",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"gen:tree:12:1..=5\"\n[[criteria]]\nname = \"a\"\nno_worse_than = \"flood\"",
    ),
    (
        "a baseline that does not exist",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nbaseline = \"lost.json\"",
    ),
    (
        "a baseline that is something else",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nbaseline = \"letter.txt\"",
    ),
    (
        "a control character",
        "version = 1\nname = \"\u{1b}[31m\"\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"a\"\nfaults = 0",
    ),
    (
        "a name that could be a command",
        "version = 1\n[[mazes]]\nset = \"a\"\npaths = \"test_maze_01\"\n[[criteria]]\nname = \"::error::\\n\"\nfaults = 0",
    ),
];

#[test]
fn each_bad_rubric_has_one_message_and_destroys_nothing() {
    let folder = folder();
    write(folder.path(), "letter.txt", "Dear judges,\n");
    write(
        folder.path(),
        "small.txt",
        "4\n3,5,5,6\n10,3,6,10\n10,9,12,10\n9,5,5,12\n",
    );
    write(folder.path(), "kept.json", "kept");
    let mut messages = String::new();
    let long = format!("version = 1\n# {}", "x".repeat(1 << 20));
    let long = ("more than a mebibyte", long.as_str());
    for (name, rubric) in RUBRICS.iter().copied().chain([long]) {
        write(folder.path(), "rubric.toml", rubric);
        let line = "grade rubric.toml flood --force --json kept.json --junit new.xml \
                    --output-dir grades";
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(&mut command(folder.path(), line));
        assert_eq!(
            (status.code(), stdout.as_str()),
            (Some(3), ""),
            "{name}: {stderr}"
        );
        assert_eq!(stderr.matches("error: ").count(), 1, "{name}: {stderr}");
        assert_eq!(text(&folder.path().join("kept.json")), "kept", "{name}");
        let stderr = stderr.trim_end();
        writeln!(messages, "# {name}\n{stderr}\n").expect("a string");
    }
    let files = fs::read_dir(folder.path()).expect("a folder").count();
    assert!(files <= 5, "temporary files are gone");
    assert!(RUBRICS.len() >= 40);
    for name in ["new.xml", "grades"] {
        assert!(!folder.path().join(name).exists(), "{name}");
    }
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_snapshot_path("../snapshots");
    settings.bind(|| assert_snapshot!("grade-bad-rubrics", messages));
}

#[test]
fn a_rubric_that_is_not_there_or_no_text_is_named() {
    let folder = folder();
    fs::write(folder.path().join("latin1.toml"), b"name = \"\xe9\"").expect("a file");
    for (rubric, expected) in [
        ("lost.toml", "error: failed to read rubric `lost.toml`: "),
        (
            "latin1.toml",
            "error: latin1.toml, line 1, column 9: expected UTF-8",
        ),
        (".", "error: failed to read rubric `.`: "),
    ] {
        let line = format!("grade {rubric} flood --json grade.json");
        let Ran { status, stderr, .. } = ran(&mut command(folder.path(), &line));
        assert_eq!(status.code(), Some(3), "{stderr}");
        assert!(stderr.starts_with(expected), "{stderr}");
        assert!(!folder.path().join("grade.json").exists());
    }
}

/// Whatever is deleted or replaced, a rubric is read or has an error with a place in it.
#[test]
fn no_change_of_a_rubric_panics() {
    let template = include_str!("../../../host/templates/grade/rubric.toml");
    let lines = template.lines().filter(|it| !it.starts_with('#'));
    let text: Vec<&str> = lines.collect();
    let text = text.join("\n");
    let (mut good, mut bad) = (0, 0);
    let mut check = |text: &str| match Rubric::read(text) {
        Ok(_) => good += 1,
        Err(error) => {
            assert!(error.line >= 1 && error.column >= 1 && !error.message.is_empty());
            assert!(error.line <= text.lines().count() + 1, "{error}");
            bad += 1;
        }
    };
    for (at, character) in text.char_indices() {
        let (before, after) = (&text[..at], &text[at + character.len_utf8()..]);
        check(&format!("{before}{after}"));
        for other in ["\"", "[", "]", "=", "-", "9", "\n", "\u{202e}", "\u{0}"] {
            check(&format!("{before}{other}{after}"));
        }
        check(before);
    }
    assert!(good > 1000 && bad > 1000, "{good} {bad}");
}
