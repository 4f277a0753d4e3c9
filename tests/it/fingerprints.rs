//! Results do not change by accident: every bundled robot in every variant and every bundled
//! maze plays the match that `fingerprints.tsv` records, to the last unit of fuel.
//!
//! The trace is not recorded by the engine: it comes from the rules and the transcript, so the
//! table also covers the replay. Its first version was written by the release before the host
//! was split into `wasmouse-core` and `wasmouse-engine`.

use std::thread;

use wasmouse_core::Digest;
use wasmouse_core::game::{SandboxLimits, Verdict};
use wasmouse_core::record::trace;
use wasmouse_engine::bundled::{BundledRobot, bundled};
use wasmouse_engine::{Executor, InProcess, Limits};

use crate::matches::{bundled_mazes, rules, spec, variants};

const TABLE: &str = include_str!("fingerprints.tsv");

/// Set to write the table instead of comparing it.
const UPDATE: &str = "WASMOUSE_UPDATE_FINGERPRINTS";

#[test]
fn matches_are_those_of_the_table() {
    let robots = u32::try_from(bundled().len()).expect("a few robots");
    let executor = InProcess::new(Limits::default(), robots, None).expect("address space");
    let executor = &executor;
    let rows: Vec<String> = thread::scope(|scope| {
        let threads: Vec<_> = bundled()
            .iter()
            .map(|robot| scope.spawn(move || rows(executor, robot)))
            .collect();
        let rows = threads.into_iter().map(|it| it.join().expect("rows"));
        rows.flatten().collect()
    });
    let (header, expected) = TABLE.split_once('\n').expect("a header");
    if std::env::var_os(UPDATE).is_some() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/it/fingerprints.tsv");
        let text = format!("{header}\n{}\n", rows.join("\n"));
        std::fs::write(file, text).expect("the table can be written");
        return;
    }
    let expected: Vec<&str> = expected.lines().collect();
    let mut differences = Vec::new();
    for (found, expected) in rows.iter().zip(&expected) {
        let cells = header
            .split('\t')
            .zip(found.split('\t').zip(expected.split('\t')));
        let names: Vec<&str> = cells
            .filter(|(_, (found, expected))| found != expected)
            .map(|(name, _)| name)
            .collect();
        if !names.is_empty() {
            let names = names.join(", ");
            differences.push(format!("{names}:\n  now    {found}\n  before {expected}"));
        }
    }
    assert!(
        differences.is_empty(),
        "{} of {} matches differ. If they should, set {UPDATE}=1, run this test again, and explain \
         the change in the changelog.\n{}",
        differences.len(),
        rows.len(),
        differences.join("\n")
    );
    assert_eq!(rows.len(), expected.len());
}

/// The matches of one robot, one row each, in the columns of the table.
fn rows(executor: &InProcess, robot: &BundledRobot) -> Vec<String> {
    let admitted = executor.admit(robot.component).expect("the host works");
    let admitted = admitted.unwrap_or_else(|rejection| panic!("{}: {rejection}", robot.name));
    let rules = rules(SandboxLimits::default());
    let mut rows = Vec::new();
    for (variant, _) in variants(robot) {
        for (name, maze) in bundled_mazes() {
            for seed in [0, 1] {
                let spec = spec(&rules, admitted.digest(), &maze, (variant, seed));
                let played = executor.execute_with_details(&admitted, &spec);
                let played = played.expect("the host works");
                let record = played.record;
                let transcript = &played.recording.transcript;
                assert_eq!(record.transcript, transcript.digest());
                let (result, trace) = trace(&maze, &rules.game, transcript).expect("a replay");
                assert_eq!(result.verdict, record.verdict);
                assert_eq!(result.steps, record.steps);
                assert_eq!(result.counts, record.counts);
                let verdict = match &record.verdict {
                    Verdict::Finished { .. } => "finished",
                    Verdict::BudgetUsedUp { goal_reached: true } => "budget-used-up-goal-reached",
                    Verdict::BudgetUsedUp {
                        goal_reached: false,
                    } => "budget-used-up",
                    Verdict::Fault { fault } => fault.kind.name(),
                };
                let (steps, counts, fuel) = (record.steps, record.counts, record.fuel);
                let ignored_resets = counts.resets_before_goal + counts.resets_in_speed_run;
                rows.push(format!(
                    "{}\t{variant}\t{name}\t{seed}\t{verdict}\t{}\t{}\t{}\t{}\t{ignored_resets}\
                     \t{}\t{}\t{}\t{}",
                    robot.name,
                    steps.exploration,
                    steps.speed,
                    counts.bumps,
                    counts.clamps,
                    fuel.start,
                    fuel.steps,
                    fuel.step_max,
                    Digest::of(&trace.identity_bytes()),
                ));
            }
        }
    }
    rows
}
