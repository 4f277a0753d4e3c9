//! Names of files that mean something in a report: every command that reads such files, and every
//! format that has their names, shows text.

#![cfg(unix)]

use std::fs;
use std::path::Path;

use tempfile::TempDir;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_engine::bundled::find;

use crate::binary::{ran, wasmouse};

/// For a terminal and an editor, a web page, a spreadsheet, Markdown, and the log of a workflow.
const NAMES: [&str; 5] = [
    "\u{1b}[2J\u{9b}31m\u{202e}\u{200b}a",
    "<script>alert(1)<img src=x onerror=alert(2)>",
    "=HYPERLINK(\"https:x\")",
    "a|b`c|[d](e)",
    "a\n::error::forged\nerror: forged",
];

const CONTEST: &str = r#"
version = 1
name = "cup"
[[robots]]
path = "robots/*.wasm"
[[mazes]]
set = "public"
paths = ["mazes"]
[[mazes]]
set = "final"
hidden = true
paths = ["hidden"]
[run]
keep_transcripts = "all"
[outputs]
html = "out.html"
csv = "out.csv"
json = "out.json"
jsonl = "out.jsonl"
markdown = "out.md"
"#;

const RUBRIC: &str = r#"
version = 1
name = "test"
[[mazes]]
set = "all"
paths = ["mazes"]
[[criteria]]
name = "finishes"
points = 1
finished_percent = 100
[[criteria]]
name = "no fault"
points = 1
faults = 0
"#;

/// Robots and mazes with these names. The last robot is rejected.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |path: String, bytes: &[u8]| {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    };
    let robots = ["flood", "dfs", "random", "wall-follower"].map(|name| {
        let robot = find(name).expect("a bundled robot");
        robot.component
    });
    let robots = robots.into_iter().chain([&b"no robot"[..]]);
    for (name, bytes) in NAMES.into_iter().zip(robots) {
        write(format!("robots/{name}.wasm"), bytes);
    }
    let spec: GenSpec = "gen:tree:12:1..=6".parse().expect("a specification");
    let mazes: Vec<String> = spec
        .expand()
        .map(|maze| format::print(&maze.generate(), Format::Udacity).expect("it can be printed"))
        .collect();
    for (name, text) in NAMES.into_iter().zip(&mazes) {
        write(format!("mazes/{name}.txt"), text.as_bytes());
    }
    write(format!("hidden/{}.txt", NAMES[0]), mazes[5].as_bytes());
    write("contest.toml".to_owned(), CONTEST.as_bytes());
    write("rubric.toml".to_owned(), RUBRIC.as_bytes());
    folder
}

/// Whether a character controls a terminal, or cannot be seen.
fn misleads(character: char) -> bool {
    let is_invisible =
        matches!(character, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{feff}');
    character != '\n' && (character.is_control() || is_invisible)
}

/// No line of its own, and nothing that cannot be seen.
#[track_caller]
fn check_plain(what: &str, text: &str) {
    let bad: Vec<char> = text.chars().filter(|it| misleads(*it)).collect();
    assert!(bad.is_empty(), "{what}: {bad:?} in\n{text:?}");
    let mut lines = text.lines().map(str::trim_start);
    let forged = lines.find(|it| it.starts_with("error: forged") || it.starts_with("::error::f"));
    assert_eq!(forged, None, "{what}: {text}");
}

#[track_caller]
fn check_html(text: &str) {
    assert!(text.contains("&lt;script&gt;alert(1)"), "{text}");
    for tag in ["<script>alert", "<img src=x"] {
        assert!(!text.contains(tag), "{tag}: {text}");
    }
}

#[track_caller]
fn check_csv(text: &str) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut fields = 0;
    for record in reader.records() {
        for field in &record.expect("lines of one length") {
            let is_formula = field.starts_with(['=', '+', '-', '@']);
            assert!(!is_formula || field.parse::<f64>().is_ok(), "{field}");
            fields += 1;
        }
    }
    assert!(fields > 0 && text.contains("HYPERLINK"), "{text}");
}

/// All lines of a table have as many cells as its first one.
#[track_caller]
fn check_markdown(text: &str) {
    let mut cells = 0;
    let mut rows = 0;
    for line in text.lines() {
        if !line.starts_with('|') {
            cells = 0;
            continue;
        }
        let found = line.replace("\\|", "").matches('|').count();
        assert!(cells == 0 || cells == found, "{line}");
        cells = found;
        rows += 1;
    }
    assert!(rows > NAMES.len() && text.contains("a\\|b"), "{text}");
    for line in text.lines() {
        for (at, _) in line.match_indices("<script>a") {
            let quotes = line[..at].matches('`').count();
            assert!(quotes % 2 == 1, "it is not in a span of code: {line}");
        }
    }
}

/// Runs a command that ends with one of these codes and prints plain text.
#[track_caller]
fn check(folder: &Path, line: &str, codes: &[i32]) {
    let words: Vec<&str> = line.split_whitespace().collect();
    check_words(folder, &words, codes);
}

