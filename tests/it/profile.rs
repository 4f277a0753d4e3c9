//! Profiles: the sum is the fuel of the match, functions have their names, and whatever ends a
//! match, the profile says what it was spent on.

use std::fs;

use wasmouse_core::game::{SandboxLimits, Verdict};
use wasmouse_engine::bundled::bundled;
use wasmouse_engine::{DetailedMatch, Executor as _, InProcess, Limits, Profile};
use wasmouse_tests::binary::{Ran, ran, wasmouse};
use wasmouse_tests::module::{IMPORT_LOG, Module};

use crate::hostile::SMALL;
use crate::matches::{bundled_mazes, rules, spec};

/// Plays a match in the first bundled maze twice, the second time with a profile.
#[track_caller]
fn profiled(limits: Limits, file: &[u8], variant: u32) -> (DetailedMatch, Profile) {
    let executor = InProcess::new(limits, 1, None).expect("address space for one match");
    let robot = executor.admit(file).expect("the host works");
    let robot = robot.expect("a robot");
    let (_, maze) = &bundled_mazes()[0];
    let spec = spec(&rules(limits.sandbox), robot.digest(), maze, (variant, 0));
    let played = executor.execute_with_details(&robot, &spec);
    let played = played.expect("the host works");
    let profile = executor.profile(&robot, file, &spec, &played);
    let profile = profile.expect("the host works").expect("a profile");
    let fuel = played.record.fuel;
    assert_eq!(profile.fuel(), fuel.start + fuel.steps);
    (played, profile)
}

/// The name of the function that used most fuel itself.
fn hottest(profile: &Profile) -> &str {
    let costs = profile.costs().into_iter().enumerate();
    let (at, _) = costs.max_by_key(|(_, cost)| cost.own).expect("a function");
    profile.functions[at].name.raw()
}

/// Every call of every bundled robot, to the last unit.
#[test]
fn the_sum_of_a_profile_is_the_fuel_of_the_match() {
    let limits = Limits::with_sandbox(SandboxLimits::default());
    for robot in bundled() {
        let variant = robot.variants.first().map_or(0, |it| it.value);
        let (played, profile) = profiled(limits, robot.component, variant);
        assert!(
            profile
                .functions
                .iter()
                .all(|it| !it.name.as_guest().starts_with("wasm-function["))
        );
        let calls = profile.nodes.iter().filter(|it| it.parent.is_none());
        let steps = calls.filter(|it| {
            let name = &profile.functions[it.function as usize].name;
            name.raw().ends_with("#next-move")
        });
        let steps: u64 = steps.map(|it| it.calls).sum();
        assert_eq!(
            steps,
            played.recording.step_fuel.len() as u64,
            "{}",
            robot.name
        );
    }
}

/// A match that ends in a fault has a profile of everything until then.
#[test]
fn faults_of_all_kinds_have_profiles() {
    let robot = |next: &str, rest: &str| {
        Module {
            imports: IMPORT_LOG,
            next,
            rest,
            ..Module::default()
        }
        .component()
    };
    let burn = "(func $burn (local $left i32) (local.set $left (i32.const 1000))
        (loop $again
            (br_if $again (local.tee $left (i32.sub (local.get $left) (i32.const 1))))))";
    for (robot, fault, name) in [
        (
            robot("(call $burn) unreachable", burn),
            "unreachable",
            "burn",
        ),
        // No call and no return tells how far it has come.
        (
            robot(
                "(call $forever) unreachable",
                "(func $forever (loop $again (br $again)))",
            ),
            "out-of-step-fuel",
            "forever",
        ),
        (
            robot("(loop $again (call $burn) (br $again)) unreachable", burn),
            "out-of-step-fuel",
            "burn",
        ),
        // With wrappers, the stack overflows at another depth.
        (
            robot(
                "(call $deep (i32.const 1)) unreachable",
                "(func $deep (param i32) (call $deep (i32.add (local.get 0) (i32.const 1))))",
            ),
            "stack-overflow",
            "deep",
        ),
        // The host takes fuel, too.
        (
            robot(
                "(call $chatter) unreachable",
                "(func $chatter (loop $again
                    (call $log (i32.const 1) (i32.const 32) (i32.const 1000)) (br $again)))",
            ),
            "out-of-step-fuel",
            // What the component has between the module and the host.
            "wasm-function[0]",
        ),
    ] {
        let (played, profile) = profiled(SMALL, &robot, 0);
        let Verdict::Fault { fault: found } = played.record.verdict else {
            panic!("{name} does not fail");
        };
        assert_eq!(found.kind.name(), fault);
        let hottest = hottest(&profile);
        assert!(hottest.ends_with(name), "{hottest}");
    }
}

/// Runs a command line.
fn run(arguments: &str) -> Ran {
    let mut command = wasmouse();
    ran(command.args(arguments.split_whitespace()))
}

/// The same bytes in this process and in a worker, and the fuel that `run` reports.
#[test]
fn a_profile_is_the_same_everywhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let flood = bundled().iter().find(|it| it.name == "flood");
    let file = path("flood.wasm");
    fs::write(&file, flood.expect("a bundled robot").component).expect("a file");
    let line = format!("profile {file} --maze tree-16 --format folded");
    let sandboxed = run(&line);
    assert_eq!(sandboxed.status.code(), Some(0), "{}", sandboxed.stderr);
    let trusted = run(&format!("{line} --trust"));
    assert_eq!(trusted.stdout, sandboxed.stdout);
    let weights = sandboxed
        .stdout
        .lines()
        .filter_map(|it| it.rsplit_once(' '));
    let sum: u64 = weights.map(|it| it.1.parse::<u64>().expect("fuel")).sum();
    let json = run(&format!("run {file} tree-16 --json")).stdout;
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let fuel = &json["matches"][0]["fuel"];
    let number = |key: &str| fuel[key].as_u64().expect("a number");
    assert_eq!(sum, number("start") + number("steps"));
    let hot = "<robot_flood::Flood as wasmouse_sdk::robot::Robot>::next_move;robot_flood::";
    assert!(sandboxed.stdout.contains(hot), "{}", sandboxed.stdout);

    let output = path("flood.speedscope.json");
    let line = format!("profile {file} --maze tree-16 --functions 1 -o {output}");
    let Ran { stdout, status, .. } = run(&line);
    assert_eq!(status.code(), Some(0));
    assert!(stdout.contains("search::packed::spread"), "{stdout}");
    let written = fs::read_to_string(&output).expect("a profile");
    let profile: serde_json::Value = serde_json::from_str(&written).expect("JSON");
    assert_eq!(profile["profiles"][0]["endValue"], sum);
    assert_eq!(run(&line).status.code(), Some(3), "it already exists");
}

/// Functions without names have their index; exported ones, the name of the export.
#[test]
fn functions_without_names_are_numbered() {
    let (_, profile) = profiled(
        SMALL,
        &Module {
            next: "(call 0) i32.const 16",
            rest: "(func (nop))",
            ..Module::default()
        }
        .component(),
        0,
    );
    let names: Vec<&str> = profile.functions.iter().map(|it| it.name.raw()).collect();
    assert!(names.contains(&"wasm-function[0]"), "{names:?}");
    assert!(
        names.iter().any(|it| it.ends_with("#next-move")),
        "{names:?}"
    );
}
