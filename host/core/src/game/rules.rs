//! [`Ruleset`]: the numbers of a contest, named and versioned.

use serde::{Deserialize, Serialize};

use super::{SandboxLimits, Score};
use crate::maze::{Maze, oracle_steps};
use crate::{Digest, DigestBuilder};

/// What the step budget counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BudgetScope {
    /// Both runs share it.
    BothRuns,
    /// Each run has all of it.
    EachRun,
}

/// The rules of the game, which the simulation applies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GameRules {
    /// Steps that a robot may take; the last one still counts. Range: at least 1. Default
    /// 1000.
    pub budget: u32,
    /// Whether `budget` is for both runs together or for each.
    pub budget_scope: BudgetScope,
    /// The longest move in one step, in cells. Range: at least 1. Default 3.
    pub longest_move: u8,
    /// The steps of the exploration run are divided by this in the score. Range: at least
    /// 1. Default 30.
    pub exploration_divisor: u32,
}

impl GameRules {
    /// The score of a robot that knows the maze: the optimal path, a reset, and the
    /// optimal path again. `None` when the goal cannot be reached.
    pub fn oracle_score(&self, maze: &Maze) -> Option<Score> {
        let steps = oracle_steps(maze, self.longest_move)?;
        Some(self.score(steps.speed_steps, steps.exploration_steps))
    }

    /// The score of that many steps.
    pub const fn score(&self, speed_steps: u32, exploration_steps: u32) -> Score {
        Score::new(speed_steps, exploration_steps, self.exploration_divisor)
    }
}

impl Default for GameRules {
    /// The rules of the contest in the published reports.
    fn default() -> Self {
        Self {
            budget: 1000,
            budget_scope: BudgetScope::BothRuns,
            longest_move: 3,
            exploration_divisor: 30,
        }
    }
}

/// Everything that decides a match apart from the engine, the robot, the maze and the
/// seed.
///
/// What decides whether a file is admitted in the first place is not part of it: those
/// limits cannot change a verdict.
///
/// ```
/// use wasmouse_core::game::Ruleset;
/// let rules = Ruleset::by_name("udacity").expect("the default ruleset");
/// assert_eq!((rules.version, rules.game.budget), (1, 1000));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ruleset {
    /// A short name for people. Changing any number of a published ruleset means a new
    /// version of it.
    pub name: String,
    /// Counted from 1.
    pub version: u32,
    /// The rules of the game.
    pub game: GameRules,
    /// What a robot may use while it runs.
    pub sandbox: SandboxLimits,
}

impl Ruleset {
    /// The rulesets that come with wasmouse, the default first.
    pub fn all() -> [Self; 2] {
        let named = |name: &str, budget_scope| Self {
            name: name.to_owned(),
            version: 1,
            game: GameRules {
                budget_scope,
                ..GameRules::default()
            },
            sandbox: SandboxLimits::default(),
        };
        [
            named("udacity", BudgetScope::BothRuns),
            named("udacity-each-run", BudgetScope::EachRun),
        ]
    }

    /// The ruleset of that name, or `None`.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|rules| rules.name == name)
    }

    /// The identity of the rules: two rulesets with the same numbers have the same digest,
    /// whatever they are called.
    ///
    /// Canonical encoding `wasmouse.rules.1` ([`DigestBuilder`]): the numbers `budget`,
    /// `budget_scope` (0 both runs, 1 each run), `longest_move`, `exploration_divisor`, then
    /// the fields of [`SandboxLimits`] in their order.
    pub fn digest(&self) -> Digest {
        let GameRules {
            budget,
            budget_scope,
            longest_move,
            exploration_divisor,
        } = self.game;
        let scope = match budget_scope {
            BudgetScope::BothRuns => 0,
            BudgetScope::EachRun => 1,
        };
        DigestBuilder::new("wasmouse.rules.1")
            .numbers(&[
                budget.into(),
                scope,
                longest_move.into(),
                exploration_divisor.into(),
            ])
            .numbers(&self.sandbox.numbers())
            .finish()
    }
}

impl Default for Ruleset {
    fn default() -> Self {
        let [udacity, _] = Self::all();
        udacity
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published rulesets never change their numbers, and the encoding never changes its
    /// bytes.
    #[test]
    fn the_digests_of_the_published_rulesets_are_fixed() {
        let digests = Ruleset::all().map(|rules| rules.digest().to_string());
        assert_eq!(
            digests,
            [
                "13ad9a53527c9d92cfc39c2ddbef55fb4d4766eb48f072e8a01a6098ed890d07",
                "917978c514335e697a9a228d625257379162d592a71903c00b21bd58672b24a3",
            ]
        );
    }

    #[test]
    fn a_name_is_not_part_of_the_identity() {
        let mut rules = Ruleset::default();
        let digest = rules.digest();
        rules.name = "mine".to_owned();
        rules.version = 7;
        assert_eq!(rules.digest(), digest);
        rules.game.budget -= 1;
        assert_ne!(rules.digest(), digest);
    }
}
