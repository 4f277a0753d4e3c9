//! What the robot believes when it thinks longer: [`Ensemble`].
//!
//! Mazes of three kinds that all agree with everything seen: trees with loops
//! ([`Trees`]), rows of walls ([`Rows`]), and what the patterns of walls make likely
//! ([`Belief`]), which also has to do for mazes drawn by people. How much each kind
//! counts, the robot learns on the way: every wall that it gets to see speaks for the
//! kinds that expected it (Bayes' rule, with walls seen at the same time taken as
//! independent).

use wasmouse_sdk::{Briefing, Grid, Random};

use crate::belief::Belief;
use crate::knowledge::Known;
use crate::numbers::{exp, ln};
use crate::rows::{Rows, Seen};
use crate::trees::Trees;

const KINDS: usize = 3;
const TREES: usize = 0;
const ROWS: usize = 1;
const PATTERNS: usize = 2;

/// A kind that counts for less is only sampled to see whether it recovers.
const WEIGHT_MIN: f32 = 0.01;

/// Mazes of such a kind.
const SAMPLES_MIN: usize = 8;

/// No kind is surer of a wall than this: it may have been lucky.
const CHANCE_MIN: f32 = 0.01;

/// Mazes of several kinds.
pub struct Ensemble {
    trees: Trees,
    rows: Rows,
    random: Random,
    kinds: [Kind; KINDS],
    /// The chance that a wall is open, for unknown ones.
    chances: Vec<f32>,
    /// The walls seen closed.
    closed: Vec<u16>,
    samples: usize,
}

#[derive(Clone)]
struct Kind {
    /// By wall, 1 where it is open.
    mazes: Vec<Vec<u8>>,
    chances: Vec<f32>,
    /// The logarithm of how likely it is, up to a common constant.
    evidence: f32,
    weight: f32,
}

impl Ensemble {
    /// Before anything is seen, with that many mazes.
    pub fn new(briefing: &Briefing, belief: &Belief, samples: usize) -> Self {
        let grid = Grid::new(briefing.dimension);
        let kind = Kind {
            mazes: Vec::new(),
            chances: vec![0.5; grid.wall_count()],
            evidence: 0.0,
            weight: 1.0 / KINDS as f32,
        };
        let mut ensemble = Self {
            trees: Trees::new(grid, briefing.start),
            rows: Rows::new(grid, briefing.start),
            random: Random::new(!briefing.seed),
            kinds: std::array::from_fn(|_| kind.clone()),
            chances: vec![0.5; grid.wall_count()],
            closed: Vec::new(),
            samples,
        };
        ensemble.draw(belief);
        ensemble
    }

    /// The chance that an unknown wall is open.
    pub fn chance(&self, wall: usize) -> f32 {
        self.chances[wall]
    }

    /// Whether the maze is more likely of a kind whose mazes are drawn as a whole than
    /// one of which only patterns are known.
    pub fn knows_kind(&self) -> bool {
        self.kinds[PATTERNS].weight < 0.5
    }

    /// How many mazes there are to imagine matches in.
    pub const fn sample_count(&self) -> usize {
        self.samples
    }

    /// One of them: by wall, 1 where it is open. Of any first few, each kind has about
    /// as many as it counts for.
    pub fn sample(&self, index: usize) -> &[u8] {
        let mut rest = radical_inverse(index + 1);
        let mut mazes = &self.kinds[PATTERNS].mazes;
        for kind in &self.kinds {
            if rest < kind.weight {
                mazes = &kind.mazes;
                break;
            }
            rest -= kind.weight;
        }
        &mazes[index % mazes.len()]
    }

    /// Takes in walls that were seen for the first time, which `belief` has not
    /// learned yet.
    pub fn weigh(&mut self, belief: &Belief, news: &[(usize, bool)]) {
        for &(wall, open) in news {
            if !open {
                self.closed.push(wall as u16);
            }
            if belief.room().holds(wall) {
                continue;
            }
            for kind in &mut self.kinds {
                let chance = kind.chances[wall];
                kind.evidence += ln(if open { chance } else { 1.0 - chance });
            }
        }
        let evidence = self.kinds.iter().map(|it| it.evidence);
        let most = evidence.fold(f32::MIN, f32::max);
        let mut total = 0.0;
        for kind in &mut self.kinds {
            kind.weight = exp(kind.evidence - most);
            total += kind.weight;
        }
        self.kinds.iter_mut().for_each(|it| it.weight /= total);
    }

    /// Draws new mazes; `belief` has learned by now.
    pub fn draw(&mut self, belief: &Belief) {
        let (known, unknown, room) = (belief.all_known(), belief.unknown(), belief.room());
        let seen = Seen {
            known,
            closed: &self.closed,
            room,
        };
        let blank: Vec<u8> = known
            .iter()
            .map(|it| u8::from(*it == Known::Open))
            .collect();
        self.trees.prepare(known, room);
        for (index, kind) in self.kinds.iter_mut().enumerate() {
            kind.mazes.clear();
            if index == PATTERNS {
                kind.mazes.extend(belief.samples().map(<[u8]>::to_vec));
                kind.believe(unknown, |wall| belief.chance(wall));
                continue;
            }
            let count = if kind.weight < WEIGHT_MIN {
                SAMPLES_MIN
            } else {
                self.samples
            };
            for _ in 0..count {
                let mut maze = blank.clone();
                let (random, to_draw) = (&mut self.random, &mut maze[..]);
                match index {
                    TREES => self.trees.draw(known, unknown, room, random, to_draw),
                    ROWS => self.rows.draw(&seen, unknown, random, to_draw),
                    _ => {}
                }
                kind.mazes.push(maze);
            }
            kind.count(unknown);
        }
        for &wall in unknown {
            let wall = usize::from(wall);
            let shares = self.kinds.iter().map(|it| it.weight * it.chances[wall]);
            self.chances[wall] = shares.sum();
        }
    }
}

impl Kind {
    fn believe(&mut self, unknown: &[u16], chance: impl Fn(usize) -> f32) {
        for &wall in unknown {
            let wall = usize::from(wall);
            self.chances[wall] = chance(wall).clamp(CHANCE_MIN, 1.0 - CHANCE_MIN);
        }
    }

    /// Believes what its mazes say on average.
    fn count(&mut self, unknown: &[u16]) {
        let mut open = vec![0u16; self.chances.len()];
        for maze in &self.mazes {
            for &wall in unknown {
                open[usize::from(wall)] += u16::from(maze[usize::from(wall)]);
            }
        }
        let count = self.mazes.len() as f32;
        self.believe(unknown, |wall| {
            (f32::from(open[wall]) + 0.5) / (count + 1.0)
        });
    }
}

/// The binary digits of a number behind the point, in reverse: the first few numbers
/// spread evenly over 0..1 (van der Corput, *Verteilungsfunktionen*, 1935).
fn radical_inverse(number: usize) -> f32 {
    let (mut rest, mut digit, mut sum) = (number, 0.5, 0.0);
    while rest > 0 {
        if rest & 1 == 1 {
            sum += digit;
        }
        digit *= 0.5;
        rest >>= 1;
    }
    sum
}
