//! Stores: records a second, and how long what is missing, a matrix and a digest take.

use std::sync::Arc;

use criterion::{BatchSize, Criterion, SamplingMode, Throughput};
use tempfile::TempDir;
use wasmouse::contest::{
    ContestMatch, ContestMaze, MatrixRobot, MazeSet, MazeSource, Seeds, Sink as _,
};
use wasmouse::store::{KeptTranscripts, MatchKeys, MatrixRequest, Store, StoreSink};
use wasmouse_core::Digest;
use wasmouse_core::game::{Action, GameRules, Ruleset};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::record::{EngineId, FuelUse, MatchRecord, Transcript, Usage, replay};

const PLAYERS: u8 = 20;
const MAZES: usize = 500;

/// Matches that are ready to be stored, and can be used with any number of seeds.
struct Contest {
    rules: Ruleset,
    engine: EngineId,
    players: Vec<(Digest, u32)>,
    mazes: Vec<ContestMaze>,
    digests: Vec<Digest>,
    played: ContestMatch,
}

impl Contest {
    fn new() -> Self {
        let rules = Ruleset {
            game: GameRules {
                budget: 1,
                ..GameRules::default()
            },
            ..Ruleset::default()
        };
        let spec: GenSpec = format!("gen:tree:16:1..={MAZES}").parse().expect("mazes");
        let mazes = spec.expand();
        let mazes: Vec<ContestMaze> = mazes
            .map(|maze| MazeSource::Generated(maze).prepare(&rules.game))
            .collect();
        let digests: Vec<Digest> = mazes.iter().map(|it| it.digest).collect();
        let players: Vec<_> = (0..PLAYERS).map(|it| (Digest::of(&[it]), 0)).collect();
        let engine = EngineId::new("benchmark");
        let keys = MatchKeys {
            engine: engine.digest(),
            rules: rules.digest(),
            players: &players,
            mazes: &digests,
            seeds: Seeds { first: 0, count: 1 },
        };
        let mut transcript = Transcript::default();
        transcript.push(Action::Reset);
        let maze = Arc::clone(&mazes[0].maze);
        let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
        let usage = Usage {
            fuel: FuelUse {
                start: 4000,
                steps: 1_234_567,
                step_max: 23_456,
            },
            memory_bytes: 1 << 20,
            ..Usage::default()
        };
        let record = MatchRecord::new(keys.key(0, 0, 0), result, usage, &transcript);
        let played = ContestMatch {
            player: 0,
            record,
            transcript,
        };
        Self {
            rules,
            engine,
            players,
            mazes,
            digests,
            played,
        }
    }

    fn keys(&self, seeds: u32) -> MatchKeys<'_> {
        MatchKeys {
            engine: self.engine.digest(),
            rules: self.rules.digest(),
            players: &self.players,
            mazes: &self.digests,
            seeds: Seeds {
                first: 0,
                count: seeds,
            },
        }
    }

    /// Stores all matches with that many seeds: 10,000 for each seed.
    fn store(&self, store: &mut Store, seeds: u32) {
        let keys = self.keys(seeds);
        let mut played = self.played.clone();
        let (engine, rules) = (self.engine.clone(), self.rules.clone());
        let mut sink = StoreSink::new(store, engine, rules, KeptTranscripts::None).expect("a sink");
        for (maze, prepared) in self.mazes.iter().enumerate() {
            sink.maze(prepared).expect("the disk has room");
            for seed in 0..seeds {
                for player in 0..self.players.len() {
                    played.record.key = keys.key(player, maze, seed);
                    sink.played(&played).expect("the disk has room");
                }
            }
        }
        sink.finish().expect("the disk has room");
    }
}

fn new_store() -> (TempDir, Store) {
    let folder = TempDir::new().expect("a folder");
    let store = Store::create_or_open(folder.path().join("results.db")).expect("a store");
    (folder, store)
}

/// `store/...`: 200,000 records written; a million read in several ways.
pub fn bench(criterion: &mut Criterion) {
    let contest = Contest::new();
    let mut group = criterion.benchmark_group("store");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.throughput(Throughput::Elements(200_000));
    group.bench_function("write 200,000 records", |b| {
        b.iter_batched_ref(
            new_store,
            |(_, store)| contest.store(store, 20),
            BatchSize::PerIteration,
        );
    });

    let (_folder, mut store) = new_store();
    contest.store(&mut store, 100);
    group.throughput(Throughput::Elements(1_000_000));
    group.bench_function("missing of a million", |b| {
        let keys = contest.keys(100);
        b.iter(|| assert_eq!(store.missing(&keys).expect("read").count(), 0));
    });
    group.bench_function("matrix of a million", |b| {
        let mazes: Vec<_> = contest.digests.iter().map(|&it| (it, 0)).collect();
        b.iter(|| {
            let robots = contest.players.iter();
            let robots = robots.map(|it| MatrixRobot::new(it.0.to_string(), it.0, it.1));
            let request = MatrixRequest {
                engine: contest.engine.digest(),
                rules: &contest.rules,
                robots: robots.collect(),
                mazes: &mazes,
                sets: vec![MazeSet {
                    name: "mazes".to_owned(),
                    is_hidden: false,
                    weight: 1,
                }],
                seeds: contest.keys(100).seeds,
            };
            let matrix = store.matrix(request).expect("read");
            assert_eq!(matrix.played(), 1_000_000);
        });
    });
    group.bench_function("records of a million", |b| {
        b.iter(|| {
            let mut steps = 0;
            let count = store.records(&contest.keys(100), &mut |record| {
                steps += u64::from(record.steps.total());
                Ok(())
            });
            assert_eq!((count.expect("read"), steps), (1_000_000, 1_000_000));
        });
    });
    group.bench_function("content digest of a million", |b| {
        b.iter(|| store.content_digest().expect("read"));
    });
    group.finish();
}
