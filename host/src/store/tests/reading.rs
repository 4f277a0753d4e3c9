//! What a store says about a plan: missing matches, matrix, records in order, mazes.

use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::record::MatchRecord;

use super::super::sample::{Contest, new_store, robot};
use super::super::{KeptName, KeptTranscripts, MatchKeys, MatrixRequest, Store, Submission};
use crate::contest::{MatchFailure, MatrixRobot, ScoreMatrix, Seeds, Sink as _};

/// Seeds across the border at which their bits change sign.
const SEEDS: Seeds = Seeds {
    first: (1 << 63) - 2,
    count: 5,
};

/// Seeds after the largest of which the smallest comes.
const WRAPPING: Seeds = Seeds {
    first: u64::MAX - 1,
    count: 4,
};

fn is_third(player: usize, maze: usize, seed: u32) -> bool {
    (player + maze + seed as usize).is_multiple_of(3)
}

#[test]
fn what_is_missing_is_what_was_not_played() {
    for seeds in [SEEDS, WRAPPING] {
        let contest = Contest::new(5, 4, seeds);
        let (_folder, mut store) = new_store();
        let keys = contest.keys();
        assert_eq!(
            store.missing(&keys).expect("read").count(),
            5 * 4 * u64::from(seeds.count)
        );
        contest.store(&mut store, KeptTranscripts::None, is_third);
        let missing = store.missing(&keys).expect("read");
        let mut count = 0;
        for maze in 0..4 {
            for seed in 0..seeds.count {
                for player in 0..5 {
                    let key = keys.key(player, maze, seed);
                    let is_missing = !is_third(player, maze, seed);
                    assert_eq!(missing.contains(&key), is_missing);
                    assert_eq!(missing.get(player, maze, seed), is_missing);
                    count += u64::from(is_missing);
                }
            }
        }
        assert_eq!(missing.count(), count);
        contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
        let missing = store.missing(&keys).expect("read");
        assert_eq!(missing.count(), 0);
        assert!((0..4).all(|maze| !missing.has_maze(maze)));
    }
}

#[test]
fn what_is_listed_twice_is_missing_once() {
    let contest = Contest::new(2, 2, Seeds { first: 1, count: 3 });
    let (_folder, mut store) = new_store();
    let players = [contest.players[0], contest.players[1], contest.players[0]];
    let mazes = [contest.digests[0], contest.digests[1], contest.digests[0]];
    let keys = MatchKeys {
        players: &players,
        mazes: &mazes,
        ..contest.keys()
    };
    assert_eq!(store.missing(&keys).expect("read").count(), 12);
    contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
    assert_eq!(store.missing(&keys).expect("read").count(), 0);
    let mut count = 0;
    let visited = store.records(&keys, &mut |_| {
        count += 1;
        Ok(())
    });
    assert_eq!((visited.expect("read"), count), (12, 12));
}

#[test]
fn another_engine_or_other_rules_are_other_matches() {
    let contest = Contest::new(2, 2, Seeds { first: 1, count: 1 });
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
    let other = MatchKeys {
        engine: robot(7),
        ..contest.keys()
    };
    assert_eq!(store.missing(&other).expect("read").count(), 4);
    let other = MatchKeys {
        rules: robot(7),
        ..contest.keys()
    };
    let missing = store.missing(&other).expect("read");
    assert_eq!(missing.count(), 4);
    assert!(
        !missing.contains(&contest.keys().key(0, 0, 0)),
        "it is of another plan"
    );
}

