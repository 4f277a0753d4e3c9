//! Replays round trip, and damaged ones are refused with the place.

use serde::Deserialize as _;
use serde_json::{Value, json};

use super::*;
use crate::Digest;
use crate::game::{Action, FaultKind, Phase, Ruleset};
use crate::journal::{Belief, Color, Journal, Level, Note};
use crate::maze::{Cell, Heading, Maze, Turn, Walls};
use crate::record::{MatchKey, MatchRecord, Transcript, Usage, replay};

/// A match of five steps in an open maze, with a journal.
fn parts() -> ReplayParts {
    let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
    let mut rules = Ruleset::default();
    rules.game.budget = 5;
    let mut transcript = Transcript::default();
    let drive = |turn, advance| Action::Move { turn, advance };
    let actions = [
        drive(Turn::Straight, 3),
        drive(Turn::Right, 100),
        Action::Reset,
        drive(Turn::Left, -1),
        drive(Turn::Left, 2),
    ];
    for action in actions {
        transcript.push(action);
    }
    with_transcript(maze, rules, transcript)
}

fn with_transcript(maze: Maze, rules: Ruleset, transcript: Transcript) -> ReplayParts {
    let mut journal = Journal::default();
    journal.clear(1_000);
    let cell = Cell::new(3, 4);
    let text = "\u{1b}[31m</script>\u{202e}".into();
    journal.push(
        0,
        Note::Log {
            level: Level::Warning,
            text,
        },
    );
    journal.push(
        1,
        Note::Paint {
            cell,
            color: Color::Violet,
        },
    );
    journal.push(1, Note::Label { cell, text });
    let side = Heading::Down;
    journal.push(
        5,
        Note::Wall {
            cell,
            side,
            belief: Belief::Closed,
        },
    );
    let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
    let key = MatchKey {
        engine: Digest::of(b"engine"),
        rules: rules.digest(),
        robot: Digest::of(b"robot"),
        variant: 3,
        maze: maze.digest(),
        seed: 7,
    };
    let usage = Usage {
        memory_bytes: 65_536,
        ..Usage::default()
    };
    ReplayParts {
        robot: "mouse:3".into(),
        maze_name: "hall".into(),
        record: MatchRecord::new(key, result, usage, &transcript),
        maze,
        rules,
        transcript,
        journal,
    }
}

fn json() -> Value {
    let replay = Replay::new(parts()).expect("it fits together");
    serde_json::to_value(&replay).expect("it serialises")
}

#[test]
fn a_replay_round_trips() {
    let replay = Replay::new(parts()).expect("it fits together");
    let text = serde_json::to_string(&replay).expect("it serialises");
    let read: Replay = serde_json::from_str(&text).expect("it is whole");
    assert_eq!(serde_json::to_string(&read).expect("it serialises"), text);
    assert_eq!(read.digest(), replay.digest());
    assert_eq!(read.trace(), replay.trace());
    assert!(
        read.parts()
            .journal
            .entries()
            .eq(replay.parts().journal.entries())
    );
}

#[test]
fn a_replay_of_a_fault_round_trips() {
    let ReplayParts { maze, rules, .. } = parts();
    let mut transcript = Transcript::default();
    transcript.end_with_fault(FaultKind::Panic, Phase::Start, "\u{7}".to_owned());
    let replay = Replay::new(with_transcript(maze, rules, transcript)).expect("it fits together");
    let text = serde_json::to_string(&replay).expect("it serialises");
    assert_eq!(
        serde_json::from_str::<Replay>(&text)
            .map(|it| it.digest())
            .ok(),
        Some(replay.digest())
    );
}

/// Other programs may store replays, so the form and the digest of version 1 never change.
#[test]
fn the_form_never_changes() {
    let json = json();
    let keys: Vec<&str> = json
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect();
    assert_eq!(
        keys,
        [
            "digest",
            "format",
            "journal",
            "maze",
            "record",
            "robot",
            "rules",
            "transcript",
            "version"
        ]
    );
    assert_eq!(json["maze"]["columns"][0], "3777777777 76".replace(' ', ""));
    assert_eq!(
        json["maze"]["goal"],
        json!({"x": 5, "y": 5, "width": 2, "height": 2})
    );
    assert_eq!(json["transcript"], "AQCFA2QALTA=");
    assert_eq!(
        json["journal"][3],
        json!({"note": "wall", "step": 5, "x": 3, "y": 4, "side": "down", "belief": "closed"})
    );
    assert_eq!(
        json["digest"],
        "f5920148b56d7d2d33da840e34c0ad0b4875df2a3355c119dfb0bf6e81d387e2"
    );
}

