//! What the robot believes about unknown walls: [`Belief`].
//!
//! A wall is predicted from its eight neighbours ([`Grid::neighborhood`]): for each of the 256
//! patterns of open and closed neighbours, training has counted how often the wall between
//! them is open, in several kinds of generated mazes. Most neighbours are unknown as well, so
//! the robot keeps some complete mazes that agree with everything it has seen, and repeatedly
//! resamples every unknown wall of each, given its neighbours there (Gibbs sampling of a
//! Markov random field; Geman and Geman, *Stochastic Relaxation, Gibbs Distributions, and the
//! Bayesian Restoration of Images*, 1984). The average is the probability that a wall is open.
//!
//! The robot also learns which kind of maze it is in, and how dense it is: every wall that it
//! sees is evidence for the kinds that predicted it (Bayes' rule, with neighbours taken as
//! independent).
//!
//! The goal room of a contest maze is open inside and has one entrance. The belief assumes
//! that until the maze contradicts it.

use wasmouse_sdk::{Briefing, Cell, Grid, Heading, Random};

use crate::knowledge::Known;
use crate::numbers::{exp, ln};
use crate::parameters::{KINDS, PATTERNS};
use crate::room::Room;

/// How much sparser or denser than its kind a maze may be: shifts of the logarithm
/// of the odds that a wall is open, with how likely each is beforehand.
const SHIFTS: [(f32, f32); 3] = [(-0.7, 1.0), (0.0, 5.0), (0.7, 1.0)];

/// A kind of maze together with a shift.
const EXPERTS: usize = KINDS * SHIFTS.len();

/// How often each sampled maze is redrawn before the first step.
const SETTLING_SWEEPS: u32 = 12;

/// How much of a chance comes from the newest samples; the rest is what was believed
/// before. Fewer samples at a time then do the work of more.
const RENEWAL: f32 = 0.5;

/// Chances and sampled mazes.
pub struct Belief {
    grid: Grid,
    known: Vec<Known>,
    unknown: Vec<u16>,
    /// The chance that a wall is open, for unknown ones.
    chances: Vec<f32>,
    samples: Vec<Sample>,
    experts: Vec<Expert>,
    /// By kind of maze, how likely it is.
    kinds: [f32; KINDS],
    /// The experts' common opinion: for each pattern, the chance of an open wall.
    opinion: [f32; 256],
    neighborhoods: Vec<[u16; 8]>,
    /// The bit of a wall in the pattern of each of its neighbours.
    bits: Vec<[u8; 8]>,
    room: Room,
    random: Random,
}

/// A complete maze.
struct Sample {
    /// 1 where a wall is open.
    open: Vec<u8>,
    /// For each wall the pattern of its neighbours, one bit each.
    patterns: Vec<u8>,
}

struct Expert {
    opinion: [f32; 256],
    /// The logarithm of how likely it is, up to a common constant.
    evidence: f32,
}

impl Belief {
    /// Before anything is seen, with this many sampled mazes.
    pub fn new(briefing: &Briefing, samples: usize) -> Self {
        let grid = Grid::new(briefing.dimension);
        let mut known = vec![Known::Open; grid.wall_count()];
        let last = briefing.dimension - 1;
        for line in 0..=last {
            let ends = [
                (Cell::new(0, line), Heading::Left),
                (Cell::new(last, line), Heading::Right),
                (Cell::new(line, 0), Heading::Down),
                (Cell::new(line, last), Heading::Up),
            ];
            for (cell, side) in ends {
                known[grid.wall(grid.cell(cell), side)] = Known::Closed;
            }
        }
        let mut neighborhoods = vec![[0; 8]; grid.wall_count()];
        let mut bits = vec![[0; 8]; grid.wall_count()];
        for wall in grid.inner_walls() {
            known[wall] = Known::Unknown;
            let around = grid.neighborhood(wall);
            neighborhoods[wall] = around.map(|it| it as u16);
            bits[wall] = around.map(|other| {
                let back = grid.neighborhood(other).iter().position(|&it| it == wall);
                1 << back.expect("neighbourhood is mutual")
            });
        }
        let mut belief = Self {
            grid,
            unknown: grid.inner_walls().map(|it| it as u16).collect(),
            chances: vec![0.5; grid.wall_count()],
            samples: Vec::new(),
            experts: experts(),
            kinds: [1.0 / KINDS as f32; KINDS],
            opinion: [0.5; 256],
            neighborhoods,
            bits,
            room: Room::new(briefing),
            random: Random::new(briefing.seed),
            known,
        };
        belief.samples = (0..samples).map(|_| belief.first_sample()).collect();
        belief.agree();
        belief.redraw(SETTLING_SWEEPS, 1.0);
        belief
    }

