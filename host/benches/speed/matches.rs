//! Whole matches of the flood robot: in the sandbox, and natively beside it.

use std::hint::black_box;
use std::sync::Arc;

use criterion::Criterion;
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::Transcript;
use wasmouse_engine::Recording;

use super::{native, stage};

/// `match of flood/...`.
pub fn bench(criterion: &mut Criterion) {
    let runtime = stage::runtime();
    let flood = stage::robot(&runtime, "flood");
    let rules = Arc::new(Ruleset::default());
    let mut group = criterion.benchmark_group("match of flood");
    for (name, maze) in stage::match_mazes() {
        let mut recording = Recording::default();
        let spec = stage::spec(&flood, (&maze, 0), &rules);
        group.bench_function(format!("wasm/{name}"), |b| {
            b.iter(|| black_box(stage::play(&runtime, &flood, &spec, &mut recording)));
        });
        let mut transcript = Transcript::default();
        group.bench_function(format!("native/{name}"), |b| {
            b.iter(|| native::play(black_box(&maze), &rules.game, 0, &mut transcript));
        });
    }
    group.finish();
}