#[test]
fn records_come_in_the_order_of_the_plan() {
    for seeds in [SEEDS, WRAPPING] {
        let contest = Contest::new(3, 3, seeds);
        let (_folder, mut store) = new_store();
        // Played in another order than planned.
        contest.store(&mut store, KeptTranscripts::None, |_, maze, _| maze == 2);
        contest.store(&mut store, KeptTranscripts::None, |player, _, _| {
            player != 1
        });
        let mut expected: Vec<MatchRecord> = Vec::new();
        for maze in 0..3 {
            for seed in 0..seeds.count {
                for player in [0, 1, 2] {
                    if maze == 2 || player != 1 {
                        expected.push(contest.play(player, maze, seed).record);
                    }
                }
            }
        }
        let mut read = Vec::new();
        let count = store.records(&contest.keys(), &mut |record| {
            read.push(record.clone());
            Ok(())
        });
        assert_eq!(count.expect("read"), expected.len() as u64);
        assert_eq!(read, expected);
    }
}

fn matrix_of(store: &Store, contest: &Contest) -> ScoreMatrix {
    let robots = contest.players.iter().enumerate();
    let robots = robots.map(|(place, &(digest, variant))| {
        MatrixRobot::new(format!("robot {place}"), digest, variant)
    });
    let mazes: Vec<_> = contest.digests.iter().map(|&it| (it, 0)).collect();
    let empty = ScoreMatrix::new(contest.rules.clone(), contest.seeds, Vec::new());
    let request = MatrixRequest {
        engine: contest.engine.digest(),
        rules: &contest.rules,
        robots: robots.collect(),
        mazes: &mazes,
        sets: empty.sets,
        seeds: contest.seeds,
    };
    store.matrix(request).expect("read")
}

#[test]
fn the_matrix_of_a_store_is_that_of_the_contest() {
    let contest = Contest::new(5, 6, SEEDS);
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::None, |_, maze, _| maze > 2);
    contest.store(&mut store, KeptTranscripts::None, |_, maze, _| maze <= 2);
    let matrix = matrix_of(&store, &contest);

    assert_eq!(matrix.played(), 5 * 6 * 5);
    let mut faults = 0;
    for (place, maze) in contest.mazes.iter().enumerate() {
        assert_eq!(matrix.mazes[place].name, maze.name);
        assert_eq!(matrix.mazes[place].digest, maze.digest);
        assert_eq!(matrix.mazes[place].oracle, maze.oracle);
        assert_eq!(matrix.mazes[place].dimension, 12);
    }
    for (place, robot) in matrix.robots.iter().enumerate() {
        let mut expected = MatrixRobot::new(robot.name.clone(), robot.digest, robot.variant);
        for maze in 0..6 {
            for seed in 0..5 {
                let record = contest.play(place, maze, seed).record;
                expected.count_fault(&record);
                let score = crate::contest::MatchScore::new(&record);
                assert_eq!(matrix.get(place, maze, seed), Some(&score));
            }
        }
        faults += expected.faults.len();
        assert_eq!(format!("{robot:?}"), format!("{expected:?}"));
    }
    assert!(faults > 3, "the sample has {faults} kinds of faults");
}

#[test]
fn unplayed_matches_are_counted_until_they_are_played() {
    let contest = Contest::new(2, 3, Seeds { first: 9, count: 2 });
    let (_folder, mut store) = new_store();
    let mut sink = super::super::StoreSink::new(
        &mut store,
        contest.engine.clone(),
        contest.rules.clone(),
        KeptTranscripts::None,
    )
    .expect("a sink");
    contest.play_into(&mut sink, |player, _, _| player == 0);
    for maze in [2, 0, 1] {
        let failure = MatchFailure {
            key: contest.keys().key(1, maze, 1),
            reason: format!("reason {}", maze % 2).into(),
        };
        match maze {
            1 => sink.failed(&failure).expect("the disk has room"),
            _ => sink.withdrawn(&failure).expect("the disk has room"),
        }
    }
    // One that was played is not unplayed.
    let failure = MatchFailure {
        key: contest.keys().key(0, 0, 0),
        reason: "too late".into(),
    };
    sink.failed(&failure).expect("the disk has room");
    sink.finish().expect("the disk has room");

    let unplayed = store.unplayed(&contest.keys()).expect("read");
    let reasons: Vec<_> = unplayed.iter().map(|it| it.reason.raw()).collect();
    assert_eq!(
        reasons,
        ["reason 0", "reason 1", "reason 0"],
        "in the order of the plan"
    );
    let matrix = matrix_of(&store, &contest);
    let counts: Vec<_> = matrix.robots[1].unplayed.clone().into_iter().collect();
    assert_eq!(counts, [("reason 0".into(), 2), ("reason 1".into(), 1)]);
    assert!(matrix.robots[0].unplayed.is_empty());

    contest.store(&mut store, KeptTranscripts::None, |_, maze, _| maze < 2);
    let unplayed = store.unplayed(&contest.keys()).expect("read");
    assert_eq!(unplayed.len(), 1);
    assert_eq!(unplayed[0].key, contest.keys().key(1, 2, 1));
}

