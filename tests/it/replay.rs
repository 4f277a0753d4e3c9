//! Replays: written by `run --replays` and `replay --save`, audited, and refused when damaged.

use std::fs;
use std::path::{Path, PathBuf};

use insta::{Settings, assert_snapshot};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};
use serde_json::Value;
use tempfile::TempDir;
use wasmouse_core::game::{Sensors, Simulation};
use wasmouse_core::journal::Belief;
use wasmouse_core::knowledge::Knowledge;
use wasmouse_core::maze::{Maze, oracle_steps};
use wasmouse_core::replay::Replay;
use wasmouse_tests::binary::{Ran, ran, wasmouse};
use wasmouse_tests::module::{IMPORT_LOG, Module};

use crate::contest_text::ContestText;
use crate::shared::shared;

fn run(folder: &Path, arguments: &[&str]) -> Ran {
    let mut command = wasmouse();
    command
        .args(arguments)
        .current_dir(folder)
        .env("WASMOUSE_CACHE", folder.join("cache"));
    ran(&mut command)
}

#[track_caller]
fn succeeds(folder: &Path, arguments: &[&str]) -> Ran {
    let ran = run(folder, arguments);
    assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {}", ran.stderr);
    ran
}

fn replays(folder: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).expect("a folder");
    let mut files: Vec<PathBuf> = files.map(|it| it.expect("a file").path()).collect();
    files.sort();
    files
}

fn read(path: &Path) -> Replay {
    let bytes = fs::read(path).expect("a file");
    serde_json::from_slice(&bytes).expect("a replay")
}

#[track_caller]
fn check(name: &str, text: &str) {
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| assert_snapshot!(format!("replay-{name}"), text));
}

#[test]
fn a_run_keeps_replays_that_are_listed_and_audited() {
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    let mazes = ["test_maze_01", "gen:tree:12:1..=2"];
    let mut arguments = vec!["run", "flood", "dfs"];
    arguments.extend(mazes);
    let all = ["--repeat", "2", "--replays", "all", "--keep", "all"];
    succeeds(folder, &[&arguments[..], &all].concat());
    let files = replays(&folder.join("all"));
    assert_eq!(files.len(), 2 * 3 * 2);
    succeeds(folder, &[&arguments[..], &["--replays", "best"]].concat());
    let best = replays(&folder.join("best"));
    assert_eq!(best.len(), 2);

    let dfs = "all/dfs-everything.test_maze_01.0.replay.json";
    let listed = succeeds(
        folder,
        &[
            "replay",
            "--list",
            "--ascii",
            dfs,
            "all/flood-reset.test_maze_01.1.replay.json",
        ],
    );
    check("list", &listed.stdout);
    check(
        "audit",
        &succeeds(folder, &["replay", "--audit", dfs]).stdout,
    );
    let json = succeeds(folder, &["replay", "--json", dfs]).stdout;
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let replay = read(&folder.join(dfs));
    let entry = &json["matches"][0];
    assert_eq!(entry["trace"], replay.playback().trace_digest().to_string());
    assert_eq!(
        entry["match"],
        replay.parts().record.key.digest().to_string()
    );
    assert!(!replay.parts().journal.is_empty(), "this robot writes");

    // Files that exist are kept.
    let again = run(folder, &[&arguments[..], &["--replays", "best"]].concat());
    assert_eq!(again.status.code(), Some(3));
    assert!(again.stderr.contains("already exists"), "{}", again.stderr);
    succeeds(
        folder,
        &[&arguments[..], &["--replays", "best", "--force"]].concat(),
    );
    assert_eq!(best, replays(&folder.join("best")));
}

#[test]
fn a_contest_has_the_replays_that_it_keeps() {
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    ContestText::of(&["flood", "dfs"])
        .mazes("all", &["test_maze_01", "gen:tree:12:1..=2"])
        .with("[run]\nkeep_transcripts = \"all\"")
        .write(folder);
    succeeds(folder, &["contest", "run"]);
    let listed = succeeds(folder, &["replay", "contest.db", "--list", "--ascii"]);
    check("contest-list", &listed.stdout);
    let one = ["replay", "contest.db", "--match", "flood/test_maze_01/0"];
    succeeds(folder, &[&one[..], &["--save", "one.replay.json"]].concat());
    let saved = succeeds(folder, &["replay", "one.replay.json", "--json"]).stdout;
    assert_eq!(
        succeeds(folder, &[&one[..], &["--json"]].concat()).stdout,
        saved
    );
    // The same match as in a run, step by step.
    succeeds(
        folder,
        &["run", "flood", "test_maze_01", "--replays", "run"],
    );
    let played = read(&folder.join("run/flood-reset.test_maze_01.0.replay.json"));
    let kept = read(&folder.join("one.replay.json"));
    assert_eq!(played.trace(), kept.trace());
    assert_eq!(played.parts().record, kept.parts().record);

    let fails = |arguments: &[&str], code, expected: &str| {
        let ran = run(folder, &[&["replay", "contest.db"], arguments].concat());
        assert_eq!(
            (ran.status.code(), ran.stdout.as_str()),
            (Some(code), ""),
            "{arguments:?}"
        );
        assert!(
            ran.stderr.contains(expected),
            "{arguments:?}: {}",
            ran.stderr
        );
    };
    fails(
        &["--match", "nobody"],
        3,
        "no match of `nobody//` was found",
    );
    fails(
        &["--match", "flood/test_maze_01/7"],
        3,
        "no match of `flood/test_maze_01/7`",
    );
    fails(&["--match", "a/b/c"], 2, "the seed is not a number");
    fails(
        &["--match", "flood", "--save", "x"],
        2,
        "--save writes one match, and there are 3",
    );
    fails(
        &["--match", "flood//0/1/2"],
        2,
        "expected ROBOT/MAZE/SEED/STEP",
    );
}

