//! The report's dynamic programming for the speed run: [`ValueTable`].
//!
//! Values count cells to the goal, not steps; the speed run then joins cells into steps.

use wasmouse_sdk::{Area, Briefing, Cell, CellSet, Heading, Hop, Map, Passages, Search, Wall};

/// The direction that wins between neighbours of equal value: the first of these.
const ORDER: [Heading; 4] = [Heading::Left, Heading::Down, Heading::Right, Heading::Up];

/// How many cells it is from each cell to the goal, through cells the robot has
/// been in.
pub struct ValueTable {
    longest_move: u32,
    goal: Area,
    /// The walls between two cells that the robot has been in.
    passages: Passages,
    /// Counts cells, because its steps are one cell long.
    values: Search,
}

impl ValueTable {
    /// Computes the values up to that of the start. The goal is its top left cell;
    /// where that cannot be reached, all of its cells.
    pub fn new(map: &Map, visited: &CellSet, briefing: &Briefing) -> Self {
        let &Briefing { start, goal, .. } = briefing;
        let passages = between(map, visited);
        let mut values = Search::new(map.dimension(), 1);
        let top_left = Cell::new(goal.origin.x, goal.origin.y + goal.height - 1);
        values.fill_until(&passages, &CellSet::from(top_left), start);
        if values.steps(start).is_none() {
            values.fill_until(&passages, &CellSet::from(goal), start);
        }
        Self {
            longest_move: briefing.longest_move,
            goal,
            passages,
            values,
        }
    }

    /// The straight stretch of the policy from `cell`, cut to what one step can
    /// drive; `None` in the goal and where there is no path.
    pub fn hop(&self, cell: Cell) -> Option<Hop> {
        let heading = self.policy(cell)?;
        let mut end = cell;
        let mut cells = 0;
        while cells < self.longest_move && self.policy(end) == Some(heading) {
            end = end.toward(heading, 1)?;
            cells += 1;
        }
        Some(Hop { heading, cells })
    }

    /// Steps of the speed run from `start`; `None` where there is no path.
    pub fn race(&self, start: Cell) -> Option<u32> {
        let mut cell = start;
        let mut steps = 0;
        while !self.goal.contains(cell) {
            let Hop { heading, cells } = self.hop(cell)?;
            cell = cell.toward(heading, cells)?;
            steps += 1;
        }
        Some(steps)
    }

    /// The report's policy grid.
    fn policy(&self, cell: Cell) -> Option<Heading> {
        let next = self.values.steps(cell)?.checked_sub(1);
        ORDER.into_iter().find(|&side| {
            self.passages.is_open(cell, side)
                && next.is_some()
                && cell.toward(side, 1).and_then(|it| self.values.steps(it)) == next
        })
    }
}

/// The walls known to be open between two of these cells.
fn between(map: &Map, cells: &CellSet) -> Passages {
    let mut passages = Passages::all_closed(map.dimension());
    for cell in cells.iter() {
        for side in [Heading::Up, Heading::Right] {
            let open = map.wall(cell, side) == Wall::Open;
            if open
                && map
                    .neighbor(cell, side)
                    .is_some_and(|it| cells.contains(it))
            {
                passages.open(cell, side);
            }
        }
    }
    passages
}
