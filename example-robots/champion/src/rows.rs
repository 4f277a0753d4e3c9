//! Imagining mazes made of rows of walls: [`Rows`].
//!
//! In mazes of this kind four edges in a row are three walls and an opening, rows are
//! added in random order where no edge is in one yet, as long as any fits, and no
//! walls close a ring (Minnett's generator, as its report describes it). Of such mazes
//! some that agree with what was seen are drawn in two stages: first rows that hold
//! the walls seen, those that explain more of them rather; then the others, in random
//! order. The second stage is how such mazes are made; the first makes the draw only
//! nearly as likely as it ought to be.

use wasmouse_sdk::{Cell, Grid, Heading, Random};

use crate::knowledge::Known;
use crate::room::Room;

/// Edges in a row.
const ROW: u32 = 4;

/// How often a row is built whose opening is at an edge that was seen open, of 256:
/// that its opening is just there is unlikely.
const ON_OPEN: u64 = 102;

/// What a row counts for by the number of seen walls that it holds, and twice as much
/// or nearly where its opening is seen too.
const BY_WALLS: [u32; 4] = [0, 10, 22, 48];
const BY_OPENING: [u32; 2] = [10, 18];

/// Mazes as rows of walls.
pub struct Rows {
    grid: Grid,
    start: Cell,
    rows: Vec<Row>,
    /// The first of the vertical ones.
    middle: usize,
    /// By wall, the rows that it can be in.
    rows_of: Vec<Vec<u16>>,
    /// By wall, the posts at its ends.
    ends_of: Vec<[u16; 2]>,
    /// By wall, whether it is in no row yet.
    free: Vec<bool>,
    /// Which posts are connected: a union-find forest.
    parents: Vec<u16>,
    order: Vec<u16>,
}

/// Four edges and their five posts.
#[derive(Clone, Copy)]
struct Row {
    walls: [u16; ROW as usize],
    posts: [u16; ROW as usize + 1],
}

/// What is known of a row.
struct Agreement {
    /// Bit by bit, where the opening can be.
    openings: u8,
    closed: usize,
    open: usize,
}

/// What is known of a maze.
pub struct Seen<'a> {
    /// By wall.
    pub known: &'a [Known],
    /// The walls seen closed.
    pub closed: &'a [u16],
    /// The goal room.
    pub room: &'a Room,
}

impl Rows {
    /// Buffers for a match.
    pub fn new(grid: Grid, start: Cell) -> Self {
        let dimension = grid.dimension();
        let mut rows = Vec::new();
        let mut ends_of = vec![[0; 2]; grid.wall_count()];
        let mut middle = 0;
        for side in [Heading::Up, Heading::Right] {
            middle = rows.len();
            for line in 0..dimension - 1 {
                let wall = |along| wall(grid, side, line, along);
                let post = |along| post(dimension, side, line, along);
                for along in 0..dimension {
                    ends_of[usize::from(wall(along))] = [post(along), post(along + 1)];
                }
                for first in 0..(dimension + 1).saturating_sub(ROW) {
                    rows.push(Row {
                        walls: std::array::from_fn(|place| wall(first + place as u32)),
                        posts: std::array::from_fn(|place| post(first + place as u32)),
                    });
                }
            }
        }
        let mut rows_of = vec![Vec::new(); grid.wall_count()];
        for (index, row) in (0..).zip(&rows) {
            for wall in row.walls {
                rows_of[usize::from(wall)].push(index);
            }
        }
        Self {
            grid,
            start,
            middle,
            order: (0..rows.len() as u16).collect(),
            rows,
            rows_of,
            ends_of,
            free: vec![false; grid.wall_count()],
            parents: vec![0; (dimension as usize + 1).pow(2)],
        }
    }

    /// Draws a maze: sets all `unknown` walls of `maze`, 1 where it is open.
    pub fn draw(&mut self, seen: &Seen, unknown: &[u16], random: &mut Random, maze: &mut [u8]) {
        for &wall in unknown {
            maze[usize::from(wall)] = 1;
        }
        seen.room.draw(seen.known, random, maze);
        self.clear(seen.room, maze);
        self.explain(seen, random, maze);
        self.fill_up(seen.known, random, maze);
    }

