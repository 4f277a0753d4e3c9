//! Content digests and merges.

use std::path::{Path, PathBuf};

use tempfile::TempDir;
use wasmouse_core::record::EngineId;

use super::super::sample::{Contest, new_store};
use super::super::{
    KeptTranscripts, MergeOptions, MergeReport, Store, StoreErrorKind, StoreSink, Submission,
};
use super::tamper::tamper;
use crate::contest::{MatchFailure, Seeds, Sink as _};

const SEEDS: Seeds = Seeds { first: 5, count: 4 };

fn contest() -> Contest {
    Contest::new(4, 6, SEEDS)
}

fn submissions(contest: &Contest) -> Vec<Submission> {
    let players = contest.players.iter().enumerate();
    let submissions = players.map(|(place, &(robot, variant))| Submission {
        name: format!("robot {place}").into(),
        author: None,
        class: None,
        robot,
        variant,
        rejection: None,
    });
    submissions.collect()
}

/// A store with the matches in some mazes, sealed and closed.
fn shard(
    contest: &Contest,
    kept: KeptTranscripts,
    wanted: impl Fn(usize) -> bool,
) -> (TempDir, PathBuf) {
    let (folder, mut store) = new_store();
    store.submit(&submissions(contest)).expect("written");
    contest.store(&mut store, kept, |_, maze, _| wanted(maze));
    store.seal().expect("written");
    let path = folder.path().join("results.db");
    (folder, path)
}

fn merge(into: &mut Store, path: &Path) -> Result<MergeReport, super::super::StoreError> {
    let from = Store::open_read_only(path).expect("a store");
    into.merge(&from, MergeOptions::default())
}

#[test]
fn the_content_digest_depends_on_content_alone() {
    let contest = contest();
    let (_folder, mut forward) = new_store();
    contest.store(&mut forward, KeptTranscripts::All, |_, _, _| true);
    let (_folder, mut backward) = new_store();
    for maze in (0..6).rev() {
        for player in [2, 0, 3, 1] {
            contest.store(&mut backward, KeptTranscripts::All, |it, at, _| {
                it == player && at == maze
            });
        }
    }
    let digest = forward.content_digest().expect("read");
    assert_eq!(backward.content_digest().expect("read"), digest);
    assert_eq!(forward.seal().expect("written"), digest);
    assert_eq!(
        forward.content_digest().expect("read"),
        digest,
        "a seal is no content"
    );

    let (_folder, mut part) = new_store();
    contest.store(&mut part, KeptTranscripts::All, |player, maze, seed| {
        (player, maze, seed) != (3, 2, 1)
    });
    assert_ne!(part.content_digest().expect("read"), digest);
}

/// Every column that can differ is part of the content.
#[test]
fn every_change_changes_the_content_digest() {
    let contest = contest();
    let (folder, mut store) = new_store();
    store.submit(&submissions(&contest)).expect("written");
    contest.store(&mut store, KeptTranscripts::All, |_, _, _| true);
    let path = folder.path().join("results.db");
    let mut digests = vec![store.content_digest().expect("read")];
    drop(store);
    // One change after the other. The last one leaves a transcript without its match.
    for column in [
        "exploration_steps",
        "speed_steps",
        "fuel_start",
        "fuel_steps",
        "fuel_step_max",
        "memory_bytes",
        "bumps",
        "clamps",
        "resets_before_goal",
        "resets_in_speed_run",
        "journal_entries",
        "journal_dropped",
        "seed",
    ] {
        let at = "WHERE maze = 1 AND robot = 1 AND variant = 0 AND seed = 8";
        tamper(
            &path,
            &format!("UPDATE match SET {column} = {column} + 77 {at}"),
        );
        let store = Store::open_read_only(&path).expect("a store");
        digests.push(store.content_digest().expect("read"));
    }
    for sql in [
        "UPDATE match SET fault_detail = 'x' WHERE verdict = 3",
        "UPDATE match SET fault_x = fault_x + 1 WHERE verdict = 3",
        "UPDATE match SET fault_step = fault_step + 1 WHERE verdict = 3",
        "UPDATE match SET fault_kind = fault_kind + 1 WHERE verdict = 3",
        "UPDATE match SET fault_phase = 0 WHERE verdict = 3",
        "UPDATE match SET fault_run = 3 - fault_run WHERE verdict = 3",
        "UPDATE maze SET name = 'x' WHERE id = 2",
        "UPDATE submission SET author = 'x' WHERE ordinal = 2",
        "UPDATE submission SET name = 'x' WHERE ordinal = 2",
        "UPDATE transcript SET is_best = 1 WHERE seed = 5",
        "UPDATE transcript SET bytes = x'01' WHERE seed = 6",
        "INSERT INTO unplayed VALUES(1, 1, 1, 9, 1, 1, 0, 'x')",
        "UPDATE unplayed SET cause = 1",
        "DELETE FROM generated WHERE maze = 1",
        "UPDATE oracle SET oracle_speed = 1 WHERE maze = 1",
    ] {
        tamper(&path, sql);
        let store = Store::open_read_only(&path).expect("a store");
        digests.push(store.content_digest().expect(sql));
    }
    let count = digests.len();
    digests.sort_unstable();
    digests.dedup();
    assert_eq!(digests.len(), count, "some change was not seen");
}

