//! Whole contests: matches per second, on one thread and on two.

use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, SamplingMode, Throughput};
use wasmouse::contest::{Contest, ContestMaze, Entrant};
use wasmouse::sim::Ruleset;

use super::stage;

/// `contest/...`: flood and depth-first search in 100 generated mazes.
pub fn bench(criterion: &mut Criterion) {
    let rules = Ruleset::default();
    let host = stage::host(2);
    let entrants = ["flood", "dfs"].map(|name| {
        let robot = stage::robot(&host, name);
        Entrant {
            name: name.to_owned(),
            digest: *robot.digest(),
            setting: 0,
            admission: Ok(Arc::new(robot)),
        }
    });
    let contest = Contest {
        entrants: entrants.into(),
        mazes: stage::generated("gen:tree:16:1..=100")
            .into_iter()
            .map(|(name, maze)| ContestMaze::new(name, maze, &rules))
            .collect(),
        seeds: vec![0],
        rules,
    };
    let mut group = criterion.benchmark_group("contest");
    group
        .throughput(Throughput::Elements(contest.matches() as u64))
        .sampling_mode(SamplingMode::Flat);
    for threads in [1, 2] {
        group.bench_function(format!("200 matches on {threads} threads"), |b| {
            b.iter(|| {
                let results = contest.run(&host, threads, &AtomicBool::new(false), &|| ());
                black_box(results.expect("the host works"));
            });
        });
    }
    group.finish();
}