#[track_caller]
fn check_words(folder: &Path, words: &[&str], codes: &[i32]) {
    let cache = folder.join("cache");
    let ran = ran(wasmouse()
        .args(words)
        .current_dir(folder)
        .env("WASMOUSE_CACHE", cache));
    let code = ran.status.code().unwrap_or(-1);
    assert!(
        codes.contains(&code),
        "{words:?}: {code}: {}{}",
        ran.stdout,
        ran.stderr
    );
    check_plain(&format!("{words:?}"), &ran.stdout);
    check_plain(&format!("{words:?}"), &ran.stderr);
}

/// A file, with simple line breaks: those of CSV may be others.
fn read(folder: &Path, name: &str) -> String {
    let text = fs::read_to_string(folder.join(name));
    let text = text.unwrap_or_else(|error| panic!("{name}: {error}"));
    text.replace("\r\n", "\n")
}

#[test]
fn contests_show_names_as_text() {
    let folder = folder();
    let folder = folder.path();
    check(folder, "contest check", &[0]);
    check(folder, "contest commit", &[0]);
    check(folder, "contest run", &[0]);
    check(folder, "contest run", &[0]);
    check(folder, "contest status --check", &[0]);
    check(folder, "contest report", &[0]);
    let all = "--html all.html --csv all.csv --matches-csv matches.csv --json all.json \
               --jsonl all.jsonl --markdown all.md";
    check(
        folder,
        &format!("contest report --organiser --ascii {all}"),
        &[0],
    );
    let files = "contest.commitment.json contest.opening.json";
    check(
        folder,
        &format!("contest reveal {files} --store contest.db"),
        &[0],
    );
    check(
        folder,
        &format!("contest reveal {files} --store other.db"),
        &[3],
    );
    check(folder, "replay contest.db --list", &[0]);
    check(folder, "replay contest.db --json", &[0]);
    check(folder, "picture contest.db --poster -o poster.svg", &[0]);
    check(folder, "plot scores contest.toml -o plot.svg", &[0]);
    for name in [
        "out.html",
        "out.csv",
        "out.json",
        "out.jsonl",
        "out.md",
        "all.html",
        "all.csv",
        "matches.csv",
        "all.json",
        "all.jsonl",
        "all.md",
        "contest.commitment.json",
        "contest.opening.json",
        "poster.svg",
        "plot.svg",
    ] {
        let text = read(folder, name);
        check_plain(name, &text);
        match Path::new(name).extension().and_then(|it| it.to_str()) {
            Some("html") => check_html(&text),
            Some("csv") => check_csv(&text),
            Some("md") => check_markdown(&text),
            Some("svg") => assert!(!text.contains("<script>alert"), "{name}"),
            _ => {}
        }
    }
}

#[test]
fn grades_show_names_as_text() {
    let folder = folder();
    let folder = folder.path();
    check(
        folder,
        "grade rubric.toml robots --annotations --output-dir grades",
        &[4],
    );
    let mut left = vec![folder.join("grades")];
    let mut files = 0;
    while let Some(path) = left.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            left.extend(entries.map(|it| it.expect("an entry").path()));
            continue;
        }
        let name = path.to_str().expect("a plain name");
        let text = read(folder, name);
        check_plain(name, &text);
        match path.extension().and_then(|it| it.to_str()) {
            Some("csv") => check_csv(&text),
            Some("xml") => assert!(!text.contains("<script>"), "{text}"),
            _ => {}
        }
        files += 1;
    }
    assert!(files > NAMES.len(), "{files}");
}

#[test]
fn other_commands_show_names_as_text() {
    let folder = folder();
    let folder = folder.path();
    check(
        folder,
        "run robots -m mazes -o out.json --html out.html",
        &[4],
    );
    check(folder, "plot regret out.json -o plot.svg", &[0]);
    check(folder, "study robots -m mazes", &[0, 4]);
    check(folder, "study robots -m mazes --json", &[0, 4]);
    check(folder, "verify out.json --robot robots -m mazes", &[0]);
    check(folder, "verify out.json --robot robots", &[3]);
    check(folder, "maze solve mazes", &[0]);
    check(folder, "maze show mazes", &[0]);
    let robots = NAMES.map(|name| format!("robots/{name}.wasm"));
    let maze = format!("mazes/{}.txt", NAMES[1]);
    for robot in &robots {
        check_words(folder, &["run", robot, &maze, "--explain"], &[0, 2, 4, 6]);
        check_words(folder, &["profile", robot, "-m", &maze], &[0, 4]);
        check_words(folder, &["inspect", robot], &[0, 4]);
        check_words(
            folder,
            &["compare", robot, "flood", "-m", &maze],
            &[0, 1, 4],
        );
    }
    for name in ["out.html", "out.json", "plot.svg"] {
        check_plain(name, &read(folder, name));
    }
    check_html(&read(folder, "out.html"));
}
