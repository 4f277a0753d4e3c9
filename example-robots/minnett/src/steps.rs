//! Dijkstra's algorithm over steps: [`Steps`].
//!
//! The graph is implicit: its nodes are cells, and its edges are the moves of one step through
//! walls that a view leaves open. It does not know the two views of the maze or the peaks.

use std::collections::{BTreeSet, VecDeque};

use wasmouse_sdk::{Cell, CellSet, Heading, Hop, Passages};

/// The order in which the report's program lists neighbours; the first of equal
/// ones is taken.
const ORDER: [Heading; 4] = [Heading::Right, Heading::Up, Heading::Left, Heading::Down];

/// The cost of a cell that is not reached.
const INFINITE: u32 = u32::MAX;

/// In which order Dijkstra's algorithm goes on from the cells that it has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The cheapest first, as it should be.
    Cheapest,
    /// The error of the report's first versions: whatever was reached and stands last
    /// in the list, here row by row from the bottom. Costs come out too high.
    LastInList,
}

/// Where one step may lead.
#[derive(Clone, Copy)]
pub struct Graph<'a> {
    /// The walls that may be driven through.
    pub passages: &'a Passages,
    /// Cells that a step may end in but not pass.
    pub stops: &'a CellSet,
    /// The longest step, in cells.
    pub longest: u32,
}

impl Graph<'_> {
    /// Every drive of one step from `cell`, with the cell that it leads to.
    fn neighbors(&self, cell: Cell) -> impl Iterator<Item = (Cell, Hop)> {
        ORDER.into_iter().flat_map(move |heading| {
            let clear = self.passages.clear_cells(cell, heading, self.longest);
            let mut stopped = false;
            (1..=clear).map_while(move |cells| {
                let there = cell.toward(heading, cells).filter(|_| !stopped)?;
                stopped = self.stops.contains(there);
                Some((there, Hop { heading, cells }))
            })
        })
    }
}

/// The path costs of all cells, in steps, with buffers that are reused.
pub struct Steps {
    dimension: u32,
    order: Order,
    /// Row by row.
    costs: Vec<u32>,
}

impl Steps {
    pub fn new(dimension: u32, order: Order) -> Self {
        Self {
            dimension,
            order,
            costs: vec![INFINITE; (dimension * dimension) as usize],
        }
    }

    /// Computes the cost of every cell from `from`.
    pub fn fill(&mut self, graph: Graph, from: Cell) {
        self.costs.fill(INFINITE);
        let first = self.index(from);
        self.costs[first] = 0;
        match self.order {
            Order::Cheapest => self.fill_cheapest_first(graph, from),
            Order::LastInList => self.fill_last_in_list_first(graph, first),
        }
    }

    /// The path of the last search from its start to `to`, hop by hop; `None` when
    /// `to` was not reached, no hops when it is the start itself.
    ///
    /// Built from its end, as in the report: to the neighbour with the smallest cost,
    /// again and again.
    pub fn path(&self, graph: Graph, to: Cell) -> Option<Vec<Hop>> {
        let mut hops = Vec::new();
        let mut at = to;
        while self.cost(at)? > 0 {
            let best = graph
                .neighbors(at)
                .min_by_key(|&(cell, _)| self.costs[self.index(cell)]);
            let (before, back) = best.expect("a cell was reached from a neighbour");
            hops.push(Hop {
                heading: back.heading.opposite(),
                cells: back.cells,
            });
            at = before;
        }
        hops.reverse();
        Some(hops)
    }

    /// Steps from the start of the last search; `None` for cells not reached.
    pub fn cost(&self, cell: Cell) -> Option<u32> {
        Some(self.costs[self.index(cell)]).filter(|&cost| cost != INFINITE)
    }

