//! How the robot decides: [`Planner`].
//!
//! Until it has reached the goal, every unknown wall costs some steps, a few more if it is
//! likely to be closed, and the robot takes the cheapest path. Afterwards it knows a path and
//! asks questions of the form: does this shorter path exist? An answer is worth the steps
//! saved in the speed run, times the probability that the path exists. It costs the steps to
//! go and look. The robot picks the question with the highest gain per step, until none is
//! worth its cost. Candidates are the cheapest paths under several costs for unlikely walls,
//! and the shortest paths in the sampled mazes of the belief.

use wasmouse_sdk::{
    Briefing, Cell, CellSet, Grid, Heading, Hop, IMPASSABLE, Passages, Pose, Search, WeightedSearch,
};

use crate::faith::Faith;
use crate::knowledge::{Knowledge, Known, STEP};
use crate::numbers::exp;
use crate::tuning::Parameters;

/// What the costs of unlikely walls are multiplied by: for bold questions and timid
/// ones.
const CAUTIONS: [f32; 5] = [1.0, 0.4, 0.65, 1.6, 2.6];

/// What to do next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plan {
    /// Drive.
    Drive(Hop),
    /// Turn on the spot to look around.
    Look,
    /// Exploring on does not pay.
    Stop,
}

/// Searches with their buffers.
pub struct Planner {
    start: Cell,
    grid: Grid,
    goal: CellSet,
    goal_numbers: Vec<usize>,
    divisor: f32,
    weighted: WeightedSearch,
    search: Search,
    /// A sampled maze, and the search in it.
    passages: Passages,
    shortest: Search,
    /// What the walls cost under one of the [`CAUTIONS`].
    costs: Vec<u16>,
    faith: Faith,
}

impl Planner {
    /// A planner for a match.
    pub fn new(briefing: &Briefing) -> Self {
        let grid = Grid::new(briefing.dimension);
        let longest = briefing.longest_move;
        Self {
            start: briefing.start,
            grid,
            goal: CellSet::from(briefing.goal),
            goal_numbers: briefing.goal.cells().map(|it| grid.cell(it)).collect(),
            divisor: briefing.exploration_divisor as f32,
            weighted: WeightedSearch::new(grid, longest, STEP),
            search: Search::new(briefing.dimension, longest),
            passages: Passages::all_closed(briefing.dimension),
            shortest: Search::new(briefing.dimension, longest),
            costs: vec![IMPASSABLE; grid.wall_count()],
            faith: Faith::default(),
        }
    }

    /// The next hop of the path to the goal that is cheapest in view of what is
    /// unknown; `None` when the goal is walled in.
    pub fn toward_goal(&mut self, knowledge: &Knowledge, from: Cell) -> Option<Hop> {
        let from = self.grid.cell(from);
        self.weighted
            .run(&knowledge.goal_costs, &self.goal_numbers, Some(from));
        self.weighted.hop(from)
    }

    /// The next hop of a shortest known path to the goal.
    pub fn race(&mut self, open: &Passages, from: Cell) -> Option<Hop> {
        self.search.fill_until(open, &self.goal, from);
        self.search.hops(open, from).next()
    }

    /// What to do once the goal has been reached. `mazes` may be the real one: by wall,
    /// 1 where it is open.
    pub fn explore<'a>(
        &mut self,
        knowledge: &Knowledge,
        mazes: impl Iterator<Item = &'a [u8]>,
        from: Cell,
        parameters: &Parameters,
    ) -> Plan {
        let open = &knowledge.open;
        self.search.fill_until(open, &self.goal, self.start);
        let Some(known_steps) = self.search.steps(self.start) else {
            let hop = self.toward_goal(knowledge, from);
            return hop.map_or(Plan::Stop, Plan::Drive);
        };
        self.faith.hear(known_steps, &knowledge.known);
        self.search.fill(open, &CellSet::from(from));
        let mut choice = Choice {
            parameters,
            known_steps,
            worth_of_step: self.divisor * self.faith.factor(parameters.faith_prior),
            distances: &self.search,
            best: None,
        };
        let start = self.grid.cell(self.start);
        for caution in CAUTIONS {
            for (cost, &wall) in self.costs.iter_mut().zip(&knowledge.way_costs) {
                *cost = match wall {
                    IMPASSABLE => IMPASSABLE,
                    _ => (f32::from(wall) * caution) as u16,
                };
            }
            self.weighted
                .run(&self.costs, &self.goal_numbers, Some(start));
            choice.consider(knowledge, self.weighted.way(start));
        }
        for maze in mazes {
            set_passages(&mut self.passages, self.grid, maze);
            self.shortest
                .fill_until(&self.passages, &self.goal, self.start);
            let at = Pose::at_start(self.start);
            let mut cell = start;
            let way = self.shortest.route(&self.passages, at).map(|hop| {
                let from = cell;
                for _ in 0..hop.cells {
                    cell = self.grid.beyond(cell, hop.heading);
                }
                (from, hop)
            });
            choice.consider(knowledge, way);
        }
        let Some((_, question)) = choice.best else {
            return Plan::Stop;
        };
        self.faith.ask(question.chance, known_steps, question.walls);
        self.search.fill_until(open, &question.vantages, from);
        let hop = self.search.hops(open, from).next();
        hop.map_or(Plan::Look, Plan::Drive)
    }
}

