//! Contests for tests: mazes, records and transcripts that belong together.

use std::sync::Arc;

use proptest::prelude::*;
use tempfile::TempDir;
use wasmouse_core::Digest;
use wasmouse_core::game::{
    Action, Counts, Fault, FaultKind, GameRules, Phase, Ruleset, Run, Steps, Verdict,
};
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Cell, Turn};
use wasmouse_core::record::{
    EngineId, FuelUse, MatchKey, MatchRecord, RecordVersion, Transcript, Usage, replay,
};

use super::{KeptTranscripts, Store, StoreSink};
use crate::contest::{ContestMatch, ContestMaze, MazeSource, Seeds, Sink};

/// A contest whose robots drive at random.
pub struct Contest {
    pub engine: EngineId,
    pub rules: Ruleset,
    pub players: Vec<(Digest, u32)>,
    pub mazes: Vec<ContestMaze>,
    pub digests: Vec<Digest>,
    pub seeds: Seeds,
}

impl Contest {
    /// A contest of generated mazes; the last one is loaded from a file.
    pub fn new(players: u32, mazes: u64, seeds: Seeds) -> Self {
        let rules = Ruleset {
            game: GameRules {
                budget: 12,
                ..GameRules::default()
            },
            ..Ruleset::default()
        };
        let spec: GenSpec = format!("gen:tree:12:1..={mazes}").parse().expect("mazes");
        let mut mazes: Vec<ContestMaze> = spec
            .expand()
            .map(|maze| MazeSource::Generated(maze).prepare(&rules.game))
            .collect();
        if let Some(last) = mazes.last_mut() {
            last.name = "a file".into();
            last.is_generated = false;
        }
        Self {
            engine: EngineId::new("wasmtime-test"),
            rules,
            players: (0..players).map(|it| (robot(it / 2), it % 2)).collect(),
            digests: mazes.iter().map(|it| it.digest).collect(),
            mazes,
            seeds,
        }
    }

    pub fn keys(&self) -> super::MatchKeys<'_> {
        super::MatchKeys {
            engine: self.engine.digest(),
            rules: self.rules.digest(),
            players: &self.players,
            mazes: &self.digests,
            seeds: self.seeds,
        }
    }

    /// A match: the same one for the same positions.
    pub fn play(&self, player: usize, maze: usize, seed: u32) -> ContestMatch {
        let key = self.keys().key(player, maze, seed);
        let address = key.digest();
        let bytes = address.as_bytes();
        let mut transcript = Transcript::default();
        let steps = if bytes[0].is_multiple_of(5) { 5 } else { 12 };
        for &byte in &bytes[1..=steps] {
            let turn = [Turn::Left, Turn::Straight, Turn::Right][usize::from(byte % 3)];
            let advance = (byte / 3 % 4).cast_signed();
            transcript.push(match byte % 11 {
                0 => Action::Reset,
                _ => Action::Move { turn, advance },
            });
        }
        if steps == 5 {
            let kind = FaultKind::ALL[usize::from(bytes[20] % 3)];
            transcript.end_with_fault(kind, Phase::NextMove, format!("fault {}", bytes[21]));
        }
        let number = |at: usize| u64::from(bytes[at]) << 56 | u64::from(bytes[at + 1]);
        let usage = Usage {
            fuel: FuelUse {
                start: number(22),
                steps: number(23),
                step_max: number(24),
            },
            memory_bytes: number(25),
            journal: JournalCounts {
                entries: number(26),
                dropped: number(27),
            },
        };
        let maze = &self.mazes[maze].maze;
        let result = replay(maze, &self.rules.game, &transcript).expect("a whole match");
        ContestMatch {
            player,
            record: MatchRecord::new(key, result, usage, &transcript),
            transcript,
        }
    }

    /// Plays what `wanted` selects by player, maze and seed, and passes it to a sink.
    pub fn play_into(&self, sink: &mut dyn Sink, wanted: impl Fn(usize, usize, u32) -> bool) {
        for (index, maze) in self.mazes.iter().enumerate() {
            sink.maze(maze).expect("the sink takes it");
            for seed in 0..self.seeds.count {
                for player in 0..self.players.len() {
                    if wanted(player, index, seed) {
                        let played = self.play(player, index, seed);
                        sink.played(&played).expect("the sink takes it");
                    }
                }
            }
        }
    }

    /// Plays into a store.
    pub fn store(
        &self,
        store: &mut Store,
        kept: KeptTranscripts,
        wanted: impl Fn(usize, usize, u32) -> bool,
    ) {
        let (engine, rules) = (self.engine.clone(), self.rules.clone());
        let mut sink = StoreSink::new(store, engine, rules, kept).expect("a sink");
        self.play_into(&mut sink, wanted);
        sink.finish().expect("the disk has room");
    }
}