    /// Nothing built but the start and the goal room.
    fn clear(&mut self, room: &Room, maze: &[u8]) {
        for (post, parent) in (0..).zip(&mut self.parents) {
            *parent = post;
        }
        self.free.fill(false);
        for wall in self.grid.inner_walls() {
            self.free[wall] = true;
        }
        let start = self.grid.cell(self.start);
        let by_start = [Heading::Up, Heading::Right].map(|side| self.grid.wall(start, side));
        let by_goal = room.entrances().iter().chain(room.inside());
        let by_goal = by_goal.map(|&it| usize::from(it));
        let by_goal = by_goal.filter(|_| room.is_believed());
        for wall in by_start.into_iter().chain(by_goal) {
            self.free[wall] = false;
            if maze[wall] == 0 {
                self.connect(wall);
            }
        }
    }

    /// Builds rows that hold the walls seen, in random order.
    fn explain(&mut self, seen: &Seen, random: &mut Random, maze: &mut [u8]) {
        let closed = seen.closed.iter().copied();
        let mut walls: Vec<u16> = closed.filter(|&it| self.free[usize::from(it)]).collect();
        shuffle(&mut walls, random);
        for wall in walls {
            if !self.free[usize::from(wall)] {
                continue;
            }
            match self.explanation(wall, seen.known, random) {
                Some((row, opening)) => self.build(row, opening, maze),
                // It cannot be of this kind; but it stands.
                None => {
                    self.free[usize::from(wall)] = false;
                    self.connect(usize::from(wall));
                }
            }
        }
    }

    /// A row with an opening that holds a wall, those that explain more rather.
    fn explanation(
        &mut self,
        wall: u16,
        known: &[Known],
        random: &mut Random,
    ) -> Option<(usize, usize)> {
        let mut choices = [(0, 0, 0); (ROW * ROW) as usize];
        let (mut count, mut total) = (0, 0);
        for index in 0..self.rows_of[usize::from(wall)].len() {
            let row = usize::from(self.rows_of[usize::from(wall)][index]);
            let Some(agreement) = self.agreement(row, known) else {
                continue;
            };
            let openings = agreement.openings & self.ringless(row);
            for opening in (0..ROW as usize).filter(|it| openings >> it & 1 == 1) {
                total += BY_WALLS[agreement.closed] * BY_OPENING[agreement.open];
                choices[count] = (row, opening, total);
                count += 1;
            }
        }
        let drawn = (total > 0).then(|| random.below(total))?;
        let chosen = choices[..count].iter().find(|it| drawn < it.2);
        chosen.map(|&(row, opening, _)| (row, opening))
    }

    /// Adds rows as long as any fits, horizontal and vertical ones in turns.
    fn fill_up(&mut self, known: &[Known], random: &mut Random, maze: &mut [u8]) {
        let mut order = std::mem::take(&mut self.order);
        let (horizontal, vertical) = order.split_at_mut(self.middle);
        shuffle(horizontal, random);
        shuffle(vertical, random);
        let mut queues = [horizontal.iter(), vertical.iter()];
        let mut turn = (random.next_u64() & 1) as usize;
        while queues.iter().any(|it| it.len() > 0) {
            for &row in &mut queues[turn] {
                if self.fits(usize::from(row), known, random, maze) {
                    break;
                }
            }
            turn = 1 - turn;
        }
        self.order = order;
    }

    /// Builds a row if possible.
    fn fits(&mut self, row: usize, known: &[Known], random: &mut Random, maze: &mut [u8]) -> bool {
        let Some(agreement) = self.agreement(row, known) else {
            return false;
        };
        if agreement.open > 0 && random.next_u64() & 0xFF >= ON_OPEN {
            return false;
        }
        let openings = agreement.openings & self.ringless(row);
        if openings == 0 {
            return false;
        }
        let drawn = random.below(openings.count_ones()) as usize;
        let mut places = (0..ROW as usize).filter(|it| openings >> it & 1 == 1);
        let opening = places.nth(drawn).expect("fewer are drawn than there are");
        self.build(row, opening, maze);
        true
    }

