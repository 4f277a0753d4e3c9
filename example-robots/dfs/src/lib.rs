//! The depth-first searches from the sketch-city report: with backtracking, and pure.
//!
//! From the report: visit every reachable cell. In each cell, continue to an unvisited
//! neighbour; in a dead end, drive back to the latest intersection that still has one; signal
//! when everything is explored. Its code pushes the neighbours in the order north, west,
//! south, east and takes the last one first. It paints visited cells green and its own cell
//! blue at the end. So does this robot; its signal is the log message `everything explored`.
//!
//! The report's first version, *pure* depth-first search, visits cells in the same order but
//! does not drive back: the position jumps from the dead end to the next branch. A robot
//! cannot do that. The variant `pure` comes closest: it drives to the branch in as few steps
//! as the visited cells allow. In a maze without loops there is only one path, so both
//! variants differ only in where they stop; with loops, `pure` often takes a shortcut.
//!
//! What the report leaves open:
//!
//! - *Steps*: the report does not count them. New cells are entered one at a time, because
//!   each has to be looked at. The path back uses moves of up to the longest move, drives
//!   backwards where that saves a turn, and ends at the first cell with an unvisited
//!   neighbour.
//! - *Behind the robot*: the report's simulation senses all four neighbours. Here a wall
//!   behind the robot may be unknown. The robot turns to look at it before it leaves the
//!   cell, unless the cell beyond has already been visited.
//! - *The contest*: the report has no goal and no second run. When everything is explored,
//!   this robot resets if it has been in the goal, and then takes the fewest steps through
//!   walls known to be open. It also resets when the remaining budget is just enough for the
//!   speed run.
//!
//! A cell costs at most two steps, so a maze of 20 x 20 cells takes at most 800 of the 1000
//! steps, not counting looks behind.
//!
//! Variants: 0 explores everything; 1 resets as soon as it is in the goal; 2 explores
//! everything by pure depth-first search.
//!
//! | variant | maze 01 | maze 02 | maze 03 |
//! |---|---|---|---|
//! | everything | 244 + 17: 25.133 | 334 + 22: 33.133 | 420 + 25: 39.000 |
//! | reset | 52 + 17: 18.733 | 94 + 27: 30.133 | 217 + 27: 34.233 |
//! | pure | 209 + 17: 23.967 | 269 + 22: 30.967 | 338 + 25: 36.267 |

use wasmouse_sdk::journal::{self, Color};
use wasmouse_sdk::{
    Action, Area, Briefing, Cell, CellSet, Heading, Map, Robot, Run, Search, Sensors, Tracker,
    Turn, View, Wall, export_robot,
};

/// The report's order: pushed last, taken first.
const ORDER: [Heading; 4] = [Heading::Right, Heading::Down, Heading::Left, Heading::Up];

/// The robot.
pub struct DepthFirst {
    tracker: Tracker,
    visited: CellSet,
    /// The path from the start to here, cell by cell.
    trail: Vec<Heading>,
    /// Distances to the goal through walls known to be open.
    search: Search,
    /// Distances to the next branch through visited cells.
    to_branch: Search,
    goal: CellSet,
    explores_everything: bool,
    is_pure: bool,
    /// Where pure search jumps to: the end of the trail, while the robot is not there.
    branch: Option<Cell>,
    signalled: bool,
}

export_robot!(DepthFirst);

impl Robot for DepthFirst {
    fn start(briefing: &Briefing) -> Self {
        let (explores_everything, is_pure) = match briefing.variant {
            0 => (true, false),
            1 => (false, false),
            2 => (true, true),
            _ => panic!("depth-first search has the variants 0 to 2"),
        };
        Self {
            tracker: Tracker::new(briefing),
            visited: CellSet::new(),
            trail: Vec::new(),
            search: Search::new(briefing.dimension, briefing.longest_move),
            to_branch: Search::new(briefing.dimension, briefing.longest_move),
            goal: CellSet::from(briefing.goal),
            explores_everything,
            is_pure,
            branch: None,
            signalled: false,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.tracker.observe(sensors);
        if self.tracker.run() == Run::Speed {
            return self.race();
        }
        self.visit();
        if self.tracker.may_reset() && !self.goes_on() {
            return self.tracker.reset();
        }
        self.explore()
    }

    fn map(&self) -> Option<&Map> {
        Some(self.tracker.map())
    }
}

impl DepthFirst {
    fn visit(&mut self) {
        let cell = self.tracker.cell();
        if !self.visited.contains(cell) {
            self.visited.insert(cell);
            journal::paint(cell, Color::Green);
        }
    }

