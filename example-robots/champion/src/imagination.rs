//! Deciding by playing to the end in imagined mazes: [`Imagination`].
//!
//! The robot has been in the goal: where to look next, and whether to go on at all? The
//! rules of the [`Planner`] answer in an instant, but know only one way at a time. Here
//! they are put to the test: each thing that could be done now is done in every maze of
//! the [`Ensemble`], and from then on the rules decide, to the reset. What that costs
//! on average, in steps of exploring, says what to do (a rollout policy; Bertsekas and
//! Castanon, *Rollout Algorithms for Stochastic Scheduling Problems*, 1999). All
//! alternatives are played in the same mazes, so that what counts is the difference in
//! each; the rules are overruled only when it is clear.
//!
//! On the way to the goal the rules decide alone: there, as many imagined matches as
//! the fuel allows decided no better. So they do where only patterns of walls are known
//! of a maze: there imagined matches did worse in mazes drawn by people, perhaps because
//! mazes drawn from patterns have too few of the short cuts that people build.

use wasmouse_sdk::{Briefing, Cell, CellSet, Grid, Hop, Passages, Pose, Search};

use crate::alternative::{Alternative, choose, drop_bad};
use crate::ensemble::Ensemble;
use crate::knowledge::{Knowledge, Known};
use crate::planner::{Plan, Planner, add_vantages};

/// How many places to look from are tried at most, besides what the rule says.
const PLACES: usize = 5;

/// Mazes before the first alternative may be dropped.
const MAZES_MIN: usize = 8;

/// The rule is overruled when something is better by this many standard errors.
const CLEAR: f32 = 2.0;

/// Exploring ends without further thought when knowing everything would save less
/// than this many steps of exploring.
const WORTH_MIN: f32 = 2.0;

/// An imagined exploration ends after that many steps.
const STEPS_MAX: u32 = 400;

/// Work of a match: its imagined steps, each counted as [`STEP_WORK`] and the number of
/// cells, and its mazes drawn. Each was measured to take 100 to 160 units of fuel: this stays
/// within the 20 thousand million that a match may use.
const WORK_MAX: u64 = 100_000_000;

/// See [`WORK_MAX`].
const STEP_WORK: u64 = 230;

/// What it costs, for each cell of the maze, to draw the mazes after news.
const DRAWING_WORK: u64 = 850;

/// A decision may use this part of the work that is left: enough is left for later
/// ones, and no step uses the fuel of many.
const DECISION_PART: u64 = 16;

/// Imagined matches with their buffers.
pub struct Imagination {
    grid: Grid,
    start: Cell,
    goal: CellSet,
    divisor: u32,
    search: Search,
    /// By wall, 1 where it is open.
    mazes: Vec<Vec<u8>>,
    knowledge: Knowledge,
    /// What is left of [`WORK_MAX`].
    work_left: u64,
}

/// The robot of an imagined match.
struct Tourist {
    cell: Cell,
    steps: u32,
}

impl Imagination {
    /// Buffers for a match.
    pub fn new(briefing: &Briefing) -> Self {
        Self {
            grid: Grid::new(briefing.dimension),
            start: briefing.start,
            goal: CellSet::from(briefing.goal),
            divisor: briefing.exploration_divisor,
            search: Search::new(briefing.dimension, briefing.longest_move),
            mazes: Vec::new(),
            knowledge: Knowledge::new(briefing.dimension),
            work_left: WORK_MAX,
        }
    }

    /// Whether the work of a match is used up; then there is nothing more to expect.
    pub const fn is_exhausted(&self) -> bool {
        self.work_left == 0
    }

    /// Takes note that mazes have been drawn.
    pub fn count_drawing(&mut self) {
        let cells = u64::from(self.grid.dimension().pow(2));
        self.work_left = self.work_left.saturating_sub(DRAWING_WORK * cells);
    }

    /// The hops to drive until there is news. None says that exploring on does not
    /// pay. The goal has been reached.
    pub fn decide(
        &mut self,
        planner: &mut Planner,
        ensemble: &Ensemble,
        now: &Knowledge,
        cell: Cell,
    ) -> Vec<Hop> {
        let rule: Vec<Hop> = match planner.explore(now, cell) {
            Plan::Drive(hop) => vec![hop],
            Plan::Look | Plan::Stop => Vec::new(),
        };
        self.mazes.clear();
        let mazes = 0..ensemble.sample_count();
        let mazes = mazes.map(|index| ensemble.sample(index).to_vec());
        self.mazes.extend(mazes);
        // With so little to gain, whatever the rule says.
        let Some(places) = self.places_for_better_ways(planner, now, cell) else {
            return Vec::new();
        };
        let mut alternatives = vec![Alternative::new(rule)];
        if !alternatives[0].hops.is_empty() {
            alternatives.push(Alternative::new(Vec::new()));
        }
        self.search.fill(&now.open, &CellSet::from(cell));
        for place in places {
            let hops = self.hops_to(now, place);
            if alternatives.iter().all(|it| it.hops != hops) {
                alternatives.push(Alternative::new(hops));
            }
        }
        let best = self.compare(planner, now, cell, &mut alternatives);
        alternatives.swap_remove(best).hops
    }