/// Whatever is wrong with a file: one message of plain text that names the file, and nothing else.
#[test]
fn damaged_files_are_refused_in_plain_text() {
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    succeeds(folder, &["run", "dfs", "test_maze_01", "--replays", "r"]);
    let whole = fs::read_to_string(&replays(&folder.join("r"))[0]).expect("a replay");
    let replaced = |from: &str, to: &str| {
        assert!(whole.contains(from), "{from}");
        whole.replacen(from, to, 1).into_bytes()
    };
    let mut cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "EOF while parsing"),
        (b"\0\0\0\0".to_vec(), "expected value"),
        (b"{}".to_vec(), "missing field `format`"),
        (b"[1, 2]".to_vec(), "line 1 column"),
        (b"\xff\xfe{}".to_vec(), "expected value"),
        (
            whole.as_bytes()[..whole.len() / 2].to_vec(),
            "EOF while parsing",
        ),
        (
            format!("{whole}{whole}").into_bytes(),
            "trailing characters",
        ),
        (b"[".repeat(100_000), "invalid type"),
        (
            replaced("wasmouse-replay", "\\u001b[31mreplay"),
            "the format is not",
        ),
        (
            replaced("\"version\":1", "\"version\":99"),
            "version 99 are not supported",
        ),
        (
            replaced(
                "\"robot\":\"dfs:everything\"",
                "\"robot\":\"\\u001b]0;x\\u0007\"",
            ),
            "the digest of the replay",
        ),
        (
            replaced("\"robot\"", "\"\\u001b[2Jrobot\""),
            "unknown field",
        ),
        (
            replaced("test_maze_01", "\\u202eevil"),
            "the digest of the replay",
        ),
        (
            replaced("\"budget\":1000", "\"budget\":999"),
            "the digest of the rules",
        ),
        (
            replaced("\"budget\":1000", "\"budget\":-1"),
            "invalid value",
        ),
        (
            replaced("\"exploration_divisor\":30", "\"exploration_divisor\":0"),
            "line 1 column",
        ),
        (
            replaced("\"seed\":0", "\"seed\":1"),
            "the id of a match does not match its key",
        ),
        (
            replaced("\"transcript\":\"AQ", "\"transcript\":\"!Q"),
            "character 0 of the transcript",
        ),
        (
            replaced("\"transcript\":\"AQ", "\"transcript\":\"AA"),
            "unsupported transcript version 0",
        ),
        (
            replaced("\"columns\":[\"", "\"columns\":[\"\\u009b"),
            "column 0 of the maze",
        ),
        (
            replaced("\"note\":\"", "\"note\":\"\\u001b"),
            "unknown variant",
        ),
    ];
    cases.push((vec![b' '; 17 << 20], "more than 16777216 bytes"));
    for (number, (bytes, expected)) in cases.iter().enumerate() {
        let name = format!("{number}.replay.json");
        fs::write(folder.join(&name), bytes).expect("a file");
        for mode in ["--audit", "--json", "--list"] {
            let ran = run(folder, &["replay", &name, mode]);
            assert_eq!(
                (ran.status.code(), ran.stdout.as_str()),
                (Some(3), ""),
                "{expected}"
            );
            let stderr = &ran.stderr;
            assert!(stderr.contains(expected), "{expected}: {stderr}");
            assert!(
                stderr.contains(&name) && stderr.lines().count() <= 4,
                "{stderr}"
            );
            let is_plain = |it: char| it == '\n' || (!it.is_control() && it != '\u{202e}');
            assert!(stderr.chars().all(is_plain), "{stderr:?}");
        }
    }
    let missing = run(folder, &["replay", "no.replay.json"]);
    assert_eq!(missing.status.code(), Some(3));
}

