//! `wasmouse verify` and `wasmouse run --twice`: true results are accepted, and what is
//! changed in a result, a robot or a maze is named.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;
use wasmouse::maze::format::{self, Format};
use wasmouse::maze::generate::GenSpec;
use wasmouse::maze::{Cell, Heading, Maze};
use wasmouse::robot::bundled::find;

use crate::binary::{Ran, ran, stdout_of, wasmouse};
use crate::hostile::{IMPORT_LOG, Module, wasm};

/// Bundled robots, copies of them, robots that fail, and files that are no robots.
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
    let (_, maze) = spec.expand().next().expect("one maze");
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

/// Verifies a text on standard input.
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
    let told = [output.stdout, output.stderr].concat();
    let told = String::from_utf8(told).expect("programs print text");
    assert!(!told.contains("panicked at"), "{told}");
    (output.status.code().expect("no signal ended it"), told)
}

const AT_HAND: [&str; 4] = ["--robot", "robots", "--maze", "mazes"];

#[test]
fn a_contest_of_twenty_robots_is_verified() {
    let folder = folder();
    let text = record(folder.path(), &ROBOTS, &MAZES);
    fs::write(folder.path().join("results.json"), &text).expect("a file");
    let expected = "results.json: verified, 190 matches of 21 robots in 5 mazes\n";
    for options in [&["--jobs", "1"][..], &["--jobs", "5", "--trust"]] {
        let mut verify = command(folder.path(), &["verify", "results.json"]);
        assert_eq!(stdout_of(verify.args(AT_HAND).args(options)), expected);
    }
    // Names of files mean nothing.
    for (old, new) in [
        ("robots/copy.wasm", "robots/x.wasm"),
        ("mazes/own.txt", "mazes/y.map"),
    ] {
        let path = |name| folder.path().join(name);
        fs::rename(path(old), path(new)).expect("a file");
    }
    let mut verify = command(folder.path(), &["verify", "results.json", "--json"]);
    let report: Value = serde_json::from_str(&stdout_of(verify.args(AT_HAND))).expect("JSON");
    assert_eq!(report["verified"], true);
    assert_eq!(report["results"][0]["matches_expected"], 190);
}

