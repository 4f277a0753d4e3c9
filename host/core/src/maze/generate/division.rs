//! `division`: Minnett's "modified version of the Recursive Division" algorithm.
//!
//! The algorithm starts from a maze with no walls but those of the start and the goal room,
//! and alternates between horizontal and vertical stretches. A stretch is four undecided edges
//! in a row; it becomes three walls and one opening (Minnett 2016, section 1.4.1). Recursive
//! division proper builds stretches across whole chambers, which gives long corridors with few
//! openings; stretches of four give more varied mazes.
//!
//! The report does not define how its stretches keep all cells connected, nor when it stops.
//! Here, a stretch is built only if its walls close no ring of walls, because cells are
//! connected exactly as long as there is no ring. The algorithm ends when no such stretch is
//! left; edges that were in no stretch stay open. The kind `stretches` is what the author's own
//! program does instead.

use super::super::{Cell, Heading, Walls};
use super::draft::{Draft, Edge};
use super::draws::Draws;
use super::sets::Sets;

/// Edges in a stretch.
const STRETCH: u8 = 4;

/// Edges in a row. Decided edges stay decided, so a stretch that cannot be built once never
/// can be, and each is tried once.
type Stretch = [Edge; STRETCH as usize];

/// The walls of one maze.
pub(super) fn walls(dimension: u8, draws: &mut Draws) -> Walls {
    let mut draft = Draft::new(Walls::open(dimension), draws);
    let mut posts = Posts::new(&draft);
    let mut candidates = [Heading::Up, Heading::Right].map(|side| {
        let mut stretches = stretches(dimension, side);
        draws.shuffle(&mut stretches);
        stretches
    });
    let mut turn = draws.index(candidates.len());
    while candidates.iter().any(|stretches| !stretches.is_empty()) {
        while let Some(stretch) = candidates[turn].pop() {
            if build(&mut draft, &mut posts, stretch, draws) {
                break;
            }
        }
        turn = 1 - turn;
    }
    draft.into_walls()
}

/// All rows of four edges on that side of their cells: up for horizontal walls, right for
/// vertical ones.
fn stretches(dimension: u8, side: Heading) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    for line in 0..dimension - 1 {
        for first in 0..=dimension - STRETCH {
            stretches.push([0, 1, 2, 3].map(|place| {
                let along = first + place;
                let cell = match side {
                    Heading::Up | Heading::Down => Cell::new(along, line),
                    Heading::Right | Heading::Left => Cell::new(line, along),
                };
                Edge::new(cell, side)
            }));
        }
    }
    stretches
}

/// Turns a stretch into three walls and an opening; false if one of its edges is decided or if
/// every choice of the opening would close a ring.
fn build(draft: &mut Draft, posts: &mut Posts, stretch: Stretch, draws: &mut Draws) -> bool {
    if !stretch.iter().all(|&edge| draft.is_free(edge)) {
        return false;
    }
    let mut openings = stretch;
    draws.shuffle(&mut openings);
    for opening in openings {
        let mut after = posts.clone();
        let mut built = stretch.iter().filter(|&&edge| edge != opening);
        if built.all(|&edge| after.connect(edge)) {
            *posts = after;
            for edge in stretch {
                draft.set(edge, edge == opening);
            }
            return true;
        }
    }
    false
}

/// Which posts are connected by walls. The perimeter counts as one post.
#[derive(Clone)]
struct Posts {
    sets: Sets,
    dimension: u8,
}

impl Posts {
    fn new(draft: &Draft) -> Self {
        let dimension = draft.walls().dimension();
        let mut posts = Self {
            sets: Sets::new((usize::from(dimension) + 1).pow(2)),
            dimension,
        };
        for edge in draft.edges() {
            if !draft.is_open(edge) {
                posts.connect(edge);
            }
        }
        posts
    }

    /// Builds a wall; false if its ends were connected, so that it closes a ring.
    fn connect(&mut self, edge: Edge) -> bool {
        let [a, b] = edge.posts().map(|post| self.index(post));
        self.sets.join(a, b)
    }

    fn index(&self, post: Cell) -> usize {
        let perimeter = [0, self.dimension];
        if perimeter.contains(&post.x) || perimeter.contains(&post.y) {
            return 0;
        }
        usize::from(post.x) * (usize::from(self.dimension) + 1) + usize::from(post.y)
    }
}
