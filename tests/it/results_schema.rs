//! The results document against its JSON Schema: real contests are valid, and a document with a
//! field missing or added is not.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use jsonschema::Validator;
use serde_json::Value;
use wasmouse::contest::{
    ContestInfo, Entrant, MazeSource, NotAdmitted, Options, Plan, RecordList, Results, Seeds,
    StandingsBuilder, SummaryBuilder, Tee, run,
};
use wasmouse::report::results_json::{ResultsWriter, read_results, write_results};
use wasmouse_core::Digest;
use wasmouse_core::game::{Fault, FaultKind, Phase, Ruleset, Run, Verdict};
use wasmouse_core::maze::{Cell, Maze, Walls};
use wasmouse_core::record::MatchSpec;
use wasmouse_engine::admission::{Inspection, Rejection};
use wasmouse_engine::bundled;
use wasmouse_engine::{
    AdmittedRobot, DetailedMatch, Executor, Frame, InProcess, InfrastructureError, Limits, Profile,
    Sink, Withdrawal,
};

use crate::pointers::objects;

const SCHEMA: &str = include_str!("../../host/schema/results.schema.json");

/// The seed with which every match fails.
const BROKEN_SEED: u64 = 2;

/// The seed with which robots have been withdrawn.
const WITHDRAWN_SEED: u64 = 3;

fn validator() -> Validator {
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    jsonschema::draft202012::meta::validate(&schema).expect("the schema is a schema");
    jsonschema::draft202012::new(&schema).expect("the schema can be used")
}

/// An executor that cannot play matches with [`BROKEN_SEED`] and [`WITHDRAWN_SEED`].
struct Broken(InProcess);

impl Executor for Broken {
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        self.0.admit(file)
    }

    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError> {
        self.0.inspect(file)
    }

    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        self.0.execute(robot, batch, &mut |spec, played| {
            let played = match spec.key.seed {
                BROKEN_SEED => Err(InfrastructureError::ForeignRobot),
                WITHDRAWN_SEED => Err(InfrastructureError::Withdrawn(Withdrawal::Stalled {
                    times: 2,
                })),
                _ => played,
            };
            sink(spec, played)
        })
    }

    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError> {
        self.0.execute_with_details(robot, spec)
    }

    fn backtrace(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        self.0.backtrace(robot, file, spec, fault)
    }

    fn profile(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        self.0.profile(robot, file, spec, played)
    }
}

/// The results of a contest in an official maze and one without a way to the goal, with these
/// seeds, and the document that was written while it was played.
///
/// `flood` finishes in the first maze, `champion` exceeds the fuel limit of a step, a file is
/// rejected, and another one cannot be admitted.
fn play(seeds: Seeds) -> (Results, Vec<u8>) {
    let mut rules = Ruleset::default();
    rules.sandbox.step_fuel_max = 100_000;
    let executor = InProcess::new(Limits::with_sandbox(rules.sandbox), 1, None);
    let executor = Broken(executor.expect("address space"));
    let entrant = |name: &str, file: &[u8]| Entrant {
        name: name.into(),
        digest: Digest::of(file),
        variant: 0,
        admission: match executor.admit(file).expect("the host works") {
            Ok(robot) => Ok(Arc::new(robot)),
            Err(rejection) => Err(NotAdmitted::Rejected(Arc::new(rejection))),
        },
    };
    let component = |name| bundled::find(name).expect("it is bundled").component;
    let loaded = |name: &str, maze| MazeSource::Loaded {
        name: name.into(),
        maze: Arc::new(maze),
    };
    let official = wasmouse_core::maze::bundled()[0];
    let official_maze = wasmouse_core::maze::format::parse(official.text).expect("a maze");
    let closed = Maze::contest(Walls::closed(12)).expect("start and goal fit");
    let plan = Plan {
        entrants: vec![
            entrant("flood", component("flood")),
            entrant("champion", component("champion")),
            entrant("rejected\u{1b}", b"no robot"),
            Entrant {
                admission: Err(NotAdmitted::Failed("no worker \u{1b}".into())),
                ..entrant("failed", b"perhaps a robot")
            },
        ],
        mazes: vec![
            loaded(official.name, official_maze.maze),
            loaded("closed", closed),
        ],
        seeds,
        rules: Arc::new(rules),
    };
    let players = plan.players();
    let contest = ContestInfo::new(&plan);
    let mut records = RecordList::new(1000);
    let mut standings = StandingsBuilder::new(&plan, &players);
    let mut summary = SummaryBuilder::new();
    let mut writer = ResultsWriter::new(Vec::new(), &contest);
    let mut sink = Tee(vec![
        &mut records,
        &mut standings,
        &mut summary,
        &mut writer,
    ]);
    let options = Options {
        jobs: 1,
        cancelled: &AtomicBool::new(false),
        wanted: &|_| true,
        ended: &|_, _| Ok(()),
        robot_time: None,
    };
    run(&plan, &executor, &options, &mut sink).expect("a contest");
    let summary = summary.finish(&plan, standings.finish(&plan, &players));
    let document = writer.finish(&summary).expect("memory takes everything");
    let results = Results {
        version: wasmouse::contest::RESULTS_VERSION,
        contest,
        matches: records.into_records().expect("a few"),
        summary,
    };
    (results, document)
}

