//! What holds for every bundled robot in every variant: natively it plays the match that its
//! component plays, its map never contradicts the maze, and it finishes legal mazes unless it is
//! known not to.

use std::collections::BTreeMap;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::Arc;
use std::thread;

use wasmouse_core::game::{SandboxLimits, Simulation};
use wasmouse_core::maze::Maze;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::{GENERATED_DIMENSIONS, GenSpec, Kind};
use wasmouse_core::record::{MatchSpec, trace};
use wasmouse_engine::bundled::{BundledRobot, bundled};
use wasmouse_engine::{Executor, InProcess, Limits};
use wasmouse_sdk::testing::{self, PlayOptions, Played};

use crate::matches::{bundled_mazes, generated_mazes, rules, spec, variants};
use crate::sdk_arena;
use crate::shared::shared_text;

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

/// Who need not finish: the robot, or one of its variants.
const MAY_FAIL: &[&str] = &["dfs:pure", "random", "wall-follower"];

/// Who has no map to show, or shows none.
const WITHOUT_MAP: &[&str] = &["random", "wall-follower"];

/// Walls that every robot with a map knows at the end of a match in any legal maze.
const KNOWN_WALLS_MIN: u32 = 40;

/// Fuel of a match beyond which a robot counts as slow: unoptimised, as in these
/// tests, it plays natively for many seconds, and plays only a sample of the mazes.
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
    let (mazes, rules) = (mazes(), rules(SandboxLimits::default()));
    let executor = executor();
    for (robot, (_, native)) in bundled().iter().zip(NATIVE) {
        let admitted = executor.admit(robot.component).expect("the host works");
        let admitted = admitted.expect("a bundled robot");
        for (variant, name) in variants(robot) {
            for (maze_name, text, maze) in &mazes {
                let place = format!("{}:{name} in {maze_name}", robot.name);
                let spec = spec(&rules, admitted.digest(), maze, (variant, 1));
                let there = executor.execute_with_details(&admitted, &spec);
                let there = there.expect("the host works");
                let transcript = &there.recording.transcript;
                let (_, trace) = trace(maze, &rules.game, transcript).expect("a replay");

                // The simulation, fed with the native actions, agrees with every native reading
                // and gives the same trace.
                let options = PlayOptions {
                    variant,
                    ..sdk_arena::options(&rules.game, 1)
                };
                let here = native(text, &options);
                let simulation = Simulation::new(maze, &rules.game);
                let native = sdk_arena::trace_of(simulation, &here, &place);
                let mut steps = native.steps().iter().zip(trace.steps());
                let differs = steps.position(|(native, component)| native != component);
                assert_eq!(differs, None, "{place}: the first step that differs");
                assert_eq!(native.steps().len(), trace.steps().len(), "{place}");
                let finished = there.record.verdict.score().is_some();
                assert_eq!(here.finished, finished, "{place}");
                if there.record.fuel.steps > SLOW_FUEL {
                    println!("skipped: {place} is slow; the mazes after it are left out");
                    break;
                }
            }
        }
    }
}

