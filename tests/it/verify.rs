//! `wasmouse verify` and `wasmouse run --reproduce`: true results are verified, and what has
//! changed in a result, a robot or a maze is named.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;
use wasmouse::contest::RESULTS_VERSION;
use wasmouse_core::Digest;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Cell, Heading, Maze};
use wasmouse_engine::bundled::find;

use crate::binary::{Ran, ran, stdout_of, wasmouse};
use crate::hostile::{IMPORT_LOG, Module, wasm};

/// Bundled robots, copies of them, robots that fail, and files that are not robots.
const ROBOTS: [&str; 21] = [
    "champion",
    "count-expansion",
    "dfs",
    "dfs:1",
    "flood",
    "flood:1",
    "lobato",
    "lobato:2",
    "minnett",
    "rai",
    "random",
    "wall-follower",
    "robots/copy.wasm",
    "robots/copy.wasm:1",
    "robots/ahead.wasm",
    "robots/core.wasm:7",
    "robots/talkative.wasm",
    "robots/trapping.wasm",
    "robots/greedy.wasm",
    "robots/wasi.wasm",
    "robots/text.wasm",
];

const MAZES: [&str; 4] = [
    "test_maze_01",
    "gen:tree:12:1..=2",
    "mazes/own.txt",
    "mazes/small.txt",
];

/// A folder with those robots and mazes, and a cache of compiled robots.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["robots", "mazes"] {
        fs::create_dir(folder.path().join(name)).expect("a folder");
    }
    let failing = |next| Module {
        next,
        ..Module::default()
    };
    let talkative = Module {
        imports: IMPORT_LOG,
        rest: r#"(data (i32.const 32) "\1b[31mred")"#,
        next: "(call $log (i32.const 2) (i32.const 32) (i32.const 8)) i32.const 16",
        ..Module::default()
    };
    let wasi = wasm(r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#);
    let mut copy = find("flood").expect("a bundled robot").component.to_vec();
    // An empty section with a name: other bytes, the same robot.
    copy.extend([0, 2, 1, b'x']);
    let spec: GenSpec = "gen:braid:14:5".parse().expect("a specification");
    let maze = spec.expand().next().expect("one maze").generate();
    let own = format::print(&maze, Format::Udacity).expect("a contest maze");
    let files: [(&str, Vec<u8>); 10] = [
        ("robots/copy.wasm", copy),
        ("robots/ahead.wasm", Module::default().component()),
        ("robots/core.wasm", Module::default().core()),
        ("robots/talkative.wasm", talkative.component()),
        ("robots/trapping.wasm", failing("unreachable").component()),
        (
            "robots/greedy.wasm",
            failing("(drop (memory.grow (i32.const 30000))) i32.const 16").component(),
        ),
        ("robots/wasi.wasm", wasi),
        ("robots/text.wasm", b"I am a robot\n".to_vec()),
        ("mazes/own.txt", own.into_bytes()),
        (
            "mazes/small.txt",
            b"4\n3,5,5,6\n10,3,6,10\n10,9,12,10\n9,5,5,12\n".to_vec(),
        ),
    ];
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = wasmouse();
    command
        .args(arguments)
        .current_dir(folder)
        .env("WASMOUSE_CACHE", folder.join("cache"));
    command
}

/// The result of those robots in those mazes with two seeds.
fn record(folder: &Path, robots: &[&str], mazes: &[&str]) -> String {
    let mut run = command(folder, &["run", "--json", "--lenient", "--repeat", "2"]);
    let played = ran(run.args(robots).args(mazes));
    let code = played.status.code();
    assert!(matches!(code, Some(0 | 4)), "{code:?} {}", played.stderr);
    played.stdout
}

/// Verifies a text on standard input; returns the exit code and everything that was printed.
fn verify(folder: &Path, text: &str, options: &[&str]) -> (i32, String) {
    let mut child = command(folder, &["verify", "-"])
        .args(options)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(text.as_bytes()).expect("it is read");
    drop(stdin);
    let output = child.wait_with_output().expect("the program ends");
    let printed = [output.stdout, output.stderr].concat();
    let printed = String::from_utf8(printed).expect("programs print text");
    assert!(!printed.contains("panicked at"), "{printed}");
    (output.status.code().expect("no signal ended it"), printed)
}

const AVAILABLE: [&str; 4] = ["--robot", "robots", "--maze", "mazes"];

