//! [`Referee`]: one way to admit robots and play matches, wherever they run.
//!
//! Robots that are trusted run in this process on a [`Host`]; all others run in the
//! confined workers of a [`Supervisor`]. Results are the same bytes either way.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use super::worker::{RemoteRobot, Sandbox, Supervisor, Workers};
use super::{
    Cache, CacheUse, Digest, Fault, Frame, Game, Host, HostError, Inspection, Outcome, Recorder,
    Refusal, Robot, Verdict,
};
use crate::sim::Ruleset;

/// Whose code a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// It may run in this process: a bundled robot, or one of the user's own.
    Trusted,
    /// It may be anything, and runs in confined workers.
    Stranger,
}

/// Where strangers' robots run.
#[derive(Clone, Debug)]
pub enum Isolation {
    /// In this process, like all others.
    None,
    /// In confined processes.
    Workers(Workers),
}

/// Admits robots and plays matches by one set of rules.
pub struct Referee {
    rules: Ruleset,
    matches: u32,
    cache: Option<Cache>,
    isolation: Isolation,
    // Each is made when the first robot needs it.
    host: OnceLock<Host>,
    supervisor: OnceLock<Supervisor>,
}

/// A robot that has been admitted.
pub enum Player {
    /// It runs in this process.
    Local(Box<Robot>),
    /// It runs in workers.
    Remote(RemoteRobot),
}

/// A match in short.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// How it ended.
    pub outcome: Outcome,
    /// The digest of the trace.
    pub trace: Digest,
    /// Entries that the robot's journal has, and that were dropped from it.
    pub journal: (u64, u64),
}

/// Gets what came of a match, and says whether to go on.
pub type Each<'a> = dyn FnMut(Result<Record, HostError>) -> ControlFlow<()> + 'a;

impl Player {
    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        match self {
            Self::Local(robot) => robot.cache_use(),
            Self::Remote(robot) => robot.cache_use(),
        }
    }
}

impl Referee {
    /// A referee for up to `matches` matches at the same time (at least 1), with
    /// compiled robots kept in `cache`.
    pub const fn new(
        rules: Ruleset,
        matches: u32,
        cache: Option<Cache>,
        isolation: Isolation,
    ) -> Self {
        Self {
            rules,
            matches,
            cache,
            isolation,
            host: OnceLock::new(),
            supervisor: OnceLock::new(),
        }
    }

    /// The rules that it plays by.
    pub const fn rules(&self) -> &Ruleset {
        &self.rules
    }

    /// How well the operating system confines the workers; `None` while there are none.
    pub fn sandbox(&self) -> Option<Sandbox> {
        self.supervisor.get().map(Supervisor::sandbox)
    }

    /// Admits the bytes of a component, or of a core module that can be turned into
    /// one, as a robot.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is refused.
    ///
    /// ```
    /// use wasmouse::robot::{Isolation, Referee, Refusal, Trust};
    /// use wasmouse::sim::Ruleset;
    ///
    /// let referee = Referee::new(Ruleset::default(), 1, None, Isolation::None);
    /// let admission = referee.admit(b"", Trust::Trusted).expect("address space");
    /// assert!(matches!(admission, Err(Refusal::Empty)));
    /// ```
    pub fn admit(&self, bytes: &[u8], trust: Trust) -> Result<Result<Player, Refusal>, HostError> {
        Ok(match self.supervisor_for(trust)? {
            Some(supervisor) => supervisor.admit(bytes)?.map(Player::Remote),
            None => {
                let admitted = self.host()?.admit(bytes);
                admitted.map(|robot| Player::Local(Box::new(robot)))
            }
        })
    }

    /// Looks at a file as [`Referee::admit`] would, and tells everything.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn inspect(&self, bytes: &[u8], trust: Trust) -> Result<Inspection, HostError> {
        match self.supervisor_for(trust)? {
            Some(supervisor) => supervisor.inspect(bytes),
            None => Ok(self.host()?.inspect(bytes)),
        }
    }

    /// Plays matches of one robot and hands over their records in order. A match that
    /// the host could not play is played once more before it counts as failed. Plays
    /// no more when `each` breaks.
    pub fn play(
        &self,
        player: &Player,
        games: &[Game<'_>],
        recorder: &mut Recorder,
        each: &mut Each<'_>,
    ) -> ControlFlow<()> {
        match player {
            Player::Local(robot) => games.iter().try_for_each(|game| {
                let mut play = || self.play_here(robot, game, recorder);
                each(play().or_else(|_| play()))
            }),
            Player::Remote(robot) => match self.supervisor() {
                Ok(Some(supervisor)) => supervisor.play(robot, games, recorder, each),
                _ => games
                    .iter()
                    .try_for_each(|_| each(Err(HostError::stranger()))),
            },
        }
    }

    /// Plays one match and leaves everything about it in `recorder`.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn record(
        &self,
        player: &Player,
        game: &Game<'_>,
        recorder: &mut Recorder,
    ) -> Result<Outcome, HostError> {
        match player {
            Player::Local(robot) => self.host()?.play(robot, game, recorder),
            Player::Remote(robot) => {
                let supervisor = self.supervisor()?.ok_or_else(HostError::stranger)?;
                let record = supervisor.record(robot, game, recorder)?;
                Ok(record.outcome)
            }
        }
    }

    /// Where in its code a robot is when it fails in that match, the innermost call
    /// first; `None` when that cannot be found out. `bytes` is the file that was
    /// admitted.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn explain(
        &self,
        player: &Player,
        bytes: &[u8],
        game: &Game<'_>,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, HostError> {
        match player {
            Player::Local(_) => {
                let host = Host::explaining(self.rules.limits)?;
                host.clock().start()?;
                let Ok(robot) = host.admit(bytes) else {
                    return Ok(None);
                };
                let mut recorder = Recorder::default();
                let outcome = host.play(&robot, game, &mut recorder)?;
                Ok(match outcome.verdict {
                    Verdict::Fault(again) if again == *fault => Some(recorder.frames),
                    _ => None,
                })
            }
            Player::Remote(_) => {
                let supervisor = self.supervisor()?.ok_or_else(HostError::stranger)?;
                supervisor.explain(bytes, game, fault)
            }
        }
    }

    fn play_here(
        &self,
        robot: &Robot,
        game: &Game<'_>,
        recorder: &mut Recorder,
    ) -> Result<Record, HostError> {
        let outcome = self.host()?.play(robot, game, recorder)?;
        Ok(Record {
            outcome,
            trace: recorder.trace_digest(),
            journal: recorder.journal.counts(),
        })
    }

    fn host(&self) -> Result<&Host, HostError> {
        if let Some(host) = self.host.get() {
            return Ok(host);
        }
        let host = Host::new(self.rules.limits, self.matches, self.cache.clone())?;
        Ok(self.host.get_or_init(|| host))
    }

    fn supervisor_for(&self, trust: Trust) -> Result<Option<&Supervisor>, HostError> {
        match trust {
            Trust::Trusted => Ok(None),
            Trust::Stranger => self.supervisor(),
        }
    }

    fn supervisor(&self) -> Result<Option<&Supervisor>, HostError> {
        let Isolation::Workers(workers) = &self.isolation else {
            return Ok(None);
        };
        if let Some(supervisor) = self.supervisor.get() {
            return Ok(Some(supervisor));
        }
        let supervisor = Supervisor::new(self.rules, workers.clone(), self.cache.clone())?;
        Ok(Some(self.supervisor.get_or_init(|| supervisor)))
    }
}
