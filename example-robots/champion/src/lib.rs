//! The champion: learns what kind of maze it is in, and explores only what is likely
//! to pay.
//!
//! No report describes this robot. It plays for the score: a step of exploring costs
//! a thirtieth of a step of racing, so it wants the goal soon, and afterwards only
//! such knowledge as is worth its price.
//!
//! - *Believing*: chances for walls not seen yet, from patterns counted in generated
//!   mazes and from what this maze has shown so far (`belief.rs`). In `deep` also from
//!   whole mazes that agree with everything seen: trees with loops (`trees.rs`), rows of
//!   walls (`rows.rs`), each as much as what was seen speaks for it (`ensemble.rs`).
//! - *Exploring*: to the goal on the cheapest way under costs for unlikely walls, then
//!   after better ways, until looking costs more than it promises (`planner.rs`). In
//!   `deep` the robot, once it has been in the goal and as long as the maze looks like a
//!   tree or like rows of walls, plays what it could do to the end in such mazes, and
//!   does what comes out cheapest (`imagination.rs`).
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
//! Measured natively (`cargo run --release -p robot-champion --example regret`): the
//! mean regret, which is the score minus the score of a robot that knows the maze, with
//! its standard error, and that of the difference in the same mazes. The generated mazes
//! have the sizes 12..=20 and the seeds 1..=50, never trained on; the competition mazes
//! are 16 x 16; no parameter was tuned on them.
//!
//! | mazes | count | `fast` | `deep` | difference |
//! |---|---|---|---|---|
//! | division | 250 | 1.588 | 1.481 +- 0.089 | -0.107 +- 0.046 |
//! | tree,loops=12 | 250 | 1.389 | 1.396 +- 0.081 | +0.007 +- 0.051 |
//! | braid | 250 | 2.051 | 1.848 +- 0.117 | -0.203 +- 0.126 |
//! | competition, one entrance to the goal | 228 | 5.054 | 5.038 +- 0.211 | -0.015 +- 0.180 |
//! | competition, several entrances | 31 | 6.115 | 6.410 +- 0.957 | +0.295 +- 0.908 |
//!
//! So far `deep` is shown to be better in mazes of the kind division only. That it
//! imagines matches only where the maze looks like a tree or like rows was tried because
//! `deep` was worse than `fast` in competition mazes (by 0.43 +- 0.23 with one entrance),
//! and was kept because 300 generated mazes of other seeds did not get worse by it.
//!
//! The official scores add up to 79.233 and 75.666, against 66.234; three mazes cannot
//! tell much, and versions of `deep` that differ by nothing but chance had sums between
//! 75.4 and 77.7. In 102 mazes of up to 20 x 20, most of them from competitions, `deep`
//! used up to 10.8 thousand million units of fuel a match and 0.6 a step, on average 2.2 a
//! match.
//!
//! Of the regret in generated mazes, 1.33 of 1.48 and 1.00 of 1.40 are paid before the
//! goal is reached for the first time, in both settings alike. That part did not become
//! clearly less in both kinds by any of these, in 134 to 2,000 mazes each: imagined matches played to the goal
//! or cut off early, three times as many sampled mazes or a third, other costs of unlikely
//! walls, mean distances in the sampled mazes instead of those costs or mixed with them,
//! a reward for stops that see more.
//!
//! Settings: 0 is fast, 1 is deep. In mazes of more than 20 x 20 cells both are the same.

mod alternative;
mod belief;
mod ensemble;
mod imagination;
mod knowledge;
mod numbers;
pub mod parameters;
mod planner;
mod room;
mod rows;
mod trees;

pub use planner::Parameters;

use wasmouse_sdk::{
    Action, Briefing, CellSet, Certificate, Grid, Heading, Hop, Map, Robot, Run, Search, Sensors,
    Tracker, Turn, View, Wall, export_robot, journal,
};

use belief::Belief;
use ensemble::Ensemble;
use imagination::Imagination;
use knowledge::{Knowledge, Known};
use planner::{Plan, Planner};

