//! The champion: learns what kind of maze it is in, and explores only what is likely to
//! pay off.
//!
//! No report describes this robot. It plays for the score: a step of the exploration run
//! costs a thirtieth of a step of the speed run, so it heads for the goal at once, and
//! afterwards explores only where the expected gain exceeds the cost.
//!
//! - *Belief*: probabilities for unseen walls, from patterns counted in generated mazes and
//!   from what this maze has shown so far, and complete mazes sampled with these
//!   probabilities (`belief.rs`).
//! - *Exploration run*: first to the goal on the path that is cheapest when every unknown
//!   wall costs some steps. Then it checks shorter paths that may exist, the one with the
//!   highest expected gain per step first, until none is worth its cost (`planner.rs`) or
//!   too many have turned out to be closed (`faith.rs`).
//! - *Speed run*: the fewest steps through walls known to be open.
//!
//! If no shorter path can exist when it resets, whatever the unknown walls are, it writes
//! [`PROVEN`] to the journal.
//!
//! The robot reaches the goal wherever that is possible within the budget: it can plan
//! through any wall that is not known to be closed, at a finite cost, and every detour
//! teaches it a wall. If the goal turns out to be walled in, it turns on the spot.
//!
//! Variants: 0 is fast. 1 is deep: it samples more mazes and checks the shortest path of
//! each. In mazes of more than 20 x 20 cells both play alike.
//!
//! The parameters are trained on generated mazes only (`training.toml`). `README.md`, in the
//! folder of this crate, has the measurements.

mod belief;
mod faith;
mod knowledge;
mod numbers;
pub mod parameters;
mod planner;
mod room;
mod tuning;

pub use tuning::Parameters;

use wasmouse_sdk::{
    Action, Briefing, CellSet, Certificate, Grid, Heading, Map, Robot, Run, Search, Sensors,
    Tracker, Turn, View, Wall, export_robot, journal,
};

use belief::Belief;
use knowledge::{Knowledge, Known};
use parameters::KINDS;
use planner::{Plan, Planner};

/// Logged when the best path is certain.
pub const PROVEN: &str = "optimal way proven";

/// How much the robot computes.
struct Effort {
    /// Sampled mazes of the belief.
    samples: usize,
    /// How often each is redrawn after news.
    sweeps: u32,
}

const FAST: Effort = Effort {
    samples: 12,
    sweeps: 1,
};

const DEEP: Effort = Effort {
    samples: 64,
    sweeps: 3,
};

/// In mazes in which a thousand steps with more would take more than the fuel of a match.
const SPARING: Effort = Effort {
    samples: 6,
    sweeps: 1,
};

/// The largest mazes for which the fuel of a match is enough, in cells along each side.
const DEEP_MAX: u32 = 20;
const FAST_MAX: u32 = 32;

/// The robot.
pub struct Champion {
    tracker: Tracker,
    grid: Grid,
    parameters: [Parameters; KINDS],
    sweeps: u32,
    belief: Belief,
    knowledge: Knowledge,
    planner: Planner,
    search: Search,
}

export_robot!(Champion);

impl Robot for Champion {
    fn start(briefing: &Briefing) -> Self {
        Self::with_parameters(briefing, parameters::SCALARS)
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        if self.tracker.run() == Run::Speed {
            let known = self.tracker.map().passages(View::Pessimistic);
            let hop = self.planner.race(known, self.tracker.cell());
            return self.act(hop.map_or(Plan::Look, Plan::Drive));
        }
        let goal_seen = self.tracker.may_reset();
        if goal_seen && !self.tracker.can_afford_race(1, &mut self.search) {
            return self.act(Plan::Stop);
        }
        let news = self.news();
        self.belief.learn(&news, self.sweeps);
        let plan = self.decide(goal_seen);
        self.act(plan)
    }

    fn map(&self) -> Option<&Map> {
        Some(self.tracker.map())
    }
}

impl Champion {
    /// The robot with other scalars than the trained ones; for training.
    ///
    /// # Panics
    ///
    /// On a variant it does not have.
    pub fn with_parameters(briefing: &Briefing, parameters: [Parameters; KINDS]) -> Self {
        let effort = match (briefing.variant, briefing.dimension) {
            (1, ..=DEEP_MAX) => DEEP,
            (0 | 1, ..=FAST_MAX) => FAST,
            (0 | 1, _) => SPARING,
            _ => panic!("champion has the variants 0 and 1"),
        };
        Self {
            tracker: Tracker::new(briefing),
            grid: Grid::new(briefing.dimension),
            parameters,
            sweeps: effort.sweeps,
            belief: Belief::new(briefing, effort.samples),
            knowledge: Knowledge::new(briefing.dimension),
            planner: Planner::new(briefing),
            search: Search::new(briefing.dimension, briefing.longest_move),
        }
    }

    fn decide(&mut self, goal_seen: bool) -> Plan {
        let cell = self.tracker.cell();
        let open = self.tracker.map().passages(View::Pessimistic);
        let (belief, knowledge) = (&self.belief, &mut self.knowledge);
        let weights = belief.kinds().into_iter();
        let parameters = Parameters::mean(weights.zip(self.parameters));
        let chance = |wall| belief.chance(wall);
        knowledge.take(open, belief.all_known(), chance, &parameters);
        if goal_seen {
            return self
                .planner
                .explore(knowledge, belief.mazes(), cell, &parameters);
        }
        let hop = self.planner.toward_goal(knowledge, cell);
        hop.map_or(Plan::Look, Plan::Drive)
    }

    fn act(&mut self, plan: Plan) -> Action {
        match plan {
            Plan::Drive(hop) => self.tracker.go(hop.heading, hop.cells),
            Plan::Look => self.tracker.turn(Turn::Right),
            Plan::Stop => {
                if self.is_proven() {
                    journal::info(PROVEN);
                }
                self.tracker.reset()
            }
        }
    }

    /// The walls in sight that the belief does not know yet, and whether they are
    /// open.
    fn news(&self) -> Vec<(usize, bool)> {
        let map: &Map = self.tracker.map();
        let mut news = Vec::new();
        for side in Heading::ALL {
            let mut cell = self.tracker.cell();
            loop {
                let wall = self.grid.wall(self.grid.cell(cell), side);
                let state = map.wall(cell, side);
                if state != Wall::Unknown && self.belief.known(wall) == Known::Unknown {
                    news.push((wall, state == Wall::Open));
                }
                match map.neighbor(cell, side) {
                    Some(beyond) if state == Wall::Open => cell = beyond,
                    _ => break,
                }
            }
        }
        news
    }

    fn is_proven(&mut self) -> bool {
        let briefing = self.tracker.briefing();
        let goal = CellSet::from(briefing.goal);
        let map = self.tracker.map();
        Certificate::of(map, briefing.start, &goal, &mut self.search).is_proven()
    }
}

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests;
