//! The run worker: plays batches of matches.

use std::io::{self, BufWriter, Read, Write};
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_bytes::ByteBuf;
use wasmouse_core::Digest;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{GameResult, MatchKey, MatchSpec, Usage};

use super::super::protocol::{
    self, Details, Hello, Loaded, MatchOrder, MatchReport, OwnedNote, Request, RunBatch,
    RunFailure, Setup,
};
use super::super::role::{Role, SandboxStatus};
use super::pipes::{Pipes, read_exactly};
use super::privileges;
use super::setup::sandboxed;
use crate::admission::Rejection;
use crate::error::InfrastructureError;
use crate::limits::{Limits, STACK_BYTES};
use crate::runner::Recording;
use crate::runtime::{AdmissionError, CompiledRobot, Runtime, engine_id};
use crate::time::{Control, MatchClock};

/// Reports wait this long at most for others to be sent with them.
const REPORT_DELAY_MAX: Duration = Duration::from_millis(20);

/// Plays what the supervisor asks for on standard input until that ends.
///
/// # Errors
///
/// When the pipes break or the machine cannot run robots.
pub fn main() -> io::Result<()> {
    main_with(&|_seed| ())
}

/// [`main`] with something to do before each match, which gets the seed: tests use it to fail
/// in the middle of a batch.
///
/// # Errors
///
/// As [`main`].
#[doc(hidden)]
pub fn main_with(before_match: &'static (dyn Fn(u64) + Sync)) -> io::Result<()> {
    privileges::close_inherited();
    privileges::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(setup) = protocol::read::<Setup>(&mut pipes.from)? else {
        return Ok(());
    };
    enter(&setup.limits.clone(), move |runtime, sandbox| {
        let hello = Hello {
            build: protocol::build(),
            sandbox,
        };
        let mut table = Table::new(runtime, setup, before_match);
        protocol::write(&mut pipes.to, &hello)?;
        pipes.to.flush()?;
        while let Some(request) = protocol::read::<Request>(&mut pipes.from)? {
            table.answer(request, &mut pipes.from, &mut pipes.to)?;
        }
        Ok(())
    })
}

/// Sandboxes this process and then works on a thread with a stack of known size. The process
/// can run robots afterwards, and not much more.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(limits: &Limits, work: W) -> io::Result<()>
where
    W: FnOnce(Runtime, SandboxStatus) -> io::Result<()> + Send + 'static,
{
    privileges::set_limits(Role::Run);
    let isolation = privileges::isolate()?;
    let failed = |error: InfrastructureError| io::Error::other(error.to_string());
    // The engine opens a file of its own, so it is made before files are forbidden.
    let runtime = Runtime::without_clock(*limits, 1, None).map_err(failed)?;
    let clock = runtime.clock();
    let threads = move || clock.start().map_err(failed);
    sandboxed(
        (Role::Run, isolation),
        STACK_BYTES,
        threads,
        move |sandbox| work(runtime, sandbox),
    )
}

/// What the worker keeps between requests.
pub(in crate::sandbox) struct Table {
    runtime: Runtime,
    rules: Arc<wasmouse_core::game::Ruleset>,
    /// The parts of every key that are the same for all matches.
    engine_digest: Digest,
    rules_digest: Digest,
    /// By slot.
    pub(in crate::sandbox) robots: Vec<Option<CompiledRobot>>,
    /// By slot, with the digest.
    pub(in crate::sandbox) mazes: Vec<Option<(Digest, Arc<Maze>)>>,
    recording: Recording,
    control: Control,
    before_match: &'static (dyn Fn(u64) + Sync),
}

impl Table {
    pub(in crate::sandbox) fn new(
        runtime: Runtime,
        setup: Setup,
        before_match: &'static (dyn Fn(u64) + Sync),
    ) -> Self {
        Self {
            runtime,
            engine_digest: engine_id().digest(),
            rules_digest: setup.rules.digest(),
            rules: Arc::new(setup.rules),
            robots: Vec::new(),
            mazes: Vec::new(),
            recording: Recording::default(),
            control: Control {
                match_time: setup.match_time,
                ..Control::default()
            },
            before_match,
        }
    }

