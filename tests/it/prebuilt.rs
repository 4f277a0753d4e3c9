//! The prebuilt robots are those of the sources, of the manifest and of the host.

use std::fs;
use std::path::Path;

use wasmouse::maze::{self, format};
use wasmouse::robot::bundled::{BundledRobot, bundled};
use wasmouse::robot::{FaultKind, Game, Host, Outcome, Phase, Recorder, Robot, Verdict};
use wasmouse::sim::Ruleset;
use xtask::manifest::Manifest;
use xtask::verify::BUILT_ROBOTS_VARIABLE;
use xtask::{repository, robots};

use crate::binary::{ran, wasmouse};

#[test]
fn no_prebuilt_robot_is_stale() {
    let problems = robots::problems(&repository()).expect("the manifest and the sources");
    assert!(
        problems.is_empty(),
        "run `cargo xtask robots` and commit the result:\n{}",
        problems.join("\n")
    );
}

#[test]
fn the_host_embeds_what_the_manifest_lists() {
    let manifest = Manifest::load(&repository()).expect("the manifest");
    assert_eq!(bundled().len(), manifest.robots.len());
    for (embedded, listed) in bundled().iter().zip(&manifest.robots) {
        assert_eq!(embedded.name, listed.name);
        assert_eq!(embedded.description, listed.description);
        assert_eq!(embedded.sha256, listed.sha256);
        assert_eq!(xtask::sources::sha256(embedded.component), listed.sha256);
        assert_eq!(embedded.component.len(), listed.size_bytes);
        let variants: Vec<_> = embedded
            .variants
            .iter()
            .map(|it| (it.value, it.name, it.description))
            .collect();
        let expected: Vec<_> = listed
            .variants
            .iter()
            .map(|it| (it.value, it.name.as_str(), it.description.as_str()))
            .collect();
        assert_eq!(variants, expected, "{}", embedded.name);
    }
}

/// Robots that were built from source just now answer as the prebuilt ones do.
/// Fuel is not compared: another compiler may need other instructions.
#[test]
fn robots_built_from_source_play_the_same_matches() {
    let Some(built) = std::env::var_os(BUILT_ROBOTS_VARIABLE) else {
        println!("skipped: `cargo xtask test` builds the robots from source for this test");
        return;
    };
    let rules = Ruleset::default();
    let host = Host::new(rules.limits, 1, None).expect("address space for one match");
    for prebuilt in bundled() {
        let file = Path::new(&built).join(prebuilt.name).with_extension("wasm");
        let source = fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let admit = |bytes: &[u8]| host.admit(bytes).expect("bundled robots are admitted");
        let (prebuilt_robot, source_robot) = (admit(prebuilt.component), admit(&source));
        for variant in variants(prebuilt) {
            for bundled_maze in maze::bundled() {
                let parsed = format::parse(bundled_maze.text).expect("bundled mazes parse");
                let game = Game {
                    maze: &parsed.maze,
                    rules: &rules,
                    seed: 1,
                    setting: variant,
                };
                let (expected, expected_record) = play(&host, &prebuilt_robot, &game);
                let (found, found_record) = play(&host, &source_robot, &game);
                let place = format!(
                    "{}, variant {variant}, {}",
                    prebuilt.name, bundled_maze.name
                );
                assert_eq!(found.verdict, expected.verdict, "{place}");
                assert_eq!(found.steps, expected.steps, "{place}");
                assert_eq!(found.counts, expected.counts, "{place}");
                assert_eq!(found_record.trace, expected_record.trace, "{place}");
            }
        }
    }
}

/// A panic of a Rust robot reaches the verdict with its message and place, through the hook
/// that `export_robot!` installs while the component is instantiated.
#[test]
fn a_panic_says_what_and_where() {
    let rules = Ruleset::default();
    let host = Host::new(rules.limits, 1, None).expect("address space for one match");
    let maze = format::parse(maze::bundled()[0].text)
        .expect("bundled mazes parse")
        .maze;
    for robot in bundled() {
        let admitted = host.admit(robot.component).expect("a bundled robot");
        let game = Game {
            maze: &maze,
            rules: &rules,
            seed: 0,
            setting: 1000,
        };
        let (outcome, _) = play(&host, &admitted, &game);
        let Verdict::Fault(fault) = outcome.verdict else {
            panic!("{} has no variant 1000", robot.name);
        };
        let found = (fault.kind, fault.phase, fault.step);
        assert_eq!(found, (FaultKind::Panic, Phase::Start, 0), "{}", robot.name);
        let source = format!("(example-robots/{}/src/lib.rs:", robot.name);
        let detail = &fault.detail;
        assert!(
            detail.starts_with("panicked: ") && detail.contains("variant"),
            "{detail}"
        );
        assert!(
            detail.contains(&source) && detail.ends_with(')'),
            "{detail}"
        );
    }
}

/// The backtrace of a panic shows the robot's functions and not those that report it.
#[test]
fn a_panic_is_explained_without_the_runtime() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flood = bundled().iter().find(|robot| robot.name == "flood");
    let file = folder.path().join("flood.wasm");
    fs::write(&file, flood.expect("a bundled robot").component).expect("a writable folder");
    let ran = ran(wasmouse()
        .args(["run", "flood.wasm:1000", "--no-cache"])
        .current_dir(&folder));
    for shown in ["0: <robot_flood::", "frames of the Rust runtime hidden)"] {
        assert!(ran.stderr.contains(shown), "{shown}: {}", ran.stderr);
    }
    for hidden in ["panicking", "rust_", "function 0", "report_panics"] {
        assert!(!ran.stderr.contains(hidden), "{hidden}: {}", ran.stderr);
    }
}

fn variants(robot: &BundledRobot) -> Vec<u32> {
    if robot.variants.is_empty() {
        return vec![0];
    }
    robot.variants.iter().map(|variant| variant.value).collect()
}

fn play(host: &Host, robot: &Robot, game: &Game<'_>) -> (Outcome, Recorder) {
    let mut recorder = Recorder::default();
    let outcome = host
        .play(robot, game, &mut recorder)
        .expect("the host does not fail");
    (outcome, recorder)
}
