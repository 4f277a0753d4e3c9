//! The hostile corpus in this process: every case has its outcome, and the good robot that plays
//! after all of them is not affected.
//!
//! `cargo xtask corpus` plays it through the `wasmouse` binary, in workers too, and measures time
//! and memory.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use serde_json::{Value, json};
use wasmouse_engine::{Executor as _, Limits};
use wasmouse_tests::corpus::{Case, cases};

use crate::hostile::Engine;

/// Matches of each file, all in one engine: nothing may be left of an earlier one.
const TIMES: usize = 3;

/// Without the cases that take long. They include floods of short calls into the host, whose
/// code is not optimised here.
#[test]
fn every_case_has_its_outcome() {
    let is_slow = |case: &Case| {
        let flood = case.name.starts_with("flood-of-") && !case.name.contains("long");
        case.is_long || flood
    };
    let cases: Vec<Case> = cases().into_iter().filter(|case| !is_slow(case)).collect();
    let next = AtomicUsize::new(0);
    let play = || {
        let engine = Engine::new(Limits::default());
        let cases = || cases.get(next.fetch_add(1, Ordering::Relaxed));
        let problems = std::iter::from_fn(cases).flat_map(|case| problems(&engine, case));
        let problems: Vec<String> = problems.collect();
        engine.assert_unharmed();
        problems
    };
    let problems: Vec<String> = thread::scope(|scope| {
        let threads = [scope.spawn(play), scope.spawn(play)];
        let problems = threads.into_iter().map(|it| it.join().expect("problems"));
        problems.flatten().collect()
    });
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// What differs from the expectations of a case.
fn problems(engine: &Engine, case: &Case) -> Vec<String> {
    let files = case.files();
    let mut problems = Vec::new();
    let mut admitted = 0;
    for (at, file) in files.iter().enumerate() {
        let outcome = match rejection(engine, file) {
            Some(rejection) => rejection,
            None => {
                admitted += 1;
                let is_repeated = case.arguments.iter().any(|it| it.starts_with("--repeat"));
                let times = if is_repeated { TIMES } else { 1 };
                let mut records = (0..times).map(|_| engine.play(file).record);
                let first = records.next().expect("at least one match");
                if records.any(|it| it != first) {
                    problems.push(format!("{}, file {at}: later matches differ", case.name));
                }
                serde_json::to_value(first).expect("records serialise")
            }
        };
        if !case.allows(&outcome) {
            let expected = &case.expected;
            let name = &case.name;
            problems.push(format!(
                "{name}, file {at}: {outcome}\nexpected {expected:?}"
            ));
        }
    }
    // Files that lack nothing but custom sections.
    if case.name.contains("-cut") && admitted * 10 > files.len() {
        let (name, all) = (&case.name, files.len());
        problems.push(format!("{name}: {admitted} of {all} admitted"));
    }
    problems
}

/// The rejection of a file, the same when it is inspected.
fn rejection(engine: &Engine, file: &[u8]) -> Option<Value> {
    let inspection = engine.executor.inspect(file).expect("the host works");
    let inspected = inspection.rejection.map(|it| it.reason());
    let rejection = engine.admit(file).err();
    let reason = rejection.as_ref().map(|it| it.reason());
    assert_eq!(inspected, reason);
    let rejection = rejection?;
    assert!(!rejection.hint().is_empty(), "{rejection:?}");
    Some(json!({"rejection": {"kind": rejection.name(), "reason": reason}}))
}

/// Errors of wasmtime that have no type are recognised as the robot's by how they start. A case
/// has each of them, so a version of wasmtime that words one otherwise fails the test above.
#[test]
fn every_known_violation_has_a_case() {
    let source = include_str!("../../host/engine/src/runtime/fault.rs");
    let (_, table) = source
        .split_once("const VIOLATIONS")
        .expect("the table of messages");
    let (_, table) = table.split_once("= [").expect("its rows");
    let (table, _) = table.split_once("];").expect("its end");
    let messages: Vec<&str> = table
        .lines()
        .filter_map(|line| line.trim().strip_prefix('"')?.strip_suffix("\","))
        .collect();
    assert!(messages.len() > 10, "{messages:?}");
    let expected: Vec<String> = cases()
        .iter()
        .flat_map(|case| &case.expected)
        .filter_map(|it| it["verdict"]["fault"]["detail"].as_str())
        .filter_map(|detail| detail.strip_prefix("violated the interface: "))
        .map(str::to_owned)
        .collect();
    let missing: Vec<&&str> = messages
        .iter()
        .filter(|message| !expected.iter().any(|it| it.starts_with(**message)))
        .collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}
