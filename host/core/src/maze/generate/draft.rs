//! [`Draft`]: a contest maze whose start and goal room are final and whose other edges are
//! free.

use super::super::{Area, Cell, Heading, Walls};
use super::draws::Draws;

/// The edge between two cells, named by the cell to its left or below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    cell: Cell,
    /// Up or right.
    heading: Heading,
}

impl Edge {
    /// The edge on that side of `cell`, which must not be the perimeter for
    /// [`Heading::Down`] and [`Heading::Left`].
    pub(super) fn new(cell: Cell, heading: Heading) -> Self {
        match heading {
            Heading::Up | Heading::Right => Self { cell, heading },
            Heading::Down | Heading::Left => Self {
                cell: cell
                    .step(heading)
                    .expect("an edge has a cell on both sides"),
                heading: heading.opposite(),
            },
        }
    }

    /// The cells on both sides.
    pub(super) fn cells(self) -> [Cell; 2] {
        let other = self.cell.step(self.heading);
        [self.cell, other.expect("an edge has a cell on both sides")]
    }

    /// The direction of a wall on it: up or right.
    pub(super) const fn along(self) -> Heading {
        match self.heading {
            Heading::Up | Heading::Down => Heading::Right,
            Heading::Right | Heading::Left => Heading::Up,
        }
    }

    /// The two edges across the post at its end in that direction, and the next edge in line.
    /// `None` past column or row 0; the caller checks the other sides of the maze.
    pub(super) fn past(self, direction: Heading) -> Option<([Self; 2], Self)> {
        let next = Self {
            cell: self.cell.step(direction)?,
            ..self
        };
        Some((self.cells().map(|cell| Self::new(cell, direction)), next))
    }

    /// The posts at both ends, each as the cell whose lower left corner it is.
    pub(super) fn posts(self) -> [Cell; 2] {
        let Cell { x, y } = self.cell;
        let far = Cell::new(x + 1, y + 1);
        match self.heading {
            Heading::Up | Heading::Down => [Cell::new(x, y + 1), far],
            Heading::Right | Heading::Left => [Cell::new(x + 1, y), far],
        }
    }
}

/// A contest maze under construction.
///
/// The start and the goal room are final: the start is open at the top only, the goal room has
/// no inner walls and exactly one entrance, at a random one of its eight outer edges (which
/// [`Draft::move_entrance`] may change). Other edges are free until they are set, which makes
/// them final.
pub(super) struct Draft {
    walls: Walls,
    /// By cell index: bits of [`Heading::Up`] and [`Heading::Right`].
    finals: Vec<u8>,
    /// The eight edges around the goal room, of which one is open.
    border: Vec<Edge>,
}

impl Draft {
    /// A draft whose free edges are those of `blank`, all open or all closed.
    pub(super) fn new(blank: Walls, draws: &mut Draws) -> Self {
        let dimension = blank.dimension();
        let mut draft = Self {
            finals: vec![0; usize::from(dimension).pow(2)],
            border: Vec::new(),
            walls: blank,
        };
        let start = Cell::new(0, 0);
        draft.set(Edge::new(start, Heading::Up), true);
        draft.set(Edge::new(start, Heading::Right), false);
        draft.set_goal(Area::center(dimension), draws);
        draft
    }

    fn set_goal(&mut self, goal: Area, draws: &mut Draws) {
        for cell in goal.cells() {
            for heading in Heading::ALL {
                let edge = Edge::new(cell, heading);
                if edge.cells().into_iter().all(|cell| goal.contains(cell)) {
                    // Both of its cells come by, and the first one makes it final.
                    if self.is_free(edge) {
                        self.set(edge, true);
                    }
                } else {
                    self.border.push(edge);
                }
            }
        }
        let entrance = draws.pick(&self.border);
        for edge in self.border.clone() {
            self.set(edge, Some(edge) == entrance);
        }
    }

    /// The possible entrances of the goal room, by goal cell.
    pub(super) fn entrances(&self) -> Vec<Edge> {
        self.border.clone()
    }

    /// Moves the entrance of the goal room, although its edges are final.
    pub(super) fn move_entrance(&mut self, entrance: Edge) {
        for &edge in &self.border {
            self.walls.set(edge.cell, edge.heading, edge == entrance);
        }
    }