#[track_caller]
fn check_valid(validator: &Validator, value: &Value) {
    let errors: Vec<String> = validator
        .iter_errors(value)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
}

#[test]
fn contests_are_valid() {
    let validator = validator();
    for (first, count, partial) in [(0, 1, false), (BROKEN_SEED - 1, 3, true)] {
        let (results, document) = play(Seeds { first, count });
        let value = serde_json::from_slice(&document).expect("it is JSON");
        check_valid(&validator, &value);
        assert_eq!(read_results(&document).as_ref(), Ok(&results));
        let written = write_results(&results, Vec::new()).expect("memory takes everything");
        assert_eq!(written, document);
        let summary = &results.summary;
        assert_eq!(
            (summary.standings.partial, summary.complete),
            (partial, !partial)
        );
        assert_eq!(summary.failures.is_empty(), !partial);
        assert_eq!(summary.withdrawn.len(), if partial { 2 } else { 0 });
        assert!(results.contest.robots[2].rejection.is_some());
        assert!(results.contest.robots[3].failure.is_some());
        let verdicts: Vec<_> = results
            .matches
            .iter()
            .map(|it| it.verdict.title())
            .collect();
        let expected = ["finished", "fault: out-of-step-fuel", "budget used up"];
        for expected in expected {
            assert!(
                verdicts.iter().any(|it| it == expected),
                "{expected}: {verdicts:?}"
            );
        }
    }
}

#[test]
fn every_fault_is_valid() {
    let validator = validator();
    let (mut results, _) = play(Seeds { first: 0, count: 1 });
    let mut record = results.matches[0].clone();
    results.matches.clear();
    for kind in FaultKind::ALL {
        for phase in Phase::ALL {
            for run in [Run::Exploration, Run::Speed] {
                let fault = Fault {
                    kind,
                    phase,
                    run,
                    step: u32::MAX,
                    cell: Cell::new(0, 255),
                    detail: "".into(),
                };
                record.verdict = Verdict::Fault { fault };
                results.matches.push(record.clone());
            }
        }
    }
    let value = serde_json::to_value(&results).expect("it can be written");
    check_valid(&validator, &value);
}

#[test]
fn a_field_that_is_missing_or_added_is_invalid() {
    let validator = validator();
    let (results, _) = play(Seeds {
        first: BROKEN_SEED - 1,
        count: 3,
    });
    let document = serde_json::to_value(&results).expect("it can be written");
    // The reader takes a missing field for null where null is a value of the field.
    let lenient = [
        "without oracle",
        "without rank",
        "without mean_score_thousandths",
        "without mean_regret_thousandths",
    ];
    let check = |changed: &Value, is_valid: bool, what: &str| {
        assert_eq!(validator.is_valid(changed), is_valid, "schema, {what}");
        let read = read_results(changed.to_string().as_bytes());
        let is_readable = is_valid || lenient.iter().any(|end| what.ends_with(end));
        assert_eq!(read.is_ok(), is_readable, "reader, {what}");
    };
    let pointers = objects(&document);
    assert!(pointers.len() > 50, "{pointers:?}");
    for pointer in pointers {
        let with = |fields: serde_json::Map<String, Value>| {
            let mut changed = document.clone();
            *changed.pointer_mut(&pointer).expect("it is there") = Value::Object(fields);
            changed
        };
        let fields = document.pointer(&pointer).and_then(Value::as_object);
        let fields = fields.expect("the pointer of an object");
        let mut added = fields.clone();
        added.insert("added".to_owned(), Value::Null);
        check(&with(added), false, &format!("{pointer}: added"));
        for name in fields.keys() {
            let mut fewer = fields.clone();
            fewer.remove(name);
            let is_optional = ["rejection", "failure"].contains(&name.as_str());
            check(
                &with(fewer),
                is_optional,
                &format!("{pointer}: without {name}"),
            );
        }
    }
}