    /// What is known about a wall.
    #[inline]
    pub fn known(&self, wall: usize) -> Known {
        self.known[wall]
    }

    /// The chance that an unknown wall is open.
    #[inline]
    pub fn chance(&self, wall: usize) -> f32 {
        self.chances[wall]
    }

    /// What is known about every wall.
    pub fn all_known(&self) -> &[Known] {
        &self.known
    }

    /// The sampled mazes: by wall, 1 where it is open.
    pub fn mazes(&self) -> impl Iterator<Item = &[u8]> {
        self.samples.iter().map(|it| &it.open[..])
    }

    /// How likely it is that the maze is of each kind, in the order of the tables.
    pub const fn kinds(&self) -> [f32; KINDS] {
        self.kinds
    }

    /// Takes in walls that were seen for the first time, and thinks about the others.
    pub fn learn(&mut self, news: &[(usize, bool)], sweeps: u32) {
        if news.is_empty() {
            return;
        }
        for &(wall, open) in news {
            self.learn_one(wall, open);
        }
        let known = &self.known;
        self.unknown
            .retain(|&wall| known[usize::from(wall)] == Known::Unknown);
        self.agree();
        self.redraw(sweeps, RENEWAL);
    }

    fn learn_one(&mut self, wall: usize, open: bool) {
        self.known[wall] = if open { Known::Open } else { Known::Closed };
        if !self.room.holds(wall) {
            self.weigh(wall, open);
        }
        for index in 0..self.samples.len() {
            self.set(index, wall, open);
        }
        self.room.check(&self.known, wall);
    }

    /// Every expert gets credit for how much it expected what was seen.
    fn weigh(&mut self, wall: usize, open: bool) {
        let count = self.samples.len() as f32;
        for expert in &mut self.experts {
            let patterns = self.samples.iter().map(|it| it.patterns[wall]);
            let sum: f32 = patterns.map(|it| expert.opinion[usize::from(it)]).sum();
            let chance = sum / count;
            expert.evidence += ln(if open { chance } else { 1.0 - chance });
        }
    }

    /// Forms the common opinion from the experts', each by its evidence.
    fn agree(&mut self) {
        let most = self.experts.iter().map(|it| it.evidence);
        let most = most.fold(f32::MIN, f32::max);
        let mut total = 0.0;
        self.opinion = [0.0; 256];
        self.kinds = [0.0; KINDS];
        for (index, expert) in self.experts.iter().enumerate() {
            let weight = exp(expert.evidence - most);
            total += weight;
            self.kinds[index / SHIFTS.len()] += weight;
            for (sum, chance) in self.opinion.iter_mut().zip(&expert.opinion) {
                *sum += weight * chance;
            }
        }
        self.opinion.iter_mut().for_each(|it| *it /= total);
        self.kinds.iter_mut().for_each(|it| *it /= total);
    }

    /// Redraws every unknown wall of every sample, and renews the chances.
    fn redraw(&mut self, sweeps: u32, renewal: f32) {
        let opinion = self.opinion.map(|it| (it * 65536.0) as u32);
        let unknown = std::mem::take(&mut self.unknown);
        let free: Vec<u16> = unknown
            .iter()
            .copied()
            .filter(|&wall| !self.room.holds(usize::from(wall)))
            .collect();
        let mut sums = vec![0u32; self.grid.wall_count()];
        for index in 0..self.samples.len() {
            for _ in 0..sweeps {
                self.redraw_entrance(index, &mut sums);
                let mut bits = 0;
                for (turn, &wall) in free.iter().enumerate() {
                    // 16 random bits a wall.
                    if turn % 4 == 0 {
                        bits = self.random.next_u64();
                    }
                    let wall = usize::from(wall);
                    let pattern = usize::from(self.samples[index].patterns[wall]);
                    let chance = opinion[pattern];
                    // The chance itself instead of what is drawn: less noise.
                    sums[wall] += chance;
                    self.set(index, wall, (bits as u32 & 0xFFFF) < chance);
                    bits >>= 16;
                }
            }
        }
        let scale = 1.0 / (65536.0 * self.samples.len() as f32 * sweeps as f32);
        for &wall in &unknown {
            let wall = usize::from(wall);
            let inside = self.room.is_believed() && self.room.is_inside(wall);
            let chance = if inside {
                1.0
            } else {
                sums[wall] as f32 * scale
            };
            self.chances[wall] += renewal * (chance - self.chances[wall]);
        }
        self.unknown = unknown;
    }