    /// The walls so far.
    pub(super) const fn walls(&self) -> &Walls {
        &self.walls
    }

    /// The finished walls.
    pub(super) fn into_walls(self) -> Walls {
        self.walls
    }

    /// Whether the edge is not final yet.
    pub(super) fn is_free(&self, edge: Edge) -> bool {
        self.finals[self.walls.index(edge.cell)] & edge.heading.bit() == 0
    }

    /// Opens or closes a free edge for good.
    ///
    /// # Panics
    ///
    /// If the edge is final: changing it could break a contest rule.
    pub(super) fn set(&mut self, edge: Edge, open: bool) {
        self.change(edge, open);
        let index = self.walls.index(edge.cell);
        self.finals[index] |= edge.heading.bit();
    }

    /// Opens or closes a free edge without making it final, for a generator that may change
    /// it again.
    ///
    /// # Panics
    ///
    /// If the edge is final: changing it could break a contest rule.
    pub(super) fn change(&mut self, edge: Edge, open: bool) {
        assert!(self.is_free(edge), "{edge:?} is final");
        self.walls.set(edge.cell, edge.heading, open);
    }

    /// Whether there is no wall on the edge.
    pub(super) fn is_open(&self, edge: Edge) -> bool {
        self.walls.is_open(edge.cell, edge.heading)
    }

    /// All edges between two cells, in the order of the cells.
    pub(super) fn edges(&self) -> Vec<Edge> {
        let edges = self.walls.edges();
        edges
            .map(|(cell, heading)| Edge { cell, heading })
            .collect()
    }

    /// The free edges around a cell, clockwise from up.
    pub(super) fn free_edges_of(&self, cell: Cell) -> Vec<(Heading, Edge)> {
        Heading::ALL
            .into_iter()
            .filter(|&heading| self.walls.neighbor(cell, heading).is_some())
            .map(|heading| (heading, Edge::new(cell, heading)))
            .filter(|&(_, edge)| self.is_free(edge))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_the_same_from_both_cells() {
        let cell = Cell::new(3, 4);
        for heading in Heading::ALL {
            let other = cell.step(heading).expect("inside");
            let edge = Edge::new(cell, heading);
            assert_eq!(edge, Edge::new(other, heading.opposite()));
            assert!(edge.cells().contains(&cell) && edge.cells().contains(&other));
        }
        let right = Edge::new(cell, Heading::Right);
        assert_eq!(right.posts(), [Cell::new(4, 4), Cell::new(4, 5)]);
        let up = Edge::new(cell, Heading::Up);
        assert_eq!(up.posts(), [Cell::new(3, 5), Cell::new(4, 5)]);
        let up_at = |x, y| Edge::new(Cell::new(x, y), Heading::Up);
        let right_at = |x, y| Edge::new(Cell::new(x, y), Heading::Right);
        let check = |edge: Edge, direction, across, next| {
            assert!([edge.along(), edge.along().opposite()].contains(&direction));
            assert_eq!(edge.past(direction), Some((across, next)));
        };
        check(
            up,
            Heading::Right,
            [right_at(3, 4), right_at(3, 5)],
            up_at(4, 4),
        );
        check(
            up,
            Heading::Left,
            [right_at(2, 4), right_at(2, 5)],
            up_at(2, 4),
        );
        check(
            right,
            Heading::Up,
            [up_at(3, 4), up_at(4, 4)],
            right_at(3, 5),
        );
        check(
            right,
            Heading::Down,
            [up_at(3, 3), up_at(4, 3)],
            right_at(3, 3),
        );
        assert_eq!(right_at(3, 0).past(Heading::Down), None);
    }

    #[test]
    fn only_start_and_goal_are_final() {
        let draft = Draft::new(Walls::open(12), &mut Draws::new("test", 12, 1));
        let edges = draft.edges();
        assert_eq!(edges.len(), 2 * 12 * 11);
        let finals = edges.iter().filter(|&&edge| !draft.is_free(edge));
        assert_eq!(finals.count(), 2 + 4 + 8);
        let closed = edges.iter().filter(|&&edge| !draft.is_open(edge));
        assert_eq!(closed.count(), 1 + 7);
    }
}
