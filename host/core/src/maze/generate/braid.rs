//! `braid`: long straights and diagonal staircases, most dead ends joined.
//!
//! Mazes that people draw for contests differ from those of textbook algorithms: they have
//! straights for fast robots, diagonals of alternating turns, several paths to the goal, few
//! dead ends, and at least one wall at every post. The three official mazes of the reports
//! have 82 % of the walls that a maze without loops would have, and 9 to 11 dead ends. This
//! generator aims at such mazes.
//!
//! First, a tree grows from the start by *branches*, straights or staircases, each from the
//! end of the last one or from a random earlier cell. Then dead ends are joined to a
//! neighbour, if possible to another dead end or straight ahead. Finally, the entrance of the
//! goal room moves to its far side. The tree reaches every cell outside the goal room, and
//! joining only removes walls, so all cells are connected wherever the entrance is.

use std::ops::Range;

use super::super::{Area, Cell, Heading, Maze, Metric, Turn, Walls, distances_from};
use super::draft::{Draft, Edge};
use super::draws::Draws;

/// The length of a straight, in cells. Two in a row may form a longer one.
const STRAIGHT: Range<u32> = 2..6;

/// The length of a staircase, in cells.
const STAIRCASE: Range<u32> = 4..10;

/// How many branches are staircases, in percent. The others are straights.
const STAIRCASES: u32 = 60;

/// How many branches start from an earlier cell although the last branch could continue, in
/// percent.
const FORKS: u32 = 35;

/// How many dead ends are joined, in percent.
const JOINED: u32 = 75;

/// The walls of one maze.
pub(super) fn walls(dimension: u8, draws: &mut Draws) -> Walls {
    let mut draft = Draft::new(Walls::closed(dimension), draws);
    grow(&mut draft, draws);
    join_dead_ends(&mut draft, draws);
    hide_entrance(&mut draft);
    draft.into_walls()
}

/// The shape of a branch.
#[derive(Clone, Copy)]
enum Shape {
    Straight,
    /// Turns at every cell, next in this direction.
    Staircase(Turn),
}

impl Shape {
    fn draw(draws: &mut Draws) -> Self {
        if !draws.percent(STAIRCASES) {
            Self::Straight
        } else if draws.percent(50) {
            Self::Staircase(Turn::Left)
        } else {
            Self::Staircase(Turn::Right)
        }
    }

    fn length(self, draws: &mut Draws) -> u32 {
        let range = match self {
            Self::Straight => STRAIGHT,
            Self::Staircase(_) => STAIRCASE,
        };
        range.start + draws.below(range.end - range.start)
    }

    /// The next heading of the branch and the shape after it.
    const fn next(self, heading: Heading) -> (Heading, Self) {
        match self {
            Self::Straight => (heading, Self::Straight),
            Self::Staircase(Turn::Left) => {
                (heading.turned(Turn::Left), Self::Staircase(Turn::Right))
            }
            Self::Staircase(_) => (heading.turned(Turn::Right), Self::Staircase(Turn::Left)),
        }
    }
}

/// Connects all cells.
fn grow(draft: &mut Draft, draws: &mut Draws) {
    let mut tree = Tree::new(draft.walls());
    let mut tip = Cell::new(0, 1);
    tree.add(tip);
    loop {
        let stuck = tree.exits(draft, tip).is_empty();
        if stuck || draws.percent(FORKS) {
            let Some(fork) = tree.fork(draft, draws) else {
                return;
            };
            tip = fork;
        }
        tip = branch(draft, &mut tree, tip, draws);
    }
}

/// Adds one branch from `tip` and returns its end.
fn branch(draft: &mut Draft, tree: &mut Tree, tip: Cell, draws: &mut Draws) -> Cell {
    let Some((mut heading, _)) = draws.pick(&tree.exits(draft, tip)) else {
        return tip;
    };
    let mut tip = tip;
    let mut shape = Shape::draw(draws);
    for _ in 0..shape.length(draws) {
        let exits = tree.exits(draft, tip);
        let Some(&(_, edge)) = exits.iter().find(|&&(exit, _)| exit == heading) else {
            break;
        };
        draft.set(edge, true);
        tip = tip.step(heading).expect("an exit leads to a cell");
        tree.add(tip);
        (heading, shape) = shape.next(heading);
    }
    tip
}

/// The cells that the growing tree has reached.
struct Tree {
    reached: Vec<bool>,
    dimension: u8,
    /// Reached cells that may still have exits.
    active: Vec<Cell>,
}

