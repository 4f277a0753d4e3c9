//! Stores that open, and whose content makes no sense.

use std::fs;

use super::super::sample::{Contest, new_store};
use super::super::{KeptTranscripts, Store, StoreError};
use super::tamper::tamper;
use crate::contest::Seeds;

fn contest() -> Contest {
    Contest::new(3, 3, Seeds { first: 0, count: 5 })
}

fn integrity_after(sql: &str) -> Result<(), StoreError> {
    let (folder, mut store) = new_store();
    contest().store(&mut store, KeptTranscripts::All, |_, _, _| true);
    drop(store);
    let path = folder.path().join("results.db");
    tamper(&path, sql);
    Store::open_read_only(&path)?.integrity().map(|_| ())
}

#[test]
fn an_untouched_store_is_in_order() {
    integrity_after("").expect("nothing was changed");
}

#[test]
fn what_contradicts_itself_is_found() {
    for (sql, message) in [
        (
            "UPDATE engine SET name = 'wasmtime-0'",
            "engine `wasmtime-0` has another digest",
        ),
        (
            "UPDATE rules SET json = replace(json, '\"budget\":12', '\"budget\":13')",
            "their numbers have another digest",
        ),
        ("UPDATE rules SET json = '{}'", "missing field"),
        (
            "UPDATE maze SET walls = substr(walls, 1, 10) WHERE walls NOT NULL",
            "its walls have another digest",
        ),
        (
            "UPDATE maze SET dimension = 14 WHERE id = 1",
            "its walls have another digest",
        ),
        (
            "UPDATE generated SET name = 'gen:tree,loops=12:12:9' WHERE maze = 1",
            "its walls have another digest",
        ),
        (
            "UPDATE generated SET name = 'gen:tree:12:1' WHERE maze = 1",
            "`gen:tree:12:1` is no generated maze",
        ),
        (
            "UPDATE oracle SET oracle_speed = oracle_speed + 1",
            "its oracle score is wrong",
        ),
        ("UPDATE match SET verdict = 9", "an unknown verdict"),
        ("UPDATE match SET verdict = 3", "damaged"),
        ("UPDATE match SET bumps = -1", "damaged"),
        ("UPDATE match SET transcript = x'00'", "damaged"),
        (
            "UPDATE match SET fault_kind = 200 WHERE verdict = 3",
            "an unknown verdict",
        ),
        (
            "UPDATE match SET speed_steps = speed_steps + 1",
            "the record does not follow from its transcript",
        ),
        (
            "UPDATE match SET clamps = clamps + 1 WHERE seed = 2",
            "the record does not follow from its transcript",
        ),
        (
            "UPDATE transcript SET bytes = x'0100' WHERE seed = 2",
            "its transcript has another digest",
        ),
        (
            "DELETE FROM match WHERE seed = 2",
            "a row of the table transcript refers to one that is not there",
        ),
        ("DELETE FROM robot", "refers to one that is not there"),
        (
            "INSERT INTO conflict(record) VALUES('{}')",
            "a conflict: missing field",
        ),
        (
            "INSERT INTO unplayed SELECT engine, rules, robot, variant, maze, seed, 0, 'x' \
             FROM match",
            "a match was played and not played",
        ),
        (
            "INSERT INTO seal VALUES(1, zeroblob(32))",
            "its content is not the one that was sealed",
        ),
    ] {
        let error = integrity_after(sql).expect_err(sql);
        assert!(error.to_string().contains(message), "{sql}: {error}");
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}

/// Whatever bytes are changed: an error or a store, never a panic.
#[test]
fn changed_bytes_end_in_errors() {
    let (folder, mut store) = new_store();
    contest().store(&mut store, KeptTranscripts::All, |_, _, _| true);
    store.seal().expect("written");
    drop(store);
    let path = folder.path().join("results.db");
    let good = fs::read(&path).expect("a file");
    let mut found = 0;
    let mut number: u64 = 1;
    for _ in 0..150 {
        let mut bytes = good.clone();
        for _ in 0..40 {
            // A linear congruential generator is random enough to choose bytes.
            number = number
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let place = usize::try_from(number >> 33).expect("31 bits") % bytes.len();
            bytes[place] = (number >> 20) as u8;
        }
        fs::write(&path, bytes).expect("a file");
        let outcome = Store::open_read_only(&path).and_then(|store| {
            store.missing(&contest().keys())?;
            store.integrity()
        });
        found += u32::from(outcome.is_err());
    }
    assert!(found >= 140, "only {found} of 150 changes were found");
}

#[test]
fn a_store_is_not_sealed_when_a_match_refers_to_nothing() {
    for table in ["engine", "rules", "robot", "maze"] {
        let (folder, mut store) = new_store();
        contest().store(&mut store, KeptTranscripts::None, |_, _, _| true);
        drop(store);
        let path = folder.path().join("results.db");
        tamper(&path, &format!("DELETE FROM {table} WHERE id = 1"));
        let mut store = Store::open_existing(&path).expect("a store");
        let error = store.seal().expect_err(table).to_string();
        assert!(error.contains("refers to id 1, which"), "{table}: {error}");
        assert_eq!(store.sealed().expect("read"), None);
    }
}