    /// The places that promise most: for each, what the imagined mazes say could be
    /// gained by ways whose walls are seen from there, less the steps to go there.
    /// `None` when all of it together is not worth looking for.
    fn places_for_better_ways(
        &mut self,
        planner: &mut Planner,
        now: &Knowledge,
        from: Cell,
    ) -> Option<Vec<Cell>> {
        let known_steps = planner.known_steps(&now.open)?;
        let mut gains = vec![0; self.grid.cell_count()];
        let mut total = 0;
        for maze in &self.mazes {
            let passages = passages(self.grid, maze);
            self.search.fill_until(&passages, &self.goal, self.start);
            let steps = self.search.steps(self.start);
            let gain = steps.map_or(0, |steps| known_steps.saturating_sub(steps));
            if gain == 0 {
                continue;
            }
            total += gain;
            for cell in self.vantages(&passages, now).iter() {
                gains[self.grid.cell(cell)] += gain;
            }
        }
        let scale = self.divisor as f32 / self.mazes.len() as f32;
        if (total as f32) * scale < WORTH_MIN {
            return None;
        }
        planner.begin(now);
        self.search.fill(&now.open, &CellSet::from(from));
        let mut ranked: Vec<(f32, usize)> = Vec::new();
        for (place, &gain) in gains.iter().enumerate().filter(|it| *it.1 > 0) {
            let steps = self.search.steps(self.grid.at(place));
            let promise = steps.map_or(0.0, |steps| gain as f32 * scale - steps as f32);
            if promise > 0.0 && steps != Some(0) {
                ranked.push((promise, place));
            }
        }
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        ranked.truncate(PLACES);
        Some(ranked.iter().map(|it| self.grid.at(it.1)).collect())
    }

    /// The cells from which an unknown wall of the way last searched for is seen.
    fn vantages(&self, passages: &Passages, now: &Knowledge) -> CellSet {
        let mut vantages = CellSet::new();
        let mut cell = self.grid.cell(self.start);
        for hop in self.search.route(passages, Pose::at_start(self.start)) {
            for _ in 0..hop.cells {
                if now.known[self.grid.wall(cell, hop.heading)] == Known::Unknown {
                    add_vantages(now, cell, hop.heading, &mut vantages);
                }
                cell = self.grid.beyond(cell, hop.heading);
            }
        }
        vantages
    }

    /// The hops to a place, from where the last search has been filled.
    fn hops_to(&self, now: &Knowledge, place: Cell) -> Vec<Hop> {
        let back = self.search.route(&now.open, Pose::at_start(place));
        let mut hops: Vec<Hop> = back
            .map(|hop| Hop {
                heading: hop.heading.opposite(),
                cells: hop.cells,
            })
            .collect();
        hops.reverse();
        hops
    }

    /// Plays the alternatives; the index of the one to choose. The first is what the
    /// rule says.
    fn compare(
        &mut self,
        planner: &mut Planner,
        now: &Knowledge,
        cell: Cell,
        alternatives: &mut [Alternative],
    ) -> usize {
        if alternatives.len() == 1 {
            return 0;
        }
        let reserve = self.work_left - self.work_left / DECISION_PART;
        let mazes = std::mem::take(&mut self.mazes);
        for (played, maze) in (1..).zip(&mazes) {
            for alternative in alternatives.iter_mut().filter(|it| !it.is_dropped) {
                let cost = self.play(planner, maze, now, cell, &alternative.hops);
                alternative.costs.push(cost as f32);
            }
            let is_decided = played >= MAZES_MIN && played % 4 == 0 && drop_bad(alternatives) == 1;
            if is_decided || self.work_left < reserve {
                break;
            }
        }
        self.mazes = mazes;
        choose(alternatives, CLEAR)
    }

    /// What an alternative costs in an imagined maze, in steps of exploring.
    fn play(
        &mut self,
        planner: &mut Planner,
        maze: &[u8],
        now: &Knowledge,
        cell: Cell,
        hops: &[Hop],
    ) -> u32 {
        self.knowledge.copy(now);
        planner.again();
        let mut tourist = Tourist { cell, steps: 0 };
        for &hop in hops {
            if self.drive(&mut tourist, hop, maze) {
                break;
            }
        }
        if !hops.is_empty() {
            self.explore_on(planner, maze, &mut tourist);
        }
        let step_work = STEP_WORK + u64::from(self.grid.dimension().pow(2));
        let work = u64::from(tourist.steps + 1) * step_work;
        self.work_left = self.work_left.saturating_sub(work);
        let race = planner.known_steps(&self.knowledge.open);
        tourist.steps + 1 + self.divisor * race.expect("a way is known from the beginning")
    }

    /// One step; whether it brought news.
    fn drive(&mut self, tourist: &mut Tourist, hop: Hop, maze: &[u8]) -> bool {
        let there = tourist.cell.toward(hop.heading, hop.cells);
        tourist.cell = there.expect("hops stay in the maze");
        tourist.steps += 1;
        self.knowledge.look_around(tourist.cell, maze)
    }

    /// By the rule, which is asked again whenever there is news.
    fn explore_on(&mut self, planner: &mut Planner, maze: &[u8], tourist: &mut Tourist) {
        while tourist.steps < STEPS_MAX {
            let Plan::Drive(hop) = planner.imagine_explore(&self.knowledge, tourist.cell) else {
                return;
            };
            let mut next = Some(hop);
            while let Some(hop) = next {
                if self.drive(tourist, hop, maze) {
                    break;
                }
                next = planner.go_on(&self.knowledge.open, tourist.cell);
            }
        }
    }
}

/// The passages of a maze, 1 by wall where it is open.
fn passages(grid: Grid, open: &[u8]) -> Passages {
    use wasmouse_sdk::Heading::{Right, Up};
    let mut passages = Passages::all_closed(grid.dimension());
    for wall in grid.inner_walls().filter(|&it| open[it] == 1) {
        let [first, second] = grid.sides(wall);
        let side = if second == first + 1 { Right } else { Up };
        passages.open(grid.at(first), side);
    }
    passages
}
