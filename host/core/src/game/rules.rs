//! [`Ruleset`]: the rules of a contest, with a name and a version.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::{FuelClass, SandboxLimits, Score};
use crate::maze::{Maze, oracle_steps};
use crate::{Digest, DigestBuilder};

/// What the step budget applies to. Serialises as `"both-runs"` or `"each-run"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BudgetScope {
    /// Both runs together.
    BothRuns,
    /// Each run alone.
    EachRun,
}

/// The rules of the game. Serialises as an object with these fields; deserialising fails if a
/// number is out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GameRules {
    /// The most steps of a match or of a run. Range: at least 1. Default 1000.
    #[serde(deserialize_with = "at_least_1")]
    pub budget: u32,
    /// Whether `budget` applies to both runs together or to each.
    pub budget_scope: BudgetScope,
    /// The longest move in a step, in cells. Range: at least 1. Default 3.
    #[serde(deserialize_with = "at_least_1")]
    pub longest_move: u8,
    /// The divisor of the exploration run's steps in the score. Range: at least 1. Default 30.
    #[serde(deserialize_with = "at_least_1")]
    pub exploration_divisor: u32,
}

fn at_least_1<'de, D, N>(deserializer: D) -> Result<N, D::Error>
where
    D: Deserializer<'de>,
    N: Deserialize<'de> + Default + PartialEq,
{
    let number = N::deserialize(deserializer)?;
    if number == N::default() {
        return Err(D::Error::custom("expected a number of at least 1, found 0"));
    }
    Ok(number)
}

impl GameRules {
    /// The score of a robot that knows the maze: the optimal path, a reset, and the optimal
    /// path again. `None` if the goal is unreachable.
    pub fn oracle_score(&self, maze: &Maze) -> Option<Score> {
        let steps = oracle_steps(maze, self.longest_move)?;
        Some(self.score(steps.speed_steps, steps.exploration_steps))
    }

    /// The score of a finished match with these steps.
    ///
    /// # Panics
    ///
    /// If `exploration_divisor` is 0.
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

/// Everything that decides a match apart from the engine, the robot, the maze and the seed.
///
/// The limits that decide whether a file is accepted as a robot are not part of it, because
/// they cannot change a verdict. Serialises as an object with these fields.
///
/// ```
/// use wasmouse_core::game::Ruleset;
/// let rules = Ruleset::by_name("udacity").expect("the default ruleset");
/// assert_eq!((rules.version, rules.game.budget), (1, 1000));
/// assert_eq!(rules, Ruleset::default());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ruleset {
    /// A short name for people.
    pub name: String,
    /// The version, counted from 1. A change of any number of a published ruleset needs a new
    /// one.
    pub version: u32,
    /// The rules of the game.
    pub game: GameRules,
    /// The resources that a robot may use.
    pub sandbox: SandboxLimits,
}

impl Ruleset {
    /// The bundled rulesets, the default first: `udacity`, `udacity-each-run`,
    /// `udacity-interpreted`, `udacity-each-run-interpreted`.
    pub fn all() -> [Self; 4] {
        let named = |name: &str, budget_scope, class: FuelClass| Self {
            name: name.to_owned(),
            version: 1,
            game: GameRules {
                budget_scope,
                ..GameRules::default()
            },
            sandbox: class.limits(),
        };
        let (both, each) = (BudgetScope::BothRuns, BudgetScope::EachRun);
        [
            named("udacity", both, FuelClass::Compiled),
            named("udacity-each-run", each, FuelClass::Compiled),
            named("udacity-interpreted", both, FuelClass::Interpreted),
            named("udacity-each-run-interpreted", each, FuelClass::Interpreted),
        ]
    }

    /// For which kind of language the fuel limits are made; `None` if they are those of no class.
    pub fn fuel_class(&self) -> Option<FuelClass> {
        FuelClass::of(&self.sandbox)
    }

    /// The bundled ruleset of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|rules| rules.name == name)
    }

    /// The identity of the rules. It does not depend on the name and the version.
    ///
    /// Canonical encoding `wasmouse.rules.1` ([`DigestBuilder`]): the numbers `budget`,
    /// `budget_scope` (0 both runs, 1 each run), `longest_move`, `exploration_divisor`, then
    /// the fields of [`SandboxLimits`] in order.
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
        let [udacity, ..] = Self::all();
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
                "3fe61a16e3546d743533a1a1e3ca3c8cc9ede8a95853e7814bc8c0eaf9dae67a",
                "fb03a1d34821bcd9ad219c0f09e420cc6169e6f553a7945f16a5a77e6cd77de6",
            ]
        );
    }

    #[test]
    fn rules_deserialise_only_in_range() {
        let json = serde_json::to_string(&Ruleset::default()).expect("it serialises");
        let parsed = serde_json::from_str::<Ruleset>(&json).ok();
        assert_eq!(parsed, Some(Ruleset::default()));
        for field in [
            "budget\":1000",
            "longest_move\":3",
            "exploration_divisor\":30",
        ] {
            let name = field.trim_end_matches(|c: char| c.is_ascii_digit());
            let changed = json.replace(field, &format!("{name}0"));
            let error = serde_json::from_str::<Ruleset>(&changed).expect_err(field);
            assert!(error.to_string().contains("at least 1, found 0"), "{error}");
        }
    }

    #[test]
    fn name_and_version_are_not_part_of_the_identity() {
        let mut rules = Ruleset::default();
        let digest = rules.digest();
        rules.name = "mine".to_owned();
        rules.version = 7;
        assert_eq!(rules.digest(), digest);
        rules.game.budget -= 1;
        assert_ne!(rules.digest(), digest);
    }
}