    /// Every edge costs one step, so the queue of Dijkstra's algorithm is sorted by
    /// itself.
    fn fill_cheapest_first(&mut self, graph: Graph, from: Cell) {
        let mut queue = VecDeque::from([from]);
        while let Some(cell) = queue.pop_front() {
            let cost = self.costs[self.index(cell)] + 1;
            for (there, _) in graph.neighbors(cell) {
                let index = self.index(there);
                if self.costs[index] == INFINITE {
                    self.costs[index] = cost;
                    queue.push_back(there);
                }
            }
        }
    }

    fn fill_last_in_list_first(&mut self, graph: Graph, first: usize) {
        let mut reached = BTreeSet::from([first]);
        while let Some(index) = reached.pop_last() {
            let (x, y) = (index as u32 % self.dimension, index as u32 / self.dimension);
            let cost = self.costs[index] + 1;
            for (there, _) in graph.neighbors(Cell::new(x, y)) {
                let index = self.index(there);
                if self.costs[index] == INFINITE {
                    reached.insert(index);
                }
                // Also where the cell has been gone on from: its neighbours then keep
                // costs that are too high.
                self.costs[index] = self.costs[index].min(cost);
            }
        }
    }

    const fn index(&self, cell: Cell) -> usize {
        (cell.y * self.dimension + cell.x) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::{Area, Random, Search};

    fn random_passages(random: &mut Random) -> Passages {
        let mut passages = Passages::all_open(9);
        for cell in Area::new(Cell::new(0, 0), 9, 9).cells() {
            for heading in [Heading::Up, Heading::Right] {
                if random.below(100) < 35 {
                    passages.close(cell, heading);
                }
            }
        }
        passages
    }

    /// Without stops it is the SDK's search; the flawed order is never better, and
    /// worse somewhere; every path is whole and as long as its cost or shorter.
    #[test]
    fn costs_and_paths() {
        let mut random = Random::new(5);
        let mut too_high = 0;
        for _ in 0..100 {
            let passages = random_passages(&mut random);
            let from = Cell::new(random.below(9), random.below(9));
            let stops = CellSet::new();
            let graph = Graph {
                passages: &passages,
                stops: &stops,
                longest: 3,
            };
            let mut search = Search::new(9, 3);
            search.fill(&passages, &CellSet::from(from));
            for order in [Order::Cheapest, Order::LastInList] {
                let mut steps = Steps::new(9, order);
                steps.fill(graph, from);
                for cell in Area::new(Cell::new(0, 0), 9, 9).cells() {
                    let (least, cost) = (search.steps(cell), steps.cost(cell));
                    match order {
                        Order::Cheapest => assert_eq!(cost, least),
                        Order::LastInList => {
                            assert!(cost >= least && cost.is_some() == least.is_some());
                            too_high += u32::from(cost > least);
                        }
                    }
                    let path = steps.path(graph, cell);
                    assert_eq!(path.is_some(), cost.is_some());
                    let Some(path) = path else { continue };
                    assert!(path.len() as u32 <= cost.expect("reached"));
                    let end = path.iter().fold(from, |at, hop| {
                        let clear = passages.clear_cells(at, hop.heading, hop.cells);
                        assert_eq!(clear, hop.cells);
                        at.toward(hop.heading, clear).expect("clear")
                    });
                    assert_eq!(end, cell);
                }
            }
        }
        assert!(too_high > 100, "only {too_high}: a weak test");
    }

    #[test]
    fn a_step_does_not_pass_a_stop() {
        let passages = Passages::all_open(4);
        let stops = CellSet::from(Cell::new(1, 0));
        let graph = Graph {
            passages: &passages,
            stops: &stops,
            longest: 3,
        };
        let mut steps = Steps::new(4, Order::Cheapest);
        steps.fill(graph, Cell::new(0, 0));
        assert_eq!(steps.cost(Cell::new(1, 0)), Some(1));
        assert_eq!(steps.cost(Cell::new(3, 0)), Some(2));
        assert_eq!(steps.cost(Cell::new(0, 3)), Some(1));
    }
}
