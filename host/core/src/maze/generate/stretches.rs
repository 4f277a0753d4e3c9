//! `stretches`: Minnett's generator as his public program has it.
//!
//! His report speaks of stretches of four edges (section 1.4.1), and `division`
//! is made from that. The maze generator of the program that he published with
//! it (`maze_generator.py`) does something else: it takes turns between vertical
//! and horizontal edges, picks any edge that is not decided yet, and lets a
//! stretch grow from it, up or right first and then down or left, to at most
//! five edges. One of them becomes an opening and the others walls. It ends when
//! all edges are decided. So even a single edge can be a stretch, which is then
//! an opening: these mazes have shorter ways to the goal than those of
//! `division`.
//!
//! A stretch grows past a post only while nothing is decided about the two edges
//! across it. It may thus grow over edges of an earlier stretch, which are then
//! decided again. That is also why all cells stay connected: no wall outside the
//! stretch stands at a post inside it, so its walls, an opening between them, are
//! connected to other walls at one end at most, and no ring of walls can close.

use super::super::{Heading, Walls};
use super::draft::{Draft, Edge};
use super::draws::Draws;

/// The most edges in a stretch.
const LONGEST: usize = 5;

/// The walls of one maze.
pub(super) fn walls(dimension: u8, draws: &mut Draws) -> Walls {
    let mut draft = Draft::new(Walls::open(dimension), draws);
    // By direction: vertical and horizontal ones.
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

/// The stretch around an edge: up or right as far as it goes, then the other way.
fn grow(first: Edge, undecided_across: &[Edge]) -> Vec<Edge> {
    let mut stretch = vec![first];
    for way in [first.along(), first.along().opposite()] {
        let mut tip = first;
        while stretch.len() < LONGEST
            && let Some((across, next)) = tip.past(way)
            && across.iter().all(|edge| undecided_across.contains(edge))
        {
            stretch.push(next);
            tip = next;
        }
    }
    stretch
}
