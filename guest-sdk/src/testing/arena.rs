//! One match by the rules: an exploration run, a speed run, a budget, a score.

use std::fmt;

use super::audit::MapAudit;
use super::maze::Maze;
use crate::record::{Entry, Recorder};
use crate::{Action, Area, Briefing, BudgetScope, Cell, Heading, Move, Pose, Robot, Sensors};

/// How to play. The default is the ruleset `udacity` with seed 0 and variant 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlayOptions {
    /// The seed of the briefing.
    pub seed: u64,
    /// The variant of the briefing.
    pub variant: u32,
    /// Steps the robot may take, at least 1. Default: 1000.
    pub budget: u32,
    /// Whether the runs share the budget. Default: they do.
    pub budget_scope: BudgetScope,
    /// The longest move, in cells. Default: 3.
    pub longest_move: u32,
    /// Divides the steps of the exploration run in the score; at least 1. Default: 30.
    pub exploration_divisor: u32,
    /// Where both runs start. Default: (0, 0).
    pub start: Cell,
    /// The goal; `None`, the default, is the room in the centre.
    pub goal: Option<Area>,
}

impl Default for PlayOptions {
    fn default() -> Self {
        Self {
            seed: 0,
            variant: 0,
            budget: 1000,
            budget_scope: BudgetScope::BothRuns,
            longest_move: 3,
            exploration_divisor: 30,
            start: Cell::new(0, 0),
            goal: None,
        }
    }
}

impl PlayOptions {
    /// The default with another variant.
    ///
    /// ```
    /// use wasmouse_sdk::testing::PlayOptions;
    /// let options = PlayOptions { budget: 50, ..PlayOptions::of_variant(2) };
    /// assert_eq!((options.variant, options.seed), (2, 0));
    /// ```
    pub fn of_variant(variant: u32) -> Self {
        Self {
            variant,
            ..Self::default()
        }
    }
}

/// A score in thousandths of a step; lower is better. Prints with three decimals.
///
/// ```
/// use wasmouse_sdk::testing::Score;
/// assert_eq!(Score::new(17, 110, 30).to_string(), "20.667");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Score {
    thousandths: u64,
}

impl Score {
    /// The steps of the speed run plus those of the exploration run divided by
    /// `divisor` (at least 1), rounded to the nearest thousandth. A tie rounds to the
    /// even one, as in the output of the original contest's tester.
    pub const fn new(speed_steps: u32, exploration_steps: u32, divisor: u32) -> Self {
        let (shared, divisor) = (exploration_steps as u64 * 1000, divisor as u64);
        let (low, rest) = (shared / divisor, shared % divisor);
        let below = rest * 2 < divisor || (rest * 2 == divisor && low.is_multiple_of(2));
        Self {
            thousandths: speed_steps as u64 * 1000 + low + if below { 0 } else { 1 },
        }
    }

    /// Thousandths of a step.
    pub const fn thousandths(self) -> u64 {
        self.thousandths
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}.{:03}",
            self.thousandths / 1000,
            self.thousandths % 1000
        )
    }
}

/// The state before a step, and the action that the robot took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// 1 for the exploration run, 2 for the speed run.
    pub run: u8,
    /// The robot's cell.
    pub cell: Cell,
    /// The robot's heading.
    pub heading: Heading,
    /// The readings.
    pub sensors: Sensors,
    /// The robot's action.
    pub action: Action,
}

/// The outcome of a match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Played {
    /// Whether the speed run ended in the goal.
    pub finished: bool,
    /// Whether a step of the exploration run ended in the goal.
    pub goal_seen: bool,
    /// Steps of the exploration run, including the reset.
    pub exploration_steps: u32,
    /// Steps of the speed run.
    pub speed_steps: u32,
    /// The score; `None` unless finished.
    pub score: Option<Score>,
    /// Every step, in order.
    pub stops: Vec<Stop>,
    /// The robot's position after the last step.
    pub end: Pose,
    /// Moves stopped by a wall.
    pub bumps: u32,
    /// Moves longer than the longest move.
    pub clamps: u32,
    /// Resets that were ignored because the goal had not been reached.
    pub resets_before_goal: u32,
    /// Resets that were ignored in the speed run.
    pub resets_in_run_2: u32,
    /// Every journal call, in order.
    pub journal: Vec<Entry>,
    /// How the robot's map compares with the maze; `None` for a robot without a map.
    pub map: Option<MapAudit>,
}

impl Played {
    /// The outcome in one line, for tests: `finished 110 + 17: 20.667`,
    /// `goal seen 1000 + 0` or `goal not seen 1000 + 0`.
    pub fn summary(&self) -> String {
        let steps = format!("{} + {}", self.exploration_steps, self.speed_steps);
        match self.score {
            Some(score) => format!("finished {steps}: {score}"),
            None if self.goal_seen => format!("goal seen {steps}"),
            None => format!("goal not seen {steps}"),
        }
    }
}

