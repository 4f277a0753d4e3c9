//! Imagining mazes that are trees with loops: [`Trees`].
//!
//! A maze of this kind joins all its cells by a tree, any one as likely as any other,
//! and a share of the walls that the tree has left is open besides. Of such mazes
//! those that agree with what was seen can be drawn at once and without error: an edge
//! seen open is in the tree or a loop, so it counts for as many times an unknown edge
//! as loops are rare, and a tree is drawn in proportion to the product of what its
//! edges count for by random walks without their loops (Wilson, *Generating Random
//! Spanning Trees More Quickly than the Cover Time*, 1996).

use wasmouse_sdk::{Cell, Grid, Heading, Random};

use crate::knowledge::Known;
use crate::room::Room;

/// The share of the walls left by the tree that is open, in percent.
const LOOPS: u16 = 12;

/// Mazes as trees with loops.
pub struct Trees {
    grid: Grid,
    start: usize,
    /// By cell, what the edges in the four directions count for, added up.
    sums: Vec<[u16; 4]>,
    /// The cells that can be reached, as far as known.
    cells: Vec<u16>,
    reached: Vec<bool>,
    in_tree: Vec<bool>,
    /// By cell, where the walk left it for the last time.
    exits: Vec<Heading>,
}

impl Trees {
    /// Buffers for a match.
    pub fn new(grid: Grid, start: Cell) -> Self {
        let count = grid.cell_count();
        Self {
            grid,
            start: grid.cell(start),
            sums: vec![[0; 4]; count],
            cells: Vec::new(),
            reached: vec![false; count],
            in_tree: vec![false; count],
            exits: vec![Heading::Up; count],
        }
    }

    /// Takes in what is known. The goal room is no part of the tree while believed in:
    /// it hangs on by its entrance.
    pub fn prepare(&mut self, known: &[Known], room: &Room) {
        self.cells.clear();
        self.reached.fill(false);
        self.reached[self.start] = true;
        let mut waiting = vec![self.start];
        while let Some(cell) = waiting.pop() {
            self.cells.push(cell as u16);
            let mut sum = 0;
            for (side, place) in Heading::ALL.into_iter().zip(0..) {
                let wall = self.grid.wall(cell, side);
                let weight = match known[wall] {
                    _ if room.holds(wall) => 0,
                    Known::Open => 100,
                    Known::Closed => 0,
                    Known::Unknown => LOOPS,
                };
                sum += weight;
                self.sums[cell][place] = sum;
                let beyond = self.grid.beyond(cell, side);
                if weight > 0 && !self.reached[beyond] {
                    self.reached[beyond] = true;
                    waiting.push(beyond);
                }
            }
        }
        self.cells.sort_unstable();
    }

    /// Draws a maze: sets all unknown walls of `maze`, 1 where it is open.
    pub fn draw(
        &mut self,
        known: &[Known],
        unknown: &[u16],
        room: &Room,
        random: &mut Random,
        maze: &mut [u8],
    ) {
        let mut bits = 0;
        for (turn, &wall) in unknown.iter().enumerate() {
            // 16 random bits a wall.
            if turn % 4 == 0 {
                bits = random.next_u64();
            }
            let share = u64::from(LOOPS) * 65536 / 100;
            maze[usize::from(wall)] = u8::from(bits & 0xFFFF < share);
            bits >>= 16;
        }
        room.draw(known, random, maze);
        self.in_tree.fill(false);
        self.in_tree[self.start] = true;
        for index in 0..self.cells.len() {
            let cell = usize::from(self.cells[index]);
            self.walk(cell, random);
            self.keep(cell, maze);
        }
    }

    /// Walks at random until it meets the tree.
    fn walk(&mut self, from: usize, random: &mut Random) {
        let (mut cell, mut bits, mut left) = (from, 0, 0);
        while !self.in_tree[cell] {
            if left == 0 {
                (bits, left) = (random.next_u64(), 4);
            }
            let [up, right, down, all] = self.sums[cell];
            let drawn = (((bits & 0xFFFF) * u64::from(all)) >> 16) as u16;
            (bits, left) = (bits >> 16, left - 1);
            let passed = [up, right, down].iter().filter(|&&it| drawn >= it).count();
            self.exits[cell] = Heading::ALL[passed];
            cell = self.grid.beyond(cell, Heading::ALL[passed]);
        }
    }

    /// Adds the walk without its loops to the tree.
    fn keep(&mut self, from: usize, maze: &mut [u8]) {
        let mut cell = from;
        while !self.in_tree[cell] {
            self.in_tree[cell] = true;
            maze[self.grid.wall(cell, self.exits[cell])] = 1;
            cell = self.grid.beyond(cell, self.exits[cell]);
        }
    }
}
