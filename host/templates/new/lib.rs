//! A robot for wasmouse. It explores along the path that looks shortest, resets in the
//! goal, and then drives the shortest path through the cells that it has seen.

use wasmouse_sdk::{
    Action, Briefing, CellSet, Robot, Run, Search, Sensors, Tracker, Turn, View, export_robot,
};

/// What the robot remembers between steps.
pub struct MyRobot {
    /// Its position and the walls that it has seen.
    tracker: Tracker,
    /// Finds the path with the fewest steps; one step drives up to three cells.
    search: Search,
    goal: CellSet,
}

export_robot!(MyRobot);

impl Robot for MyRobot {
    /// Called once. The briefing has the size of the maze, the goal and the budget.
    fn start(briefing: &Briefing) -> Self {
        Self {
            tracker: Tracker::new(briefing),
            search: Search::new(briefing.dimension, briefing.longest_move),
            goal: CellSet::from(briefing.goal),
        }
    }

    /// Called once per step, with the number of open cells to the left, ahead and to the
    /// right.
    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        // The exploration run may end as soon as the robot has reached the goal. Exploring
        // further may find a shorter path: a step of the exploration run costs only 1/30.
        if self.tracker.may_reset() {
            return self.tracker.reset();
        }
        // The exploration run treats unknown walls as open, the speed run as closed.
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
            // No path leads to the goal, so there is nothing left to try.
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