#[test]
fn shards_merge_to_the_whole_and_merging_again_adds_nothing() {
    let contest = contest();
    for kept in [
        KeptTranscripts::None,
        KeptTranscripts::Best,
        KeptTranscripts::All,
    ] {
        let (_whole, whole) = shard(&contest, kept, |_| true);
        let whole = Store::open_read_only(whole).expect("a store");
        let (_folder, mut merged) = new_store();
        for part in [2, 0, 1] {
            // Shards overlap: maze 5 is in all of them.
            let (_folder, path) = shard(&contest, kept, |maze| maze % 3 == part || maze == 5);
            let first = merge(&mut merged, &path).expect("merged");
            assert!(first.added >= 16 * 2);
            merged.seal().expect("written");
            let again = merge(&mut merged, &path).expect("merged");
            let same = first.added + first.same;
            let expected = MergeReport {
                same,
                ..MergeReport::default()
            };
            assert_eq!(again, expected);
            assert!(merged.sealed().expect("read").is_some(), "nothing changed");
        }
        let digest = whole.content_digest().expect("read");
        assert_eq!(merged.content_digest().expect("read"), digest, "{kept:?}");
        merged.integrity().expect("in order");
    }
}

/// Checks that a shard is refused, and that nothing of it was merged.
#[track_caller]
fn check_refused(path: &Path, message: &str) {
    let contest = contest();
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::All, |_, maze, _| maze == 1);
    let before = store.seal().expect("written");
    let error = merge(&mut store, path).expect_err(message);
    let shown = error.to_string();
    assert!(
        shown.starts_with(&format!("store `{}`: ", path.display())),
        "{shown}"
    );
    assert!(shown.contains(message), "{shown}");
    assert_eq!(store.content_digest().expect("read"), before, "{message}");
    assert_eq!(store.sealed().expect("read"), Some(before), "{message}");
}

#[test]
fn a_changed_shard_is_refused_by_name() {
    let contest = contest();
    // Ids are the places of mazes and robots, counted from 1.
    let change = |what: &str, maze: u32| {
        format!(
            "UPDATE match SET {what} WHERE maze = {maze} AND robot = 1 AND variant = 1 \
             AND seed = 6"
        )
    };
    let (_folder, path) = shard(&contest, KeptTranscripts::None, |maze| maze == 4);
    tamper(&path, &change("fuel_steps = 1", 5));
    check_refused(&path, "its content is not the one that was sealed");

    // Sealed again, and its transcripts say otherwise.
    let (_folder, path) = shard(&contest, KeptTranscripts::All, |maze| maze == 4);
    tamper(&path, &change("bumps = bumps + 1", 5));
    Store::open_existing(&path)
        .expect("a store")
        .seal()
        .expect("written");
    check_refused(
        &path,
        "robot `robot 1`, maze `gen:tree,loops=12:12:5`, seed 6: \
         the record does not follow from its transcript",
    );

    // Sealed again, without transcripts, and another shard says otherwise.
    let (_folder, path) = shard(&contest, KeptTranscripts::None, |maze| maze == 1);
    tamper(&path, &change("fuel_steps = 1", 2));
    Store::open_existing(&path)
        .expect("a store")
        .seal()
        .expect("written");
    check_refused(&path, "it has records that contradict those of `");
    check_refused(&path, "`: 1, the first: ");
    check_refused(
        &path,
        "the first: robot `robot 1`, maze `gen:tree,loops=12:12:2`, seed 6",
    );

    for (sql, message) in [
        ("UPDATE rules SET json = '{}'", "it is damaged: rules "),
        (
            "UPDATE engine SET name = 'x'",
            "engine `x` has another digest",
        ),
        (
            "UPDATE maze SET digest = randomblob(32)",
            "its walls have another digest",
        ),
        (
            "UPDATE oracle SET oracle_speed = oracle_speed - 1",
            "its oracle score is wrong",
        ),
        (
            "INSERT INTO generated SELECT generator, 'gen:tree,loops=12:12:99', maze FROM generated \
             LIMIT 1",
            "`gen:tree,loops=12:12:99` is another maze",
        ),
    ] {
        let (_folder, path) = shard(&contest, KeptTranscripts::None, |maze| maze == 4);
        tamper(&path, &format!("{sql}; DELETE FROM seal"));
        if let Ok(mut store) = Store::open_existing(&path) {
            // Whoever changes it may seal it again, if that is possible.
            let _ = store.seal();
        }
        let (_folder, mut store) = new_store();
        let from = Store::open_read_only(&path).expect("a store");
        let options = MergeOptions {
            require_seal: false,
        };
        let error = store.merge(&from, options).expect_err(sql);
        assert!(error.to_string().contains(message), "{sql}: {error}");
    }
}

