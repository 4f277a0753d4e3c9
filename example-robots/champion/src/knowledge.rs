//! The input of the planner: [`Knowledge`].
//!
//! Once per decision it turns the probabilities of the belief into costs.

use wasmouse_sdk::{Grid, IMPASSABLE, Passages};

use crate::numbers::ln;
use crate::tuning::Parameters;

/// What a step costs in the weighted searches; walls cost in the same unit.
pub const STEP: u16 = 32;

/// The most that an unknown wall costs.
const WALL_COST_MAX: f32 = 600.0;

/// No wall is believed to be closed more firmly than that.
const CHANCE_MIN: f32 = 0.02;

/// What is known about a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Not seen.
    Unknown,
    /// Seen open.
    Open,
    /// Seen closed, or of the perimeter.
    Closed,
}

/// Walls seen so far, and what the others cost.
pub struct Knowledge {
    /// Numbers of cells and walls.
    pub grid: Grid,
    /// By wall.
    pub known: Vec<Known>,
    /// The walls known to be open.
    pub open: Passages,
    /// By wall, on the way to the goal for the first time: nothing where it is open,
    /// [`IMPASSABLE`] where closed, between them where unknown.
    pub goal_costs: Vec<u16>,
    /// The same for the path from start to goal that is looked for afterwards.
    pub way_costs: Vec<u16>,
    /// By wall, where unknown: -ln of the chance that it is open.
    pub surprise: Vec<f32>,
}

impl Knowledge {
    /// Nothing known but the perimeter, nothing believed.
    pub fn new(dimension: u32) -> Self {
        let grid = Grid::new(dimension);
        Self {
            grid,
            known: vec![Known::Closed; grid.wall_count()],
            open: Passages::all_closed(dimension),
            goal_costs: vec![IMPASSABLE; grid.wall_count()],
            way_costs: vec![IMPASSABLE; grid.wall_count()],
            surprise: vec![0.0; grid.wall_count()],
        }
    }

    /// Takes over the passages known to be open, what is known by wall, and the chance
    /// that an unknown wall is open.
    pub fn take(
        &mut self,
        open: &Passages,
        known: &[Known],
        chance: impl Fn(usize) -> f32,
        parameters: &Parameters,
    ) {
        self.open.clone_from(open);
        self.known.copy_from_slice(known);
        for wall in self.grid.inner_walls() {
            let costs = match known[wall] {
                Known::Open => [0, 0],
                Known::Closed => [IMPASSABLE, IMPASSABLE],
                Known::Unknown => {
                    let surprise = -ln(chance(wall).clamp(CHANCE_MIN, 1.0));
                    self.surprise[wall] = surprise;
                    [
                        parameters.goal_price + parameters.goal_caution * surprise,
                        parameters.way_caution * surprise,
                    ]
                    .map(|steps| {
                        let cost = steps * f32::from(STEP) + 0.5;
                        cost.min(WALL_COST_MAX) as u16
                    })
                }
            };
            [self.goal_costs[wall], self.way_costs[wall]] = costs;
        }
    }
}
