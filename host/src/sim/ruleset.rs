//! [`Ruleset`]: the numbers of a contest, named and versioned.

use super::Limits;
use serde::{Deserialize, Serialize};

/// What the step budget counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum BudgetScope {
    /// Both runs share it.
    BothRuns,
    /// Each run has all of it.
    EachRun,
}

/// Everything that decides a match apart from the robot, the maze and the seed.
///
/// Changing any number of a published ruleset means a new version of it.
///
/// ```
/// use wasmouse::sim::Ruleset;
/// let rules = Ruleset::by_name("udacity").expect("the default ruleset");
/// assert_eq!((rules.version, rules.budget), (1, 1000));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Ruleset {
    /// A short name: lowercase letters and hyphens.
    // A worker process plays by numbers and needs no name.
    #[serde(skip)]
    pub name: &'static str,
    /// Counted from 1.
    pub version: u32,
    /// Steps that a robot may take. The last one is still executed.
    pub budget: u32,
    /// Whether `budget` is for both runs together or for each.
    pub budget_scope: BudgetScope,
    /// The longest move in one step, in cells.
    pub longest_move: u8,
    /// The steps of run 1 are divided by this in the score; at least 1.
    pub exploration_divisor: u32,
    /// What a robot may use.
    pub limits: Limits,
}

impl Ruleset {
    /// All rulesets, the default first.
    pub fn all() -> [Self; 2] {
        let udacity = Self {
            name: "udacity",
            version: 1,
            budget: 1000,
            budget_scope: BudgetScope::BothRuns,
            longest_move: 3,
            exploration_divisor: 30,
            limits: Limits::default(),
        };
        let each_run = Self {
            name: "udacity-each-run",
            budget_scope: BudgetScope::EachRun,
            ..udacity
        };
        [udacity, each_run]
    }

    /// The ruleset of that name, or `None`.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|rules| rules.name == name)
    }

    /// The bytes that identify the rules: name, version and every number.
    pub fn identity_bytes(&self) -> Vec<u8> {
        // The debug form names every field, so that a new one cannot be
        // forgotten here.
        format!("{self:?}").into_bytes()
    }
}

impl Default for Ruleset {
    fn default() -> Self {
        let [udacity, _] = Self::all();
        udacity
    }
}
