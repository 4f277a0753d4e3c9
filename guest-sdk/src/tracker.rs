//! The state of a match as a robot knows it: [`Tracker`].
//!
//! It combines position, map, run and budget, and decides nothing. It stays correct as long
//! as the robot returns only actions that the tracker creates.

use crate::{
    Action, Briefing, BudgetScope, Cell, CellSet, Heading, Map, News, Pose, Search, Sensors, Turn,
    View,
};

/// One of the two runs of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Run {
    /// The exploration run: find the goal, learn the maze, reset.
    Exploration,
    /// The speed run: to the goal in as few steps as possible.
    Speed,
}

/// The robot's position, the walls that it has seen, and the steps that are left.
///
/// In each step, pass the readings to [`observe`](Self::observe) and return the action from
/// [`go`](Self::go), [`turn`](Self::turn) or [`reset`](Self::reset). Moves are limited to
/// what is known to be open, so the robot never bumps and always knows its position.
///
/// ```
/// use wasmouse_sdk::{Action, Briefing, Cell, Heading, Sensors, Tracker, Turn};
///
/// let mut tracker = Tracker::new(&Briefing::contest(12));
/// tracker.observe(Sensors { left: 0, front: 2, right: 0 });
/// assert_eq!(tracker.go(Heading::Up, 3), Action::drive(Turn::Straight, 2));
/// assert_eq!(tracker.pose().cell, Cell::new(0, 2));
/// tracker.observe(Sensors { left: 0, front: 0, right: 4 });
/// assert_eq!(tracker.go(Heading::Down, 1), Action::drive(Turn::Straight, -1));
/// assert_eq!(tracker.steps_left(), 998);
/// ```
#[derive(Clone, Debug)]
pub struct Tracker {
    briefing: Briefing,
    pose: Pose,
    map: Map,
    run: Run,
    /// Whether a step of the exploration run has ended in the goal.
    goal_seen: bool,
    steps_left: u32,
}

impl Tracker {
    /// The state at the start of the exploration run, with an empty map.
    ///
    /// # Panics
    ///
    /// If the dimension of the briefing is outside 2..=64 or the start is outside the maze.
    pub fn new(briefing: &Briefing) -> Self {
        let map = Map::new(briefing.dimension);
        assert!(
            map.contains(briefing.start),
            "the start is outside the maze"
        );
        Self {
            briefing: *briefing,
            pose: Pose::at_start(briefing.start),
            map,
            run: Run::Exploration,
            goal_seen: false,
            steps_left: briefing.budget,
        }
    }

    /// Adds the readings of this step to the map.
    pub fn observe(&mut self, sensors: Sensors) -> News {
        self.map.observe(self.pose, sensors)
    }

    /// The action that drives up to `cells` cells in that direction of the maze, limited to
    /// cells known to be reachable and to the longest move.
    ///
    /// It turns if the direction is to a side, and drives backwards if it is behind the
    /// robot. There is no rear sensor: if the nearest wall behind is unknown, the action
    /// turns right on the spot instead, to see it in the next step.
    pub fn go(&mut self, heading: Heading, cells: u32) -> Action {
        let cells = cells.min(self.briefing.longest_move).min(i8::MAX as u32);
        let known = self.map.passages(View::Pessimistic);
        let clear = known.clear_cells(self.pose.cell, heading, cells);
        let advance = clear as i8;
        match self.pose.heading.turn_to(heading) {
            Some(turn) => self.answer(turn, heading, advance),
            None if clear == 0 && cells > 0 && self.may_be_open(heading) => {
                self.answer(Turn::Right, heading, 0)
            }
            None => self.answer(Turn::Straight, heading, -advance),
        }
    }

    /// The action that only turns.
    pub fn turn(&mut self, turn: Turn) -> Action {
        self.answer(turn, self.pose.heading, 0)
    }

    /// The reset, which begins the speed run in the start cell. Where the host ignores it (see
    /// [`may_reset`](Self::may_reset)) the position stays and the step is spent.
    pub fn reset(&mut self) -> Action {
        self.steps_left = self.steps_left.saturating_sub(1);
        if self.may_reset() {
            self.run = Run::Speed;
            self.pose = Pose::at_start(self.briefing.start);
            if self.briefing.budget_scope == BudgetScope::EachRun {
                self.steps_left = self.briefing.budget;
            }
        }
        Action::Reset
    }

    /// Whether the host accepts a reset: in the exploration run, after a step has ended in
    /// the goal.
    pub fn may_reset(&self) -> bool {
        self.run == Run::Exploration && self.goal_seen
    }

    /// Whether the robot is in the goal.
    pub const fn in_goal(&self) -> bool {
        self.briefing.goal.contains(self.pose.cell)
    }

    /// The robot's position.
    pub const fn pose(&self) -> Pose {
        self.pose
    }

    /// The robot's cell.
    pub const fn cell(&self) -> Cell {
        self.pose.cell
    }

    /// What is known about the walls.
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The current run.
    pub const fn run(&self) -> Run {
        self.run
    }

    /// The briefing of the match.
    pub const fn briefing(&self) -> &Briefing {
        &self.briefing
    }

    /// How many steps are left, including this one. If each run has its own budget, that of
    /// the current run.
    pub const fn steps_left(&self) -> u32 {
        self.steps_left
    }

    /// Whether the budget allows `exploration` more steps of the exploration run, then the
    /// reset, then `speed` steps of the speed run.
    pub fn can_afford(&self, exploration: u32, speed: u32) -> bool {
        let here = exploration.saturating_add(1);
        match self.briefing.budget_scope {
            BudgetScope::BothRuns => here.saturating_add(speed) <= self.steps_left,
            BudgetScope::EachRun => here <= self.steps_left && speed <= self.briefing.budget,
        }
    }