    /// On to a new cell, or to look at a wall, or back.
    fn explore(&mut self) -> Action {
        let here = self.tracker.cell();
        if let Some(branch) = self.branch.take().filter(|&it| it != here) {
            return self.drive_to(branch);
        }
        if let Some(side) = self.unvisited(here, Wall::Open) {
            self.trail.push(side);
            return self.tracker.go(side, 1);
        }
        if let Some(side) = self.unvisited(here, Wall::Unknown) {
            // Behind the robot, so this turns on the spot.
            return self.tracker.go(side, 1);
        }
        if self.trail.is_empty() {
            return self.finish();
        }
        if self.is_pure {
            return self.jump();
        }
        self.go_back()
    }

    /// The first side of `cell` in that state with an unvisited cell beyond.
    fn unvisited(&self, cell: Cell, state: Wall) -> Option<Heading> {
        let map = self.tracker.map();
        ORDER.into_iter().find(|&side| {
            map.wall(cell, side) == state
                && map
                    .neighbor(cell, side)
                    .is_some_and(|beyond| !self.visited.contains(beyond))
        })
    }

    /// One hop back along the trail.
    fn go_back(&mut self) -> Action {
        let last = *self.trail.last().expect("checked by the caller");
        let back = last.opposite();
        let mut cell = self.tracker.cell();
        let mut cells = 0;
        while cells < self.tracker.briefing().longest_move && self.trail.last() == Some(&last) {
            self.trail.pop();
            cells += 1;
            cell = cell.toward(back, 1).expect("the trail is inside the maze");
            if self.has_something_left(cell) {
                break;
            }
        }
        self.tracker.go(back, cells)
    }

    /// To the latest cell with something left, however the robot came here.
    fn jump(&mut self) -> Action {
        let mut cell = self.tracker.cell();
        while let Some(last) = self.trail.pop() {
            cell = cell
                .toward(last.opposite(), 1)
                .expect("the trail is inside the maze");
            if self.has_something_left(cell) {
                return self.drive_to(cell);
            }
        }
        self.finish()
    }

    /// One step to a visited cell through others.
    fn drive_to(&mut self, branch: Cell) -> Action {
        let pose = self.tracker.pose();
        let known = self.tracker.map().passages(View::Pessimistic);
        let mut passages = known.clone();
        let dimension = known.dimension();
        let unvisited = Area::new(Cell::new(0, 0), dimension, dimension)
            .cells()
            .filter(|&cell| !self.visited.contains(cell));
        unvisited.for_each(|cell| passages.wall_in(cell));
        let branches = CellSet::from(branch);
        self.to_branch.fill_until(&passages, &branches, pose.cell);
        let hop = self.to_branch.route(&passages, pose).next();
        let hop = hop.expect("the trail leads there");
        self.branch = Some(branch);
        self.tracker.go(hop.heading, hop.cells)
    }

    fn has_something_left(&self, cell: Cell) -> bool {
        let sides = [Wall::Open, Wall::Unknown].map(|state| self.unvisited(cell, state));
        sides != [None, None]
    }

    /// Everything is explored.
    fn finish(&mut self) -> Action {
        if !self.signalled {
            self.signalled = true;
            journal::info("everything explored");
            journal::paint(self.tracker.cell(), Color::Blue);
        }
        if self.tracker.may_reset() {
            self.tracker.reset()
        } else {
            // The goal cannot be reached; there is nothing left to do.
            self.tracker.turn(Turn::Right)
        }
    }

    /// Whether one more step of exploration is wanted and affordable.
    fn goes_on(&mut self) -> bool {
        if !self.explores_everything {
            return false;
        }
        self.tracker.can_afford_race(1, &mut self.search)
    }

    /// The fewest steps through walls known to be open.
    fn race(&mut self) -> Action {
        let pose = self.tracker.pose();
        let passages = self.tracker.map().passages(View::Pessimistic);
        let hop = self.search.next_hop(passages, &self.goal, pose);
        match hop {
            Some(hop) => self.tracker.go(hop.heading, hop.cells),
            None => self.tracker.turn(Turn::Right),
        }
    }
}

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::testing::{self, MAZE_01, Note, PlayOptions, Played};

