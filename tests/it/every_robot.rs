//! What holds for every bundled robot in every variant: natively it plays the match
//! that its component plays, its map never contradicts the maze, and it finishes legal
//! mazes unless it is known not to.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use wasmouse::contest::{Contest, ContestMaze, Entrant, STUDY_SEEDS, study_families};
use wasmouse::maze::format::{self, Format};
use wasmouse::maze::{self, Maze};
use wasmouse::robot::bundled::{BundledRobot, bundled};
use wasmouse::robot::{
    Digest, Game, Host, Isolation, Outcome, Player, Recorder, Referee, Trust, Verdict,
};
use wasmouse::sim::{Ruleset, Simulation, Trace};
use wasmouse_sdk::testing::{self, PlayOptions, Played};

use crate::sdk_arena;

/// Plays a robot natively.
type Native = fn(&str, &PlayOptions) -> Played;

/// The bundled robots by name, as Rust types. A robot that is missing fails
/// [`every_bundled_robot_is_in_the_table`].
const NATIVE: &[(&str, Native)] = &[
    ("champion", testing::play::<robot_champion::Champion>),
    (
        "count-expansion",
        testing::play::<robot_count_expansion::CountExpansion>,
    ),
    ("dfs", testing::play::<robot_dfs::DepthFirst>),
    ("flood", testing::play::<robot_flood::Flood>),
    ("lobato", testing::play::<robot_lobato::Lobato>),
    ("minnett", testing::play::<robot_minnett::Minnett>),
    ("rai", testing::play::<robot_rai::Rai>),
    ("random", testing::play::<robot_random::RandomWalk>),
    (
        "wall-follower",
        testing::play::<robot_wall_follower::WallFollower>,
    ),
];

/// Who need not finish: robot, and the variant if it is only one of them.
const MAY_FAIL: &[(&str, Option<&str>)] = &[
    ("dfs", Some("pure")),
    ("random", None),
    ("wall-follower", None),
];

/// Who has no map to show, or shows none.
const WITHOUT_MAP: &[&str] = &["random", "wall-follower"];

/// Walls that every robot with a map knows at the end of a match in any legal maze.
const KNOWN_WALLS_MIN: u32 = 40;

/// Fuel of a match beyond which a robot counts as slow: unoptimised, as in these
/// tests, it plays natively for many seconds, and a sample of mazes has to do.
const SLOW_FUEL: u64 = 200_000_000;

#[test]
fn every_bundled_robot_is_in_the_table() {
    let names: Vec<&str> = NATIVE.iter().map(|&(name, _)| name).collect();
    let bundled: Vec<&str> = bundled().iter().map(|robot| robot.name).collect();
    assert_eq!(
        names, bundled,
        "add the robot to `NATIVE` and to tests/Cargo.toml"
    );
}

/// In the bundled mazes and in a generated one of each family and size.
#[test]
fn natively_robots_play_the_match_of_their_component() {
    let (mazes, rules) = (mazes(), Ruleset::default());
    let host = Host::new(rules.limits, 1, None).expect("address space for one match");
    for (robot, (_, native)) in bundled().iter().zip(NATIVE) {
        let component = host.admit(robot.component).expect("an admitted robot");
        for (variant, name) in variants(robot) {
            for (maze_name, text, maze) in &mazes {
                let game = Game {
                    maze,
                    rules: &rules,
                    seed: 1,
                    setting: variant,
                };
                let mut recorder = Recorder::default();
                let outcome = host.play(&component, &game, &mut recorder);
                let outcome = outcome.expect("the host does not fail");
                let options = PlayOptions {
                    variant,
                    ..sdk_arena::options(&rules, game.seed)
                };
                let played = native(text, &options);
                let place = format!("{}:{name} in {maze_name}", robot.name);
                check_same(maze, &played, &outcome, &recorder.trace, &place);
                if outcome.fuel.steps > SLOW_FUEL {
                    println!("skipped: {place} is slow; the mazes after it are left out");
                    break;
                }
            }
        }
    }
}

/// What a robot believes about a wall, seen or inferred, is true after every step of
/// every match; and it knows something.
#[test]
fn no_map_contradicts_the_maze() {
    let mazes = mazes();
    for (robot, (_, native)) in bundled().iter().zip(NATIVE) {
        for (variant, name) in variants(robot) {
            for (maze_name, text, _) in &mazes {
                let place = format!("{}:{name} in {maze_name}", robot.name);
                let played = native(text, &PlayOptions::of_variant(variant));
                if WITHOUT_MAP.contains(&robot.name) {
                    assert_eq!(played.map, None, "{place}: strike it off `WITHOUT_MAP`");
                    break;
                }
                let audit = played.map.expect("a map, or a place in `WITHOUT_MAP`");
                assert_eq!(audit.first_error, None, "{place}");
                assert!(audit.known >= KNOWN_WALLS_MIN, "{place}: {audit:?}");
            }
        }
    }
}