#[test]
fn a_contest_of_twenty_robots_is_verified() {
    let folder = folder();
    let text = record(folder.path(), &ROBOTS, &MAZES);
    fs::write(folder.path().join("results.json"), &text).expect("a file");
    let expected = "results.json: verified 190 matches\n";
    for options in [&["--jobs", "1"][..], &["--jobs", "5", "--trust"]] {
        let mut verify = command(folder.path(), &["verify", "results.json"]);
        assert_eq!(stdout_of(verify.args(AVAILABLE).args(options)), expected);
    }
    // File names mean nothing.
    for (old, new) in [
        ("robots/copy.wasm", "robots/x.wasm"),
        ("mazes/own.txt", "mazes/y.map"),
    ] {
        let path = |name| folder.path().join(name);
        fs::rename(path(old), path(new)).expect("a file");
    }
    let mut verify = command(folder.path(), &["verify", "results.json", "--json"]);
    let report: Value = serde_json::from_str(&stdout_of(verify.args(AVAILABLE))).expect("JSON");
    assert_eq!(report["verified"], true);
    assert_eq!(report["files"][0]["status"], "verified");
    assert_eq!(report["files"][0]["matches_planned"], 190);
}

/// The same values in another text are the same result, with an exit code of its own.
#[test]
fn reformatted_results_are_verified() {
    let folder = folder();
    let text = record(
        folder.path(),
        &["flood", "robots/text.wasm"],
        &["mazes/own.txt"],
    );
    let json: Value = serde_json::from_str(&text).expect("JSON");
    // `serde_json` sorts the names of an object, so this is another order too.
    let sorted = serde_json::to_string(&json).expect("JSON");
    let indented = serde_json::to_string_pretty(&json).expect("JSON");
    for other in [
        sorted,
        indented,
        text.replace('\n', "\r\n"),
        text.clone() + "\n",
    ] {
        let (code, printed) = verify(folder.path(), &other, &AVAILABLE);
        assert_eq!(code, 8, "{printed}");
        assert!(printed.contains("-: verified 2 matches, but the formatting differs at line "));
    }
    let (code, printed) = verify(folder.path(), &text, &AVAILABLE);
    assert_eq!((code, &*printed), (0, "-: verified 2 matches\n"));
}

/// A name is a label: whoever changes it and the digest of the results gets them verified, and a
/// warning that says which robot it is.
#[test]
fn renamed_robots_are_reported() {
    let folder = folder();
    let text = record(folder.path(), &["flood", "dfs"], &["test_maze_01"]);
    let renamed = text
        .replace("\"flood:", "\"FLOOD:")
        .replace("\"dfs:", "\"flood:")
        .replace("\"FLOOD:", "\"dfs:");
    assert_ne!(renamed, text, "they have variants");
    fs::write(folder.path().join("renamed.json"), &renamed).expect("a file");
    let verified = |name: &str| {
        let mut verify = command(folder.path(), &["verify", name]);
        ran(&mut verify)
    };
    let played = verified("renamed.json");
    for (robot, name) in [("flood", "dfs"), ("dfs", "flood")] {
        let warning = format!("warning: the result calls the bundled robot `{robot}` `{name}:");
        assert!(played.stderr.contains(&warning), "{}", played.stderr);
    }
    fs::write(folder.path().join("own.json"), &text).expect("a file");
    let played = verified("own.json");
    assert_eq!((played.status.code(), &*played.stderr), (Some(0), ""));
}

/// Replaces a value in a document and verifies it.
#[track_caller]
fn check_change(folder: &Path, json: &Value, pointer: &str, value: Value, expected: (i32, &str)) {
    let mut changed = json.clone();
    let place = changed.pointer_mut(pointer);
    let place = place.unwrap_or_else(|| panic!("{pointer} is in the document"));
    assert_ne!(*place, value, "{pointer} changes");
    *place = value;
    let (code, printed) = verify(folder, &changed.to_string(), &AVAILABLE);
    let (expected_code, message) = expected;
    assert_eq!(code, expected_code, "{pointer}: {printed}");
    assert!(printed.contains(message), "{pointer}: {printed}");
}