#[test]
fn mazes_are_read_back_whether_generated_or_not() {
    let contest = Contest::new(1, 3, Seeds { first: 0, count: 1 });
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
    for maze in &contest.mazes {
        let stored = store
            .maze(&maze.digest)
            .expect("read")
            .expect("it was played");
        assert_eq!((&stored.name, &stored.maze), (&maze.name, &*maze.maze));
    }
    assert_eq!(store.maze(&robot(1)).expect("read"), None);
    let generated = store.generated_digests().expect("read");
    assert_eq!(generated.len(), 2, "the last one is a file");
    let spec: GenSpec = "gen:tree:12:1..=3".parse().expect("mazes");
    let found: Vec<_> = spec
        .expand()
        .map(|it| generated.get(&it).copied())
        .collect();
    assert_eq!(
        found,
        [Some(contest.digests[0]), Some(contest.digests[1]), None]
    );
}

#[test]
fn kept_matches_are_those_with_a_transcript() {
    let contest = Contest::new(3, 4, SEEDS);
    for kept in [
        KeptTranscripts::None,
        KeptTranscripts::Best,
        KeptTranscripts::All,
    ] {
        let (_folder, mut store) = new_store();
        contest.store(&mut store, kept, |_, _, _| true);
        let mut matches = Vec::new();
        let visited = store.kept_matches(&mut |_| true, &mut |found| {
            matches.push(found);
            true
        });
        visited.expect("read");
        let expected = match kept {
            KeptTranscripts::None => 0,
            KeptTranscripts::Best => 3,
            KeptTranscripts::All => 3 * 4 * 5,
        };
        assert_eq!(matches.len(), expected, "{kept:?}");
        for found in &matches {
            let key = &found.record.key;
            assert_eq!(
                store.record(key).expect("read").as_ref(),
                Some(&found.record)
            );
            assert_eq!(
                store.transcript(key).expect("read").as_ref(),
                Some(&found.transcript)
            );
            assert_eq!(found.maze.digest(), key.maze);
            assert_eq!(found.rules.digest(), key.rules);
            // Nobody has submitted these robots.
            assert_eq!(found.robot, key.robot.to_string()[..12]);
        }
    }
}

#[test]
fn kept_matches_are_found_by_name() {
    let contest = Contest::new(3, 4, SEEDS);
    let (_folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::All, |_, _, _| true);
    let submission = |name: &str, number| Submission {
        name: name.into(),
        author: None,
        class: None,
        robot: robot(number),
        variant: 0,
        rejection: None,
    };
    store
        .submit(&[submission("ann", 0), submission("bob", 1)])
        .expect("written");
    let mut found = Vec::new();
    let mut is_wanted = |name: KeptName<'_>| name.robot == "bob" && name.seed == SEEDS.first;
    let visited = store.kept_matches(&mut is_wanted, &mut |kept| {
        found.push((kept.robot, kept.record.key.robot));
        found.len() < 2
    });
    visited.expect("read");
    assert_eq!(found, vec![("bob".into(), robot(1)); 2]);
}