/// No robot fails in the official mazes, and flood finishes all three: with its first path, and
/// with the best one.
#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn flood_finishes_the_official_mazes() {
    let mazes = ["test_maze_01", "test_maze_02", "test_maze_03"].map(|name| {
        let text = shared_text(&format!("mazes/udacity/{name}.txt"));
        (name, Arc::new(format::parse(&text).expect("a maze").maze))
    });
    let (executor, rules) = (executor(), rules(SandboxLimits::default()));
    for robot in bundled() {
        let admitted = executor.admit(robot.component).expect("the host works");
        let admitted = admitted.expect("a bundled robot");
        for (variant, _) in variants(robot) {
            let scores = mazes.each_ref().map(|(name, maze)| {
                let spec = spec(&rules, admitted.digest(), maze, (variant, 0));
                let played = executor.execute_with_details(&admitted, &spec);
                let verdict = played.expect("the host works").record.verdict;
                assert_eq!(verdict.fault(), None, "{}:{variant} in {name}", robot.name);
                verdict.score().map(|score| score.thousandths())
            });
            match (robot.name, variant) {
                ("flood", 0) => assert_eq!(scores, [22_033, 30_267, 46_067].map(Some)),
                ("flood", 1) => assert_eq!(scores, [21_867, 28_433, 34_367].map(Some)),
                _ => {}
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

/// Seeds of generated mazes that no robot was fitted to.
const SEEDS: RangeInclusive<u64> = 500_001..=500_100;

/// The generated mazes of every kind and contest size with these seeds.
fn families(seeds: &RangeInclusive<u64>) -> Vec<(String, Arc<Maze>)> {
    let families = Kind::ALL.into_iter().flat_map(|kind| {
        let spec = GenSpec::new(kind, GENERATED_DIMENSIONS, seeds.clone());
        generated_mazes(&spec.expect("a few seeds").to_string())
    });
    families.collect()
}

/// The bundled mazes, and one of each kind and size.
fn mazes() -> Vec<(String, String, Arc<Maze>)> {
    let first = *SEEDS.start();
    let bundled = bundled_mazes().into_iter();
    let bundled = bundled.map(|(name, maze)| (name.to_owned(), maze));
    let all = bundled.chain(families(&(first..=first)));
    all.map(|(name, maze)| {
        let text = format::print(&maze, Format::Udacity).expect("a contest maze");
        (name, text, maze)
    })
    .collect()
}

/// One maze of each kind and size for every robot, and twenty for those that are not slow.
#[test]
fn robots_finish_a_sample_of_legal_mazes() {
    let first = *SEEDS.start();
    let fuel = check_finished(&(first..=first), |_| true);
    check_finished(&(first + 1..=first + 19), |name| fuel[name] <= SLOW_FUEL);
}

#[test]
#[ignore = "plays thousands of mazes with every robot, which takes many minutes"]
fn robots_finish_thousands_of_legal_mazes() {
    check_finished(&SEEDS, |_| true);
}

fn executor() -> InProcess {
    let robots = u32::try_from(bundled().len()).expect("a few robots");
    InProcess::new(Limits::default(), robots, None).expect("address space")
}

/// Plays mazes of every kind and size with the chosen robots of those that must finish, requires
/// that they do, and returns the fuel of the most expensive match of each robot and variant.
fn check_finished(
    seeds: &RangeInclusive<u64>,
    is_chosen: impl Fn(&str) -> bool + Sync,
) -> BTreeMap<String, u64> {
    let executor = executor();
    let (rules, mazes) = (rules(SandboxLimits::default()), families(seeds));
    let play = |robot: &BundledRobot| {
        let mut fuel = BTreeMap::new();
        let admitted = executor.admit(robot.component).expect("the host works");
        let admitted = admitted.expect("a bundled robot");
        for (variant, variant_name) in variants(robot) {
            let name = format!("{}:{variant_name}", robot.name);
            let may_fail = MAY_FAIL.iter().any(|it| *it == name || *it == robot.name);
            if may_fail || !is_chosen(&name) {
                continue;
            }
            let specs = mazes.iter();
            let specs = specs.map(|(_, it)| spec(&rules, admitted.digest(), it, (variant, 0)));
            let specs: Vec<MatchSpec> = specs.collect();
            let (mut most, mut names) = (0, mazes.iter().map(|(name, _)| name));
            let flow = executor.execute(&admitted, &specs, &mut |_, played| {
                let record = played.expect("the host works").record;
                let maze = names.next().expect("a maze for each match");
                let finished = record.verdict.score().is_some();
                assert!(finished, "{name} in {maze}: {}", record.verdict.title());
                most = most.max(record.fuel.steps);
                ControlFlow::Continue(())
            });
            assert!(flow.is_continue() && names.next().is_none(), "{name}");
            fuel.insert(name, most);
        }
        fuel
    };
    let play = &play;
    thread::scope(|scope| {
        let robots = bundled().iter();
        let threads: Vec<_> = robots.map(|it| scope.spawn(move || play(it))).collect();
        let fuel = threads.into_iter().map(|it| it.join().expect("finished"));
        fuel.flatten().collect()
    })
}