    fn play(maze: &str, options: &PlayOptions) -> Played {
        let played = testing::play::<DepthFirst>(maze, options);
        assert_eq!(played.bumps, 0);
        played
    }

    fn signals(played: &Played) -> usize {
        let log = |note: &Note| matches!(note, Note::Log(_, text) if text == "everything explored");
        played.journal.iter().filter(|it| log(&it.note)).count()
    }

    #[test]
    fn contest_mazes() {
        let expected = [
            (1, 0, "finished 244 + 17: 25.133"),
            (2, 0, "finished 334 + 22: 33.133"),
            (3, 0, "finished 420 + 25: 39.000"),
            (1, 1, "finished 52 + 17: 18.733"),
            (2, 1, "finished 94 + 27: 30.133"),
            (3, 1, "finished 217 + 27: 34.233"),
            (1, 2, "finished 209 + 17: 23.967"),
            (2, 2, "finished 269 + 22: 30.967"),
            (3, 2, "finished 338 + 25: 36.267"),
        ];
        let mazes = contest_mazes::contest_mazes();
        for (number, variant, expected) in expected {
            let options = PlayOptions::of_variant(variant);
            if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
                let played = play(maze, &options);
                assert_eq!(signals(&played), usize::from(variant != 1));
                assert_eq!(played.summary(), expected, "maze {number}");
            }
        }
    }

    /// The cells in the order in which they were visited.
    fn visits(played: &Played) -> Vec<Cell> {
        let green = |note: &Note| match *note {
            Note::Paint(cell, Color::Green) => Some(cell),
            _ => None,
        };
        played
            .journal
            .iter()
            .filter_map(|it| green(&it.note))
            .collect()
    }

    /// Both searches visit every cell, in the order of the report's stack.
    #[test]
    fn visits_every_cell_of_maze_01() {
        let [backtracking, pure] = [0, 2].map(|variant| {
            let options = PlayOptions::of_variant(variant);
            visits(&play(MAZE_01, &options))
        });
        assert_eq!(backtracking.len(), 144);
        assert_eq!(pure, report_order(MAZE_01));
        assert_eq!(backtracking, pure);
    }

    /// The report's loop, with its jumps: pop a position, push its open neighbours
    /// north, west, south, east.
    fn report_order(maze: &str) -> Vec<Cell> {
        let values: Vec<Vec<u8>> = maze
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|it| it.parse().unwrap()).collect())
            .collect();
        let mut order = Vec::new();
        let mut stack = vec![Cell::new(0, 0)];
        while let Some(cell) = stack.pop() {
            if order.contains(&cell) {
                continue;
            }
            order.push(cell);
            let sides = [
                (1, Heading::Up),
                (8, Heading::Left),
                (4, Heading::Down),
                (2, Heading::Right),
            ];
            for (bit, side) in sides {
                if values[cell.x as usize][cell.y as usize] & bit != 0 {
                    stack.push(cell.toward(side, 1).unwrap());
                }
            }
        }
        order
    }

    #[test]
    fn stops_exploring_in_time() {
        for (budget, variant) in (100..300).flat_map(|it| [(it, 0), (it, 2)]) {
            let options = PlayOptions {
                budget,
                variant,
                ..PlayOptions::default()
            };
            let played = play(MAZE_01, &options);
            assert!(played.finished || !played.goal_seen, "budget {budget}");
        }
    }

    #[test]
    fn looks_behind_a_start_in_the_middle() {
        for variant in [0, 2] {
            let options = PlayOptions {
                variant,
                start: Cell::new(0, 5),
                goal: Some(Area::new(Cell::new(0, 0), 1, 1)),
                ..PlayOptions::default()
            };
            let played = play(MAZE_01, &options);
            assert!(played.finished && signals(&played) == 1);
            assert_eq!(played.speed_steps, 2);
        }
    }

    #[test]
    fn a_goal_that_is_walled_in() {
        let maze = "3\n1,5,4\n0,0,0\n0,0,0";
        for variant in [0, 2] {
            let options = PlayOptions::of_variant(variant);
            let played = play(maze, &options);
            assert_eq!(played.summary(), "goal not seen 1000 + 0");
            assert_eq!(signals(&played), 1);
        }
    }

    #[test]
    #[should_panic(expected = "variants 0 to 2")]
    fn an_unknown_variant() {
        DepthFirst::start(&Briefing {
            variant: 3,
            ..Briefing::contest(12)
        });
    }
}
