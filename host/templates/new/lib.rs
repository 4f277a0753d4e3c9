//! A robot for wasmouse: explores on the path that looks shortest, resets in the
//! goal, and races along what it has seen.

use wasmouse_sdk::{
    Action, Briefing, CellSet, Robot, Run, Search, Sensors, Tracker, Turn, View, export_robot,
};

/// What the robot remembers from step to step.
pub struct MyRobot {
    /// Where it is, and the walls it has seen.
    tracker: Tracker,
    /// Finds the way with the fewest steps; a step drives up to three cells.
    search: Search,
    goal: CellSet,
}

export_robot!(MyRobot);

impl Robot for MyRobot {
    /// Called once. The briefing has the size of the maze, the goal, the budget.
    fn start(briefing: &Briefing) -> Self {
        Self {
            tracker: Tracker::new(briefing),
            search: Search::new(briefing.dimension, briefing.longest_move),
            goal: CellSet::from(briefing.goal),
        }
    }

    /// Called once a step, with the open cells to the left, ahead and to the right.
    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        // In the goal, the first run has done its work. A robot that goes on
        // exploring here may find a shorter way: an exploring step costs 1/30.
        if self.tracker.may_reset() {
            return self.tracker.reset();
        }
        // Exploring, unknown walls count as open; racing, as closed.
        let view = match self.tracker.run() {
            Run::Exploration => View::Optimistic,
            Run::Speed => View::Pessimistic,
        };
        let pose = self.tracker.pose();
        let passages = self.tracker.map().passages(view);
        self.search.fill_until(passages, &self.goal, pose.cell);
        let hop = self.search.route(passages, pose).next();
        match hop {
            Some(hop) => self.tracker.go(hop.heading, hop.cells),
            // The goal is walled in: nothing is left to try.
            None => self.tracker.turn(Turn::Right),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};

    #[test]
    fn finishes_the_first_maze() {
        let played = testing::play::<MyRobot>(MAZE_01, &PlayOptions::default());
        let summary = played.summary();
        assert!(summary.starts_with("finished"), "{summary}");
        assert_eq!(played.bumps, 0);
    }
}
