//! Rai's planner, from his report of 2017.
//!
//! Explores cell by cell, always to the neighbour where it has been least, marks
//! dead ends while it backs out of them, and stops when it has been in a fixed share
//! of the cells. Run 2 follows a value table.
//!
//! What the report says, and what was chosen where it leaves something open. Its
//! figures fix nearly all of it: figure 5 is the traversal grid of maze 01 at the
//! end of an exploration of 139 calls, figures 9 and 10 are two races in maze 02.
//!
//! - *Candidates* are the open cells to the left, ahead and to the right. Each move
//!   enters the neighbour; the report does not say how far a move goes, but figure 5
//!   counts 139 visits in the 139 calls of the score 21.633 = 17 + 139 / 30.
//! - *The choice* is the cell with the fewest visits, then the smallest Manhattan
//!   distance to the goal. Of all walks that obey this, only two give figure 5, and
//!   they differ in the sense in which they go round the goal room. All their choices
//!   between equals are explained by one order: smaller x, then smaller y. That is
//!   the order in which the report lists what it keeps of each candidate (visits,
//!   distance, coordinates).
//! - *Dead ends*: a cell whose open sides to the left, ahead and to the right all lead
//!   to marked cells is marked, and left backwards by one cell. The side behind is no
//!   candidate.
//! - *The cap* is on cells that the robot has been in (figure 5 shows 97 of 144, and
//!   cells only seen from afar as unexplored), marked ones included.
//! - *The end*: the goal must have been visited, and the next cell must lie outside
//!   it. Figure 5 shows that the robot goes round the goal room twice before it resets
//!   on the point of leaving, although it has long been in 60 % of the cells.
//! - *Values* count cells between cells it has been in (figure 7). The goal is its top
//!   left cell, the only 0 in figure 7. Between neighbours of equal value: left, down,
//!   right, up; with that both races are those of figures 9 and 10, cell by cell. The
//!   race joins equal directions to moves of up to the longest move.
//! - *The first version*, before dead ends were marked, backs out of a dead end until
//!   two readings are not 0, and goes a random way from there (section 0.13). There
//!   was no cap then: "initially, I ran my robot until whole maze is discovered". The
//!   variant `full` is this, with the same choice everywhere else; its chance comes
//!   from the seed of the briefing.
//!
//! Not in the report is how to live within the budget. Until the robot has seen the
//! goal, it keeps one step for each cell of the maze, half a step for each cell for
//! the race, and one for the reset; when no more than that is left, it drives on the
//! path of fewest steps to the goal that may still exist. Afterwards it stops
//! exploring when the budget has just enough steps left for the race. On the official
//! mazes neither ever happens.
//!
//! Steps of run 1 with the reset + steps of run 2, and the score; the report's score
//! is the same where the last column does not name another:
//!
//! | variant | maze 01 | maze 02 | maze 03 | report |
//! |---|---|---|---|---|
//! | `cap-60` | 139 + 17: 21.633 | 220 + 28: 35.333 | 260 + 29: 37.667 | same |
//! | `cap-70` | 144 + 17: 21.800 | 255 + 28: 36.500 | 297 + 29: 38.900 | same |
//! | `cap-80` | 180 + 17: 23.000 | 280 + 28: 37.333 | 362 + 29: 41.067 | same |
//! | `cap-100` | 304 + 17: 27.133 | 681 + 26: 48.700 | 837 + 27: 54.900 | none |
//! | `full`, seed 0 | 382 + 17: 29.733 | 657 + 26: 47.900 | 776 + 27: 52.867 | 22.667, 37.333, 40.333 |
//!
//! The report's figures for its first version leave at most 170 calls for maze 01
//! (nothing races in less than 17 steps), and 280 for maze 02, whose race figure 10
//! shows. Moves of one cell visit every cell of maze 01 in no fewer than 152 calls
//! when the maze is known, and in 304 with dead ends marked. Without marks the best
//! of 40 tries took 313, 639 and 766 calls in the three mazes, and the same rule with
//! the least visited way in place of the random one 314, 651 and 873; to have seen
//! every wall from somewhere takes that one 310, 608 and 871. But it has been in three
//! quarters of the cells after 170, 274 and 326 calls, and with chance after exactly
//! 170, 280 and 340 in 3, 33 and 22 of 300 tries. So the figures look like those of a
//! capped exploration too; and the race of figure 10, "without dead end detection",
//! is that of `cap-80`, to the cell and with the same 280 calls.
//!
//! Variants: 0 `cap-60`, 1 `cap-70`, 2 `cap-80`, 3 `cap-100`, 4 `full`.

mod value_table;
mod walk;

use value_table::ValueTable;
use walk::{DeadEnds, Walk};
use wasmouse_sdk::{
    Action, Briefing, CellSet, Heading, Map, Random, Robot, Run, Search, Sensors, Tracker, Turn,
    View, Wall, export_robot,
};

