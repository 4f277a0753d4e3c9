//! `tree`: a random spanning tree, and a share of the remaining walls opened.
//!
//! Kruskal's algorithm over edges in random order makes a maze with exactly one
//! way between any two cells, full of short dead ends. Opening some of the
//! remaining walls makes the loops without which exploring would be pointless.
//! The more loops, the more the shortest way differs from the first one found.

use super::super::Walls;
use super::draft::{Draft, Edge};
use super::draws::Draws;
use super::sets::Sets;

/// The walls of one maze; `loops` is the percentage of walls that is opened
/// after the tree is complete, rounded down.
pub(super) fn walls(dimension: u8, loops: u8, draws: &mut Draws) -> Walls {
    assert!(loops <= 100, "{loops} percent of walls");
    let mut draft = Draft::new(Walls::closed(dimension), draws);
    let mut edges = draft.edges();
    draws.shuffle(&mut edges);
    let mut remaining = span(&mut draft, &edges);
    let opened = remaining.len() * usize::from(loops) / 100;
    // In the order of the shuffle, which is random enough and means that a
    // higher percentage opens the same walls and more.
    remaining.truncate(opened);
    for edge in remaining {
        draft.set(edge, true);
    }
    draft.into_walls()
}

/// Connects all cells and returns the free edges that were not needed for it.
fn span(draft: &mut Draft, edges: &[Edge]) -> Vec<Edge> {
    let mut cells = Sets::new(usize::from(draft.walls().dimension()).pow(2));
    let mut join = |draft: &Draft, edge: Edge| {
        let [a, b] = edge.cells().map(|cell| draft.walls().index(cell));
        cells.join(a, b)
    };
    for &edge in edges.iter().filter(|&&edge| draft.is_open(edge)) {
        join(draft, edge);
    }
    let mut remaining = Vec::new();
    for &edge in edges {
        if !draft.is_free(edge) {
            continue;
        }
        if join(draft, edge) {
            draft.set(edge, true);
        } else {
            remaining.push(edge);
        }
    }
    remaining
}
