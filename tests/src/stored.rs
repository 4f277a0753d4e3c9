//! A contest without robots, for stores: its matches end at once, and no two are equal.

use std::io;

use wasmouse::contest::{ContestMatch, ContestMaze, MazeSource, Seeds, Sink};
use wasmouse::store::MatchKeys;
use wasmouse_core::Digest;
use wasmouse_core::game::{Action, FaultKind, GameRules, Phase, Ruleset};
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::record::{EngineId, FuelUse, MatchRecord, Transcript, Usage, replay};

/// A contest of some robots in generated mazes.
pub struct Contest {
    /// The engine.
    pub engine: EngineId,
    /// The rules: two steps.
    pub rules: Ruleset,
    players: Vec<(Digest, u32)>,
    mazes: Vec<ContestMaze>,
    digests: Vec<Digest>,
    seeds: Seeds,
}

impl Contest {
    /// Robots, mazes and seeds.
    pub fn new(players: u32, mazes: u32, seeds: u32) -> Self {
        let rules = Ruleset {
            game: GameRules {
                budget: 2,
                ..GameRules::default()
            },
            ..Ruleset::default()
        };
        let spec: GenSpec = format!("gen:braid:12:1..={mazes}").parse().expect("mazes");
        let mazes = spec.expand();
        let mazes: Vec<ContestMaze> = mazes
            .map(|maze| MazeSource::Generated(maze).prepare(&rules.game))
            .collect();
        Self {
            engine: EngineId::new("no engine"),
            rules,
            players: (0..players)
                .map(|it| (Digest::of(&[it as u8]), it))
                .collect(),
            digests: mazes.iter().map(|it| it.digest).collect(),
            mazes,
            seeds: Seeds {
                first: 1,
                count: seeds,
            },
        }
    }

    /// What is played.
    pub fn keys(&self) -> MatchKeys<'_> {
        MatchKeys {
            engine: self.engine.digest(),
            rules: self.rules.digest(),
            players: &self.players,
            mazes: &self.digests,
            seeds: self.seeds,
        }
    }

    /// How many matches there are.
    pub fn len(&self) -> u64 {
        let mazes = self.mazes.len() as u64;
        self.players.len() as u64 * mazes * u64::from(self.seeds.count)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Player, maze and seed of a match by its place in the order of the plan.
    pub fn place(&self, index: u64) -> (usize, usize, u32) {
        let players = self.players.len() as u64;
        let (row, player) = (index / players, index % players);
        let seeds = u64::from(self.seeds.count);
        (
            player as usize,
            (row / seeds) as usize,
            (row % seeds) as u32,
        )
    }

    /// Plays the match of that index into a sink, with its maze.
    pub fn play(&self, index: u64, sink: &mut dyn Sink) -> io::Result<()> {
        let (player, maze, seed) = self.place(index);
        sink.maze(&self.mazes[maze])?;
        let key = self.keys().key(player, maze, seed);
        let mut transcript = Transcript::default();
        transcript.push(Action::Reset);
        if index.is_multiple_of(7) {
            let detail = format!("match {index}");
            transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, detail);
        } else {
            transcript.push(Action::Reset);
        }
        let maze = &self.mazes[maze].maze;
        let result = replay(maze, &self.rules.game, &transcript).expect("a whole match");
        let usage = Usage {
            fuel: FuelUse {
                start: index,
                steps: 1000 + index,
                step_max: 500,
            },
            memory_bytes: 65_536,
            journal: JournalCounts::default(),
        };
        let record = MatchRecord::new(key, result, usage, &transcript);
        sink.played(&ContestMatch {
            player,
            record,
            transcript,
        })
    }
}
