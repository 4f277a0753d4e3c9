//! Knowledge against brute force: over all mazes in which the robot would have read the same.

use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::game::{Action, FaultKind, GameRules, Phase, Sensors, Simulation, Trace, Verdict};
use crate::journal::{Belief, Journal, Note};
use crate::maze::testing::random_maze;
use crate::maze::{Cell, Heading, Maze, Turn, Walls, oracle_steps};

const RULES: GameRules = GameRules {
    budget: 200,
    budget_scope: crate::game::BudgetScope::BothRuns,
    longest_move: 3,
    exploration_divisor: 30,
};

fn any_action() -> impl Strategy<Value = Action> {
    let turn = prop::sample::select(vec![Turn::Left, Turn::Straight, Turn::Right]);
    // Backwards as often as forwards: only driving backwards is not seen before.
    let drive = (turn, -3_i8..=3).prop_map(|(turn, advance)| Action::Move { turn, advance });
    prop_oneof![9 => drive, 1 => Just(Action::Reset)]
}

/// Plays until the actions or the match end, and then fails, so that the last position has a
/// reading too.
fn play(maze: &Maze, actions: &[Action]) -> (Trace, Verdict) {
    let mut simulation = Simulation::new(maze, &RULES);
    let mut trace = Trace::default();
    for &action in actions {
        if simulation.has_ended() {
            break;
        }
        trace.apply(&mut simulation, action);
    }
    let verdict = simulation.verdict().unwrap_or_else(|| {
        let fault = simulation.fault(FaultKind::Panic, Phase::NextMove, "".into());
        Verdict::Fault { fault }
    });
    (trace, verdict)
}

/// Whether a robot that took these actions in this maze would have read the same.
fn reads_the_same(maze: &Maze, trace: &Trace, last: Option<Sensors>) -> bool {
    let mut simulation = Simulation::new(maze, &RULES);
    for step in trace.steps() {
        if simulation.has_ended() || simulation.sense() != step.sensors {
            return false;
        }
        simulation.apply(step.action);
    }
    match last {
        Some(sensors) => !simulation.has_ended() && simulation.sense() == sensors,
        None => true,
    }
}

/// All mazes that differ from this one in some of these walls.
fn variations(maze: &Maze, edges: &[(Cell, Heading)]) -> impl Iterator<Item = Maze> {
    (0_u32..1 << edges.len()).map(|bits| {
        let mut walls = maze.walls().clone();
        for (at, &(cell, side)) in edges.iter().enumerate() {
            walls.set(cell, side, bits >> at & 1 == 1);
        }
        Maze::new(walls, maze.start(), maze.goal()).expect("the same start and goal")
    })
}

fn optimum(maze: &Maze) -> Option<u32> {
    oracle_steps(maze, RULES.longest_move).map(|it| it.speed_steps)
}

