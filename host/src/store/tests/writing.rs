//! Conflicts, transcripts and submissions.

use wasmouse_core::Digest;

use super::super::sample::{Contest, new_store, robot};
use super::super::{KeptTranscripts, Store, StoreError, StoreErrorKind, StoreSink, Submission};
use crate::contest::{RejectionEntry, Seeds, Sink as _};

const SEEDS: Seeds = Seeds { first: 3, count: 4 };

#[test]
fn a_record_that_differs_is_kept_and_ends_the_contest() {
    let contest = Contest::new(3, 2, SEEDS);
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::All, |_, _, _| true);
    let name = Submission {
        name: "flood".into(),
        author: None,
        class: None,
        robot: contest.players[1].0,
        variant: contest.players[1].1,
        rejection: None,
    };
    store.submit(&[name]).expect("written");
    let (engine, rules) = (contest.engine.clone(), contest.rules.clone());
    let mut sink = StoreSink::new(&mut store, engine, rules, KeptTranscripts::All).expect("a sink");
    let mut other = contest.play(1, 1, 2);
    other.record.fuel.steps += 1;
    sink.maze(&contest.mazes[1]).expect("not written yet");
    sink.played(&contest.play(0, 1, 0))
        .expect("not written yet");
    sink.played(&other).expect("not written yet");
    let error = sink.finish().expect_err("a conflict");
    let message = error.to_string();
    assert!(
        message.contains("robot `flood`, maze `a file`, seed 5, address "),
        "{message}"
    );
    assert!(matches!(error.kind, StoreErrorKind::Conflict { .. }));
    assert_eq!(store.conflicts().expect("read"), [other.record.clone()]);
    let first = store.record(&other.record.key).expect("read");
    assert_eq!(
        first,
        Some(contest.play(1, 1, 2).record),
        "the first one stays"
    );
}

#[test]
fn records_of_another_contest_are_refused() {
    let contest = Contest::new(1, 1, SEEDS);
    let (_folder, mut store) = new_store();
    let (engine, mut rules) = (contest.engine.clone(), contest.rules.clone());
    rules.game.budget += 1;
    let mut sink =
        StoreSink::new(&mut store, engine, rules, KeptTranscripts::None).expect("a sink");
    sink.maze(&contest.mazes[0]).expect("not written yet");
    let error = sink
        .played(&contest.play(0, 0, 0))
        .expect_err("other rules");
    let error = StoreError::of_sink(&error).expect("a store error");
    assert!(error.to_string().contains("other rules"), "{error}");
}

#[test]
fn what_arrived_is_written_when_the_sink_is_dropped() {
    let contest = Contest::new(2, 2, SEEDS);
    let (_folder, mut store) = new_store();
    let (engine, rules) = (contest.engine.clone(), contest.rules.clone());
    let mut sink =
        StoreSink::new(&mut store, engine, rules, KeptTranscripts::None).expect("a sink");
    contest.play_into(&mut sink, |_, _, _| true);
    drop(sink);
    assert_eq!(store.missing(&contest.keys()).expect("read").count(), 0);
}

#[test]
fn references_are_checked_again_when_the_sink_is_gone() {
    let contest = Contest::new(1, 1, SEEDS);
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
    let written = store.write(|transaction| {
        let sql = "INSERT INTO generated(generator, name, maze) VALUES('a', 'b', 77)";
        Ok(transaction.execute(sql, [])?)
    });
    let error = written.expect_err("there is no such maze").to_string();
    assert!(error.contains("FOREIGN KEY"), "{error}");
}

/// The keys whose transcripts a store has.
fn kept(store: &Store, contest: &Contest) -> Vec<Digest> {
    let mut kept = Vec::new();
    for maze in 0..contest.mazes.len() {
        for seed in 0..contest.seeds.count {
            for player in 0..contest.players.len() {
                let played = contest.play(player, maze, seed);
                let stored = store.transcript(&played.record.key).expect("read");
                if let Some(stored) = stored {
                    assert_eq!(stored, played.transcript);
                    kept.push(played.record.key.digest());
                }
            }
        }
    }
    kept
}

#[test]
fn all_transcripts_are_kept_or_none() {
    let contest = Contest::new(3, 3, SEEDS);
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
    assert_eq!(kept(&store, &contest), []);
    contest.store(&mut store, KeptTranscripts::All, |_, _, _| true);
    assert_eq!(kept(&store, &contest).len(), 3 * 3 * 4);
}

#[test]
fn the_best_match_does_not_depend_on_the_order() {
    let contest = Contest::new(4, 4, SEEDS);
    let (_folder, mut forward) = new_store();
    contest.store(&mut forward, KeptTranscripts::Best, |_, _, _| true);
    let (_other, mut backward) = new_store();
    for maze in (0..4).rev() {
        contest.store(&mut backward, KeptTranscripts::Best, |_, it, _| it == maze);
    }
    let best = kept(&forward, &contest);
    assert_eq!(best.len(), 4, "one for each player");
    assert_eq!(kept(&backward, &contest), best);
    for &(robot, variant) in &contest.players {
        let engine = contest.engine.digest();
        let found = forward.best_match(&engine, &contest.rules, &robot, variant);
        let (record, transcript) = found.expect("read").expect("it played");
        assert!(best.contains(&record.key.digest()));
        assert_eq!(transcript.digest(), record.transcript);
    }
}

fn submission(name: &str, number: u32) -> Submission {
    Submission {
        name: name.into(),
        author: (number > 1).then(|| "an \u{1b} author".into()),
        class: (number > 2).then(|| "light".into()),
        robot: robot(number),
        variant: number,
        rejection: (number > 3).then(|| RejectionEntry {
            kind: "too-large".into(),
            reason: "a reason".into(),
            hint: "a hint".into(),
        }),
    }
}

#[test]
fn submissions_supersede_and_stay() {
    let (_folder, mut store) = new_store();
    let first = [submission("a", 1), submission("b", 2)];
    assert_eq!(store.submit(&first).expect("written"), 2);
    assert_eq!(store.submit(&first).expect("written"), 0, "nothing is new");
    let second = [submission("b", 3), submission("c", 4), submission("a", 1)];
    assert_eq!(store.submit(&second).expect("written"), 2);
    let back = [submission("b", 2)];
    assert_eq!(
        store.submit(&back).expect("written"),
        1,
        "an old file again"
    );
    let all = store.submissions().expect("read");
    let [a, b2, b3, c] = [
        submission("a", 1),
        submission("b", 2),
        submission("b", 3),
        submission("c", 4),
    ];
    assert_eq!(all, [a.clone(), b2.clone(), b3, c.clone(), b2.clone()]);
    assert_eq!(store.current_submissions().expect("read"), [a, b2, c]);
}
