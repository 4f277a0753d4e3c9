//! Mazes without robots: parsing, solving, generating.

use std::hint::black_box;

use criterion::Criterion;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::{GenSpec, Kind};
use wasmouse_core::maze::{LONGEST_MOVE, oracle_steps};

use super::stage;

/// `parse/...`, `solve/...` and `generate/...`, all 16 x 16.
pub fn bench(criterion: &mut Criterion) {
    let (_, maze) = stage::generated("gen:tree:16:1").swap_remove(0);

    let mut group = criterion.benchmark_group("parse");
    for format in Format::ALL {
        let text = format::print(&maze, format).expect("every format holds contest mazes");
        group.bench_function(format.name(), |b| {
            b.iter(|| black_box(format::parse(black_box(&text))).is_ok());
        });
    }
    group.finish();

    let mut group = criterion.benchmark_group("solve");
    for (name, maze) in stage::match_mazes() {
        group.bench_function(name, |b| {
            b.iter(|| oracle_steps(black_box(&maze), LONGEST_MOVE));
        });
    }
    group.finish();

    let mut group = criterion.benchmark_group("generate");
    for kind in Kind::ALL {
        let specification: GenSpec = format!("gen:{}:16:1", kind.name())
            .parse()
            .expect("a specification");
        group.bench_function(kind.name(), |b| {
            b.iter(|| {
                let mazes = black_box(&specification).expand();
                mazes.for_each(|maze| drop(black_box(maze.generate())));
            });
        });
    }
    group.finish();
}