/// Plays one match of the robot `R` in a maze in the Udacity text format.
///
/// # Panics
///
/// If `maze_text` is not such a maze, the start or the goal is outside it, or the robot
/// panics.
pub fn play<R: Robot>(maze_text: &str, options: &PlayOptions) -> Played {
    let maze = Maze::parse(maze_text);
    let briefing = briefing(maze.dimension, options);
    let goal = briefing.goal;
    assert!(maze.contains(briefing.start), "the start is outside");
    assert!(
        goal.cells().all(|it| maze.contains(it)),
        "the goal is outside"
    );

    let recorder = Recorder::start();
    let mut robot = R::start(&briefing);
    let mut arena = Arena::new(&maze, briefing);
    while arena.may_go_on() {
        recorder.step(arena.played.stops.len() as u32 + 1);
        let sensors = maze.sense(arena.pose.cell, arena.pose.heading);
        let action = robot.next_move(sensors);
        arena.step(sensors, action);
        if let Some(map) = robot.map() {
            let call = arena.played.stops.len() as u32;
            let audit = arena.played.map.unwrap_or_default();
            arena.played.map = Some(audit.after(call, map, &maze));
        }
    }
    Played {
        end: arena.pose,
        journal: recorder.finish(),
        ..arena.played
    }
}

/// Plays one match and requires that [`Played::summary`] is as expected, without bumps,
/// clamped moves or ignored resets.
///
/// ```
/// use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};
/// use wasmouse_sdk::{Action, Briefing, Robot, Sensors, Turn};
///
/// /// Drives up and then turns around.
/// struct Stray;
///
/// impl Robot for Stray {
///     fn start(_: &Briefing) -> Self {
///         Self
///     }
///
///     fn next_move(&mut self, sensors: Sensors) -> Action {
///         match sensors.front.min(3) {
///             0 => Action::drive(Turn::Left, 0),
///             cells => Action::drive(Turn::Straight, cells as i8),
///         }
///     }
/// }
///
/// testing::check::<Stray>(MAZE_01, &PlayOptions::default(), "goal not seen 1000 + 0");
/// ```
///
/// # Panics
///
/// If it is not, and where [`play`] does.
pub fn check<R: Robot>(maze_text: &str, options: &PlayOptions, expected: &str) {
    let played = play::<R>(maze_text, options);
    assert_eq!(played.summary(), expected, "{options:?}");
    let wrong = [
        (played.bumps, "bumps"),
        (played.clamps, "clamps"),
        (played.resets_before_goal, "resets before the goal"),
        (played.resets_in_run_2, "resets in run 2"),
    ];
    for (count, what) in wrong {
        assert_eq!(count, 0, "{what}, {options:?}");
    }
}

/// The briefing that [`play`] gives a robot in a maze of this dimension.
pub fn briefing(dimension: u32, options: &PlayOptions) -> Briefing {
    Briefing {
        dimension,
        start: options.start,
        goal: options.goal.unwrap_or(Area::center(dimension)),
        budget: options.budget,
        budget_scope: options.budget_scope,
        longest_move: options.longest_move,
        units_per_cell: 1,
        exploration_divisor: options.exploration_divisor,
        seed: options.seed,
        variant: options.variant,
    }
}

struct Arena<'a> {
    maze: &'a Maze,
    briefing: Briefing,
    run: u8,
    pose: Pose,
    played: Played,
}

impl<'a> Arena<'a> {
    fn new(maze: &'a Maze, briefing: Briefing) -> Self {
        Self {
            maze,
            briefing,
            run: 1,
            pose: Pose::at_start(briefing.start),
            played: Played {
                finished: false,
                goal_seen: false,
                exploration_steps: 0,
                speed_steps: 0,
                score: None,
                stops: Vec::new(),
                end: Pose::at_start(briefing.start),
                bumps: 0,
                clamps: 0,
                resets_before_goal: 0,
                resets_in_run_2: 0,
                journal: Vec::new(),
                map: None,
            },
        }
    }

    fn may_go_on(&self) -> bool {
        let played = &self.played;
        let used = match (self.briefing.budget_scope, self.run) {
            (BudgetScope::BothRuns, _) => played.exploration_steps + played.speed_steps,
            (BudgetScope::EachRun, 1) => played.exploration_steps,
            (BudgetScope::EachRun, _) => played.speed_steps,
        };
        !played.finished && used < self.briefing.budget
    }

    fn step(&mut self, sensors: Sensors, action: Action) {
        self.played.stops.push(Stop {
            run: self.run,
            cell: self.pose.cell,
            heading: self.pose.heading,
            sensors,
            action,
        });
        if self.run == 1 {
            self.played.exploration_steps += 1;
        } else {
            self.played.speed_steps += 1;
        }
        match action {
            Action::Reset => self.reset(),
            Action::Move(it) => self.drive(it),
        }
    }

    fn reset(&mut self) {
        if self.run == 2 {
            self.played.resets_in_run_2 += 1;
        } else if !self.played.goal_seen {
            self.played.resets_before_goal += 1;
        } else {
            self.run = 2;
            self.pose = Pose::at_start(self.briefing.start);
        }
    }

