//! Doors for fuzzing: what a stranger's bytes reach first, without the processes around it.
//!
//! Hidden from the documentation and used by the tests alone. Each door takes any bytes,
//! must never panic, and says in a few words what came of them, so that a fuzzer can
//! tell old behaviour from new.

use std::io::{self, BufWriter};

use super::matches::{Table, answers, full};
use super::replay::replay;
use super::wire::{
    self, Answers, Batch, Examined, Explained, GameOrder, Hello, Loaded, Request, Sandbox, Setup,
    Stop,
};
use crate::maze::{Maze, bundled, format};
use crate::robot::{
    Digest, Frame, Game, Host, Note, Recorder, Refusal, Verdict, admission, inspection,
};
use crate::sim::{Limits, Ruleset, Run};

/// What can be told of a file before it is compiled.
pub fn admit(file: &[u8]) -> String {
    let told = |refusal: Refusal| format!("{}: {refusal}", refusal.name());
    let read = match admission::read(file, &Limits::default()) {
        Ok(read) => read,
        Err(refusal) => return told(refusal),
    };
    match admission::check_names(&read.shape) {
        Ok(()) => format!("read, wit {}", inspection::world(&read.bytes).is_some()),
        Err(refusal) => told(refusal),
    }
}

/// A play worker without a process: it keeps what requests say, and a robot in slot 0.
pub struct Worker(Table);

impl Worker {
    /// A worker that has that robot.
    ///
    /// # Panics
    ///
    /// When the file is no robot, or the machine cannot run it.
    pub fn new(robot: &[u8]) -> Self {
        let rules = short_rules();
        let host = Host::new(rules.limits, 1, None).expect("address space for one match");
        let robot = host.admit(robot).expect("a robot");
        let mut table = Table::new(host, rules, &|_| ());
        table.robots.push(Some(robot));
        Self(table)
    }

    /// Answers frames as they come from a supervisor, until one is no request.
    pub fn serve(&mut self, mut frames: &[u8]) -> String {
        let mut sink = BufWriter::new(io::sink());
        let mut count = 0;
        loop {
            let answered = match wire::read::<Request>(&mut frames) {
                Ok(Some(request)) => self.0.answer(request, &mut frames, &mut sink),
                Ok(None) => return format!("ends after {count}"),
                Err(error) => Err(error),
            };
            if let Err(error) = answered {
                return format!("{count}: {error}");
            }
            count += 1;
        }
    }

    /// Frames that a supervisor may send.
    pub fn examples() -> Vec<Vec<u8>> {
        let maze = Request::Maze {
            slot: 1,
            bytes: maze().identity_bytes(),
        };
        let game = GameOrder {
            maze: 1,
            seed: 7,
            setting: 0,
        };
        let play = Request::Play(Batch {
            robot: 0,
            full: true,
            games: vec![game],
        });
        let robot = Request::Robot {
            slot: 3,
            length: 4,
            code: Digest::of(b"code"),
            component: Digest::of(b"component"),
        };
        let mut loads = framed(&robot);
        loads.extend(b"edoc");
        let together = [framed(&maze), framed(&play), loads.clone()].concat();
        vec![framed(&maze), loads, together]
    }
}

/// A frame from a worker as the supervisor judges it. The first byte says which, and
/// with 128 added, that the frame's length is left out.
///
/// # Panics
///
/// When the supervisor believes what cannot be.
pub fn judge(bytes: &[u8]) -> String {
    let Some((&kind, rest)) = bytes.split_first() else {
        return "nothing".into();
    };
    let length = u32::try_from(rest.len()).unwrap_or(u32::MAX);
    let with_length = [&length.to_le_bytes(), rest].concat();
    let frame = &mut if kind < 128 { rest } else { &with_length };
    let judged = match kind % 8 {
        0 => wire::expect::<Hello>(frame).map(|hello| format!("hello {:?}", hello.sandbox)),
        1 => wire::expect::<Examined>(frame).map(|it| format!("examined {:?}", it.kind)),
        2 => wire::expect::<Loaded>(frame).map(|it| match it {
            Loaded::Ready(needs) => format!("ready {}", needs.is_some()),
            // Words that tell of the code, and not of the input, are what a fuzzer wants.
            Loaded::Refused(told) => format!("refused {}", Refusal::from(told).hint().is_empty()),
            Loaded::Damaged => "damaged".into(),
        }),
        3 => wire::expect::<Explained>(frame).map(|it| {
            let frames = it.fault.into_iter().flat_map(|(_, frames)| frames);
            format!("explained {}", frames.map(Frame::checked).count())
        }),
        4 => wire::expect::<Setup>(frame).map(|it| format!("setup {:?}", it.rules.budget_scope)),
        _ => wire::expect::<Answers>(frame).map(judge_answers),
    };
    judged.unwrap_or_else(|error| error.to_string())
}