/// What the journal says when the best way is certain.
pub const PROVEN: &str = "optimal way proven";

/// How much the robot thinks.
struct Effort {
    /// Sampled mazes of the belief.
    samples: usize,
    /// How often each is redrawn after news.
    sweeps: u32,
    /// Mazes to imagine matches in, if any.
    imagined: Option<usize>,
}

const FAST: Effort = Effort {
    samples: 8,
    sweeps: 1,
    imagined: None,
};

const DEEP: Effort = Effort {
    samples: 32,
    sweeps: 2,
    imagined: Some(48),
};

/// The largest maze that the robot imagines matches in, in cells along each side.
/// Beyond, `deep` decides as `fast` does, and stays within its fuel.
const IMAGINABLE: u32 = 20;

/// The robot.
pub struct Champion {
    tracker: Tracker,
    grid: Grid,
    parameters: Parameters,
    sweeps: u32,
    belief: Belief,
    knowledge: Knowledge,
    planner: Planner,
    search: Search,
    /// In `deep` only.
    depth: Option<(Ensemble, Imagination)>,
    /// What is left of a decision, the last hop first; ends with the next news.
    hops: Vec<Hop>,
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
        if news.is_empty()
            && let Some(hop) = self.hops.pop()
        {
            return self.act(Plan::Drive(hop));
        }
        self.learn(&news);
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
    /// On a setting it does not have.
    pub fn with_parameters(briefing: &Briefing, parameters: Parameters) -> Self {
        let effort = match briefing.setting {
            0 => FAST,
            1 if briefing.dimension > IMAGINABLE => FAST,
            1 => DEEP,
            _ => panic!("champion has the settings 0 and 1"),
        };
        let belief = Belief::new(briefing, effort.samples);
        let depth = effort.imagined.map(|samples| {
            let ensemble = Ensemble::new(briefing, &belief, samples);
            (ensemble, Imagination::new(briefing))
        });
        Self {
            tracker: Tracker::new(briefing),
            grid: Grid::new(briefing.dimension),
            parameters,
            sweeps: effort.sweeps,
            belief,
            knowledge: Knowledge::new(briefing.dimension),
            planner: Planner::new(briefing, parameters),
            search: Search::new(briefing.dimension, briefing.longest_move),
            depth,
            hops: Vec::new(),
        }
    }

    fn learn(&mut self, news: &[(usize, bool)]) {
        if news.is_empty() {
            return;
        }
        // Out of fuel to imagine with, it decides by the rules.
        self.depth
            .take_if(|(_, imagination)| imagination.is_exhausted());
        if let Some((ensemble, _)) = &mut self.depth {
            ensemble.weigh(&self.belief, news);
        }
        self.belief.learn(news, self.sweeps);
        if let Some((ensemble, imagination)) = &mut self.depth {
            ensemble.draw(&self.belief);
            imagination.count_drawing();
        }
    }

    fn decide(&mut self, goal_seen: bool) -> Plan {
        let cell = self.tracker.cell();
        let open = self.tracker.map().passages(View::Pessimistic);
        let (belief, ensemble) = (&self.belief, self.depth.as_ref().map(|it| &it.0));
        let chance = |wall| ensemble.map_or_else(|| belief.chance(wall), |it| it.chance(wall));
        let known = belief.all_known();
        self.knowledge.take(open, known, chance, &self.parameters);
        if !goal_seen {
            let hop = self.planner.toward_goal(&self.knowledge, cell);
            return hop.map_or(Plan::Look, Plan::Drive);
        }
        let depth = self.depth.as_mut().filter(|it| it.0.knows_kind());
        let Some((ensemble, imagination)) = depth else {
            return self.planner.explore(&self.knowledge, cell);
        };
        self.hops = imagination.decide(&mut self.planner, ensemble, &self.knowledge, cell);
        self.hops.reverse();
        self.hops.pop().map_or(Plan::Stop, Plan::Drive)
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