#[test]
fn changed_values_are_named() {
    let folder = folder();
    let robots = ["flood", "flood:1", "random", "robots/text.wasm"];
    let text = record(folder.path(), &robots, &["mazes/own.txt", "gen:tree:12:1"]);
    let json: Value = serde_json::from_str(&text).expect("JSON");
    let check = |pointer: &str, value: Value, code: i32, message: &str| {
        check_change(folder.path(), &json, pointer, value, (code, message));
    };
    let match_0 = "`flood:reset` in `own`, seed 0: ";
    check("/version", json!(RESULTS_VERSION + 1), 3, "version");
    check(
        "/contest/engine",
        json!("wasmtime-3"),
        7,
        "recorded by engine `wasmtime-3`",
    );
    check(
        "/contest/seeds/count",
        json!(3),
        1,
        "contest.matches_planned: recorded 12, found 18",
    );
    check(
        "/contest/rules/game/budget",
        json!(999),
        3,
        "no such ruleset",
    );
    check(
        "/contest/robots/2/name",
        json!("rbndom"),
        1,
        "summary.standings.lines[",
    );
    check(
        "/contest/robots/1/variant",
        json!(3),
        1,
        "summary.matches: recorded 12, found 8",
    );
    check(
        "/contest/robots/3/rejection/reason",
        json!("x"),
        1,
        "contest.robots[3].rejection.reason",
    );
    check(
        "/summary/mazes/0/dimension",
        json!(15),
        1,
        "summary.mazes[0].dimension: recorded 15, found 14",
    );
    check("/summary/complete", json!(false), 1, "summary");
    check(
        "/summary/standings/lines/0/rank",
        json!(2),
        1,
        "summary.standings.lines[0].rank: recorded 2, found 1",
    );
    check(
        "/matches/0/counts/bumps",
        json!(7),
        1,
        &format!("{match_0}counts.bumps: recorded 7, found 0"),
    );
    check(
        "/matches/0/fuel/steps",
        json!(7),
        1,
        &format!("{match_0}fuel.steps: recorded 7, found "),
    );
    check(
        "/matches/0/steps/speed",
        json!(7),
        1,
        &format!("{match_0}steps.speed: recorded 7, found "),
    );
    check(
        "/matches/0/verdict/score/thousandths",
        json!(7),
        3,
        "thousandths",
    );
    check(
        "/matches/0/key/seed",
        json!(7),
        3,
        "the id of a match does not match its key",
    );
    let digest = json["matches"][1]["transcript"].clone();
    check(
        "/matches/0/transcript",
        digest,
        1,
        &format!("{match_0}transcript: recorded "),
    );
    let digest = json["matches"][0]["transcript"].clone();
    check("/summary/digest", digest, 1, "summary.digest: recorded ");
    let first = json["matches"][0].clone();
    check("/matches/1", first, 1, "match: recorded ");
}

#[test]
fn changed_robots_and_mazes_are_named() {
    let folder = folder();
    let robots = ["robots/copy.wasm:1", "robots/trapping.wasm"];
    let text = record(folder.path(), &robots, &["mazes/own.txt"]);
    let check = |file: &str, at: usize, code: i32, expected: &str| {
        let path = folder.path().join(file);
        let intact = fs::read(&path).expect("a file");
        let mut bytes = intact.clone();
        let at = at * (bytes.len() - 1) / 7;
        bytes[at] ^= 1;
        fs::write(&path, &bytes).expect("a file");
        let (found, printed) = verify(folder.path(), &text, &AVAILABLE);
        fs::write(&path, &intact).expect("a file");
        assert_eq!(found, code, "{file}, byte {at}: {printed}");
        assert!(printed.contains(expected), "{file}, byte {at}: {printed}");
    };
    for at in 0..=7 {
        check(
            "robots/copy.wasm",
            at,
            1,
            "  contest.robots[0].digest: recorded ",
        );
        check(
            "robots/trapping.wasm",
            at,
            1,
            "  contest.robots[1].digest: recorded ",
        );
    }
    // Most changes of a maze file leave no maze, and such a file is skipped in a folder.
    check(
        "mazes/own.txt",
        0,
        3,
        "  maze `own` was not found (SHA-256 ",
    );
    // Another maze: both cells of a wall have to agree.
    let path = folder.path().join("mazes/own.txt");
    let maze = fs::read_to_string(&path).expect("a file");
    let parsed = format::parse(&maze).expect("a maze").maze;
    let mut walls = parsed.walls().clone();
    let (cell, heading) = (Cell::new(3, 3), Heading::Up);
    walls.set(cell, heading, !walls.is_open(cell, heading));
    let other = Maze::new(walls, parsed.start(), parsed.goal()).expect("a maze");
    let other = format::print(&other, Format::Udacity).expect("a contest maze");
    fs::write(&path, other).expect("a file");
    let (code, printed) = verify(folder.path(), &text, &AVAILABLE);
    assert_eq!(code, 1, "{printed}");
    assert!(
        printed.contains("  summary.mazes[0].digest: recorded "),
        "{printed}"
    );
}

#[test]
fn what_is_not_found_is_named() {
    let folder = folder();
    let robots = ["robots/copy.wasm:1", "flood", "robots/text.wasm"];
    let text = record(folder.path(), &robots, &["mazes/own.txt", "gen:tree:12:4"]);
    let (code, printed) = verify(folder.path(), &text, &["--robot", "robots/text.wasm"]);
    assert_eq!(code, 3, "{printed}");
    for expected in [
        "-: not verified: required robots or mazes were not found\n",
        "  robot `copy:1` was not found (SHA-256 ",
        "  maze `own` was not found (SHA-256 ",
        "hint: give their files or folders with --robot and --maze\n",
    ] {
        assert!(printed.contains(expected), "{printed}");
    }
    assert_eq!(printed.matches("SHA-256").count(), 2, "{printed}");
}