    /// Where the opening of a row can be for what is known; `None` when the row cannot
    /// be built, whatever closes a ring.
    fn agreement(&self, row: usize, known: &[Known]) -> Option<Agreement> {
        let mut it = Agreement {
            openings: (1 << ROW) - 1,
            closed: 0,
            open: 0,
        };
        for (place, wall) in self.rows[row].walls.into_iter().enumerate() {
            if !self.free[usize::from(wall)] {
                return None;
            }
            match known[usize::from(wall)] {
                Known::Unknown => {}
                Known::Closed => {
                    it.openings &= !(1 << place);
                    it.closed += 1;
                }
                Known::Open => {
                    it.openings &= 1 << place;
                    it.open += 1;
                }
            }
        }
        (it.openings != 0).then_some(it)
    }

    /// Where the opening of a row can be, bit by bit, so that no walls close a ring:
    /// the walls before the opening are a chain of posts, and so are those after it;
    /// neither may hold a connected set of posts twice, both together at most one.
    fn ringless(&mut self, row: usize) -> u8 {
        let posts = self.rows[row].posts;
        let roots = posts.map(|it| self.root(it));
        let are_apart = |chain: &[u16]| {
            let mut rest = chain.iter().enumerate();
            rest.all(|(place, it)| !chain[..place].contains(it))
        };
        let mut openings = 0;
        for opening in 0..ROW as usize {
            let (before, after) = roots.split_at(opening + 1);
            let shared = before.iter().filter(|it| after.contains(it)).count();
            if shared <= 1 && are_apart(before) && are_apart(after) {
                openings |= 1 << opening;
            }
        }
        openings
    }

    fn build(&mut self, row: usize, opening: usize, maze: &mut [u8]) {
        for (place, wall) in self.rows[row].walls.into_iter().enumerate() {
            self.free[usize::from(wall)] = false;
            if place != opening {
                maze[usize::from(wall)] = 0;
                self.connect(usize::from(wall));
            }
        }
    }

    fn connect(&mut self, wall: usize) {
        let [first, second] = self.ends_of[wall].map(|it| self.root(it));
        self.parents[usize::from(first)] = second;
    }

    fn root(&mut self, post: u16) -> u16 {
        let mut at = post;
        loop {
            let parent = self.parents[usize::from(at)];
            if parent == at {
                return at;
            }
            let grandparent = self.parents[usize::from(parent)];
            self.parents[usize::from(at)] = grandparent;
            at = grandparent;
        }
    }
}

/// The number of the wall at that side of a cell: up or right, in that line of cells.
fn wall(grid: Grid, side: Heading, line: u32, along: u32) -> u16 {
    let cell = match side {
        Heading::Up | Heading::Down => Cell::new(along, line),
        Heading::Right | Heading::Left => Cell::new(line, along),
    };
    grid.wall(grid.cell(cell), side) as u16
}

/// The number of the post where that wall begins; those of the perimeter are one.
fn post(dimension: u32, side: Heading, line: u32, along: u32) -> u16 {
    let (x, y) = match side {
        Heading::Up | Heading::Down => (along, line + 1),
        Heading::Right | Heading::Left => (line + 1, along),
    };
    let on_perimeter = |it| it == 0 || it == dimension;
    if on_perimeter(x) || on_perimeter(y) {
        return 0;
    }
    (y * (dimension + 1) + x) as u16
}

/// Puts items in a random order (Fisher and Yates).
fn shuffle(items: &mut [u16], random: &mut Random) {
    for last in (1..items.len()).rev() {
        let other = random.below(last as u32 + 1) as usize;
        items.swap(last, other);
    }
}
