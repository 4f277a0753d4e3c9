//! A playback against a simulation that is stopped at each position.

use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::game::{Action, Event, GameRules, Simulation, Trace};
use crate::journal::Journal;
use crate::maze::testing::random_maze;
use crate::maze::{Maze, Turn, Walls};

fn any_action() -> impl Strategy<Value = Action> {
    let turn = prop::sample::select(vec![Turn::Left, Turn::Straight, Turn::Right]);
    let drive = (turn, -4_i8..=4).prop_map(|(turn, advance)| Action::Move { turn, advance });
    prop_oneof![8 => drive, 1 => Just(Action::Reset)]
}

fn played(maze: &Maze, rules: &GameRules, actions: &[Action]) -> Option<Playback> {
    let mut simulation = Simulation::new(maze, rules);
    let mut trace = Trace::default();
    for &action in actions {
        if simulation.has_ended() {
            break;
        }
        trace.apply(&mut simulation, action);
    }
    let verdict = simulation.verdict()?;
    Some(Playback::new(
        maze.clone(),
        *rules,
        trace,
        verdict,
        Journal::default(),
    ))
}

proptest! {
    #[test]
    fn positions_are_those_of_the_simulation(
        maze in random_maze(3..=5),
        actions in vec(any_action(), 60),
    ) {
        let rules = GameRules { budget: 60, ..GameRules::default() };
        let playback = played(&maze, &rules, &actions).expect("the budget is used up");
        let mut simulation = Simulation::new(&maze, &rules);
        let mut stops = vec![maze.start()];
        let mut moved = 0;
        for position in 0..=playback.last() {
            let at = playback.at(position);
            prop_assert_eq!(at.run, simulation.run());
            prop_assert_eq!((at.cell, at.heading), (simulation.cell(), simulation.heading()));
            prop_assert_eq!(at.sensors, simulation.sense());
            prop_assert_eq!(at.steps, simulation.steps());
            prop_assert_eq!(at.goal_reached, simulation.goal_reached());
            prop_assert_eq!(&playback.stops(position), &stops);
            let visits = playback.visits(position);
            prop_assert_eq!(visits.iter().sum::<u32>(), moved + 1);
            prop_assert!(visits[maze.walls().index(at.cell)] > 0);
            let Some(step) = playback.trace().steps().get(position) else { break };
            match simulation.apply(step.action) {
                Event::Moved { cells, cell, .. } => {
                    moved += u32::from(cells);
                    if cells > 0 {
                        stops.push(cell);
                    }
                }
                Event::Reset => {
                    moved += 1;
                    stops = vec![maze.start()];
                }
                Event::ResetBeforeGoal | Event::ResetInSpeedRun => {}
            }
        }
        let unknown: Vec<usize> =
            (0..=playback.last()).map(|at| playback.knowledge(at).unknown_walls()).collect();
        for (pair, step) in unknown.windows(2).zip(&playback.audit().steps[1..]) {
            prop_assert_eq!(pair[0] - pair[1], step.new_walls as usize);
        }
    }
}

#[test]
fn milestones_are_found_where_they_happen() {
    let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
    let drive = |turn, advance| Action::Move { turn, advance };
    let path = [
        drive(Turn::Straight, 3),
        drive(Turn::Straight, 2),
        drive(Turn::Right, 3),
        drive(Turn::Straight, 2),
    ];
    let mut actions = vec![Action::Reset, drive(Turn::Left, 9)];
    actions.push(drive(Turn::Right, 0));
    actions.extend(path);
    actions.push(Action::Reset);
    actions.extend(path);
    let playback = played(&maze, &GameRules::default(), &actions).expect("a whole match");
    let found = playback.milestones().iter();
    let found: Vec<_> = found.map(|it| (it.position, it.kind)).collect();
    use MilestoneKind::*;
    assert_eq!(
        found,
        [
            (1, IgnoredReset),
            (2, Bump),
            (2, Clamp),
            (5, Certain),
            (7, GoalReached),
            (8, Reset),
            (12, End)
        ]
    );
}
