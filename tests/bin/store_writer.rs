//! Writes a contest into a store and says how far it is, to be killed at any moment.
//!
//! `store-writer STORE PLAYERS MAZES SEEDS`: plays what is missing, in transactions of several
//! sizes, and prints the index of the last match that is on the disk after each.

use std::io::{self, Write as _};

use wasmouse::store::{KeptTranscripts, Store, StoreSink};
use wasmouse_tests::stored::Contest;

fn main() -> io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_default();
    let numbers: Vec<u32> = arguments.filter_map(|it| it.parse().ok()).collect();
    let &[players, mazes, seeds] = &numbers[..] else {
        return Err(io::Error::other("expected STORE PLAYERS MAZES SEEDS"));
    };
    let contest = Contest::new(players, mazes, seeds);
    let mut store = Store::create_or_open(path)?;
    play(&contest, &mut store)?;
    store.seal()?;
    println!("sealed");
    Ok(())
}

fn play(contest: &Contest, store: &mut Store) -> io::Result<()> {
    let missing = store.missing(&contest.keys())?;
    let (engine, rules) = (contest.engine.clone(), contest.rules.clone());
    let mut sink = StoreSink::new(store, engine, rules, KeptTranscripts::Best)?;
    let mut out = io::stdout().lock();
    let mut is_new = false;
    for index in 0..contest.len() {
        let (player, maze, seed) = contest.place(index);
        if missing.get(player, maze, seed) {
            contest.play(index, &mut sink)?;
            is_new = true;
        }
        // Each number has one cube modulo 23, so two of 23 matches end a transaction.
        if is_new && (index * index * index) % 23 < 2 {
            sink.flush()?;
            writeln!(out, "{index}")?;
            out.flush()?;
            is_new = false;
        }
    }
    sink.finish()?;
    Ok(())
}