/// The robot.
pub struct Rai {
    tracker: Tracker,
    walk: Walk,
    /// The table to race by; the last one that the budget allows.
    values: Option<ValueTable>,
    /// The fewest steps to the goal that may still exist, for when time is short.
    shortcut: Search,
    /// The share of the cells to explore, in percent.
    cap: u32,
}

export_robot!(Rai);

impl Robot for Rai {
    fn start(briefing: &Briefing) -> Self {
        let first_version = DeadEnds::BackOut {
            random: Random::new(briefing.seed),
            retreating: false,
        };
        let (cap, dead_ends) = match briefing.variant {
            0 => (60, DeadEnds::Mark),
            1 => (70, DeadEnds::Mark),
            2 => (80, DeadEnds::Mark),
            3 => (100, DeadEnds::Mark),
            4 => (100, first_version),
            _ => panic!("this robot has the variants 0 to 4"),
        };
        let &Briefing {
            dimension,
            goal,
            longest_move,
            ..
        } = briefing;
        Self {
            tracker: Tracker::new(briefing),
            walk: Walk::new(dimension, goal, dead_ends),
            values: None,
            shortcut: Search::new(dimension, longest_move),
            cap,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        if self.tracker.run() == Run::Speed {
            return self.race();
        }
        self.walk.visit(self.tracker.cell());
        if self.tracker.may_reset() && !self.has_time() {
            return self.reset();
        }
        if !self.tracker.may_reset() && self.is_late() {
            return self.hurry();
        }
        let heading = self.walk.next(self.tracker.map(), self.tracker.pose());
        if self.has_explored_enough() && !self.stays_in_goal(heading) {
            return self.reset();
        }
        self.tracker.go(heading, 1)
    }

    fn map(&self) -> Option<&Map> {
        Some(self.tracker.map())
    }
}

impl Rai {
    fn has_explored_enough(&self) -> bool {
        self.tracker.may_reset() && self.walk.has_visited(self.cap)
    }

    /// Whether a step of one cell in that direction ends in the goal.
    fn stays_in_goal(&self, heading: Heading) -> bool {
        let here = self.tracker.cell();
        let next = match self.tracker.map().wall(here, heading) {
            Wall::Open => here.toward(heading, 1).unwrap_or(here),
            Wall::Unknown | Wall::Closed => here,
        };
        self.tracker.briefing().goal.contains(next)
    }

    /// Whether one more step of exploration leaves enough for the race.
    ///
    /// [`Tracker::can_afford_race`] would ask for the fewest steps, but this robot
    /// races by its values, whose ways are the shortest in cells only.
    fn has_time(&mut self) -> bool {
        let cells = self.tracker.briefing().dimension.pow(2);
        if self.tracker.can_afford(1, cells) {
            // No race is longer than that, so there is no need to know the values.
            return true;
        }
        let values = self.new_values();
        let race = values.race(self.tracker.briefing().start);
        let fits = race.is_some_and(|race| self.tracker.can_afford(1, race));
        if fits {
            // A table of the next step may take more steps: its ways are shorter in
            // cells only. Then there is still time for this one.
            self.values = Some(values);
        }
        fits
    }

    /// Whether the goal must be looked for in earnest.
    fn is_late(&self) -> bool {
        let cells = self.tracker.briefing().dimension.pow(2);
        !self.tracker.can_afford(cells, cells / 2)
    }

    /// One step on the shortest path to the goal that may exist.
    fn hurry(&mut self) -> Action {
        let pose = self.tracker.pose();
        let passages = self.tracker.map().passages(View::Optimistic);
        let goal = CellSet::from(self.tracker.briefing().goal);
        let hop = self.shortcut.next_hop(passages, &goal, pose);
        let Some(hop) = hop else {
            // The goal is walled in.
            return self.tracker.turn(Turn::Right);
        };
        let action = self.tracker.go(hop.heading, hop.cells);
        let mut cell = pose.cell;
        while cell != self.tracker.cell() {
            // Cells that it drives through, but for the first, already counted, and
            // the last, counted on arrival.
            cell = cell.toward(hop.heading, 1).expect("driven in the maze");
            if cell != self.tracker.cell() {
                self.walk.visit(cell);
            }
        }
        action
    }

    fn reset(&mut self) -> Action {
        if self.values.is_none() {
            self.values = Some(self.new_values());
        }
        self.tracker.reset()
    }

    fn new_values(&self) -> ValueTable {
        let map = self.tracker.map();
        ValueTable::new(map, self.walk.visited(), self.tracker.briefing())
    }

    fn race(&mut self) -> Action {
        let values = self.values.as_ref();
        match values.and_then(|it| it.hop(self.tracker.cell())) {
            Some(hop) => self.tracker.go(hop.heading, hop.cells),
            None => self.tracker.turn(Turn::Right),
        }
    }
}

#[cfg(test)]
#[path = "../../contest_figures.rs"]
mod contest_figures;

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests;
