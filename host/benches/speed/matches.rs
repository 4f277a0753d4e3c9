//! Whole matches of the flood robot: in the sandbox, and natively beside it.

use std::hint::black_box;

use criterion::Criterion;
use wasmouse::robot::Recorder;
use wasmouse::sim::{Ruleset, Trace};

use super::{native, stage};

/// `match of flood/...`.
pub fn bench(criterion: &mut Criterion) {
    let host = stage::host(1);
    let flood = stage::robot(&host, "flood");
    let rules = Ruleset::default();
    let mut group = criterion.benchmark_group("match of flood");
    for (name, maze) in stage::match_mazes() {
        let mut recorder = Recorder::default();
        group.bench_function(format!("wasm/{name}"), |b| {
            b.iter(|| {
                black_box(stage::play(
                    &host,
                    &flood,
                    (&maze, 0),
                    &rules,
                    &mut recorder,
                ))
            });
        });
        let mut trace = Trace::default();
        group.bench_function(format!("native/{name}"), |b| {
            b.iter(|| native::play(black_box(&maze), &rules, 0, &mut trace));
        });
    }
    group.finish();
}