/// Changes of one byte and the field that has to be named; `host/src/report/result/tests.rs`
/// does that for bytes everywhere.
#[test]
fn changed_fields_are_named() {
    let folder = folder();
    let robots = [
        "flood",
        "flood:1",
        "random",
        "robots/copy.wasm",
        "robots/text.wasm",
    ];
    let text = record(folder.path(), &robots, &["mazes/own.txt", "gen:tree:12:1"]);
    let json: Value = serde_json::from_str(&text).expect("JSON");
    let flood = json["robots"][0]["sha256"].as_str().expect("a digest");
    let own = json["mazes"][0]["sha256"].as_str().expect("a digest");
    let fuel = json["matches"][0]["steps_fuel"].to_string();
    let digit = if fuel.starts_with('1') { "2" } else { "1" };
    let fuel_wrong = fuel.replacen(&fuel[..1], digit, 1);
    let flood_wrong = flood.replacen(&flood[..1], "x", 1);
    let own_wrong = own.replacen(&own[..1], "x", 1);
    let changes: [(&str, &str, i32, &str); 19] = [
        (
            "\"schema\": 1",
            "\"schema\": 2",
            3,
            "schema: expected 1, which this version reads, found 2",
        ),
        (
            "\"wasmouse\": \"0",
            "\"wasmouse\": \"7",
            1,
            "  wasmouse: recorded \"7.",
        ),
        (
            "wasmtime-4",
            "wasmtime-3",
            1,
            "  engine: recorded \"wasmtime-3",
        ),
        (
            "\"udacity\"",
            "\"udacitx\"",
            3,
            "ruleset.name: this version has no ruleset `udacitx`",
        ),
        (
            "\"version\": 1",
            "\"version\": 3",
            1,
            "  ruleset.version: recorded 3, here 1\n",
        ),
        (
            "    0,\n    1\n  ]",
            "    0,\n    5\n  ]",
            1,
            "  seeds[1]: recorded 5, in matches[1].seed 1\n",
        ),
        ("complete\": true", "complete\": trux", 3, "in `complete`: "),
        (
            "\"name\": \"random\"",
            "\"name\": \"rbndom\"",
            1,
            "  robots[2].name: recorded \"rbndom\", in matches[8].robot \"random\"\n",
        ),
        (flood, &flood_wrong, 1, "  robots[0].sha256: recorded \"x"),
        (
            "\"setting\": 1",
            "\"setting\": 3",
            1,
            "  robots[1].setting: recorded 3, by the end of robots[1].name 1\n",
        ),
        (
            "\"reason\": \"",
            "\"reason\": \"x",
            1,
            "  robots[4].refusal.reason: recorded \"x",
        ),
        (own, &own_wrong, 1, "  mazes[0].sha256: recorded \"x"),
        (
            "\"dimension\": 14",
            "\"dimension\": 15",
            1,
            "  mazes[0].dimension: recorded 15, here 14\n",
        ),
        (
            "\"verdict\": \"f",
            "\"verdict\": \"g",
            1,
            "  matches[0].verdict: recorded \"ginished\", played \"finished\" (`flood` in `own`, seed 0)\n",
        ),
        (
            &fuel,
            &fuel_wrong,
            1,
            &format!(
                "  matches[0].steps_fuel: recorded {fuel_wrong}, played {fuel} (`flood` in `own`, seed 0)\n"
            ),
        ),
        (
            "\"rank\": 1",
            "\"rank\": 2",
            1,
            "  standings[0].rank: recorded 2, counted 1\n",
        ),
        (
            "\n  \"sha256\": \"",
            "\n  \"sha256\": \"g",
            1,
            "  sha256: recorded",
        ),
        (
            ",\n  \"failed\"",
            ",\n \t\"failed\"",
            1,
            "  text: recorded \" \\t\\\"failed\\\": [],\", line ",
        ),
        ("\n}\n", "\n}", 1, "line "),
    ];
    for (old, new, code, expected) in changes {
        assert!(text.contains(old), "{old} is not in {text}");
        let changed = text.replacen(old, new, 1);
        let (found, told) = verify(folder.path(), &changed, &AT_HAND);
        assert_eq!(found, code, "{new}: {told}");
        assert!(told.contains(expected), "{new}: {told}");
        assert!(!told.contains("verified,"), "{new}: {told}");
    }
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
        let (found, told) = verify(folder.path(), &text, &AT_HAND);
        fs::write(&path, &intact).expect("a file");
        assert_eq!(found, code, "{file}, byte {at}: {told}");
        assert!(told.contains(expected), "{file}, byte {at}: {told}");
    };
    for at in 0..=7 {
        let expected = ", of `robots/copy.wasm` \"";
        check("robots/copy.wasm", at, 1, expected);
        check(
            "robots/trapping.wasm",
            at,
            1,
            "  robots[1].sha256: recorded \"",
        );
    }
    // Most changes of a maze file leave no maze, which is passed over in a folder.
    check("mazes/own.txt", 0, 3, "\n  mazes[0] `own`, sha256 ");
    // Another maze: of one wall, both cells have to know.
    let path = folder.path().join("mazes/own.txt");
    let maze = fs::read_to_string(&path).expect("a file");
    let parsed = format::parse(&maze).expect("a maze").maze;
    let mut walls = parsed.walls().clone();
    let (cell, heading) = (Cell::new(3, 3), Heading::Up);
    walls.set(cell, heading, !walls.is_open(cell, heading));
    let other = Maze::new(walls, parsed.start(), parsed.goal()).expect("a maze");
    let other = format::print(&other, Format::Udacity).expect("a contest maze");
    fs::write(&path, other).expect("a file");
    let (code, told) = verify(folder.path(), &text, &AT_HAND);
    assert_eq!(code, 1, "{told}");
    assert!(told.contains("  mazes[0].sha256: recorded \""), "{told}");
    assert!(told.contains("of `mazes/own.txt` \""), "{told}");
}

#[test]
fn what_is_not_at_hand_is_named() {
    let folder = folder();
    let robots = ["robots/copy.wasm:1", "flood", "robots/text.wasm"];
    let text = record(folder.path(), &robots, &["mazes/own.txt", "gen:tree:12:4"]);
    let (code, told) = verify(folder.path(), &text, &["--robot", "robots/text.wasm"]);
    assert_eq!(code, 3, "{told}");
    for expected in [
        "-: not verified\n",
        "error: robots or mazes of result `-` are not at hand:\n",
        "  robots[0] `copy:1`, sha256 ",
        "  mazes[0] `own`, sha256 ",
        "hint: name their files or folders with --robot and --maze\n",
    ] {
        assert!(told.contains(expected), "{told}");
    }
    assert_eq!(told.matches("sha256").count(), 2, "{told}");
}

