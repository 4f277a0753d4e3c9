//! Fuzz targets for the protocol, from both ends.

use std::cell::RefCell;
use std::fmt::Debug;
use std::io::{self, BufWriter, Read};
use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasmouse_core::Digest;
use wasmouse_core::game::BudgetScope;
use wasmouse_core::journal::ENTRY_BYTES;
use wasmouse_core::record::{MatchKey, MatchSpec};

use super::child::run::Table;
use super::protocol::{
    self, Backtrace, BacktraceOrder, CompileOrder, Examined, FRAME_BYTES_MAX, Hello, Loaded,
    MatchReport, Request, Setup,
};
use super::supervisor::check::check;
use crate::bundled::find;
use crate::fuzz::{limits, maze, rules};
use crate::runner::Recording;
use crate::runtime::Runtime;

/// Requests to a run worker. Whatever it answers is well formed, and the supervisor believes
/// its reports: they are honest.
pub fn requests(bytes: &[u8]) -> bool {
    thread_local! {
        static TABLE: RefCell<Table> = RefCell::new(table());
    }
    TABLE.with_borrow_mut(|table| {
        let served = serve(table, bytes).is_ok();
        // A case must not depend on those before it.
        table.mazes.clear();
        table.robots.truncate(1);
        served
    })
}

/// A worker with the robot flood in its first slot.
fn table() -> Table {
    let runtime = Runtime::new(limits(), 1, None).expect("address space for one match");
    let flood = find("flood").expect("a bundled robot").component;
    let flood = runtime.admit(flood).expect("a robot");
    let setup = Setup {
        rules: rules(),
        limits: limits(),
        match_time: crate::time::MATCH_TIME_MAX,
    };
    let mut table = Table::new(runtime, setup, &|_| ());
    table.robots.push(Some(flood));
    table
}

/// Answers requests until they end.
fn serve(table: &mut Table, mut from: &[u8]) -> io::Result<()> {
    while let Some(request) = read::<Request>(&mut from)? {
        let expected = format!("{request:?}");
        let (mut specs, mut loads) = (Vec::new(), false);
        match &request {
            Request::Maze { .. } => {}
            Request::Robot { .. } => loads = true,
            Request::Run(batch) => {
                let orders = batch.matches.iter();
                specs.extend(orders.filter_map(|order| Some(table.find(batch, order)?.1)));
            }
        }
        let mut answers = BufWriter::new(Vec::new());
        table.answer(request, &mut from, &mut answers)?;
        let answers = answers.into_inner().expect("memory");
        let mut answers = answers.as_slice();
        if loads {
            protocol::expect::<Loaded>(&mut answers).expect("an answer");
        }
        for spec in specs {
            let report = protocol::expect(&mut answers).expect("a report");
            let checked = check(report, &spec, &mut Recording::default());
            checked.expect("an honest report").expect("the host works");
        }
        assert!(
            answers.is_empty(),
            "more answers than asked for: {expected}"
        );
    }
    Ok(())
}

/// Frames that a worker sends, after a byte that chooses the kind.
pub fn reports(bytes: &[u8]) -> bool {
    let Some((&kind, mut frame)) = bytes.split_first() else {
        return false;
    };
    match kind % 8 {
        0 => is_read::<Hello>(frame),
        1 => is_read::<Examined>(frame),
        2 => is_read::<Loaded>(frame),
        3 => is_read::<Backtrace>(frame),
        4 => is_read::<CompileOrder>(frame),
        5 => is_read::<BacktraceOrder>(frame),
        _ => match read(&mut frame) {
            Ok(Some(report)) => check_report(report),
            Ok(None) | Err(_) => false,
        },
    }
}

fn is_read<T: Debug + Serialize + DeserializeOwned>(mut frame: &[u8]) -> bool {
    matches!(read::<T>(&mut frame), Ok(Some(_)))
}