fn judge_answers(answers: Answers) -> String {
    let (maze, rules) = (maze(), short_rules());
    let game = game(&maze, &rules);
    let mut recorder = Recorder::default();
    let (answered, is_full) = (answers.actions.len(), answers.full.is_some());
    let record = match replay(answers, &game, &mut recorder) {
        Ok(Ok(record)) => record,
        Ok(Err(_)) => return "a failure of the host".into(),
        Err(nonsense) => return nonsense.0.into(),
    };
    let outcome = &record.outcome;
    let [explored, sped] = outcome.steps;
    let steps = explored + sped;
    assert_eq!(usize::try_from(steps).ok(), Some(answered), "lost answers");
    assert!(steps <= rules.budget, "more steps than the budget");
    assert!(outcome.fuel.steps <= rules.limits.match_fuel_max);
    let entries_max = rules.limits.journal_bytes_max / 16;
    assert!(record.journal.0 <= entries_max, "more entries than fit");
    if is_full {
        assert_eq!(recorder.journal.counts().0, record.journal.0, "entries");
        let fuel: u64 = recorder.step_fuel.iter().sum();
        assert_eq!(fuel, outcome.fuel.steps, "fuel of steps");
        let last = recorder.journal.entries().map(|entry| entry.step).max();
        assert!(last <= Some(steps + 1), "an entry after the last step");
    }
    let verdict = match &outcome.verdict {
        Verdict::Fault(fault) => {
            let run = match fault.run {
                Run::Exploration => 1,
                Run::Speed => 2,
            };
            format!("{} {:?} {run}", fault.kind.name(), fault.phase)
        }
        other => other.name().into(),
    };
    let has_text = recorder
        .journal
        .entries()
        .any(|entry| matches!(entry.note, Note::Log { .. }));
    let has_sped = sped > 0;
    format!("{verdict}, {is_full} {has_text} {has_sped}")
}

/// Frames as a worker may send them, each after the byte that says which it is. The
/// answers are those of that robot.
///
/// # Panics
///
/// When the file is no robot, or the machine cannot run it.
pub fn examples(robot: &[u8]) -> Vec<Vec<u8>> {
    let sandbox = Sandbox::default();
    let build = wire::build();
    let refusal = Refusal::Empty;
    let rules = short_rules();
    let mut examples = vec![
        tagged(0, &Hello { build, sandbox }),
        tagged(1, &examined(robot)),
        tagged(2, &Loaded::Ready(None)),
        tagged(2, &Loaded::Refused(refusal.into())),
        tagged(
            3,
            &Explained {
                fault: Some((
                    crate::robot::FaultKind::Unreachable,
                    vec![Frame {
                        function: "main".into(),
                        offset: Some(7),
                        source: Some("src/lib.rs:12:5".into()),
                    }],
                )),
            },
        ),
        tagged(4, &Setup { rules }),
    ];
    let maze = maze();
    let host = Host::new(rules.limits, 1, None).expect("address space for one match");
    let robot = host.admit(robot).expect("a robot");
    let mut recorder = Recorder::default();
    let game = game(&maze, &rules);
    let play = |recorder: &mut Recorder| host.play(&robot, &game, recorder);
    for is_full in [false, true] {
        let played = play(&mut recorder);
        let told = is_full.then(|| full(&recorder));
        examples.push(tagged(5, &answers(played, &recorder, told)));
        let stopped = Answers {
            actions: Vec::new(),
            stop: Some(Stop::Failed("the host is tired".into())),
            fuel: crate::robot::FuelUse::default(),
            journal: (0, 0),
            full: is_full.then(|| full(&Recorder::default())),
        };
        examples.push(tagged(5, &stopped));
        let mut fault = stopped;
        fault.stop = Some(Stop::Fault {
            kind: crate::robot::FaultKind::Unreachable,
            phase: crate::robot::Phase::NextMove,
            detail: "executed `unreachable`".into(),
        });
        examples.push(tagged(5, &fault));
    }
    examples
}

fn examined(file: &[u8]) -> Examined {
    let read = admission::read(file, &Limits::default()).ok();
    Examined {
        kind: read.as_ref().map(|read| read.kind),
        wit: read
            .as_ref()
            .and_then(|read| inspection::world(&read.bytes)),
        shape: read.map(|read| read.shape),
        result: wire::Compiled::Code {
            length: 4,
            digest: Digest::of(b"code"),
        },
    }
}

fn tagged(kind: u8, value: &impl serde::Serialize) -> Vec<u8> {
    let frame = framed(value);
    match kind {
        0 => [&[kind], &frame[..]].concat(),
        _ => [&[kind + 128], &frame[4..]].concat(),
    }
}

fn framed(value: &impl serde::Serialize) -> Vec<u8> {
    let mut bytes = Vec::new();
    wire::write(&mut bytes, value).expect("memory, and a small frame");
    bytes
}

pub(super) fn maze() -> Maze {
    let first = &bundled()[0];
    format::parse(first.text).expect("a bundled maze").maze
}

/// The default rules with a small journal and a budget that is soon used up.
pub(super) fn short_rules() -> Ruleset {
    let rules = Ruleset::default();
    Ruleset {
        budget: 200,
        limits: Limits {
            match_fuel_max: 100_000_000,
            journal_bytes_max: 4 << 10,
            ..rules.limits
        },
        ..rules
    }
}

const fn game<'a>(maze: &'a Maze, rules: &'a Ruleset) -> Game<'a> {
    Game {
        maze,
        rules,
        seed: 0,
        setting: 0,
    }
}