    /// Whether the budget allows `exploration` more steps of the exploration run, then the
    /// reset, then a speed run with the fewest steps through walls known to be open. `false`
    /// if no such path from the start to the goal is known.
    ///
    /// A robot that resets as soon as this is `false` for one more step, and
    /// [`may_reset`](Self::may_reset) allows it, can always finish. Refills `search` only if
    /// the budget is less than one step per cell.
    ///
    /// ```
    /// use wasmouse_sdk::{Area, Briefing, Cell, Search, Sensors, Tracker};
    ///
    /// let briefing = Briefing {
    ///     goal: Area::new(Cell::new(0, 5), 1, 1),
    ///     budget: 10,
    ///     ..Briefing::contest(12)
    /// };
    /// let mut search = Search::new(12, 3);
    /// let mut tracker = Tracker::new(&briefing);
    /// assert!(!tracker.can_afford_race(1, &mut search));
    /// tracker.observe(Sensors { left: 0, front: 5, right: 0 });
    /// // 2 steps in the speed run, 1 for the reset.
    /// assert!(tracker.can_afford_race(7, &mut search));
    /// assert!(!tracker.can_afford_race(8, &mut search));
    /// ```
    pub fn can_afford_race(&self, exploration: u32, search: &mut Search) -> bool {
        let cells = self.briefing.dimension.pow(2);
        if self.goal_seen && self.can_afford(exploration, cells) {
            // No speed run is longer than that, so there is no need to search.
            return true;
        }
        let start = self.briefing.start;
        let goal = CellSet::from(self.briefing.goal);
        search.fill_until(self.map.passages(View::Pessimistic), &goal, start);
        search
            .steps(start)
            .is_some_and(|race| self.can_afford(exploration, race))
    }

    fn may_be_open(&self, heading: Heading) -> bool {
        let possible = self.map.passages(View::Optimistic);
        possible.is_open(self.pose.cell, heading)
    }

    // Every step ends here; a call would add to its fuel.
    #[inline]
    fn answer(&mut self, turn: Turn, travel: Heading, advance: i8) -> Action {
        let cells = u32::from(advance.unsigned_abs());
        self.pose = self
            .pose
            .moved(turn, travel, cells)
            .expect("the perimeter is closed");
        self.steps_left = self.steps_left.saturating_sub(1);
        self.goal_seen |= self.in_goal();
        Action::drive(turn, advance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Area;

    const NOTHING: Sensors = Sensors {
        left: 0,
        front: 0,
        right: 0,
    };

    fn briefing() -> Briefing {
        Briefing {
            start: Cell::new(5, 5),
            goal: Area::new(Cell::new(5, 7), 1, 1),
            budget: 10,
            ..Briefing::contest(12)
        }
    }

    #[test]
    fn an_unknown_rear_is_looked_at_first() {
        let mut tracker = Tracker::new(&briefing());
        tracker.observe(NOTHING);
        assert_eq!(tracker.go(Heading::Down, 2), Action::drive(Turn::Right, 0));
        tracker.observe(Sensors {
            right: 1,
            ..NOTHING
        });
        assert_eq!(tracker.go(Heading::Down, 2), Action::drive(Turn::Right, 1));
        assert_eq!(tracker.cell(), Cell::new(5, 4));
        // Behind it now is the cell it came from.
        assert_eq!(
            tracker.go(Heading::Up, 3),
            Action::drive(Turn::Straight, -1)
        );
        assert_eq!(tracker.go(Heading::Up, 3), Action::drive(Turn::Straight, 0));
    }

    #[test]
    fn a_reset_counts_only_after_the_goal() {
        let mut tracker = Tracker::new(&briefing());
        tracker.reset();
        assert_eq!((tracker.run(), tracker.steps_left()), (Run::Exploration, 9));
        tracker.observe(Sensors {
            front: 3,
            ..NOTHING
        });
        // Passing through does not count.
        tracker.go(Heading::Up, 3);
        assert!(!tracker.may_reset());
        tracker.go(Heading::Down, 1);
        assert!(tracker.in_goal() && tracker.may_reset());
        tracker.reset();
        assert_eq!((tracker.run(), tracker.steps_left()), (Run::Speed, 6));
        assert_eq!(tracker.pose(), Pose::at_start(Cell::new(5, 5)));
        assert!(!tracker.may_reset());
    }

    #[test]
    fn what_the_budget_allows() {
        let mut tracker = Tracker::new(&briefing());
        assert!(tracker.can_afford(4, 5) && !tracker.can_afford(5, 5));
        assert!(!tracker.can_afford(u32::MAX, u32::MAX));
        tracker.briefing.budget_scope = BudgetScope::EachRun;
        assert!(tracker.can_afford(9, 10) && !tracker.can_afford(10, 1));
        assert!(!tracker.can_afford(1, 11));
        tracker.goal_seen = true;
        tracker.reset();
        assert_eq!(tracker.steps_left(), 10);
    }

    #[test]
    fn longer_moves_than_a_step_can_hold() {
        let mut tracker = Tracker::new(&Briefing {
            longest_move: u32::MAX,
            ..Briefing::contest(64)
        });
        tracker.observe(Sensors {
            front: 63,
            ..NOTHING
        });
        assert_eq!(
            tracker.go(Heading::Up, u32::MAX),
            Action::drive(Turn::Straight, 63)
        );
    }
}
