//! The champion: learns what kind of maze it is in, and explores only what is likely
//! to pay.
//!
//! No report describes this robot. It plays for the score: a step of exploring costs
//! a thirtieth of a step of racing, so it wants the goal soon, and afterwards only
//! such knowledge as is worth its price.
//!
//! - *Believing*: chances for walls not seen yet, from patterns counted in generated
//!   mazes and from what this maze has shown so far (`belief.rs`).
//! - *Exploring*: to the goal on the cheapest way under costs for unlikely walls, then
//!   after better ways, until looking costs more than it promises (`planner.rs`).
//! - *Racing*: the fewest steps through walls known to be open.
//!
//! When the reset comes with proof that no shorter way exists, whatever the unknown
//! walls are, it writes [`PROVEN`] to the journal.
//!
//! It reaches the goal wherever that is possible within the budget: every wall not
//! known to be closed can be driven through at a finite cost, and every detour has
//! taught it a wall. When the goal turns out to be walled in, it turns on the spot.
//! The parameters are trained on generated mazes only: `training.toml` has the seeds,
//! and `cargo run --release -p robot-champion --example train` writes them.
//!
//! Measured natively (`cargo run --release -p robot-champion --example regret`, mean
//! score minus the score of a robot that knows the maze): 1.588 in 250 generated mazes
//! of the kind division and 1.389 in 250 of the kind tree (sizes 12..=20, seeds
//! 1..=50, never trained on); 2.051 in 250 of the kind braid; 79.233 as the sum of the
//! three official scores, against 66.234; 5.054 in 228 competition mazes with one
//! entrance to the goal and 6.115 in 31 with several. Redrawing the samples twice
//! after news instead of once costs twice the time and gives 1.578, 1.337, 2.002,
//! 78.033, 4.893 and 6.925. In generated mazes most of the regret is paid before the
//! goal is reached for the first time; where there are several entrances, by
//! exploring on for longer than it pays.
//!
//! Settings: 0 is fast.

mod belief;
mod numbers;
pub mod parameters;
mod planner;

pub use planner::Parameters;

use wasmouse_sdk::{
    Action, Briefing, CellSet, Certificate, Grid, Heading, Map, Robot, Run, Search, Sensors,
    Tracker, Turn, Wall, export_robot, journal,
};

use belief::{Belief, Known};
use planner::{Plan, Planner};

/// What the journal says when the best way is certain.
pub const PROVEN: &str = "optimal way proven";

/// How many sampled mazes the robot believes in.
const SAMPLES: usize = 8;

/// How often each is redrawn after news.
const SWEEPS: u32 = 1;

/// The robot.
pub struct Champion {
    tracker: Tracker,
    grid: Grid,
    belief: Belief,
    planner: Planner,
    search: Search,
}

export_robot!(Champion);

impl Robot for Champion {
    fn start(briefing: &Briefing) -> Self {
        assert!(briefing.setting == 0, "champion has the setting 0");
        Self::with_parameters(briefing, parameters::SCALARS)
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        let cell = self.tracker.cell();
        if self.tracker.run() == Run::Speed {
            let hop = self.planner.race(self.tracker.map(), cell);
            return self.act(hop.map_or(Plan::Look, Plan::Drive));
        }
        let news = self.news();
        self.belief.learn(&news, SWEEPS);
        if !self.tracker.may_reset() {
            let hop = self.planner.toward_goal(&self.belief, cell);
            return self.act(hop.map_or(Plan::Look, Plan::Drive));
        }
        let plan = if self.tracker.can_afford_race(1, &mut self.search) {
            self.planner.explore(&self.belief, self.tracker.map(), cell)
        } else {
            Plan::Stop
        };
        self.act(plan)
    }
}

impl Champion {
    /// The robot with other scalars than the trained ones; for training.
    pub fn with_parameters(briefing: &Briefing, parameters: Parameters) -> Self {
        Self {
            tracker: Tracker::new(briefing),
            grid: Grid::new(briefing.dimension),
            belief: Belief::new(briefing, SAMPLES),
            planner: Planner::new(briefing, parameters),
            search: Search::new(briefing.dimension, briefing.longest_move),
        }
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