    /// Does what a request asks; the bytes that follow the request come from `from`.
    pub(in crate::sandbox) fn answer(
        &mut self,
        request: Request,
        from: &mut impl Read,
        to: &mut BufWriter<impl Write>,
    ) -> io::Result<()> {
        match request {
            Request::Robot {
                slot,
                length,
                code,
                robot,
            } => {
                let bytes = read_exactly(from, length)?;
                let loaded = self.load(slot, &bytes, (code, robot));
                protocol::write(to, &loaded)?;
                to.flush()
            }
            Request::Maze {
                slot,
                digest,
                bytes,
            } => {
                let maze = Maze::from_identity_bytes(&bytes);
                let maze = maze.ok_or_else(|| io::Error::other("a maze cannot be read"))?;
                put(&mut self.mazes, slot, (digest, Arc::new(maze)));
                Ok(())
            }
            Request::Run(batch) => self.run(&batch, to),
        }
    }

    fn load(&mut self, slot: u16, bytes: &[u8], (code, robot): (Digest, Digest)) -> Loaded {
        if Digest::of(bytes) != code {
            return Loaded::Damaged;
        }
        // SAFETY: the digest is the one that the supervisor wrote down when a compile worker
        // handed the code over.
        match unsafe { self.runtime.load(bytes, robot) } {
            Ok(robot) => {
                let requirements = robot.requirements();
                put(&mut self.robots, slot, robot);
                Loaded::Ready(requirements)
            }
            // From another version of wasmtime, say, or more than the pool has room for. The
            // supervisor knows how old the code is.
            Err(AdmissionError::Rejected(rejection @ Rejection::Invalid { .. })) => {
                Loaded::Unloadable(rejection.into())
            }
            Err(AdmissionError::Rejected(rejection)) => Loaded::Rejected(rejection.into()),
            Err(AdmissionError::Host(error)) => Loaded::Failed(error.to_string()),
        }
    }

    fn run(&mut self, batch: &RunBatch, to: &mut BufWriter<impl Write>) -> io::Result<()> {
        let mut sent = Instant::now();
        for order in &batch.matches {
            (self.before_match)(order.seed);
            let report = self.run_one(batch, order)?;
            protocol::write(to, &report)?;
            if sent.elapsed() >= REPORT_DELAY_MAX {
                to.flush()?;
                sent = Instant::now();
            }
        }
        to.flush()
    }

    fn run_one(&mut self, batch: &RunBatch, order: &MatchOrder) -> io::Result<MatchReport> {
        let mut recording = std::mem::take(&mut self.recording);
        let (robot, spec) = self
            .find(batch, order)
            .ok_or_else(|| io::Error::other("a match of an unknown robot or maze"))?;
        let clock = MatchClock::start(self.control.clone(), None);
        let ran = self
            .runtime
            .run_within(robot, &spec, &mut recording, &clock);
        let report = report(ran, &recording, batch.details);
        self.recording = recording;
        Ok(report)
    }

    /// The robot and the specification of a match; `None` when a slot is empty.
    pub(in crate::sandbox) fn find(
        &self,
        batch: &RunBatch,
        order: &MatchOrder,
    ) -> Option<(&CompiledRobot, MatchSpec)> {
        let robot = get(&self.robots, batch.robot)?;
        let (maze_digest, maze) = get(&self.mazes, order.maze)?;
        let spec = MatchSpec {
            key: MatchKey {
                engine: self.engine_digest,
                rules: self.rules_digest,
                robot: *robot.digest(),
                variant: order.variant,
                maze: *maze_digest,
                seed: order.seed,
            },
            maze: Arc::clone(maze),
            rules: Arc::clone(&self.rules),
        };
        Some((robot, spec))
    }
}

fn report(
    ran: Result<(GameResult, Usage), InfrastructureError>,
    recording: &Recording,
    details: bool,
) -> MatchReport {
    let (transcript, usage) = match ran {
        Ok((_, usage)) => (Ok(ByteBuf::from(recording.transcript.to_bytes())), usage),
        Err(InfrastructureError::Slow { seconds }) => {
            (Err(RunFailure::Slow { seconds }), Usage::default())
        }
        Err(error) => (Err(RunFailure::Failed(error.to_string())), Usage::default()),
    };
    MatchReport {
        transcript,
        usage,
        details: details.then(|| {
            let entries = recording.journal.entries();
            Details {
                step_fuel: recording.step_fuel.clone(),
                journal: entries
                    .map(|entry| (entry.step, OwnedNote::from(entry.note)))
                    .collect(),
            }
        }),
    }
}

fn put<T>(slots: &mut Vec<Option<T>>, slot: u16, value: T) {
    let slot = usize::from(slot);
    if slots.len() <= slot {
        slots.resize_with(slot + 1, || None);
    }
    slots[slot] = Some(value);
}

fn get<T>(slots: &[Option<T>], slot: u16) -> Option<&T> {
    slots.get(usize::from(slot))?.as_ref()
}
