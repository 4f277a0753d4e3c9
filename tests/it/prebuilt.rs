//! The prebuilt robots are those of the sources, of the manifest and of the host.

use std::fs;
use std::path::Path;

use wasmouse::maze::{self, format};
use wasmouse::robot::bundled::{BundledRobot, bundled};
use wasmouse::robot::{Game, Host, Outcome, Recorder, Robot};
use wasmouse::sim::Ruleset;
use xtask::manifest::Manifest;
use xtask::verify::BUILT_ROBOTS_VARIABLE;
use xtask::{repository, robots};

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
        let settings: Vec<_> = embedded
            .settings
            .iter()
            .map(|it| (it.value, it.name, it.description))
            .collect();
        let expected: Vec<_> = listed
            .settings
            .iter()
            .map(|it| (it.value, it.name.as_str(), it.description.as_str()))
            .collect();
        assert_eq!(settings, expected, "{}", embedded.name);
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
        for setting in settings(prebuilt) {
            for bundled_maze in maze::bundled() {
                let parsed = format::parse(bundled_maze.text).expect("bundled mazes parse");
                let game = Game {
                    maze: &parsed.maze,
                    rules: &rules,
                    seed: 1,
                    setting,
                };
                let (expected, expected_record) = play(&host, &prebuilt_robot, &game);
                let (found, found_record) = play(&host, &source_robot, &game);
                let place = format!(
                    "{}, setting {setting}, {}",
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

fn settings(robot: &BundledRobot) -> Vec<u32> {
    if robot.settings.is_empty() {
        return vec![0];
    }
    robot.settings.iter().map(|setting| setting.value).collect()
}

fn play(host: &Host, robot: &Robot, game: &Game<'_>) -> (Outcome, Recorder) {
    let mut recorder = Recorder::default();
    let outcome = host
        .play(robot, game, &mut recorder)
        .expect("the host does not fail");
    (outcome, recorder)
}