/// What is changed, and what the error says.
#[test]
fn damaged_replays_say_where_they_break() {
    #[track_caller]
    fn check(pointer: &str, value: Value, expected: &str) {
        let mut json = json();
        match json.pointer_mut(pointer) {
            Some(place) => *place = value,
            None => {
                let object = json.as_object_mut().expect("an object");
                object.insert(pointer.to_owned(), value);
            }
        }
        let error = Replay::deserialize(json).expect_err("it is damaged");
        assert!(error.to_string().contains(expected), "{pointer}: {error}");
    }
    check("/format", json!("replay"), "the format is not");
    check("/version", json!(2), "version 2 are not supported");
    check("/version", json!("1"), "invalid type");
    check(
        "/robot",
        json!("x".repeat(201)),
        "the name of the robot has more than 200",
    );
    check(
        "/maze/name",
        json!("x".repeat(201)),
        "the name of the maze has more than 200",
    );
    check("/robot", json!("mouse:2"), "the digest of the replay");
    check("/maze/name", json!("wall"), "the digest of the replay");
    check(
        "/maze/columns/3",
        json!("77"),
        "column 3 of the maze has 2 cells, and there are 12",
    );
    check(
        "/maze/columns",
        json!([]),
        "the cells are not those of a maze",
    );
    check(
        "/maze/columns/3",
        json!("7fffffffffxe"),
        "cell (3, 10) of the maze",
    );
    check(
        "/maze/columns/3",
        json!("7FFFFFFFFFFE"),
        "cell (3, 1) of the maze",
    );
    check(
        "/maze/columns/3",
        json!("ffffffffffff"),
        "the cells are not those of a maze",
    );
    check(
        "/maze/columns/3",
        json!("7fffffbfffff"),
        "the cells are not those of a maze",
    );
    check(
        "/maze/start/x",
        json!(12),
        "the cells are not those of a maze",
    );
    check("/maze/start/x", json!(1), "the digest of the maze");
    check(
        "/maze/goal/width",
        json!(0),
        "the cells are not those of a maze",
    );
    check("/maze/goal/width", json!(1), "the digest of the maze");
    check("/rules/game/budget", json!(6), "the digest of the rules");
    check(
        "/rules/name",
        json!("udacity-2"),
        "the digest of the replay",
    );
    check("/record/version", json!(9), "only version 2 is supported");
    check(
        "/record/key/seed",
        json!(8),
        "the id of a match does not match its key",
    );
    check("/record/steps/speed", json!(1), "disagree about the steps");
    check(
        "/record/counts/bumps",
        json!(9),
        "disagree about the counts",
    );
    check(
        "/record/verdict/goal_reached",
        json!(true),
        "disagree about the verdict",
    );
    check("/record/fuel/steps", json!(1), "the digest of the replay");
    check(
        "/record/journal/dropped",
        json!(1),
        "the digest of the replay",
    );
    check(
        "/record/transcript",
        json!("ab"),
        "64 lowercase hexadecimal digits",
    );
    check(
        "/transcript",
        json!("AQCF*2QALTA="),
        "character 4 of the transcript is not Base64",
    );
    check("/transcript", json!(""), "the transcript is truncated");
    check(
        "/transcript",
        json!("AgA="),
        "unsupported transcript version 2",
    );
    check("/transcript", json!("AQA="), "the digest of the transcript");
    check(
        "/journal/1/color",
        json!("purple"),
        "unknown variant `purple`",
    );
    check(
        "/journal/2/text",
        json!("other"),
        "the digest of the replay",
    );
    check("/journal/0/step", json!(-1), "invalid value");
    check("/journal", json!([]), "the digest of the replay");
    check("/digest", json!("0".repeat(64)), "the digest of the replay");
    check("more", json!(1), "unknown field `more`");
}

/// A transcript that its record agrees with still has to be one of a match.
#[test]
fn transcripts_that_end_elsewhere_are_refused() {
    #[track_caller]
    fn check(change: impl Fn(&mut Transcript), expected: &str) {
        let mut parts = parts();
        change(&mut parts.transcript);
        parts.record.transcript = parts.transcript.digest();
        let error = Replay::new(parts).expect_err("another match");
        assert_eq!(error.to_string(), expected);
    }
    check(
        |it| it.push(Action::Reset),
        "the transcript has actions after the end of the match, which is step 5",
    );
    check(
        |it| it.clear(),
        "the transcript ends after step 0, before the match does",
    );
    check(
        |it| it.end_with_fault(FaultKind::Panic, Phase::NextMove, String::new()),
        "the transcript has a fault after the end of the match",
    );
}

/// Every character of a file matters, or is space, or is the same after it was read.
#[test]
fn no_changed_byte_is_taken_for_the_same_replay() {
    let replay = Replay::new(parts()).expect("it fits together");
    let text = serde_json::to_string(&replay).expect("it serialises");
    let mut read = 0;
    for at in 0..text.len() {
        let mut bytes = text.clone().into_bytes();
        bytes[at] ^= 1;
        if let Ok(other) = serde_json::from_slice::<Replay>(&bytes) {
            read += 1;
            assert_eq!(
                serde_json::to_string(&other).ok(),
                Some(text.clone()),
                "byte {at}"
            );
        }
    }
    assert!(read < 20, "{read}");
    for length in 0..text.len() {
        assert!(serde_json::from_slice::<Replay>(&text.as_bytes()[..length]).is_err());
    }
}