/// The digest of a robot.
pub fn robot(number: u32) -> Digest {
    Digest::of(&number.to_le_bytes())
}

/// A store in a folder of its own.
pub fn new_store() -> (TempDir, Store) {
    let folder = TempDir::new().expect("a folder");
    let store = Store::create_or_open(folder.path().join("results.db")).expect("a store");
    (folder, store)
}

/// A maze with that digest, and nothing else that is true.
pub fn maze_with(digest: Digest) -> ContestMaze {
    let spec: GenSpec = "gen:tree:12:1".parse().expect("a maze");
    let maze = spec.expand().next().expect("a maze").generate();
    ContestMaze {
        name: "some maze".into(),
        digest,
        oracle: None,
        is_generated: false,
        maze: Arc::new(maze),
    }
}

fn any_digest() -> impl Strategy<Value = Digest> {
    any::<[u8; 32]>().prop_map(Digest::from_bytes)
}

fn any_fault() -> impl Strategy<Value = Fault> {
    let kind = prop::sample::select(FaultKind::ALL.to_vec());
    let phase = prop::sample::select(Phase::ALL.to_vec());
    let run = prop::sample::select(vec![Run::Exploration, Run::Speed]);
    (kind, phase, run, any::<(u32, u8, u8, String)>()).prop_map(
        |(kind, phase, run, (step, x, y, detail))| Fault {
            kind,
            phase,
            run,
            step,
            cell: Cell::new(x, y),
            detail: detail.into(),
        },
    )
}

/// Any record of these rules and that engine, possible or not.
pub fn any_record(engine: Digest, rules: Ruleset) -> impl Strategy<Value = MatchRecord> {
    let key = (any_digest(), any_digest(), any::<(u32, u64)>());
    let numbers = any::<([u32; 6], [u64; 6])>();
    let verdict = prop_oneof![
        Just(None),
        any::<bool>().prop_map(|it| Some(Verdict::BudgetUsedUp { goal_reached: it })),
        any_fault().prop_map(|fault| Some(Verdict::Fault { fault })),
    ];
    (key, numbers, verdict, any_digest()).prop_map(
        move |((robot, maze, (variant, seed)), (small, large), verdict, transcript)| {
            let steps = Steps {
                exploration: small[0],
                speed: small[1],
            };
            MatchRecord {
                version: RecordVersion,
                key: MatchKey {
                    engine,
                    rules: rules.digest(),
                    robot,
                    variant,
                    maze,
                    seed,
                },
                verdict: verdict.unwrap_or_else(|| Verdict::Finished {
                    score: rules.game.score(steps.speed, steps.exploration),
                }),
                steps,
                counts: Counts {
                    bumps: small[2],
                    clamps: small[3],
                    resets_before_goal: small[4],
                    resets_in_speed_run: small[5],
                },
                fuel: FuelUse {
                    start: large[0],
                    steps: large[1],
                    step_max: large[2],
                },
                memory_bytes: large[3],
                journal: JournalCounts {
                    entries: large[4],
                    dropped: large[5],
                },
                transcript,
            }
        },
    )
}