/// Reads a frame from a sender that never stops: only as much is taken as a frame may have.
/// What was read is written and read the same.
fn read<T: Debug + Serialize + DeserializeOwned>(from: &mut &[u8]) -> io::Result<Option<T>> {
    let mut endless = (*from).chain(io::repeat(0)).take(u64::MAX);
    let taken = protocol::read::<T>(&mut endless);
    let bytes = u64::MAX - endless.limit();
    assert!(bytes <= 4 + FRAME_BYTES_MAX as u64, "{bytes} bytes taken");

    let read = protocol::read::<T>(from);
    if let Ok(Some(value)) = &read {
        let taken = taken.expect("it has a frame").expect("it has a frame");
        assert_eq!(format!("{taken:?}"), format!("{value:?}"));
        let mut written = Vec::new();
        protocol::write(&mut written, value).expect("it came out of a frame");
        let again = protocol::expect::<T>(&mut written.as_slice()).expect("a frame");
        assert_eq!(format!("{again:?}"), format!("{value:?}"));
    }
    read
}

/// Whether a report is believed; if so it must be possible.
fn check_report(report: MatchReport) -> bool {
    let (maze, rules) = (maze(), rules());
    let spec = MatchSpec {
        key: MatchKey {
            engine: Digest::of(b"engine"),
            rules: rules.digest(),
            robot: Digest::of(b"robot"),
            variant: 0,
            maze: maze.digest(),
            seed: 0,
        },
        maze: Arc::new(maze),
        rules: Arc::new(rules),
    };
    let has_details = report.details.is_some();
    let transcript = report.transcript.as_ref().ok().cloned();
    let transcript = transcript.map(serde_bytes::ByteBuf::into_vec);
    let mut recording = Recording::default();
    let Ok(Ok(record)) = check(report, &spec, &mut recording) else {
        return false;
    };
    let (game, limits) = (&spec.rules.game, &spec.rules.sandbox);
    assert_eq!(record.key, spec.key);
    assert_eq!(Some(recording.transcript.to_bytes()), transcript);
    assert_eq!(record.transcript, recording.transcript.digest());

    let steps = record.steps.total();
    assert_eq!(game.budget_scope, BudgetScope::BothRuns);
    assert!(steps <= game.budget, "more steps than the budget");
    let actions = recording.transcript.actions().count();
    assert_eq!(usize::try_from(steps).ok(), Some(actions), "lost actions");

    let fuel = record.fuel;
    assert!(fuel.start <= limits.start_fuel_max, "{fuel:?}");
    assert!(fuel.step_max <= limits.step_fuel_max, "{fuel:?}");
    assert!(fuel.steps <= limits.match_fuel_max, "{fuel:?}");
    let entries_max = limits.journal_bytes_max / ENTRY_BYTES;
    assert!(record.journal.entries <= entries_max, "more than fit");
    if has_details {
        let entries = recording.journal.entries();
        assert_eq!(entries.count() as u64, record.journal.entries);
        assert_eq!(recording.step_fuel.iter().sum::<u64>(), fuel.steps);
        let last = recording.journal.entries().map(|entry| entry.step).max();
        assert!(last <= Some(steps + 1), "an entry after the last step");
    }
    true
}

#[cfg(test)]
mod tests {
    use fuzz_harness::Target;
    use wasmouse_core::game::{FaultKind, Phase};
    use wasmouse_core::record::{FuelUse, Transcript, Usage};

    use super::super::protocol::{Compiled, MatchOrder, OwnedNote, RunBatch, RunFailure};
    use super::super::role::SandboxStatus;
    use super::*;
    use crate::admission::{Rejection, examine, world};
    use crate::runtime::Frame;
    use wasmouse_core::journal::{JournalCounts, Level};

    fn framed(value: &impl Serialize) -> Vec<u8> {
        let mut bytes = Vec::new();
        protocol::write(&mut bytes, value).expect("a small frame");
        bytes
    }

    #[test]
    fn requests() {
        Target {
            name: "requests",
            run: super::requests,
            seeds: request_seeds,
            words: &[],
            bytes_max: 4 << 10,
            cases: 300,
        }
        .check();
    }

