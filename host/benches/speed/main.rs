//! `cargo bench`: how fast wasmouse is, and whether it is as fast as it promises.
//!
//! First come criterion's benchmarks, one module for each topic, then the table of
//! the speed targets ([`targets`]). `host/benches/README.md` says how to read both.

mod boundary;
mod contest;
mod fuel;
mod matches;
mod mazes;
mod native;
mod pairs;
mod player;
mod process;
mod stage;
mod store;
mod targets;

use criterion::Criterion;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    mazes::bench(&mut criterion);
    boundary::bench(&mut criterion);
    matches::bench(&mut criterion);
    contest::bench(&mut criterion);
    store::bench(&mut criterion);
    player::bench(&mut criterion);
    criterion.final_summary();
    if targets::are_wanted("targets") {
        targets::print();
    }
    if targets::are_wanted("fuel") {
        fuel::print();
    }
}
