//! [`Baseline`]: recorded scores that a robot is compared with.

use std::collections::{BTreeSet, HashMap};

use wasmouse_core::game::{Ruleset, Score, Steps, Verdict};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::MatchRecord;
use wasmouse_core::{Digest, GuestText};

use super::super::mean::Mean;
use super::super::plan::Seeds;
use super::super::scoring::worst_score_steps;
use super::measure::mean_of;

/// The recorded matches of one robot under one ruleset.
#[derive(Clone, Debug, Default)]
pub struct Baseline {
    /// By maze and seed; what an unfinished match counts as, too.
    scores: HashMap<(Digest, u64), Score>,
}

/// Why records are no baseline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BaselineError {
    /// There are none.
    #[error("it has no matches")]
    Empty,
    /// No robot is called so.
    #[error("it has no matches of a robot `{0}`")]
    NoSuchRobot(String),
    /// It is not clear whose matches are meant.
    #[error("it has matches of {0} robots, and `baseline_robot` does not say which is meant")]
    SeveralRobots(usize),
    /// Its matches were played by other rules.
    #[error("its matches were played by other rules than those of the rubric")]
    OtherRules,
    /// Matches of the rubric are not in it.
    #[error("it has no match in maze `{}` with seed {seed}", maze.escaped())]
    MissingMatch {
        /// The maze.
        maze: GuestText,
        /// The seed.
        seed: u64,
    },
}

impl Baseline {
    /// The matches of a robot: the only one, or the one that is named. `name` gives the name of
    /// the robot of a record, if the document has one; a digest in hexadecimal is a name too.
    ///
    /// # Errors
    ///
    /// When no robot is meant, or more than one, or the rules are others.
    pub fn new<'a>(
        records: &'a [MatchRecord],
        name: impl Fn(&MatchRecord) -> Option<GuestStr<'a>>,
        robot: Option<&str>,
        rules: &Ruleset,
    ) -> Result<Self, BaselineError> {
        if records.is_empty() {
            return Err(BaselineError::Empty);
        }
        let is_meant = |record: &&MatchRecord| {
            robot.is_none_or(|it| {
                name(record).is_some_and(|name| name == it) || record.key.robot.to_string() == it
            })
        };
        let records: Vec<&MatchRecord> = records.iter().filter(is_meant).collect();
        let players: BTreeSet<_> = records
            .iter()
            .map(|it| (it.key.robot, it.key.variant))
            .collect();
        match (players.len(), robot) {
            (1, _) => {}
            (0, robot) => {
                return Err(BaselineError::NoSuchRobot(
                    robot.unwrap_or_default().to_owned(),
                ));
            }
            (count, _) => return Err(BaselineError::SeveralRobots(count)),
        }
        let digest = rules.digest();
        if records.iter().any(|it| it.key.rules != digest) {
            return Err(BaselineError::OtherRules);
        }
        let scores = records.iter().map(|record| {
            let place = (record.key.maze, record.key.seed);
            (place, cost(record, rules))
        });
        Ok(Self {
            scores: scores.collect(),
        })
    }

    /// Checks that it has every match in a maze.
    ///
    /// # Errors
    ///
    /// With the first that it has not.
    pub fn require(
        &self,
        name: &GuestText,
        maze: Digest,
        seeds: Seeds,
    ) -> Result<(), BaselineError> {
        let mut all = (0..seeds.count).map(|it| seeds.get(it));
        match all.find(|&seed| !self.scores.contains_key(&(maze, seed))) {
            None => Ok(()),
            Some(seed) => Err(BaselineError::MissingMatch {
                maze: name.clone(),
                seed,
            }),
        }
    }

    /// The average over those matches; `None` when one of them is not there, or there are none.
    pub fn mean_score(&self, places: impl Iterator<Item = (Digest, u64)>) -> Option<Mean> {
        let scores: Option<Vec<Score>> = places.map(|it| self.scores.get(&it).copied()).collect();
        mean_of(scores?.into_iter())
    }
}

/// What a match counts as.
fn cost(record: &MatchRecord, rules: &Ruleset) -> Score {
    let Steps { exploration, speed } = record.steps;
    match record.verdict {
        Verdict::Finished { .. } => rules.game.score(speed, exploration),
        Verdict::BudgetUsedUp { .. } | Verdict::Fault { .. } => {
            let worst = worst_score_steps(&rules.game);
            Score::new(worst, 0, rules.game.exploration_divisor)
        }
    }
}