    fn request_seeds() -> Vec<Vec<u8>> {
        let maze = framed(&Request::Maze {
            slot: 1,
            digest: maze().digest(),
            bytes: maze().identity_bytes(),
        });
        let order = |seed| MatchOrder {
            maze: 1,
            seed,
            variant: 0,
        };
        let run = framed(&Request::Run(RunBatch {
            robot: 0,
            details: true,
            matches: vec![order(7), order(8)],
        }));
        let robot = Request::Robot {
            slot: 3,
            length: 4,
            code: Digest::of(b"code"),
            robot: Digest::of(b"robot"),
        };
        let robot = [framed(&robot), b"edoc".to_vec()].concat();
        let all = [maze.clone(), run.clone(), robot.clone()].concat();
        vec![[maze.clone(), run].concat(), maze, robot, all]
    }

    #[test]
    fn reports() {
        Target {
            name: "reports",
            run: super::reports,
            seeds: report_seeds,
            words: &[],
            bytes_max: 16 << 10,
            cases: 4_000,
        }
        .check();
    }

    /// A frame of each kind, and true and constructed reports.
    fn report_seeds() -> Vec<Vec<u8>> {
        fn tagged(kind: u8, value: &impl Serialize) -> Vec<u8> {
            [vec![kind], framed(value)].concat()
        }

        let flood = find("flood").expect("a bundled robot").component;
        let limits = limits();
        let mut seeds = vec![
            tagged(
                0,
                &Hello {
                    build: protocol::build(),
                    sandbox: SandboxStatus::default(),
                },
            ),
            tagged(
                1,
                &Examined {
                    kind: examine(flood, &limits).kind,
                    shape: examine(flood, &limits).shape,
                    wit: world(flood),
                    result: Compiled::Rejected(Rejection::Empty.into()),
                },
            ),
            tagged(2, &Loaded::Ready(None)),
            tagged(2, &Loaded::Rejected(Rejection::Empty.into())),
            tagged(
                3,
                &Backtrace {
                    fault: Some((
                        FaultKind::Unreachable,
                        vec![Frame {
                            function: "main".into(),
                            offset: Some(7),
                            source: Some("src/lib.rs:12:5".into()),
                        }],
                    )),
                },
            ),
            tagged(
                4,
                &CompileOrder {
                    limits,
                    length: 4,
                    compile: true,
                    describe: false,
                    backtraces: false,
                },
            ),
            tagged(
                5,
                &BacktraceOrder {
                    profile: None,
                    robot: Digest::of(b"robot"),
                    code: None,
                    rules: rules(),
                    limits,
                    maze: maze().identity_bytes(),
                    seed: 1,
                    variant: 0,
                    length: 4,
                },
            ),
        ];
        for details in [false, true] {
            seeds.push([vec![6], honest_report(details)].concat());
            seeds.push(tagged(6, &failed_report(details)));
        }
        seeds
    }

    /// What a worker reports of a match of flood.
    fn honest_report(details: bool) -> Vec<u8> {
        let mut table = table();
        let maze = maze();
        table.mazes.push(Some((maze.digest(), Arc::new(maze))));
        let batch = RunBatch {
            robot: 0,
            details,
            matches: vec![MatchOrder {
                maze: 0,
                seed: 0,
                variant: 0,
            }],
        };
        let mut answers = BufWriter::new(Vec::new());
        let answered = table.answer(Request::Run(batch), &mut io::empty(), &mut answers);
        answered.expect("a match");
        answers.into_inner().expect("memory")
    }

    /// A robot that failed in its first step, after it wrote to its journal.
    fn failed_report(details: bool) -> MatchReport {
        let mut transcript = Transcript::default();
        let detail = "executed `unreachable`".to_owned();
        transcript.end_with_fault(FaultKind::Unreachable, Phase::NextMove, detail);
        MatchReport {
            transcript: Ok(transcript.to_bytes().into()),
            usage: Usage {
                fuel: FuelUse {
                    start: 1,
                    steps: 7,
                    step_max: 7,
                },
                memory_bytes: 65_536,
                journal: JournalCounts {
                    entries: 1,
                    dropped: 0,
                },
            },
            details: details.then(|| protocol::Details {
                step_fuel: vec![7],
                journal: vec![(1, OwnedNote::Log(Level::Info, "text".into()))],
            }),
        }
    }

    #[test]
    fn a_failure_of_the_worker_is_no_report() {
        let report = MatchReport {
            transcript: Err(RunFailure::Slow { seconds: 1 }),
            ..failed_report(false)
        };
        assert!(!check_report(report));
    }
}
