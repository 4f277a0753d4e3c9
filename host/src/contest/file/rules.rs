//! [`RulesEntry`]: the `[rules]` of a contest file.

use serde::Deserialize;
use wasmouse_core::game::{BudgetScope, GameRules, Ruleset, SandboxLimits};

use super::super::config::{Integer, Name, table};
use super::options::{FUEL_MAX, MEMORY_BYTES_MAX};

/// A bundled ruleset, or one with numbers of its own.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct RulesEntry {
    /// The bundled ruleset that everything else is taken from. Default `udacity`.
    pub base: Option<Name>,
    /// The name of the ruleset. Default: that of `base`; required with numbers of its own.
    pub name: Option<Name>,
    /// The version of the ruleset. Default: that of `base`.
    pub version: Option<Integer<1, { u32::MAX as u64 }>>,
    /// Rules of the game that are not those of `base`.
    #[serde(deserialize_with = "table")]
    pub game: GameEntry,
    /// Limits on robots that are not those of `base`.
    #[serde(deserialize_with = "table")]
    pub sandbox: SandboxEntry,
}

/// Rules of the game: see [`GameRules`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct GameEntry {
    /// The most steps of a match or of a run.
    pub budget: Option<Integer<1, 1_000_000>>,
    /// Whether `budget` applies to both runs together or to each.
    pub budget_scope: Option<BudgetScope>,
    /// The longest move in a step, in cells.
    pub longest_move: Option<Integer<1, 255>>,
    /// The divisor of the exploration run's steps in the score.
    pub exploration_divisor: Option<Integer<1, 1_000_000>>,
}

/// Limits on the resources of a robot: see [`SandboxLimits`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct SandboxEntry {
    /// Fuel for instantiation, and again for the call of `start`.
    pub start_fuel_max: Option<Integer<1, FUEL_MAX>>,
    /// Fuel for one step.
    pub step_fuel_max: Option<Integer<1, FUEL_MAX>>,
    /// Fuel for `start` and all steps of a match together.
    pub match_fuel_max: Option<Integer<1, FUEL_MAX>>,
    /// Linear memory, in bytes.
    pub memory_bytes_max: Option<Integer<65_536, MEMORY_BYTES_MAX>>,
    /// Table elements.
    pub table_elements_max: Option<Integer<0, 10_000_000>>,
    /// Wasm call stack, in bytes.
    pub stack_bytes_max: Option<Integer<16_384, 4_194_304>>,
    /// Journal of a match, in bytes.
    pub journal_bytes_max: Option<Integer<0, 16_777_216>>,
    /// Bytes that one call into the host may copy.
    pub host_call_bytes_max: Option<Integer<1, 1_048_576>>,
}

impl RulesEntry {
    /// The ruleset; `None` if there is no bundled one of the name.
    pub fn ruleset(&self) -> Option<Ruleset> {
        let mut rules = match &self.base {
            None => Ruleset::default(),
            Some(name) => Ruleset::by_name(name.as_str())?,
        };
        if let Some(name) = &self.name {
            name.as_str().clone_into(&mut rules.name);
        }
        if let Some(version) = self.version {
            rules.version = version.get_u32();
        }
        self.game.apply(&mut rules.game);
        self.sandbox.apply(&mut rules.sandbox);
        Some(rules)
    }
}

/// Replaces a number if there is one for it.
fn set<const MIN: u64, const MAX: u64>(number: &mut u64, by: Option<Integer<MIN, MAX>>) {
    if let Some(by) = by {
        *number = by.get();
    }
}

impl GameEntry {
    fn apply(&self, rules: &mut GameRules) {
        if let Some(budget) = self.budget {
            rules.budget = budget.get_u32();
        }
        if let Some(scope) = self.budget_scope {
            rules.budget_scope = scope;
        }
        if let Some(cells) = self.longest_move {
            rules.longest_move = u8::try_from(cells.get()).expect("the range of the type");
        }
        if let Some(divisor) = self.exploration_divisor {
            rules.exploration_divisor = divisor.get_u32();
        }
    }
}

impl SandboxEntry {
    fn apply(&self, limits: &mut SandboxLimits) {
        let Self {
            start_fuel_max,
            step_fuel_max,
            match_fuel_max,
            memory_bytes_max,
            table_elements_max,
            stack_bytes_max,
            journal_bytes_max,
            host_call_bytes_max,
        } = *self;
        set(&mut limits.start_fuel_max, start_fuel_max);
        set(&mut limits.step_fuel_max, step_fuel_max);
        set(&mut limits.match_fuel_max, match_fuel_max);
        set(&mut limits.memory_bytes_max, memory_bytes_max);
        set(&mut limits.table_elements_max, table_elements_max);
        set(&mut limits.stack_bytes_max, stack_bytes_max);
        set(&mut limits.journal_bytes_max, journal_bytes_max);
        set(&mut limits.host_call_bytes_max, host_call_bytes_max);
    }
}