/// The bundled mazes, and one of each family and size of the study.
fn mazes() -> Vec<(String, String, Maze)> {
    let first = *STUDY_SEEDS.start();
    let families = study_families(first..=first);
    let generated = families.into_iter().flat_map(|it| it.expand());
    let generated = generated.map(|(name, maze)| {
        let text = format::print(&maze, Format::Udacity).expect("a contest maze");
        (name, text, maze)
    });
    let bundled = maze::bundled().iter().map(|bundled| {
        let maze = format::parse(bundled.text).expect("a maze").maze;
        (bundled.name.to_owned(), bundled.text.to_owned(), maze)
    });
    bundled.chain(generated).collect()
}

/// The same answers to the same readings: the host's simulation, fed with the
/// native answers, agrees with every native reading and writes the trace of the
/// component.
fn check_same(maze: &Maze, played: &Played, outcome: &Outcome, trace: &Trace, place: &str) {
    let rules = Ruleset::default();
    let mut native = Trace::default();
    sdk_arena::check_against(Simulation::new(maze, &rules, &mut native), played, place);
    let mut steps = native.steps().iter().zip(trace.steps());
    let differs = steps.position(|(native, component)| native != component);
    assert_eq!(differs, None, "{place}: the first step that differs");
    assert_eq!(native.steps().len(), trace.steps().len(), "{place}");
    let steps = [played.exploration_steps, played.speed_steps];
    assert_eq!(steps, outcome.steps, "{place}");
    let finished = matches!(outcome.verdict, Verdict::Finished(_));
    assert_eq!(played.finished, finished, "{place}");
}

fn variants(robot: &BundledRobot) -> Vec<(u32, &'static str)> {
    if robot.variants.is_empty() {
        return vec![(0, "0")];
    }
    let variants = robot.variants.iter();
    variants
        .map(|variant| (variant.value, variant.name))
        .collect()
}

/// One maze of each family and size for every robot, and twenty for those that
/// are not slow.
#[test]
fn robots_finish_a_sample_of_legal_mazes() {
    let first = *STUDY_SEEDS.start();
    let referee = referee();
    let fuel = check_finished(&referee, entrants(&referee), first..=first);
    let mut quick = entrants(&referee);
    quick.retain(|entrant| fuel[&entrant.name] <= SLOW_FUEL);
    check_finished(&referee, quick, first + 1..=first + 19);
}

#[test]
#[ignore = "plays 2,000 mazes with every robot, which takes as long as `wasmouse study`"]
fn robots_finish_all_mazes_of_the_study() {
    let referee = referee();
    check_finished(&referee, entrants(&referee), STUDY_SEEDS);
}

/// Threads of the contests in these tests.
const THREADS: u32 = 2;

fn referee() -> Referee {
    Referee::new(Ruleset::default(), THREADS, None, Isolation::None)
}

/// The bundled robots in all variants in which they have to finish.
fn entrants(referee: &Referee) -> Vec<Entrant> {
    let may_fail = |robot: &str, variant: &str| {
        let is_it = |&(name, only): &(&str, Option<&str>)| {
            name == robot && only.is_none_or(|only| only == variant)
        };
        MAY_FAIL.iter().any(is_it)
    };
    let mut entrants = Vec::new();
    for robot in bundled() {
        let admitted = admit(referee, robot.component);
        for (variant, name) in variants(robot) {
            if !may_fail(robot.name, name) {
                entrants.push(Entrant {
                    name: format!("{}:{name}", robot.name),
                    digest: Digest::of(robot.component),
                    setting: variant,
                    admission: Ok(Arc::clone(&admitted)),
                });
            }
        }
    }
    entrants
}

fn admit(referee: &Referee, component: &[u8]) -> Arc<Player> {
    let admission = referee.admit(component, Trust::Trusted);
    match admission.expect("address space for two matches") {
        Ok(player) => Arc::new(player),
        Err(refusal) => panic!("refused: {refusal}"),
    }
}

/// Plays mazes of every family and size, requires that all matches are finished,
/// and returns the fuel of the most expensive match of each entrant.
fn check_finished(
    referee: &Referee,
    entrants: Vec<Entrant>,
    seeds: RangeInclusive<u64>,
) -> BTreeMap<String, u64> {
    let rules = Ruleset::default();
    let mazes = study_families(seeds).into_iter().flat_map(|it| it.expand());
    let contest = Contest {
        entrants,
        mazes: mazes
            .map(|(name, maze)| ContestMaze::new(name, maze, &rules))
            .collect(),
        seeds: vec![0],
        rules,
    };
    let played = contest.run(referee, THREADS as usize, &AtomicBool::new(false), &|| ());
    let results = played.expect("there are threads").results;
    assert_eq!(results.len(), contest.matches());
    let mut fuel = BTreeMap::new();
    let mut failures = Vec::new();
    for result in results {
        let name = &contest.entrants[result.entrant].name;
        let most: &mut u64 = fuel.entry(name.clone()).or_default();
        *most = (*most).max(result.outcome.fuel.steps);
        if !matches!(result.outcome.verdict, Verdict::Finished(_)) {
            let maze = &contest.mazes[result.maze].name;
            let verdict = result.outcome.verdict.title();
            failures.push(format!("{name} in {maze}: {verdict}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    fuel
}
