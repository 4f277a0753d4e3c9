//! The worker that plays: [`main`].

use std::io::{self, BufWriter, Read, Write};
use std::time::{Duration, Instant};

use super::begin::confined;
use super::confine::{self, Role};
use super::pipes::Pipes;
use super::wire::{
    self, Answers, Batch, Full, GameOrder, Hello, Loaded, Note, Request, Sandbox, Setup, Stop,
};
use crate::maze::Maze;
use crate::robot::{
    self, Digest, Game, Host, HostError, Outcome, Recorder, Refusal, Robot, STACK_BYTES, Verdict,
};
use crate::sim::Ruleset;

/// Answers wait this long at most for others to be sent with them.
const ANSWERS_WAIT_MAX: Duration = Duration::from_millis(20);

/// Plays what the supervisor asks on standard input until that ends.
///
/// # Errors
///
/// When the pipes break or the machine cannot run robots.
pub fn main() -> io::Result<()> {
    main_with(&|_seed| ())
}

/// [`main`] with something to do before each match, which gets the seed: tests use it
/// to fail in the middle of a batch.
///
/// # Errors
///
/// As [`main`].
#[doc(hidden)]
pub fn main_with(before_match: &'static (dyn Fn(u64) + Sync)) -> io::Result<()> {
    confine::close_inherited();
    confine::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(setup) = wire::read::<Setup>(&mut pipes.from)? else {
        return Ok(());
    };
    let rules = setup.rules;
    enter(&rules, move |host, sandbox| {
        let hello = Hello {
            build: wire::build(),
            sandbox,
        };
        let mut table = Table::new(host, rules, before_match);
        wire::write(&mut pipes.to, &hello)?;
        pipes.to.flush()?;
        while let Some(request) = wire::read::<Request>(&mut pipes.from)? {
            table.answer(request, &mut pipes.from, &mut pipes.to)?;
        }
        Ok(())
    })
}

/// Confines this process and then works on a thread with a stack of known size. The
/// process can play afterwards, and not much more.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(rules: &Ruleset, work: W) -> io::Result<()>
where
    W: FnOnce(Host, Sandbox) -> io::Result<()> + Send + 'static,
{
    confine::set_limits(Role::Play);
    let failed = |error: HostError| io::Error::other(error.to_string());
    // The engine opens a file of its own, so it comes before all are forbidden.
    let host = Host::without_clock(rules.limits, 1, None).map_err(failed)?;
    let clock = host.clock();
    let threads = move || clock.start().map_err(failed);
    confined(Role::Play, STACK_BYTES, threads, move |sandbox| {
        work(host, sandbox)
    })
}

/// What the worker keeps between requests.
pub(super) struct Table {
    host: Host,
    rules: Ruleset,
    /// By slot.
    pub(super) robots: Vec<Option<Robot>>,
    /// By slot.
    mazes: Vec<Option<Maze>>,
    recorder: Recorder,
    before_match: &'static (dyn Fn(u64) + Sync),
}

impl Table {
    pub(super) fn new(
        host: Host,
        rules: Ruleset,
        before_match: &'static (dyn Fn(u64) + Sync),
    ) -> Self {
        Self {
            host,
            rules,
            robots: Vec::new(),
            mazes: Vec::new(),
            recorder: Recorder::default(),
            before_match,
        }
    }

    /// Does what a request asks; what follows the request comes from `from`.
    pub(super) fn answer(
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
                component,
            } => {
                let bytes = read_exactly(from, length)?;
                let loaded = self.load(slot, &bytes, (code, component));
                wire::write(to, &loaded)?;
                to.flush()
            }
            Request::Maze { slot, bytes } => {
                let maze = Maze::from_identity_bytes(&bytes);
                let maze = maze.ok_or_else(|| io::Error::other("a maze cannot be read"))?;
                put(&mut self.mazes, slot, maze);
                Ok(())
            }
            Request::Play(batch) => self.play(&batch, to),
        }
    }

    fn load(&mut self, slot: u16, bytes: &[u8], (code, component): (Digest, Digest)) -> Loaded {
        if Digest::of(bytes) != code {
            return Loaded::Damaged;
        }
        // SAFETY: the digest is the one that the supervisor wrote down when a compile
        // worker handed the code over.
        match unsafe { self.host.load(bytes, component) } {
            Ok(robot) => {
                let needs = robot.needs();
                put(&mut self.robots, slot, robot);
                Loaded::Ready(needs)
            }
            // The robot was valid when it was compiled; this is about its code, as of
            // another version of wasmtime.
            Err(Refusal::Invalid(_)) => Loaded::Damaged,
            Err(refusal) => Loaded::Refused(refusal.into()),
        }
    }

    fn play(&mut self, batch: &Batch, to: &mut BufWriter<impl Write>) -> io::Result<()> {
        let mut sent = Instant::now();
        for order in &batch.games {
            (self.before_match)(order.seed);
            let answers = self.play_one(batch, order)?;
            wire::write(to, &answers)?;
            if sent.elapsed() >= ANSWERS_WAIT_MAX {
                to.flush()?;
                sent = Instant::now();
            }
        }
        to.flush()
    }

    fn play_one(&mut self, batch: &Batch, order: &GameOrder) -> io::Result<Answers> {
        let unknown = || io::Error::other("a match of an unknown robot or maze");
        let robot = get(&self.robots, batch.robot).ok_or_else(unknown)?;
        let game = Game {
            maze: get(&self.mazes, order.maze).ok_or_else(unknown)?,
            rules: &self.rules,
            seed: order.seed,
            setting: order.setting,
        };
        let played = self.host.play(robot, &game, &mut self.recorder);
        let full = batch.full.then(|| full(&self.recorder));
        Ok(answers(played, &self.recorder, full))
    }
}

pub(super) fn answers(
    played: Result<Outcome, HostError>,
    recorder: &Recorder,
    full: Option<Full>,
) -> Answers {
    let (stop, fuel) = match played {
        Ok(outcome) => {
            let stop = match outcome.verdict {
                Verdict::Fault(fault) => Some(Stop::Fault {
                    kind: fault.kind,
                    phase: fault.phase,
                    detail: fault.detail,
                }),
                Verdict::Finished(_) | Verdict::BudgetUsedUp { .. } => None,
            };
            (stop, outcome.fuel)
        }
        Err(HostError::Stalled) => (Some(Stop::Stalled), robot::FuelUse::default()),
        Err(error) => (
            Some(Stop::Failed(error.to_string())),
            robot::FuelUse::default(),
        ),
    };
    Answers {
        actions: recorder
            .trace
            .steps()
            .iter()
            .map(|step| step.action)
            .collect(),
        stop,
        fuel,
        journal: recorder.journal.counts(),
        full,
    }
}

pub(super) fn full(recorder: &Recorder) -> Full {
    let journal = recorder.journal.entries();
    Full {
        step_fuel: recorder.step_fuel.clone(),
        journal: journal
            .map(|entry| (entry.step, Note::from(entry.note)))
            .collect(),
    }
}

/// Reads that many bytes, taking memory only for those that come.
pub(super) fn read_exactly(from: &mut impl Read, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(length).read_to_end(&mut bytes)?;
    if u64::try_from(bytes.len()).is_ok_and(|read| read == length) {
        Ok(bytes)
    } else {
        Err(io::ErrorKind::UnexpectedEof.into())
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
