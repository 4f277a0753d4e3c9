//! The flood robot: flood fill, treating unknown walls as open.
//!
//! Classic micromouse robots number the cells by their distance to the goal and drive
//! towards smaller numbers. Here the numbers count steps of up to three cells instead of
//! cells, because the contest counts steps. No report describes exactly this robot; it is
//! the baseline for the robots from the reports.
//!
//! - *Exploration run*: unknown walls count as open. After every reading it finds the path
//!   with the fewest steps to the goal and takes its first step.
//! - *In the goal* it resets (variant 0) or continues to explore (variant 1). Variant 1
//!   drives to the first unknown wall on the path with the fewest steps from the start to
//!   the goal, until that whole path is known to be open, or until the remaining budget is
//!   just enough for the speed run.
//! - *Speed run*: the fewest steps through walls known to be open.
//!
//! Between paths of equal length it prefers to drive straight, then right, then left, then
//! backwards, and prefers long moves to short ones.
//!
//! The robot reaches the goal wherever that is possible within the budget: it avoids only
//! walls that it has seen, and every detour teaches it one. If the goal turns out to be
//! walled in, it turns on the spot until the budget is used up.
//!
//! Variants: 0 resets in the goal; 1 explores until the best path is certain.

use wasmouse_sdk::{
    Action, Briefing, CellSet, Doubt, Hop, Map, Pose, Robot, Run, Search, Sensors, Tracker, Turn,
    View, export_robot,
};

/// The robot.
pub struct Flood {
    tracker: Tracker,
    /// The search that the robot drives by.
    to_goal: Search,
    /// The next pose on a route of that search that is known to be whole.
    on_route: Option<Pose>,
    /// For all other questions.
    questions: Search,
    goal: CellSet,
    explores_on: bool,
}

export_robot!(Flood);

impl Robot for Flood {
    fn start(briefing: &Briefing) -> Self {
        let explores_on = match briefing.variant {
            0 => false,
            1 => true,
            _ => panic!("flood has the variants 0 and 1"),
        };
        Self {
            tracker: Tracker::new(briefing),
            to_goal: Search::new(briefing.dimension, briefing.longest_move),
            on_route: None,
            questions: Search::new(briefing.dimension, briefing.longest_move),
            goal: CellSet::from(briefing.goal),
            explores_on,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        let news = self.tracker.observe(sensors);
        if news.closed > 0 {
            self.on_route = None;
        }
        if self.tracker.run() == Run::Speed {
            return self.drive_to_goal(View::Pessimistic);
        }
        if !self.tracker.may_reset() {
            return self.drive_to_goal(View::Optimistic);
        }
        self.on_route = None;
        match self.next_question() {
            Some(question) => self.look_into(question),
            None => self.tracker.reset(),
        }
    }

    fn map(&self) -> Option<&Map> {
        Some(self.tracker.map())
    }
}

impl Flood {
    /// The first step of a shortest path to the goal. Searches only when the path
    /// of the last search is no longer whole: walls that close make nothing shorter.
    fn drive_to_goal(&mut self, view: View) -> Action {
        let pose = self.tracker.pose();
        let passages = self.tracker.map().passages(view);
        let mut hop = match self.on_route {
            Some(expected) if expected == pose => self.to_goal.route(passages, pose).next(),
            _ => self.to_goal.first_hop(passages, pose),
        };
        if hop.is_none() {
            self.to_goal.fill_until(passages, &self.goal, pose.cell);
            hop = self.to_goal.route(passages, pose).next();
        }
        self.on_route = hop.and_then(|hop| pose.hopped(hop));
        self.drive(hop)
    }

    fn drive(&mut self, hop: Option<Hop>) -> Action {
        match hop {
            Some(hop) => self.tracker.go(hop.heading, hop.cells),
            None => self.tracker.turn(Turn::Right),
        }
    }

    /// The first unknown wall on the best path from start to goal that may exist;
    /// `None` when there is nothing more to ask, or no time.
    fn next_question(&mut self) -> Option<Doubt> {
        if !self.explores_on || !self.tracker.can_afford_race(1, &mut self.questions) {
            return None;
        }
        let start = self.tracker.briefing().start;
        Doubt::first(self.tracker.map(), &mut self.questions, start, &self.goal)
    }

    /// Drives towards the cell of the question; there, looks at the wall.
    fn look_into(&mut self, Doubt { cell, side }: Doubt) -> Action {
        let pose = self.tracker.pose();
        if pose.cell == cell {
            return self.tracker.go(side, 1);
        }
        let passages = self.tracker.map().passages(View::Pessimistic);
        let target = CellSet::from(cell);
        self.questions.fill_until(passages, &target, pose.cell);
        let hop = self.questions.route(passages, pose).next();
        self.drive(hop)
    }
}

#[cfg(test)]
#[path = "../../contest_figures.rs"]
mod contest_figures;

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};
    use wasmouse_sdk::{Area, Cell};

    #[test]
    fn contest_mazes() {
        let expected = [
            (1, 0, "finished 31 + 21: 22.033"),
            (2, 0, "finished 68 + 28: 30.267"),
            (3, 0, "finished 92 + 43: 46.067"),
            // The optima, with a longer exploration.
            (1, 1, "finished 146 + 17: 21.867"),
            (2, 1, "finished 193 + 22: 28.433"),
            (3, 1, "finished 281 + 25: 34.367"),
        ];
        contest_figures::check::<Flood>(&expected);
    }

    /// The smallest budget that is enough for variant 0 is enough for variant 1.
    #[test]
    fn stops_exploring_in_time() {
        for (budget, expected) in [(52, "finished 31 + 21: 22.033"), (51, "goal seen 31 + 20")] {
            let options = PlayOptions {
                variant: 1,
                budget,
                ..PlayOptions::default()
            };
            testing::check::<Flood>(MAZE_01, &options, expected);
        }
    }

    #[test]
    fn a_goal_behind_the_start() {
        let options = PlayOptions {
            start: Cell::new(0, 11),
            goal: Some(Area::new(Cell::new(0, 2), 1, 1)),
            ..PlayOptions::default()
        };
        testing::check::<Flood>(MAZE_01, &options, "finished 5 + 3: 3.167");
    }

    #[test]
    fn a_goal_that_is_walled_in() {
        let maze = "3\n1,5,4\n0,0,0\n0,0,0";
        testing::check::<Flood>(maze, &PlayOptions::default(), "goal not seen 1000 + 0");
    }

    #[test]
    #[should_panic(expected = "variants 0 and 1")]
    fn an_unknown_variant() {
        Flood::start(&Briefing {
            variant: 2,
            ..Briefing::contest(12)
        });
    }
}