/// Several results, of which some are good.
#[test]
fn the_worst_result_decides() {
    let folder = folder();
    let text = record(folder.path(), &["flood"], &["test_maze_01"]);
    let files = [
        ("good.json", text.clone()),
        ("false.json", text.replace("\"bumps\":0", "\"bumps\":1")),
        ("broken.json", text[..text.len() / 2].to_owned()),
    ];
    assert_ne!(files[1].1, text);
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a file");
    }
    let check = |files: &[&str], code: i32, expected: &[&str]| {
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(command(folder.path(), &["verify"]).args(files));
        let printed = stdout + &stderr;
        assert_eq!(status.code(), Some(code), "{printed}");
        for expected in expected {
            assert!(printed.contains(expected), "{printed}");
        }
    };
    let good = "good.json: verified 2 matches\n";
    let wrong =
        "false.json: 2 differences\n  `flood:reset` in `test_maze_01`, seed 0: counts.bumps";
    let broken = "error: failed to read result `broken.json`: ";
    check(&["good.json", "false.json"], 1, &[good, wrong]);
    check(
        &["broken.json", "false.json", "good.json"],
        3,
        &[good, wrong, broken, "broken.json: not verified"],
    );
    check(&["missing.json", "good.json"], 3, &[good, "`missing.json`"]);
}

#[test]
fn a_contest_is_reproduced_in_another_order() {
    let folder = folder();
    let arguments = ["--json", "--lenient", "--repeat", "2"];
    let robots = [
        "flood",
        "random",
        "robots/core.wasm",
        "robots/trapping.wasm",
        "robots/wasi.wasm",
    ];
    let run = |jobs: &str, reproduce: &[&str]| {
        let mut run = command(folder.path(), &["run", "--jobs", jobs]);
        let played = ran(run.args(arguments).args(robots).args(MAZES).args(reproduce));
        assert_eq!(played.status.code(), Some(4), "{}", played.stderr);
        (played.stdout, played.stderr)
    };
    let (stdout, stderr) = run("2", &[]);
    for jobs in ["1", "2", "3"] {
        let again = run(jobs, &["--reproduce"]);
        assert!(again.0 == stdout, "{jobs} threads");
        assert_eq!(again.1, format!("{stderr}reproduced 40 matches\n"));
    }
}

/// Makes an entry of a cache claim the code of another one, as only the owner of the cache can:
/// its header is that of the first, with the length and the digests of the other code.
fn forge(entry: &Path, other: &Path) {
    let read = |path| fs::read(path).expect("an entry");
    let code = read(other).split_off(160);
    let mut forged = read(entry);
    forged.truncate(128);
    forged[88..96].copy_from_slice(&(code.len() as u64).to_le_bytes());
    forged[96..].copy_from_slice(Digest::of(&code).as_bytes());
    let seal = Digest::of(&forged);
    forged.extend_from_slice(seal.as_bytes());
    forged.extend_from_slice(&code);
    fs::write(entry, forged).expect("an entry");
}

/// Something has to go wrong between the two times for a difference. Here it is a cache that
/// has the code of one robot under the name of another.
#[test]
fn what_is_not_reproducible_is_named() {
    let folder = folder();
    let cached = |robot: &str, name: &str| {
        let cache = folder.path().join(name);
        let mut run = command(folder.path(), &["run", robot, "test_maze_01"]);
        stdout_of(run.env("WASMOUSE_CACHE", &cache));
        let mut files = cache.read_dir().expect("a cache");
        let file = files.next().expect("a compiled robot").expect("a file");
        file.path()
    };
    for (robot, name) in [("flood", "flood:reset"), ("robots/copy.wasm", "copy")] {
        let one = cached(robot, &format!("one-{name}"));
        let other = cached("dfs", &format!("other-{name}"));
        forge(&one, &other);
        let cache = one.parent().expect("a folder");
        let mut run = command(
            folder.path(),
            &["run", robot, "test_maze_01", "--seed", "5"],
        );
        let run = run.args(["--reproduce", "-o", "kept.json", "--force"]);
        let played = ran(run.env("WASMOUSE_CACHE", cache));
        assert_eq!(played.status.code(), Some(1), "{}", played.stderr);
        // Results come first, and are not lost.
        assert!(played.stdout.contains("finished"), "{}", played.stdout);
        assert!(folder.path().join("kept.json").is_file());
        let first = format!("not reproducible: `{name}` in `test_maze_01`, seed 5: ");
        assert!(played.stderr.contains(&first), "{}", played.stderr);
        let count = " when the contest is played again";
        assert!(played.stderr.contains(count), "{}", played.stderr);
    }
}