/// The order of outlooks: no path is longer than any.
fn length(steps: Option<u32>) -> u32 {
    steps.unwrap_or(u32::MAX)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    /// In mazes of 3 x 3 cells there are 4,096 ways to put the walls, and knowledge has to say
    /// exactly what is true of those in which the robot would have read the same.
    #[test]
    fn knowledge_is_what_all_consistent_mazes_share(
        maze in random_maze(3..=3),
        actions in vec(any_action(), 0..12),
    ) {
        let (trace, verdict) = play(&maze, &actions);
        let last = verdict.fault().map(|fault| {
            let heading = trace.steps().last().map_or(Heading::Up, |it| it.end(&maze).2);
            Sensors::at(&maze, fault.cell, heading)
        });
        let edges: Vec<_> = maze.walls().edges().collect();
        let consistent: Vec<Maze> = variations(&maze, &edges)
            .filter(|it| reads_the_same(it, &trace, last))
            .collect();
        let mut walk = Walk::new(&maze, &trace, &verdict);
        for _ in 0..=trace.steps().len() {
            walk.advance();
        }
        let knowledge = walk.into_knowledge();
        for &(cell, side) in &edges {
            let open = consistent.iter().filter(|it| it.walls().is_open(cell, side)).count();
            let expected = match open {
                0 => Belief::Closed,
                all if all == consistent.len() => Belief::Open,
                _ => Belief::Unknown,
            };
            prop_assert_eq!(knowledge.wall(cell, side), expected, "{} {}", cell, side);
        }
        prop_assert_eq!(consistent.len(), 1 << knowledge.unknown_walls());
        let outlook = knowledge.outlook(RULES.longest_move);
        let all = || consistent.iter().map(|it| length(optimum(it)));
        prop_assert_eq!(Some(length(outlook.optimistic)), all().min());
        prop_assert_eq!(Some(length(outlook.pessimistic)), all().max());
    }

    /// In larger mazes, over the mazes that differ in twelve walls.
    #[test]
    fn the_outlook_bounds_all_consistent_mazes(
        maze in random_maze(4..=6),
        actions in vec(any_action(), 0..60),
        chosen in vec(any::<prop::sample::Index>(), 12),
    ) {
        let (trace, verdict) = play(&maze, &actions);
        let audit = Audit::new(&maze, &RULES, &trace, &verdict, &Journal::default());
        let all: Vec<_> = maze.walls().edges().collect();
        let mut edges: Vec<_> = chosen.iter().map(|it| *it.get(&all)).collect();
        edges.sort_by_key(|&(cell, side)| (maze.walls().index(cell), side as u8));
        edges.dedup();
        let last = audit.steps.last().expect("a position").outlook;
        for other in variations(&maze, &edges).filter(|it| reads_the_same(it, &trace, None)) {
            let optimum = length(optimum(&other));
            prop_assert!(optimum <= length(last.pessimistic) || verdict.fault().is_some());
            prop_assert!(optimum >= length(last.optimistic) || verdict.fault().is_some());
        }
        // What is known only grows, and always holds the truth.
        let truth = length(optimum(&maze));
        for pair in audit.steps.windows(2) {
            let (before, after) = (pair[0].outlook, pair[1].outlook);
            prop_assert!(length(before.optimistic) <= length(after.optimistic));
            prop_assert!(length(before.pessimistic) >= length(after.pessimistic));
        }
        for step in &audit.steps {
            let within = length(step.outlook.optimistic)..=length(step.outlook.pessimistic);
            prop_assert!(within.contains(&truth));
            prop_assert!(!step.outlook.is_certain() || step.outlook.pessimistic == optimum(&maze));
        }
    }
}

#[test]
fn driving_backwards_shows_the_cells_behind() {
    let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
    let drive = |turn, advance| Action::Move { turn, advance };
    // Up two, turn right and on two, and back three: two cells, then the perimeter.
    let actions = [
        drive(Turn::Straight, 2),
        drive(Turn::Right, 2),
        drive(Turn::Straight, -3),
    ];
    let (trace, verdict) = play(&maze, &actions);
    let audit = Audit::new(&maze, &RULES, &trace, &verdict, &Journal::default());
    let new: Vec<u32> = audit.steps.iter().map(|it| it.new_walls).collect();
    // 11 walls up and 11 to the right; the row of (0, 2); the column of (2, 2) both ways; nothing.
    assert_eq!(new, [22, 11, 11, 0]);
    assert_eq!(audit.idle_steps, 1);
}

#[test]
fn false_beliefs_are_found_and_dated() {
    let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
    let (trace, verdict) = play(&maze, &[Action::Reset, Action::Reset]);
    let mut journal = Journal::default();
    journal.clear(1_000);
    let mut say = |step, (x, y), belief| {
        let (cell, side) = (Cell::new(x, y), Heading::Up);
        journal.push(step, Note::Wall { cell, side, belief });
    };
    say(0, (0, 0), Belief::Closed);
    say(1, (0, 0), Belief::Closed);
    say(1, (5, 5), Belief::Closed);
    say(2, (5, 5), Belief::Unknown);
    say(2, (5, 5), Belief::Open);
    say(2, (0, 11), Belief::Open);
    say(2, (99, 99), Belief::Closed);
    let audit = Audit::new(&maze, &RULES, &trace, &verdict, &journal);
    let found = audit.contradictions.iter();
    let found: Vec<_> = found
        .map(|it| (it.step, it.cell.x, it.cell.y, it.was_known))
        .collect();
    assert_eq!(
        found,
        [
            (0, 0, 0, false),
            (1, 0, 0, true),
            (1, 5, 5, false),
            (2, 0, 11, true)
        ]
    );
}
