//! `stretches`: Minnett's generator as his public program implements it.
//!
//! His report describes stretches of four edges (section 1.4.1), which `division` implements.
//! The generator of the program that he published with it (`maze_generator.py`) differs: it
//! alternates between vertical and horizontal edges, picks any undecided edge, and extends it
//! to a stretch of at most five edges, up or right first, then down or left. One of them
//! becomes an opening and the others walls. The algorithm ends when all edges are decided. A
//! stretch can be a single edge, which is then an opening, so these mazes have shorter paths
//! to the goal than those of `division`.
//!
//! A stretch extends past a post only if the two edges across it are undecided. It may extend
//! over edges of an earlier stretch, which are then decided again. This also keeps all cells
//! connected: there is no wall outside the stretch at a post inside it, so each part of its
//! walls, on either side of the opening, is connected to other walls at one end at most, and
//! closes no ring of walls.

use super::super::{Heading, Walls};
use super::draft::{Draft, Edge};
use super::draws::Draws;

/// The most edges in a stretch.
const LONGEST: usize = 5;

/// The walls of one maze.
pub(super) fn walls(dimension: u8, draws: &mut Draws) -> Walls {
    let mut draft = Draft::new(Walls::open(dimension), draws);
    // Vertical edges, then horizontal ones.
    let mut undecided = [Heading::Up, Heading::Right].map(|along| {
        let mut edges = draft.edges();
        edges.retain(|&edge| draft.is_free(edge) && edge.along() == along);
        edges
    });
    let mut turn = draws.index(undecided.len());
    while undecided.iter().any(|edges| !edges.is_empty()) {
        if let Some(first) = draws.pick(&undecided[turn]) {
            let stretch = grow(first, &undecided[1 - turn]);
            let opening = draws.pick(&stretch);
            for &edge in &stretch {
                draft.change(edge, Some(edge) == opening);
            }
            undecided[turn].retain(|edge| !stretch.contains(edge));
        }
        turn = 1 - turn;
    }
    draft.into_walls()
}

/// The stretch around an edge: as far as possible up or right, then in the other direction.
fn grow(first: Edge, undecided_across: &[Edge]) -> Vec<Edge> {
    let mut stretch = vec![first];
    for direction in [first.along(), first.along().opposite()] {
        let mut tip = first;
        while stretch.len() < LONGEST
            && let Some((across, next)) = tip.past(direction)
            && across.iter().all(|edge| undecided_across.contains(edge))
        {
            stretch.push(next);
            tip = next;
        }
    }
    stretch
}