impl Tree {
    /// The empty tree. Start and goal count as reached, because their edges are final.
    fn new(walls: &Walls) -> Self {
        let dimension = walls.dimension();
        let mut tree = Self {
            reached: vec![false; usize::from(dimension).pow(2)],
            dimension,
            active: Vec::new(),
        };
        let goal = Area::center(dimension);
        for cell in goal.cells().chain([Cell::new(0, 0)]) {
            tree.reached[walls.index(cell)] = true;
        }
        tree
    }

    fn add(&mut self, cell: Cell) {
        let index = usize::from(cell.x) * usize::from(self.dimension) + usize::from(cell.y);
        self.reached[index] = true;
        self.active.push(cell);
    }

    /// The free edges from `cell` to cells that are not reached yet.
    fn exits(&self, draft: &Draft, cell: Cell) -> Vec<(Heading, Edge)> {
        let mut exits = draft.free_edges_of(cell);
        exits.retain(|&(heading, _)| {
            let next = cell.step(heading).expect("a free edge has two cells");
            !self.reached[draft.walls().index(next)]
        });
        exits
    }

    /// A random reached cell with an exit; `None` if all cells are reached.
    fn fork(&mut self, draft: &Draft, draws: &mut Draws) -> Option<Cell> {
        while !self.active.is_empty() {
            let place = draws.index(self.active.len());
            let cell = self.active[place];
            if !self.exits(draft, cell).is_empty() {
                return Some(cell);
            }
            // It never has an exit again, because reached cells stay reached.
            self.active.swap_remove(place);
        }
        None
    }
}

/// Opens one wall of most dead ends.
fn join_dead_ends(draft: &mut Draft, draws: &mut Draws) {
    let mut cells: Vec<Cell> = draft.walls().cells().collect();
    draws.shuffle(&mut cells);
    for cell in cells {
        let Some(open) = only_exit(draft.walls(), cell) else {
            continue;
        };
        let mut edges = draft.free_edges_of(cell);
        edges.retain(|&(_, edge)| !draft.is_open(edge) && posts_keep_a_wall(draft, edge));
        if edges.is_empty() || !draws.percent(JOINED) {
            continue;
        }
        let best = edges.iter().map(|&it| merit(draft, cell, open, it)).max();
        edges.retain(|&it| Some(merit(draft, cell, open, it)) == best);
        let (_, edge) = draws.pick(&edges).expect("one of the edges is the best");
        draft.set(edge, true);
    }
}

/// Moves the entrance to where the path to it is longest, so that robots have to explore
/// more of the maze. Of equally long paths, the first entrance is taken.
fn hide_entrance(draft: &mut Draft) {
    let maze = Maze::contest(draft.walls().clone()).expect("start and goal fit");
    let distances = distances_from(&maze, maze.start(), Metric::Cells);
    let goal = maze.goal();
    let distance = |edge: &Edge| {
        let outside = edge.cells().into_iter().find(|&cell| !goal.contains(cell));
        outside.and_then(|cell| distances.get(cell))
    };
    let mut farthest = draft.entrances()[0];
    for edge in draft.entrances() {
        if distance(&edge) > distance(&farthest) {
            farthest = edge;
        }
    }
    draft.move_entrance(farthest);
}

/// The open side of a dead end.
fn only_exit(walls: &Walls, cell: Cell) -> Option<Heading> {
    let exits = Heading::ALL.map(|heading| walls.is_open(cell, heading));
    let only = exits.iter().filter(|&&open| open).count() == 1;
    let open = exits.iter().position(|&open| open)?;
    only.then(|| Heading::ALL[open])
}

/// Joining two dead ends is best, then going straight on.
fn merit(draft: &Draft, cell: Cell, exit: Heading, (heading, _): (Heading, Edge)) -> u8 {
    let next = cell.step(heading).expect("a free edge has two cells");
    match only_exit(draft.walls(), next) {
        Some(_) => 2,
        None if heading == exit.opposite() => 1,
        None => 0,
    }
}

/// Whether both posts of the wall at `edge` have another wall.
fn posts_keep_a_wall(draft: &Draft, edge: Edge) -> bool {
    edge.posts()
        .into_iter()
        .all(|post| walls_at(draft.walls(), post) > 1)
}

/// The number of walls at a post. A post of the perimeter counts as having 4.
fn walls_at(walls: &Walls, post: Cell) -> usize {
    let n = walls.dimension();
    if post.x == 0 || post.y == 0 || post.x == n || post.y == n {
        return 4;
    }
    let (upper_right, lower_left) = (post, Cell::new(post.x - 1, post.y - 1));
    let sides = [
        (upper_right, Heading::Left),
        (upper_right, Heading::Down),
        (lower_left, Heading::Right),
        (lower_left, Heading::Up),
    ];
    sides
        .into_iter()
        .filter(|&(cell, heading)| !walls.is_open(cell, heading))
        .count()
}
