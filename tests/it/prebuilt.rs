//! The prebuilt robots are those of the sources, of the manifest and of the host.

use std::fs;
use std::path::Path;

use wasmouse_core::game::{FaultKind, Phase, SandboxLimits};
use wasmouse_engine::bundled::{bundled, find};
use wasmouse_engine::{
    Executor as _, Frame, FramePart, InProcess, Limits, Origin, Recording, Runtime,
};
use xtask::manifest::Manifest;
use xtask::verify::BUILT_ROBOTS_VARIABLE;
use xtask::{repository, robots};

use crate::matches::{bundled_mazes, rules, spec, variants};

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

/// Robots that were built from source just now play as the prebuilt ones do.
/// Fuel is not compared: another compiler may need other instructions.
#[test]
fn robots_built_from_source_play_the_same_matches() {
    let Some(built) = std::env::var_os(BUILT_ROBOTS_VARIABLE) else {
        println!("skipped: `cargo xtask test` builds the robots from source for this test");
        return;
    };
    let rules = rules(SandboxLimits::default());
    let runtime = Runtime::new(Limits::default(), 1, None).expect("address space");
    for prebuilt in bundled() {
        let file = Path::new(&built).join(prebuilt.name).with_extension("wasm");
        let source = fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let admit = |bytes: &[u8]| runtime.admit(bytes).expect("bundled robots are admitted");
        let robots = [admit(prebuilt.component), admit(&source)];
        for (variant, _) in variants(prebuilt) {
            for (maze_name, maze) in bundled_mazes() {
                let [expected, found] = robots.each_ref().map(|robot| {
                    let spec = spec(&rules, robot.digest(), &maze, (variant, 1));
                    let mut recording = Recording::default();
                    let played = runtime.run(robot, &spec, &mut recording);
                    let (result, _) = played.expect("the host works");
                    (result, recording.transcript)
                });
                assert_eq!(found, expected, "{}:{variant}, {maze_name}", prebuilt.name);
            }
        }
    }
}

/// A variant that no bundled robot has.
const NO_VARIANT: u32 = 1000;

/// A panic of a Rust robot reaches the verdict with its message and place, through the hook
/// that `export_robot!` installs while the component is instantiated.
#[test]
fn a_panic_says_what_and_where() {
    let (executor, rules) = (executor(), rules(SandboxLimits::default()));
    let (_, maze) = &bundled_mazes()[0];
    for robot in bundled() {
        let admitted = executor.admit(robot.component).expect("the host works");
        let admitted = admitted.expect("a bundled robot");
        let spec = spec(&rules, admitted.digest(), maze, (NO_VARIANT, 0));
        let played = executor.execute_with_details(&admitted, &spec);
        let verdict = played.expect("the host works").record.verdict;
        let fault = verdict.fault().expect("a panic");
        let found = (fault.kind, fault.phase, fault.step);
        assert_eq!(found, (FaultKind::Panic, Phase::Start, 0), "{}", robot.name);
        let source = format!("(example-robots/{}/src/lib.rs:", robot.name);
        let detail = fault.detail.raw();
        assert!(detail.starts_with("panicked: "), "{detail}");
        assert!(detail.contains("variant"), "{detail}");
        assert!(
            detail.contains(&source) && detail.ends_with(')'),
            "{detail}"
        );
    }
}

/// The backtrace of a panic shows the robot's functions and not those that report it.
#[test]
fn a_backtrace_hides_the_runtime() {
    let (executor, rules) = (executor(), rules(SandboxLimits::default()));
    let (_, maze) = &bundled_mazes()[0];
    let file = find("flood").expect("a bundled robot").component;
    let robot = executor.admit(file).expect("the host works");
    let robot = robot.expect("a bundled robot");
    let spec = spec(&rules, robot.digest(), maze, (NO_VARIANT, 0));
    let played = executor.execute_with_details(&robot, &spec);
    let verdict = played.expect("the host works").record.verdict;
    let fault = verdict.fault().expect("a panic");
    let frames = executor.backtrace(&robot, file, &spec, fault);
    let frames = frames.expect("the host works").expect("the same fault");
    let parts = Frame::folded(&frames);
    assert!(
        matches!(parts[0], FramePart::Folded { of: Origin::Rust, frames } if frames > 1),
        "{frames:?}"
    );
    let of_robot = parts.iter().filter_map(|part| match part {
        FramePart::Frame(frame) => Some(frame.function.raw()),
        FramePart::Folded { .. } => None,
    });
    let functions: Vec<&str> = of_robot.collect();
    assert!(functions[0].starts_with("<robot_flood::"), "{functions:?}");
    for hidden in ["panicking", "rust_", "function 0", "report_panics"] {
        assert!(
            !functions.iter().any(|it| it.contains(hidden)),
            "{functions:?}"
        );
    }
}

fn executor() -> InProcess {
    InProcess::new(Limits::default(), 1, None).expect("address space for one match")
}