    /// Redraws which wall of the goal room is its entrance.
    fn redraw_entrance(&mut self, index: usize, sums: &mut [u32]) {
        if !self.room.is_believed() {
            return;
        }
        let walls = self.room.entrances().to_vec();
        let known = &self.known;
        let found = walls
            .iter()
            .any(|&it| known[usize::from(it)] == Known::Open);
        let candidates: Vec<usize> = walls
            .iter()
            .map(|&it| usize::from(it))
            .filter(|&it| known[it] == Known::Unknown)
            .collect();
        let patterns = &self.samples[index].patterns;
        let odds = |wall: usize| {
            let chance = self.opinion[usize::from(patterns[wall])];
            // No entrance is out of the question.
            chance / (1.0 - chance) + 0.1
        };
        let weights: Vec<f32> = candidates.iter().map(|&it| odds(it)).collect();
        let bits = (self.random.next_u64() >> 40) as f32;
        let mut rest = bits / (1 << 24) as f32 * weights.iter().sum::<f32>();
        let mut entrance = candidates.len().wrapping_sub(1);
        for (turn, weight) in weights.iter().enumerate() {
            if rest < *weight {
                entrance = turn;
                break;
            }
            rest -= weight;
        }
        for (turn, &wall) in candidates.iter().enumerate() {
            let open = !found && turn == entrance;
            sums[wall] += if open { 65536 } else { 0 };
            self.set(index, wall, open);
        }
    }

    fn first_sample(&mut self) -> Sample {
        let mut open: Vec<u8> = self
            .known
            .iter()
            .map(|it| u8::from(*it == Known::Open))
            .collect();
        for &wall in &self.unknown {
            open[usize::from(wall)] = (self.random.next_u64() & 1) as u8;
        }
        if self.room.is_believed() {
            for &wall in self.room.entrances() {
                open[usize::from(wall)] = 0;
            }
            for &wall in self.room.inside() {
                open[usize::from(wall)] = 1;
            }
        }
        let mut patterns = vec![0; open.len()];
        for &wall in &self.unknown {
            let around = self.neighborhoods[usize::from(wall)].iter().enumerate();
            patterns[usize::from(wall)] = around.fold(0, |bits, (place, &it)| {
                bits | open[usize::from(it)] << place
            });
        }
        Sample { open, patterns }
    }

    #[inline]
    fn set(&mut self, index: usize, wall: usize, open: bool) {
        let sample = &mut self.samples[index];
        if sample.open[wall] == u8::from(open) {
            return;
        }
        sample.open[wall] = u8::from(open);
        let around = self.neighborhoods[wall].iter().zip(self.bits[wall]);
        for (&other, bit) in around {
            sample.patterns[usize::from(other)] ^= bit;
        }
    }
}

/// Every kind with every shift.
fn experts() -> Vec<Expert> {
    let mut experts = Vec::with_capacity(EXPERTS);
    for pattern in &PATTERNS {
        for (shift, weight) in SHIFTS {
            let factor = if shift < 0.0 {
                exp(shift)
            } else {
                1.0 / exp(-shift)
            };
            experts.push(Expert {
                opinion: pattern.map(|it| {
                    let chance = f32::from(it) / 65536.0;
                    let odds = chance / (1.0 - chance) * factor;
                    odds / (1.0 + odds)
                }),
                evidence: ln(weight / 7.0),
            });
        }
    }
    experts
}
