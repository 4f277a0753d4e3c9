//! A short run of every fuzz target, the same each time, and random robots in whole
//! contests. `cargo xtask fuzz` runs long.

use wasmouse::maze::generate::GenSpec;
use wasmouse::robot::bundled::find;
use wasmouse::sim::Ruleset;
use wasmouse_tests::fuzz::{Bench, Fuzzer, Target, strangers, targets};

use crate::binary::{ran, wasmouse};

#[track_caller]
fn check(name: &str) {
    let find = |target: &Target| target.name == name;
    let target = targets().into_iter().find(find).expect("a target");
    let mut fuzzer = Fuzzer::new(target, 1);
    for _ in 0..target.short {
        let input = fuzzer.next_input();
        if let Some(finding) = fuzzer.feed(input) {
            panic!("{finding:?}");
        }
    }
    let summary = fuzzer.summary();
    // Inputs that are all refused for the same reason would prove nothing.
    assert!(summary.behaviours >= 6, "{summary:?}");
    println!("{name}: {summary:?}");
}

#[test]
fn mazes() {
    check("mazes");
}

#[test]
fn specifications() {
    check("specifications");
}

#[test]
fn results() {
    check("results");
}

#[test]
fn admission() {
    check("admission");
}

#[test]
fn answers() {
    check("answers");
}

#[test]
fn requests() {
    check("requests");
}

#[test]
fn matches() {
    check("matches");
}

#[test]
fn differential() {
    check("differential");
}

/// Robots that play whole contests, in whole matches.
#[test]
fn bundled_robots_play_the_same_on_all_engines() {
    let bench = Bench::new(Ruleset::default());
    let mazes: GenSpec = "gen:braid:12:3".parse().expect("a specification");
    let (_, maze) = mazes.expand().next().expect("one maze");
    for name in ["flood", "random", "lobato"] {
        let file = find(name).expect("a bundled robot").component;
        let ended = bench.compare(file, &maze);
        assert!(
            ended.starts_with("finished") || name == "random",
            "{name}: {ended}"
        );
    }
}

/// Random robots among each other: alone or eight at a time, in this process or in
/// workers, every byte of the result is the same.
#[test]
fn random_robots_play_the_same_on_one_thread_and_on_eight() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = strangers();
    for (number, file) in files.iter().enumerate() {
        let path = folder.path().join(format!("{number:03}.wasm"));
        std::fs::write(path, file).expect("a file");
    }
    let run = |options: &[&str]| {
        let mut command = wasmouse();
        command.args(["run", "--json", "--cache", "cache", "flood"]);
        command.args((0..files.len()).map(|number| format!("{number:03}.wasm")));
        command.arg("test_maze_01");
        let played = ran(command.args(options).current_dir(folder.path()));
        assert_eq!(played.status.code(), Some(4), "{}", played.stderr);
        played.stdout
    };
    let expected = run(&["--jobs", "1"]);
    for options in [
        &["--jobs", "8"][..],
        &["--jobs", "8", "--trust"],
        &["--jobs", "1", "--trust"],
    ] {
        assert!(run(options) == expected, "{options:?}: other bytes");
    }
    let result: serde_json::Value = serde_json::from_str(&expected).expect("JSON");
    let robots = result["robots"].as_array().expect("a list").iter();
    let admitted = robots.filter(|robot| robot["refusal"].is_null()).count();
    println!("{admitted} of {} are admitted", files.len() + 1);
    assert!(admitted > 20, "only {admitted} play");
}
