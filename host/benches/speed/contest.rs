//! Whole contests: matches per second, in this process and in workers.

use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, SamplingMode, Throughput};
use wasmouse::contest::{Contest, ContestMaze, Entrant};
use wasmouse::robot::{Digest, Referee, Trust, bundled};
use wasmouse::sim::Ruleset;

use super::stage;

/// A contest with a referee that has admitted its robots.
pub struct Stage {
    contest: Contest,
    referee: Referee,
}

impl Stage {
    /// Those bundled robots in those mazes, on up to `threads` threads, run as the
    /// host's own or as a stranger's.
    pub fn new(robots: &[&str], mazes: &str, threads: u32, trust: Trust) -> Self {
        let rules = Ruleset::default();
        let referee = stage::referee(threads);
        let entrants = robots.iter().map(|name| {
            let component = bundled::find(name).expect("a bundled robot").component;
            let admission = referee.admit(component, trust).expect("the host works");
            Entrant {
                name: (*name).to_owned(),
                digest: Digest::of(component),
                setting: 0,
                admission: admission.map(Arc::new).map_err(Arc::new),
            }
        });
        let contest = Contest {
            entrants: entrants.collect(),
            mazes: stage::generated(mazes)
                .into_iter()
                .map(|(name, maze)| ContestMaze::new(name, maze, &rules))
                .collect(),
            seeds: vec![0],
            rules,
        };
        Self { contest, referee }
    }

    /// Plays all of it.
    pub fn play(&self, threads: usize) {
        let cancelled = AtomicBool::new(false);
        let played = self
            .contest
            .run(&self.referee, threads, &cancelled, &|| ())
            .expect("there are threads");
        assert_eq!(played.results.len(), self.contest.matches());
        black_box(played);
    }
}

/// `contest/...`: flood and depth-first search in 100 generated mazes.
pub fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("contest");
    group.sampling_mode(SamplingMode::Flat);
    for (trust, place) in [(Trust::Trusted, "here"), (Trust::Stranger, "in workers")] {
        let stage = Stage::new(&["flood", "dfs"], "gen:tree:16:1..=100", 2, trust);
        group.throughput(Throughput::Elements(stage.contest.matches() as u64));
        for threads in [1, 2] {
            group.bench_function(format!("200 matches on {threads} threads {place}"), |b| {
                b.iter(|| stage.play(threads));
            });
        }
    }
    group.finish();
}
