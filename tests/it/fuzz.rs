//! A short run of every fuzz target, the same each time. `cargo xtask fuzz` runs long.

use wasmouse::maze::generate::GenSpec;
use wasmouse::robot::bundled::find;
use wasmouse::sim::Ruleset;
use wasmouse_tests::fuzz::{Bench, Fuzzer, Target, targets};

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