/// Looks for the question that promises most.
struct Choice<'a> {
    parameters: &'a Parameters,
    /// Of the known path.
    known_steps: u32,
    /// Steps of exploring that a saved step of the speed run is worth.
    worth_of_step: f32,
    /// Filled with the steps from where the robot stands.
    distances: &'a Search,
    /// With what it promises.
    best: Option<(f32, Question)>,
}

impl Choice<'_> {
    /// Asks whether a path exists, if that promises enough and more than all before.
    fn consider(&mut self, knowledge: &Knowledge, way: impl Iterator<Item = (usize, Hop)>) {
        let question = Question::of(knowledge, way, self.parameters.doubt);
        let vantages = question.vantages.iter();
        let nearest = vantages.filter_map(|it| self.distances.steps(it)).min();
        let (Some(nearest), Some(saved @ 1..)) =
            (nearest, self.known_steps.checked_sub(question.steps))
        else {
            return;
        };
        let gain = self.worth_of_step * saved as f32 * question.chance;
        let promise = gain / (nearest as f32 + self.parameters.overhead);
        let least = self
            .best
            .as_ref()
            .map_or(self.parameters.reluctance, |it| it.0);
        if promise > least {
            self.best = Some((promise, question));
        }
    }
}

/// A path from start to goal that may exist.
struct Question {
    steps: u32,
    /// How likely it is taken to exist.
    chance: f32,
    /// Its unknown walls.
    walls: Vec<usize>,
    /// Cells from which one of these walls is seen.
    vantages: CellSet,
}

impl Question {
    fn of(knowledge: &Knowledge, way: impl Iterator<Item = (usize, Hop)>, doubt: f32) -> Self {
        let grid = knowledge.grid;
        let (mut steps, mut surprise) = (0, 0.0);
        let (mut walls, mut vantages) = (Vec::new(), CellSet::new());
        for (mut cell, hop) in way {
            steps += 1;
            for _ in 0..hop.cells {
                let wall = grid.wall(cell, hop.heading);
                if knowledge.known[wall] == Known::Unknown {
                    surprise += knowledge.surprise[wall];
                    walls.push(wall);
                    add_vantages(knowledge, cell, hop.heading, &mut vantages);
                }
                cell = grid.beyond(cell, hop.heading);
            }
        }
        Self {
            steps,
            chance: exp(-doubt * surprise),
            walls,
            vantages,
        }
    }
}

/// Adds the cells from which the unknown wall on that side of `cell` is seen: the
/// cells on both sides of it, and those behind them as far as the view is known to be
/// free.
fn add_vantages(knowledge: &Knowledge, cell: usize, side: Heading, vantages: &mut CellSet) {
    let grid = knowledge.grid;
    let ends = [(cell, side.opposite()), (grid.beyond(cell, side), side)];
    for (mut cell, away) in ends {
        vantages.insert(grid.at(cell));
        while knowledge.known[grid.wall(cell, away)] == Known::Open {
            cell = grid.beyond(cell, away);
            vantages.insert(grid.at(cell));
        }
    }
}

/// Opens the walls of a maze that are 1, and closes the others.
fn set_passages(passages: &mut Passages, grid: Grid, open: &[u8]) {
    *passages = Passages::all_closed(grid.dimension());
    for wall in grid.inner_walls().filter(|&it| open[it] == 1) {
        let [first, second] = grid.sides(wall);
        let side = if second == first + 1 {
            Heading::Right
        } else {
            Heading::Up
        };
        passages.open(grid.at(first), side);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::SCALARS;
    use wasmouse_sdk::Area;

    /// A known path around three sides of a square, and what lies across it unknown.
    fn plan(chance: f32, mazes: &[Vec<u8>]) -> Plan {
        let goal = Cell::new(4, 0);
        let briefing = Briefing {
            goal: Area::new(goal, 1, 1),
            ..Briefing::contest(6)
        };
        let grid = Grid::new(6);
        let mut open = Passages::all_closed(6);
        let mut known = vec![Known::Closed; grid.wall_count()];
        for line in 0..4 {
            for (cell, side) in [
                (Cell::new(0, line), Heading::Up),
                (Cell::new(line, 4), Heading::Right),
                (Cell::new(4, line), Heading::Up),
            ] {
                open.open(cell, side);
                known[grid.wall(grid.cell(cell), side)] = Known::Open;
            }
        }
        for wall in across(grid) {
            known[wall] = Known::Unknown;
        }
        let mut knowledge = Knowledge::new(6);
        knowledge.take(&open, &known, |_| chance, &SCALARS[0]);
        let mut planner = Planner::new(&briefing);
        let mazes = mazes.iter().map(|it| &it[..]);
        planner.explore(&knowledge, mazes, goal, &SCALARS[0])
    }

    fn across(grid: Grid) -> impl Iterator<Item = usize> {
        (0..4).map(move |x| grid.wall(grid.cell(Cell::new(x, 2)), Heading::Right))
    }

    #[test]
    fn goes_and_looks_when_it_pays() {
        let nearest = Plan::Drive(Hop {
            heading: Heading::Up,
            cells: 2,
        });
        assert_eq!(plan(0.98, &[]), nearest);
        assert_eq!(plan(0.05, &[]), Plan::Stop);
    }

    /// What is unlikely by its patterns is asked no more often because a maze has it.
    #[test]
    fn a_sampled_maze_asks_but_does_not_answer() {
        let grid = Grid::new(6);
        let mut maze = vec![1; grid.wall_count()];
        assert_eq!(plan(0.05, &[maze.clone()]), Plan::Stop);
        maze.fill(0);
        assert!(matches!(plan(0.98, &[maze]), Plan::Drive(_)));
    }
}
