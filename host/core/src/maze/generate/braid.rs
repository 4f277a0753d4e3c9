//! `braid`: long straights and diagonal staircases, most dead ends joined.
//!
//! Mazes drawn by people for contests look different from those of textbook
//! algorithms: they tempt fast robots with straights, have diagonals made of
//! alternating turns, offer several ways to the goal, have few dead ends, and
//! at every post stands at least one wall. The three official mazes of the
//! reports have walls on 82 % of the places that a maze without loops would
//! use, and 9 to 11 dead ends. This generator aims at that.
//!
//! First a tree grows from the start by *runs*, straights or staircases, each
//! going on from the last or branching off from a random earlier cell. Then dead
//! ends are joined to a neighbour, straight ahead or to another dead end where
//! possible. At last the entrance of the goal room moves to its far side. The
//! tree reaches every cell outside the goal room and joining only removes walls,
//! so all cells are connected wherever the entrance is.

use std::ops::Range;

use super::super::{Area, Cell, Heading, Maze, Metric, Turn, Walls, distances_from};
use super::draft::{Draft, Edge};
use super::draws::Draws;

/// How long a straight is, in cells. Two in a row may make a longer one.
const STRAIGHT: Range<u32> = 2..6;

/// How long a staircase is, in cells.
const STAIRCASE: Range<u32> = 4..10;

/// How often a run is a staircase and not a straight, in percent.
const STAIRCASES: u32 = 60;

/// How often a new run branches off from an earlier cell although the last run
/// could go on, in percent.
const BRANCHES: u32 = 35;

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

/// A shape that a run keeps to.
#[derive(Clone, Copy)]
enum Shape {
    Straight,
    /// Turns at every cell, next time in this direction.
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

    /// The next heading of the run and the shape after it.
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
        let stuck = tree.ways_on(draft, tip).is_empty();
        if stuck || draws.percent(BRANCHES) {
            let Some(branch) = tree.branch(draft, draws) else {
                return;
            };
            tip = branch;
        }
        tip = run(draft, &mut tree, tip, draws);
    }
}

/// Carves one run from `tip` and returns where it ends.
fn run(draft: &mut Draft, tree: &mut Tree, tip: Cell, draws: &mut Draws) -> Cell {
    let Some((mut heading, _)) = draws.pick(&tree.ways_on(draft, tip)) else {
        return tip;
    };
    let mut tip = tip;
    let mut shape = Shape::draw(draws);
    for _ in 0..shape.length(draws) {
        let ways = tree.ways_on(draft, tip);
        let Some(&(_, edge)) = ways.iter().find(|&&(way, _)| way == heading) else {
            break;
        };
        draft.set(edge, true);
        tip = tip.step(heading).expect("a way on stays in the maze");
        tree.add(tip);
        (heading, shape) = shape.next(heading);
    }
    tip
}

/// The cells that the growing tree has reached.
struct Tree {
    reached: Vec<bool>,
    dimension: u8,
    /// Reached cells that may still have ways on.
    active: Vec<Cell>,
}

impl Tree {
    /// Before any growth. Start and goal count as reached: their edges are final.
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

    /// The free edges that lead from `cell` to cells not reached yet.
    fn ways_on(&self, draft: &Draft, cell: Cell) -> Vec<(Heading, Edge)> {
        let mut ways = draft.free_edges_of(cell);
        ways.retain(|&(heading, _)| {
            let next = cell.step(heading).expect("a free edge has two cells");
            !self.reached[draft.walls().index(next)]
        });
        ways
    }

    /// A random reached cell with a way on; `None` when all cells are reached.
    fn branch(&mut self, draft: &Draft, draws: &mut Draws) -> Option<Cell> {
        while !self.active.is_empty() {
            let place = draws.index(self.active.len());
            let cell = self.active[place];
            if !self.ways_on(draft, cell).is_empty() {
                return Some(cell);
            }
            // Never again has a way on, because reached cells stay reached.
            self.active.swap_remove(place);
        }
        None
    }
}

/// Opens a wall of most dead ends.
fn join_dead_ends(draft: &mut Draft, draws: &mut Draws) {
    let mut cells: Vec<Cell> = draft.walls().cells().collect();
    draws.shuffle(&mut cells);
    for cell in cells {
        let Some(open) = only_exit(draft.walls(), cell) else {
            continue;
        };
        let mut ways = draft.free_edges_of(cell);
        ways.retain(|&(_, edge)| !draft.is_open(edge) && posts_keep_a_wall(draft, edge));
        if ways.is_empty() || !draws.percent(JOINED) {
            continue;
        }
        let best = ways.iter().map(|&way| merit(draft, cell, open, way)).max();
        ways.retain(|&way| Some(merit(draft, cell, open, way)) == best);
        let way = draws.pick(&ways);
        let (_, edge) = way.expect("the best of some ways is one of them");
        draft.set(edge, true);
    }
}

/// Moves the entrance to where the way to it is longest, so that robots get to
/// see some of the maze. Of equally long ways the first entrance is taken.
fn hide_entrance(draft: &mut Draft) {
    let maze = Maze::contest(draft.walls().clone()).expect("room for start and goal");
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

/// Two dead ends in one go are best, then a straight.
fn merit(draft: &Draft, cell: Cell, exit: Heading, (heading, _): (Heading, Edge)) -> u8 {
    let next = cell.step(heading).expect("a free edge has two cells");
    match only_exit(draft.walls(), next) {
        Some(_) => 2,
        None if heading == exit.opposite() => 1,
        None => 0,
    }
}

/// Whether both posts of a wall have another wall.
fn posts_keep_a_wall(draft: &Draft, edge: Edge) -> bool {
    edge.posts()
        .into_iter()
        .all(|post| walls_at(draft.walls(), post) > 1)
}

/// How many walls stand at a post; a post of the perimeter has plenty.
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