#[test]
fn unsealed_conflicting_and_foreign_shards_are_refused() {
    let contest = contest();
    let (_folder, path) = shard(&contest, KeptTranscripts::None, |maze| maze == 4);
    contest.store(
        &mut Store::open_existing(&path).expect("a store"),
        KeptTranscripts::None,
        |_, maze, _| maze == 5,
    );
    check_refused(&path, "the contest that wrote it has not ended");

    let mut foreign = Contest::new(4, 6, SEEDS);
    foreign.engine = EngineId::new("wasmtime-other");
    let (_folder, path) = shard(&foreign, KeptTranscripts::None, |maze| maze == 4);
    check_refused(
        &path,
        "its matches were played with engine `wasmtime-other`, those of `",
    );

    let (_folder, path) = shard(&contest, KeptTranscripts::None, |maze| maze == 4);
    let record = contest.play(0, 0, 0).record;
    let json = serde_json::to_string(&record).expect("it serialises");
    tamper(
        &path,
        &format!("INSERT INTO conflict(record) VALUES('{json}')"),
    );
    check_refused(&path, "it has 1 conflicts of its own");

    let (_folder, mut store) = new_store();
    let itself = Store::open_read_only(store.path()).expect("a store");
    let error = store
        .merge(&itself, MergeOptions::default())
        .expect_err("itself");
    assert!(matches!(error.kind, StoreErrorKind::Itself), "{error}");
}

#[test]
fn unplayed_matches_and_histories_merge() {
    let contest = contest();
    let failure = |maze, reason: &str| MatchFailure {
        key: contest.keys().key(0, maze, 0),
        reason: reason.into(),
    };
    let store_with = |mazes: &[usize], failures: &[MatchFailure]| {
        let (folder, mut store) = new_store();
        let mut sink = StoreSink::new(
            &mut store,
            contest.engine.clone(),
            contest.rules.clone(),
            KeptTranscripts::None,
        )
        .expect("a sink");
        contest.play_into(&mut sink, |_, maze, _| mazes.contains(&maze));
        for failure in failures {
            sink.failed(failure).expect("the disk has room");
        }
        sink.finish().expect("the disk has room");
        (folder, store)
    };
    let (_left, mut left) = store_with(&[1], &[failure(2, "b"), failure(3, "b")]);
    let (_right, mut right) = store_with(&[2], &[failure(1, "a"), failure(3, "a")]);
    let [old, new] = [0, 1].map(|number| Submission {
        name: "a".into(),
        ..submissions(&contest)[number].clone()
    });
    left.submit(&[old.clone(), new.clone(), old.clone()])
        .expect("written");
    right.submit(&[old.clone(), new.clone()]).expect("written");
    let options = MergeOptions {
        require_seal: false,
    };
    left.merge(&right, options).expect("merged");
    right.merge(&left, options).expect("merged");
    for store in [&left, &right] {
        let unplayed = store.unplayed(&contest.keys()).expect("read");
        let [only] = &unplayed[..] else {
            panic!("{unplayed:?}")
        };
        assert_eq!((only.key, only.reason.raw()), (failure(3, "a").key, "a"));
        let all = store.submissions().expect("read");
        assert_eq!(all, [old.clone(), new.clone(), old.clone()]);
    }
    let digest = left.content_digest().expect("read");
    assert_eq!(right.content_digest().expect("read"), digest);
}