/// Several results, of which some are good.
#[test]
fn the_worst_result_decides() {
    let folder = folder();
    let text = record(folder.path(), &["flood"], &["test_maze_01"]);
    let files = [
        ("good.json", text.clone()),
        ("false.json", text.replace("\"bumps\": 0", "\"bumps\": 1")),
        ("broken.json", text[..text.len() / 2].to_owned()),
    ];
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a file");
    }
    let check = |files: &[&str], code: i32, expected: &[&str]| {
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(command(folder.path(), &["verify"]).args(files));
        let told = stdout + &stderr;
        assert_eq!(status.code(), Some(code), "{told}");
        for expected in expected {
            assert!(told.contains(expected), "{told}");
        }
    };
    let good = "good.json: verified, 2 matches of 1 robot in 1 maze\n";
    let wrong = "false.json: 2 differences\n  matches[0].bumps: recorded 1, played 0";
    let broken = "error: failed to read result `broken.json`: line ";
    check(&["good.json", "false.json"], 1, &[good, wrong]);
    check(
        &["broken.json", "false.json", "good.json"],
        3,
        &[good, wrong, broken, "broken.json: not verified\n"],
    );
    check(&["missing.json", "good.json"], 3, &[good, "`missing.json`"]);
}

#[test]
fn the_same_twice_is_as_once() {
    let folder = folder();
    let arguments = ["--json", "--lenient", "--repeat", "2"];
    let robots = [
        "flood",
        "random",
        "robots/core.wasm",
        "robots/trapping.wasm",
        "robots/wasi.wasm",
    ];
    let run = |jobs: &str, twice: &[&str]| {
        let mut run = command(folder.path(), &["run", "--jobs", jobs]);
        let played = ran(run.args(arguments).args(robots).args(MAZES).args(twice));
        assert_eq!(played.status.code(), Some(4), "{}", played.stderr);
        (played.stdout, played.stderr)
    };
    let expected = run("2", &[]);
    for jobs in ["1", "2", "3"] {
        assert!(run(jobs, &["--twice"]) == expected, "{jobs} threads");
    }
}

/// Something between the two times has to go wrong for a difference. Here it is a cache
/// that has the code of one robot under the name of another.
#[test]
fn what_is_not_the_same_twice_is_named() {
    let folder = folder();
    let cached = |robot: &str, name: &str| {
        let cache = folder.path().join(name);
        let mut run = command(folder.path(), &["run", robot, "test_maze_01"]);
        stdout_of(run.env("WASMOUSE_CACHE", &cache));
        let mut files = cache.read_dir().expect("a cache");
        let file = files.next().expect("a compiled robot").expect("a file");
        file.path()
    };
    for robot in ["flood", "robots/copy.wasm"] {
        let one = cached(robot, &format!("one-{}", robot.len()));
        let other = cached("dfs", &format!("other-{}", robot.len()));
        fs::copy(&other, &one).expect("a file");
        let cache = one.parent().expect("a folder");
        let run = |options: &[&str]| {
            let mut run = command(
                folder.path(),
                &["run", robot, "test_maze_01", "--seed", "5"],
            );
            ran(run.args(options).env("WASMOUSE_CACHE", cache))
        };
        let once = run(&[]);
        assert_eq!(once.status.code(), Some(0), "{}", once.stderr);
        let twice = run(&["--twice"]);
        assert_eq!(twice.status.code(), Some(5), "{}", twice.stderr);
        assert_eq!(twice.stdout, "", "no result is printed");
        let name = robot
            .trim_start_matches("robots/")
            .trim_end_matches(".wasm");
        for expected in [
            "error: the same contest played twice was not the same:\n",
            "\n  matches[0].steps_fuel: first ",
            &format!(" (`{name}` in `test_maze_01`, seed 5)\n"),
            "\n  standings[0].mean_score: first ",
        ] {
            assert!(twice.stderr.contains(expected), "{}", twice.stderr);
        }
    }
}
