//! [`Scoring`]: how a contest turns matches into ranks.

use serde::{Deserialize, Serialize};
use wasmouse_core::game::{BudgetScope, GameRules};

/// How robots are ranked. Serialises as an object with these fields, in kebab case where they are
/// names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scoring {
    /// What robots are ranked by.
    pub method: Method,
    /// What an unfinished match counts as, in steps. `None` is [`worst_score_steps`]. Range: at
    /// least 1.
    pub unfinished_steps: Option<u32>,
    /// What decides between robots that are equal by the method, in this order. Robots that are
    /// still equal share a rank. Empty is [`TIE_BREAKS_DEFAULT`].
    pub tie_breaks: Vec<TieBreak>,
}

/// The tie-breaks of a contest that names none.
pub const TIE_BREAKS_DEFAULT: [TieBreak; 4] = [
    TieBreak::Finished,
    TieBreak::MedianScore,
    TieBreak::ExplorationSteps,
    TieBreak::Fuel,
];

impl Scoring {
    /// What an unfinished match counts as, in steps.
    ///
    /// ```
    /// use wasmouse::contest::Scoring;
    /// use wasmouse_core::game::GameRules;
    ///
    /// assert_eq!(Scoring::default().penalty_steps(&GameRules::default()), 1000);
    /// ```
    pub fn penalty_steps(&self, rules: &GameRules) -> u32 {
        self.unfinished_steps
            .unwrap_or_else(|| worst_score_steps(rules))
    }

    /// What decides between robots that are equal by the method.
    pub fn order(&self) -> &[TieBreak] {
        match self.tie_breaks.as_slice() {
            [] => &TIE_BREAKS_DEFAULT,
            tie_breaks => tie_breaks,
        }
    }
}

/// What robots are ranked by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The average score; an unfinished match counts as [`Scoring::unfinished_steps`]. Lower is
    /// better.
    #[default]
    MeanScore,
    /// The average of score minus oracle score; an unfinished match has the regret of
    /// [`Scoring::unfinished_steps`]. Lower is better. All ranked robots have played the same
    /// mazes, so this ranks them as `MeanScore` does, but with numbers that can be compared
    /// between contests.
    Regret,
    /// Points for each match: one for each robot that scored worse in the same maze with the same
    /// seed, and half a point for each that did equally well. Any score is better than an
    /// unfinished match. Higher is better.
    RankPoints,
}

/// What decides between robots that are equal by the method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TieBreak {
    /// More finished matches.
    Finished,
    /// The lower median score; unfinished matches count as [`Scoring::unfinished_steps`].
    MedianScore,
    /// The lower average of the exploration run's steps over the finished matches. Robots that
    /// finished none come last.
    ExplorationSteps,
    /// Less fuel a step.
    Fuel,
    /// Less linear memory in any match.
    Memory,
}

/// The least number of steps that no finished match can exceed as its score. By default, an
/// unfinished match counts as this, so that a robot never gains by failing.
///
/// ```
/// use wasmouse::contest::worst_score_steps;
/// use wasmouse_core::game::{BudgetScope, GameRules};
///
/// assert_eq!(worst_score_steps(&GameRules::default()), 1000);
/// let each_run = GameRules { budget_scope: BudgetScope::EachRun, ..GameRules::default() };
/// assert_eq!(worst_score_steps(&each_run), 1034);
/// ```
pub const fn worst_score_steps(rules: &GameRules) -> u32 {
    match rules.budget_scope {
        // A step in the exploration run counts no more than one in the speed run.
        BudgetScope::BothRuns => rules.budget,
        BudgetScope::EachRun => rules
            .budget
            .saturating_add(rules.budget.div_ceil(rules.exploration_divisor)),
    }
}
