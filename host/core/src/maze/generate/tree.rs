//! `tree`: a random spanning tree, with some of the remaining walls opened.
//!
//! Kruskal's algorithm over edges in random order gives a maze with exactly one path between
//! any two cells, and many short dead ends. Opening some of the remaining walls gives loops,
//! without which exploration would be pointless: the more loops, the more the shortest path
//! differs from the first one found.

use super::super::Walls;
use super::draft::{Draft, Edge};
use super::draws::Draws;
use super::sets::Sets;

/// The walls of one maze. `loops` is the percentage of the remaining walls that are opened,
/// rounded down.
pub(super) fn walls(dimension: u8, loops: u8, draws: &mut Draws) -> Walls {
    assert!(loops <= 100, "{loops} percent of walls");
    let mut draft = Draft::new(Walls::closed(dimension), draws);
    let mut edges = draft.edges();
    draws.shuffle(&mut edges);
    let mut remaining = span(&mut draft, &edges);
    let opened = remaining.len() * usize::from(loops) / 100;
    // In the order of the shuffle, so that a higher percentage opens the same walls and more.
    remaining.truncate(opened);
    for edge in remaining {
        draft.set(edge, true);
    }
    draft.into_walls()
}

/// Connects all cells and returns the remaining free edges.
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
