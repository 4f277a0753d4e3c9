//! Lobato's count expansion, the second benchmark of his report.
//!
//! From the report: a breadth-first expansion opens the squares around the robot until it
//! finds the goal; the path is then built backwards, from the goal to the robot. His A*
//! (section 3.2.2) adds a heuristic to it and shows the details:
//!
//! - Unknown walls count as open, and the expansion starts again in every step.
//! - Every square gets the next number when it is opened. Neighbours are opened in the order
//!   up, left, down, right.
//! - The path goes from the goal to the neighbour with the smallest number, and so on.
//! - The first straight stretch of the path is one move of at most three cells (the
//!   "intensity"). Nothing else counts steps.
//! - The goal is one cell, the top left one of the room. There the robot resets. The speed
//!   run follows the same rules with the map from the exploration run; unknown walls still
//!   count as open.
//!
//! What the report leaves open: the straight stretch is counted as far as it goes; an unknown
//! wall behind the robot is looked at first; another goal cell is used if the top left one
//! cannot be reached.
//!
//! Results, as exploration steps (including the reset) + speed steps: score. The report's
//! table does not count the reset as a step, but its scores do.
//!
//! | maze | report | this robot |
//! |---|---|---|
//! | 01 | 33 + 43: 44.100 | 36 + 44: 45.200 |
//! | 02 | 56 + 47: 48.867 | 60 + 44: 46.000 |
//! | 03 | 75 + 48: 50.500 | 75 + 47: 49.500 |
//!
//! Every figure is within 4 steps of the report's. The differences must come from ties: the
//! report does not print in which order its benchmark (unlike its A*) opens squares.
//!
//! Variants: only 0.

use wasmouse_sdk::{
    Action, Briefing, Cell, CellSet, Expansion, Hop, Map, Robot, Sensors, Tracker, Turn, View,
    export_robot,
};

/// The robot.
pub struct CountExpansion {
    tracker: Tracker,
    expansion: Expansion,
    /// The goal cell of the report.
    favourite: Cell,
    goal: CellSet,
}

export_robot!(CountExpansion);

impl Robot for CountExpansion {
    fn start(briefing: &Briefing) -> Self {
        assert!(
            briefing.variant == 0,
            "the count expansion has the variant 0 only"
        );
        let goal = briefing.goal;
        Self {
            tracker: Tracker::new(briefing),
            expansion: Expansion::new(briefing.dimension),
            favourite: Cell::new(goal.origin.x, goal.origin.y + goal.height - 1),
            goal: CellSet::from(goal),
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        let here = self.tracker.cell();
        if self.tracker.may_reset() && here == self.favourite {
            return self.tracker.reset();
        }
        let hop = self.hop_to(&CellSet::from(self.favourite));
        if hop.is_none() && self.tracker.may_reset() {
            // The favourite is walled in, but the robot has stood in the goal.
            return self.tracker.reset();
        }
        let hop = hop.or_else(|| self.hop_to(&self.goal.clone()));
        match hop {
            Some(hop) => self.tracker.go(hop.heading, hop.cells),
            None => self.tracker.turn(Turn::Right),
        }
    }

    fn map(&self) -> Option<&Map> {
        Some(self.tracker.map())
    }
}

impl CountExpansion {
    /// The first stretch of the path that the expansion finds: breadth first, which
    /// is to go on from all squares in the order in which they were opened.
    fn hop_to(&mut self, targets: &CellSet) -> Option<Hop> {
        let passages = self.tracker.map().passages(View::Optimistic);
        let here = self.tracker.cell();
        let is_open = |cell, side| passages.is_open(cell, side);
        self.expansion.first_hop(is_open, here, targets, |_, _| 0)
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
    use wasmouse_sdk::Area;
    use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};

    /// The figures of the crate's documentation.
    #[test]
    fn contest_mazes() {
        contest_figures::check::<CountExpansion>(&[
            (1, 0, "finished 36 + 44: 45.200"),
            (2, 0, "finished 60 + 44: 46.000"),
            (3, 0, "finished 75 + 47: 49.500"),
        ]);
    }

    #[test]
    fn a_favourite_that_is_walled_in() {
        // Columns 0 and 1 of 4: the goal is (0, 1) and (0, 2), closed in between.
        let maze = "4\n1,4,0,0\n0,0,0,0\n0,0,0,0\n0,0,0,0";
        let options = PlayOptions {
            goal: Some(Area::new(Cell::new(0, 1), 1, 2)),
            ..PlayOptions::default()
        };
        testing::check::<CountExpansion>(maze, &options, "finished 2 + 1: 1.067");
    }

    #[test]
    fn a_goal_that_is_walled_in() {
        let maze = "3\n1,5,4\n0,0,0\n0,0,0";
        testing::check::<CountExpansion>(maze, &PlayOptions::default(), "goal not seen 1000 + 0");
    }

    #[test]
    fn a_goal_behind_the_start() {
        let options = PlayOptions {
            start: Cell::new(0, 11),
            goal: Some(Area::new(Cell::new(0, 2), 1, 1)),
            ..PlayOptions::default()
        };
        testing::check::<CountExpansion>(MAZE_01, &options, "finished 5 + 3: 3.167");
    }

    #[test]
    #[should_panic(expected = "variant 0 only")]
    fn an_unknown_variant() {
        CountExpansion::start(&Briefing {
            variant: 1,
            ..Briefing::contest(12)
        });
    }
}
