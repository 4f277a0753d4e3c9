//! The rules by which the robot decides: [`Planner`].
//!
//! An unknown wall is worth a detour, the more the likelier it stands: on the way to
//! the goal it costs some steps times -ln of the chance that it is open. Once the
//! goal has been reached, the robot knows a way, and looks for the cheapest way from
//! the start under such costs. It goes on exploring as long as the steps which that
//! way would save in the race, times a power of the chance that the way exists, are
//! worth more than the steps to go and look.

use wasmouse_sdk::{
    Briefing, Cell, CellSet, Grid, GuidedSearch, Heading, Hop, Passages, Search, WeightedSearch,
};

use crate::knowledge::{Knowledge, Known, STEP};
use crate::numbers::exp;

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
    /// Under the costs on the way to the goal, and under those for better ways.
    weighted: [WeightedSearch; 2],
    /// For better ways in imagined matches.
    guided: GuidedSearch,
    search: Search,
}

const TO_GOAL: usize = 0;
const BETTER: usize = 1;

impl Planner {
    /// A planner for a match.
    pub fn new(briefing: &Briefing, parameters: Parameters) -> Self {
        let grid = Grid::new(briefing.dimension);
        let longest = briefing.longest_move;
        let weighted = WeightedSearch::new(grid, longest, STEP);
        Self {
            grid,
            start: briefing.start,
            goal: CellSet::from(briefing.goal),
            goal_numbers: briefing.goal.cells().map(|it| grid.cell(it)).collect(),
            divisor: briefing.exploration_divisor as f32,
            parameters,
            weighted: [weighted.clone(), weighted],
            guided: GuidedSearch::new(grid, longest, STEP),
            search: Search::new(briefing.dimension, longest),
        }
    }

    /// The next hop of the way to the goal that is cheapest in view of what is
    /// unknown; `None` when the goal is walled in.
    pub fn toward_goal(&mut self, knowledge: &Knowledge, from: Cell) -> Option<Hop> {
        let from = self.grid.cell(from);
        let search = &mut self.weighted[TO_GOAL];
        search.run(&knowledge.goal_costs, &self.goal_numbers, Some(from));
        search.hop(from)
    }

    /// The next hop of a shortest known way to the goal.
    pub fn race(&mut self, open: &Passages, from: Cell) -> Option<Hop> {
        self.search.fill_until(open, &self.goal, from);
        self.search.hops(open, from).next()
    }

    /// What to do once the goal has been reached.
    pub fn explore(&mut self, knowledge: &Knowledge, from: Cell) -> Plan {
        let Some(known_steps) = self.known_steps(&knowledge.open) else {
            let hop = self.toward_goal(knowledge, from);
            return hop.map_or(Plan::Stop, Plan::Drive);
        };
        let start = self.grid.cell(self.start);
        let search = &mut self.weighted[BETTER];
        search.run(&knowledge.way_costs, &self.goal_numbers, Some(start));
        let question = Question::of(knowledge, self.weighted[BETTER].way(start));
        self.weigh(knowledge, from, known_steps, &question)
    }

    /// Steps of the race through walls known to be open.
    pub fn known_steps(&mut self, open: &Passages) -> Option<u32> {
        self.search.fill_until(open, &self.goal, self.start);
        self.search.steps(self.start)
    }

    /// Whether a question is worth an answer, and where to go for it.
    fn weigh(
        &mut self,
        knowledge: &Knowledge,
        from: Cell,
        known_steps: u32,
        question: &Question,
    ) -> Plan {
        if question.steps >= known_steps || question.vantages.is_empty() {
            return Plan::Stop;
        }
        let open = &knowledge.open;
        self.search.fill_until(open, &question.vantages, from);
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
        self.go_on(open, from).map_or(Plan::Look, Plan::Drive)
    }

    /// The next hop to where the last plan of exploring leads; `None` when it has
    /// arrived.
    pub fn go_on(&self, open: &Passages, from: Cell) -> Option<Hop> {
        self.search.hops(open, from).next()
    }
}

/// For imagined matches: the same rule, thousands of times a decision.
impl Planner {
    /// Searches the whole maze for imagined matches to go on from.
    pub fn begin(&mut self, knowledge: &Knowledge) {
        let search = &mut self.weighted[BETTER];
        search.run(&knowledge.way_costs, &self.goal_numbers, None);
    }

    /// Begins an imagined match.
    pub fn again(&mut self) {
        self.guided.begin(&self.weighted[BETTER]);
    }

    /// Like [`explore`](Self::explore), with the goal reached.
    pub fn imagine_explore(&mut self, knowledge: &Knowledge, from: Cell) -> Plan {
        let Some(known_steps) = self.known_steps(&knowledge.open) else {
            return Plan::Stop;
        };
        let start = self.grid.cell(self.start);
        self.guided.run(&knowledge.way_costs, start);
        let question = Question::of(knowledge, self.guided.way());
        self.weigh(knowledge, from, known_steps, &question)
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

impl Question {
    fn of(knowledge: &Knowledge, way: impl Iterator<Item = (usize, Hop)>) -> Self {
        let grid = knowledge.grid;
        let mut question = Self {
            steps: 0,
            surprise: 0.0,
            vantages: CellSet::new(),
        };
        for (mut cell, hop) in way {
            question.steps += 1;
            for _ in 0..hop.cells {
                let wall = grid.wall(cell, hop.heading);
                if knowledge.known[wall] == Known::Unknown {
                    question.surprise += knowledge.surprise[wall];
                    add_vantages(knowledge, cell, hop.heading, &mut question.vantages);
                }
                cell = grid.beyond(cell, hop.heading);
            }
        }
        question
    }
}

/// Adds the cells from which the unknown wall on that side of `cell` is seen: the
/// cells on both sides of it, and those behind them as far as the view is known to be
/// free.
pub fn add_vantages(knowledge: &Knowledge, cell: usize, side: Heading, vantages: &mut CellSet) {
    let grid = knowledge.grid;
    let ends = [(cell, side.opposite()), (grid.beyond(cell, side), side)];
    for (mut cell, away) in ends {
        vantages.insert(grid.at(cell));
        while knowledge.known[grid.wall(cell, away)] == Known::Open {
            cell = grid.beyond(cell, away);
            vantages.insert(grid.at(cell));
        }
    }
}