    fn drive(&mut self, Move { turn, advance }: Move) {
        self.pose.heading = self.pose.heading.turned(turn);
        let travel = if advance < 0 {
            self.pose.heading.opposite()
        } else {
            self.pose.heading
        };
        let wish = u32::from(advance.unsigned_abs());
        self.played.clamps += u32::from(wish > self.briefing.longest_move);
        for _ in 0..wish.min(self.briefing.longest_move) {
            if !self.maze.is_open(self.pose.cell, travel) {
                self.played.bumps += 1;
                break;
            }
            self.pose.cell = self
                .maze
                .neighbor(self.pose.cell, travel)
                .expect("the perimeter is closed");
        }
        // Only the final cell of a step counts; passing through does not.
        if self.briefing.goal.contains(self.pose.cell) {
            self.arrive();
        }
    }

    fn arrive(&mut self) {
        let played = &mut self.played;
        if self.run == 1 {
            played.goal_seen = true;
        } else {
            played.finished = true;
            played.score = Some(Score::new(
                played.speed_steps,
                played.exploration_steps,
                self.briefing.exploration_divisor,
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Turn::{Left, Right, Straight};
    use crate::testing::MAZE_01;

    #[test]
    fn scores_have_three_decimals() {
        let cases = [
            ((17, 110, 30), "20.667"),
            ((22, 197, 30), "28.567"),
            ((17, 18, 30), "17.600"),
            ((1, 1, 16), "1.062"),
            ((1, 3, 16), "1.188"),
            ((0, u32::MAX, 1), "4294967295.000"),
        ];
        for ((speed, exploration, divisor), expected) in cases {
            let score = Score::new(speed, exploration, divisor);
            assert_eq!(score.to_string(), expected);
        }
    }

    /// Plays a list of answers in maze 01, then turns on the spot.
    fn played(actions: &[Action], options: &PlayOptions) -> Played {
        let maze = Maze::parse(MAZE_01);
        let mut arena = Arena::new(&maze, briefing(maze.dimension, options));
        let mut actions = actions.iter();
        while arena.may_go_on() {
            let action = actions.next().copied().unwrap_or(Action::drive(Left, 0));
            arena.step(maze.sense(arena.pose.cell, arena.pose.heading), action);
        }
        arena.played
    }

    #[test]
    fn walls_stop_a_move_and_long_moves_are_clamped() {
        let actions = [
            Action::drive(Straight, 7),
            Action::drive(Right, 1),
            Action::drive(Left, -5),
            Action::drive(Straight, -1),
        ];
        let played = played(&actions, &PlayOptions::default());
        let cells: Vec<(u32, u32)> = played.stops[..5]
            .iter()
            .map(|it| (it.cell.x, it.cell.y))
            .collect();
        assert_eq!(cells, [(0, 0), (0, 3), (0, 3), (0, 0), (0, 0)]);
        assert_eq!((played.clamps, played.bumps), (2, 2));
    }

    #[test]
    fn a_reset_before_the_goal_costs_a_step() {
        let played = played(&[Action::Reset], &PlayOptions::default());
        assert_eq!(played.resets_before_goal, 1);
        assert_eq!((played.exploration_steps, played.speed_steps), (1000, 0));
        assert_eq!(played.score, None);
    }

    #[test]
    fn a_match_ends_in_the_goal_of_the_speed_run_and_not_before() {
        let options = PlayOptions {
            goal: Some(Area::new(Cell::new(0, 4), 1, 1)),
            ..PlayOptions::default()
        };
        let there = [Action::drive(Straight, 3), Action::drive(Straight, 1)];
        let mut actions = vec![Action::drive(Straight, 3), Action::drive(Straight, 2)];
        // The robot only passed through the goal, so this reset is ignored.
        actions.push(Action::Reset);
        actions.push(Action::drive(Straight, -1));
        actions.push(Action::Reset);
        actions.push(Action::Reset);
        actions.extend(there);
        let played = played(&actions, &options);
        assert!(played.finished);
        assert_eq!((played.resets_before_goal, played.resets_in_run_2), (1, 1));
        assert_eq!((played.exploration_steps, played.speed_steps), (5, 3));
        assert_eq!(played.score.map(Score::thousandths), Some(3167));
    }

    #[test]
    fn the_scope_of_the_budget() {
        let arrive = |budget_scope| PlayOptions {
            goal: Some(Area::new(Cell::new(0, 1), 1, 1)),
            budget: 10,
            budget_scope,
            ..PlayOptions::default()
        };
        let actions = [Action::drive(Straight, 1), Action::Reset];
        let shared = played(&actions, &arrive(BudgetScope::BothRuns));
        assert_eq!((shared.exploration_steps, shared.speed_steps), (2, 8));
        let each = played(&actions, &arrive(BudgetScope::EachRun));
        assert_eq!((each.exploration_steps, each.speed_steps), (2, 10));
    }
}