/// Names and journals of an untrusted robot are shown as text.
#[test]
fn hostile_robots_are_replayed_as_text() {
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    let robot = Module {
        imports: IMPORT_LOG,
        rest: r#"(data (i32.const 32) "\1b]0;title\07</script>\e2\80\ae")"#,
        next: "(call $log (i32.const 3) (i32.const 32) (i32.const 24)) unreachable",
        ..Module::default()
    };
    let name = "\u{1b}[31m<b>\u{202e}.wasm";
    fs::write(folder.join(name), robot.component()).expect("a file");
    let ran = run(folder, &["run", name, "test_maze_01", "--replays", "r"]);
    assert_eq!(ran.status.code(), Some(4), "{}", ran.stderr);
    let [file] = &replays(&folder.join("r"))[..] else {
        panic!("one replay");
    };
    let file = file.to_str().expect("a plain name");
    let journal = read(Path::new(file)).parts().journal.len();
    assert_eq!(journal, 1);
    for mode in ["--audit", "--json", "--list"] {
        let ran = succeeds(folder, &["replay", file, mode]);
        let is_plain = |it: char| it == '\n' || (!it.is_control() && it != '\u{202e}');
        assert!(ran.stdout.chars().all(is_plain), "{:?}", ran.stdout);
    }
}

/// Mazes in which the robot would have read the same, with unknown walls at random.
fn consistent(knowledge: &Knowledge, maze: &Maze, random: &mut ChaCha8Rng) -> Maze {
    let mut walls = maze.walls().clone();
    let share = random.next_u32() % 100;
    for (cell, side) in maze.walls().edges() {
        if knowledge.wall(cell, side) == Belief::Unknown {
            walls.set(cell, side, random.next_u32() % 100 < share);
        }
    }
    Maze::new(walls, maze.start(), maze.goal()).expect("the same start and goal")
}

/// In every match of every bundled robot: the audit never claims more than is true of the maze and
/// of random mazes in which the robot would have read the same until then.
#[track_caller]
fn check_claims(mazes: &[&str]) {
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    let robots = [
        "champion",
        "flood",
        "flood:1",
        "minnett",
        "rai",
        "dfs",
        "count-expansion",
        "lobato",
        "random",
        "wall-follower",
    ];
    let keep = ["--replays", "r", "--keep", "all", "--trust"];
    let ran = run(folder, &[&["run"], &robots[..], mazes, &keep].concat());
    assert!(matches!(ran.status.code(), Some(0 | 6)), "{}", ran.stderr);
    let files = replays(&folder.join("r"));
    assert_eq!(files.len(), robots.len() * mazes.len());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut certain, mut compared) = (0, 0);
    for file in files {
        let replay = read(&file);
        let playback = replay.playback();
        let (maze, audit) = (playback.maze(), playback.audit());
        let longest_move = playback.rules().longest_move;
        let optimum = |maze: &Maze| oracle_steps(maze, longest_move).map(|it| it.speed_steps);
        let truth = optimum(maze).expect("a solvable maze");
        for step in &audit.steps {
            assert!(step.outlook.optimistic.is_some_and(|it| it <= truth));
            assert!(step.outlook.pessimistic.is_none_or(|it| it >= truth));
        }
        let Some(position) = audit.certain_at else {
            continue;
        };
        certain += 1;
        let knowledge = playback.knowledge(position);
        for _ in 0..20 {
            let other = consistent(&knowledge, maze, &mut random);
            assert_eq!(optimum(&other), Some(truth), "{}", file.display());
            let mut simulation = Simulation::new(&other, playback.rules());
            for step in &playback.trace().steps()[..position] {
                assert_eq!(simulation.sense(), step.sensors);
                simulation.apply(step.action);
            }
            let at = playback.at(position);
            assert_eq!(Sensors::at(&other, at.cell, at.heading), at.sensors);
            assert_eq!(
                (simulation.cell(), simulation.heading()),
                (at.cell, at.heading)
            );
            compared += usize::from(other != *maze);
        }
        // Before that, some maze had another optimum.
        if let Some(before) = position.checked_sub(1) {
            let knowledge = playback.knowledge(before);
            let bounds = [knowledge.optimistic(), knowledge.pessimistic()];
            assert_ne!(
                optimum(&bounds[0]),
                optimum(&bounds[1]),
                "{}",
                file.display()
            );
        }
    }
    assert!(certain >= 4 * mazes.len(), "{certain}");
    assert!(compared >= 40 * mazes.len(), "{compared}");
}

#[test]
fn proven_is_never_claimed_falsely() {
    check_claims(&[
        "test_maze_01",
        "gen:tree:14:7",
        "gen:braid:16:3",
        "gen:division:12:5",
    ]);
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn proven_is_never_claimed_falsely_in_the_official_mazes() {
    let maze = |number| shared().join(format!("mazes/udacity/test_maze_0{number}.txt"));
    let mazes = [1, 2, 3].map(maze);
    let mazes: Vec<&str> = mazes
        .iter()
        .map(|it| it.to_str().expect("Unicode"))
        .collect();
    check_claims(&mazes);
}
