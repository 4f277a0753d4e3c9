//! Where to go next: [`Planner`].
//!
//! An unknown wall is worth a detour, the more the likelier it stands: on the way to
//! the goal it costs some steps times -ln of the chance that it is open. Once the
//! goal has been reached, the robot knows a way, and looks for the cheapest way from
//! the start under such costs. It goes on exploring as long as the steps which that
//! way would save in the race, times a power of the chance that the way exists, are
//! worth more than the steps to go and look.

use wasmouse_sdk::{
    Briefing, Cell, CellSet, Grid, Heading, Hop, IMPASSABLE, Map, Search, View, WeightedSearch,
};

use crate::belief::{Belief, Known};
use crate::numbers::{exp, ln};

/// The scalars that decide between driving, exploring and resetting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// What an unknown wall costs on the way to the goal. Unit: steps for each unit
    /// of -ln of the chance that it is open.
    pub goal_caution: f32,
    /// The same for the way from start to goal that is looked for afterwards.
    pub way_caution: f32,
    /// The power of the chance that this way exists.
    pub doubt: f32,
    /// How much more than the cost of looking the gain has to be.
    pub reluctance: f32,
    /// Steps that looking costs besides the way to the first wall.
    pub overhead: f32,
}

/// What a step costs in the weighted searches; walls cost in the same unit.
const STEP: u16 = 32;

/// The most that an unknown wall costs.
const WALL_COST_MAX: f32 = 600.0;

/// No wall is believed to be closed more firmly than that.
const CHANCE_MIN: f32 = 0.02;

/// What to do next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plan {
    /// Drive.
    Drive(Hop),
    /// Look around where it stands.
    Look,
    /// Exploring on does not pay.
    Stop,
}

/// Searches with their buffers.
pub struct Planner {
    grid: Grid,
    start: Cell,
    goal: CellSet,
    goal_numbers: Vec<usize>,
    divisor: f32,
    parameters: Parameters,
    costs: Vec<u16>,
    weighted: WeightedSearch,
    search: Search,
}

impl Planner {
    /// A planner for a match.
    pub fn new(briefing: &Briefing, parameters: Parameters) -> Self {
        let grid = Grid::new(briefing.dimension);
        Self {
            grid,
            start: briefing.start,
            goal: CellSet::from(briefing.goal),
            goal_numbers: briefing.goal.cells().map(|it| grid.cell(it)).collect(),
            divisor: briefing.exploration_divisor as f32,
            parameters,
            costs: vec![IMPASSABLE; grid.wall_count()],
            weighted: WeightedSearch::new(grid, briefing.longest_move, STEP),
            search: Search::new(briefing.dimension, briefing.longest_move),
        }
    }

    /// The next hop of the way to the goal that is cheapest in view of what is
    /// unknown; `None` when the goal is walled in.
    pub fn toward_goal(&mut self, belief: &Belief, from: Cell) -> Option<Hop> {
        self.price(belief, self.parameters.goal_caution);
        let from = self.grid.cell(from);
        self.weighted
            .run(&self.costs, &self.goal_numbers, Some(from));
        self.weighted.hop(from)
    }

    /// The next hop of a shortest known way to the goal.
    pub fn race(&mut self, map: &Map, from: Cell) -> Option<Hop> {
        let known = map.passages(View::Pessimistic);
        self.search.fill_until(known, &self.goal, from);
        self.search.hops(known, from).next()
    }

    /// What to do once the goal has been reached.
    pub fn explore(&mut self, belief: &Belief, map: &Map, from: Cell) -> Plan {
        let known = map.passages(View::Pessimistic);
        self.search.fill_until(known, &self.goal, self.start);
        let Some(known_steps) = self.search.steps(self.start) else {
            return self
                .toward_goal(belief, from)
                .map_or(Plan::Stop, Plan::Drive);
        };
        let question = self.question(belief);
        if question.steps >= known_steps || question.vantages.is_empty() {
            return Plan::Stop;
        }
        self.search.fill_until(known, &question.vantages, from);
        let Some(steps) = self.search.steps(from) else {
            return Plan::Stop;
        };
        let Parameters {
            doubt,
            reluctance,
            overhead,
            ..
        } = self.parameters;
        let gain = (known_steps - question.steps) as f32 * exp(-doubt * question.surprise);
        if gain <= reluctance * (steps as f32 + overhead) / self.divisor {
            return Plan::Stop;
        }
        let hop = self.search.hops(known, from).next();
        hop.map_or(Plan::Look, Plan::Drive)
    }

    /// The cheapest way from start to goal in view of what is unknown.
    fn question(&mut self, belief: &Belief) -> Question {
        self.price(belief, self.parameters.way_caution);
        let (grid, start) = (self.grid, self.grid.cell(self.start));
        self.weighted
            .run(&self.costs, &self.goal_numbers, Some(start));
        let mut question = Question {
            steps: 0,
            surprise: 0.0,
            vantages: CellSet::new(),
        };
        for (mut cell, hop) in self.weighted.way(start) {
            question.steps += 1;
            for _ in 0..hop.cells {
                let wall = grid.wall(cell, hop.heading);
                let beyond = grid.beyond(cell, hop.heading);
                if belief.known(wall) == Known::Unknown {
                    question.surprise -= ln(belief.chance(wall).max(CHANCE_MIN));
                    let vantages = &mut question.vantages;
                    add_vantages(grid, belief, cell, hop.heading.opposite(), vantages);
                    add_vantages(grid, belief, beyond, hop.heading, vantages);
                }
                cell = beyond;
            }
        }
        question
    }

    /// Gives every wall its cost.
    fn price(&mut self, belief: &Belief, caution: f32) {
        for wall in self.grid.inner_walls() {
            self.costs[wall] = match belief.known(wall) {
                Known::Open => 0,
                Known::Closed => IMPASSABLE,
                Known::Unknown => {
                    let surprise = -ln(belief.chance(wall).clamp(CHANCE_MIN, 1.0));
                    (caution * f32::from(STEP) * surprise + 0.5).min(WALL_COST_MAX) as u16
                }
            };
        }
    }
}

/// A way that may exist.
struct Question {
    steps: u32,
    /// The sum of -ln of the chances of its unknown walls.
    surprise: f32,
    /// Cells from which one of these walls is seen.
    vantages: CellSet,
}

/// Adds `cell` and the cells behind it, in direction `back`, as far as the view
/// from there to `cell` is known to be free.
fn add_vantages(
    grid: Grid,
    belief: &Belief,
    mut cell: usize,
    back: Heading,
    vantages: &mut CellSet,
) {
    vantages.insert(grid.at(cell));
    while belief.known(grid.wall(cell, back)) == Known::Open {
        cell = grid.beyond(cell, back);
        vantages.insert(grid.at(cell));
    }
}
