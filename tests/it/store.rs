//! Stores whose writers are killed, and two writers at once.
//!
//! The laws of stores are tested in the module itself; this is about processes.

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;
use wasmouse::store::{KeptTranscripts, MergeOptions, Store, StoreErrorKind, StoreSink};
use wasmouse_tests::stored::Contest;

const WRITER: &str = env!("CARGO_BIN_EXE_store-writer");

const PLAYERS: u32 = 6;
const MAZES: u32 = 20;
const SEEDS: u32 = 40;

/// Times that the writer is killed.
const KILLS: u64 = 24;

fn contest(seeds: u32) -> Contest {
    Contest::new(PLAYERS, MAZES, seeds)
}

fn writer(path: &Path, seeds: u32) -> Command {
    let mut command = Command::new(WRITER);
    command
        .arg(path)
        .args([PLAYERS, MAZES, seeds].map(|it| it.to_string()))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn start(path: &Path, seeds: u32) -> (Child, BufReader<ChildStdout>) {
    let mut child = writer(path, seeds).spawn().expect("the program starts");
    let stdout = child.stdout.take().expect("it is piped");
    (child, BufReader::new(stdout))
}

/// Reads the index of the last match of a transaction; `None` at the end.
fn acknowledged(stdout: &mut BufReader<ChildStdout>) -> Option<u64> {
    let mut line = String::new();
    stdout.read_line(&mut line).expect("it prints text");
    line.strip_suffix('\n')?.parse().ok()
}

#[test]
fn what_was_acknowledged_survives_kills_and_the_end_is_the_same() {
    let contest = contest(SEEDS);
    let keys = contest.keys();
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("results.db");
    let mut last = None;
    for round in 0..KILLS {
        let (mut child, mut stdout) = start(&path, SEEDS);
        // Other moments in each round, some of them before the first transaction.
        for _ in 0..round * 5 % 13 {
            last = acknowledged(&mut stdout).or(last);
        }
        std::thread::sleep(Duration::from_micros(round * 977 % 4001));
        child.kill().expect("it may have ended");
        child.wait().expect("it was started");
        // What was printed before the kill counts, too.
        while let Some(index) = acknowledged(&mut stdout) {
            last = Some(index);
        }
        let store = match Store::open_read_only(&path) {
            Ok(store) => store,
            // Killed before there was a store.
            Err(error) => {
                let is_absent = matches!(error.kind, StoreErrorKind::Absent);
                assert!(is_absent && last.is_none(), "round {round}: {error}");
                continue;
            }
        };
        store.integrity().expect("everything is in order");
        let missing = store.missing(&keys).expect("read");
        for index in 0..last.map_or(0, |it| it + 1) {
            let (player, maze, seed) = contest.place(index);
            let is_lost = missing.get(player, maze, seed);
            assert!(!is_lost, "round {round}: match {index} is lost");
        }
        assert!(missing.count() > 0, "it was never killed in the middle");
    }
    assert!(last.is_some_and(|it| it > 300), "it got to {last:?} only");
    let output = writer(&path, SEEDS).output().expect("the program runs");
    assert!(output.status.success(), "{output:?}");

    let unbroken = folder.path().join("unbroken.db");
    let output = writer(&unbroken, SEEDS).output().expect("the program runs");
    assert!(output.status.success(), "{output:?}");
    let [broken, unbroken] = [&path, &unbroken].map(|path| {
        let store = Store::open_read_only(path).expect("a store");
        let integrity = store.integrity().expect("everything is in order");
        assert_eq!(integrity.matches, contest.len());
        assert!(integrity.is_sealed);
        store.content_digest().expect("read")
    });
    assert_eq!(broken, unbroken);
}

#[test]
fn another_process_that_writes_is_in_the_way_until_it_ends() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("results.db");
    // So many matches that it does not end by itself.
    let contest = contest(SEEDS * 100);
    let (mut child, mut stdout) = start(&path, SEEDS * 100);
    acknowledged(&mut stdout).expect("it writes");
    let error = Store::create_or_open(&path).expect_err("it has a writer");
    assert!(matches!(error.kind, StoreErrorKind::InUse), "{error}");
    let second = writer(&path, SEEDS).output().expect("the program runs");
    assert!(!second.status.success());
    let stderr = String::from_utf8_lossy(&second.stderr);
    assert!(stderr.contains("InUse"), "{stderr}");
    let reader = Store::open_read_only(&path).expect("reading goes on");
    let missing = reader.missing(&contest.keys()).expect("read");
    assert!(missing.count() < contest.len());
    child.kill().expect("it may have ended");
    child.wait().expect("it was started");
    Store::open_existing(&path).expect("the lock went with the process");
}

/// A million matches: missing, matrix and digest within seconds even without optimisation, in
/// much less memory than 150 MB. Takes a minute; run it with `--ignored`.
#[test]
#[ignore = "takes a minute"]
fn a_million_matches() {
    let contest = Contest::new(100, 100, 100);
    let folder = TempDir::new().expect("a folder");
    let mut store = Store::create_or_open(folder.path().join("a.db")).expect("a store");
    let (engine, rules) = (contest.engine.clone(), contest.rules.clone());
    let mut sink =
        StoreSink::new(&mut store, engine, rules, KeptTranscripts::None).expect("a sink");
    for index in 0..contest.len() {
        contest.play(index, &mut sink).expect("the disk has room");
    }
    sink.finish().expect("the disk has room");
    assert_eq!(store.missing(&contest.keys()).expect("read").count(), 0);
    store.seal().expect("written");
    let mut merged = Store::create_or_open(folder.path().join("b.db")).expect("a store");
    let report = merged.merge(&store, MergeOptions::default());
    assert_eq!(report.expect("merged").added, contest.len());
    let digest = store.content_digest().expect("read");
    assert_eq!(merged.content_digest().expect("read"), digest);
}
