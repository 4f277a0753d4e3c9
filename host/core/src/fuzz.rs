//! Fuzz targets: whatever bytes come, nothing panics, and what is accepted is consistent.
//!
//! Each target is an ordinary test, run by `fuzz-harness`, and a libFuzzer target in
//! `tests/fuzz`. Only a build for libFuzzer (`--cfg fuzzing`) makes this module public.

use std::sync::LazyLock;

use serde_json::{from_slice, to_string};

use crate::Digest;
use crate::game::{BudgetScope, GameRules, Ruleset, Verdict};
use crate::maze::format::{Format, parse, parse_as, print};
use crate::maze::generate::GenSpec;
use crate::maze::{Area, Cell, Maze, Survey, Walls, oracle_steps, violations};
use crate::record::{MatchKey, MatchRecord, Transcript, replay, trace};

/// Solving a large maze takes most of the time of a case and reaches no more code.
const SOLVED_DIMENSION_MAX: u8 = 12;

/// Maze files in every format, and identity bytes. Returns whether it is a maze.
pub fn maze(bytes: &[u8]) -> bool {
    if let Some(maze) = Maze::from_identity_bytes(bytes) {
        assert_eq!(maze.identity_bytes(), bytes, "identity bytes are canonical");
        check_maze(&maze);
        return true;
    }
    let Ok(text) = std::str::from_utf8(bytes) else {
        return false;
    };
    let recognized = parse(text);
    match &recognized {
        Ok(parsed) => {
            let again = parse_as(text, parsed.format);
            assert_eq!(again.as_ref(), Ok(parsed), "the format is no guess");
        }
        Err(error) => {
            let message = error.to_string();
            assert!(!message.chars().any(char::is_control), "{message:?}");
        }
    }
    let mut mazes = Format::ALL
        .into_iter()
        .filter_map(|format| parse_as(text, format).ok());
    mazes.by_ref().for_each(|parsed| check_maze(&parsed.maze));
    recognized.is_ok()
}

/// A maze survives every format that can hold it, and can be judged and solved.
fn check_maze(maze: &Maze) {
    let is_usual = maze.start() == Cell::new(0, 0) && maze.goal() == Area::center(maze.dimension());
    for format in Format::ALL {
        match print(maze, format) {
            Ok(text) => {
                let parsed = parse(&text).expect("a printed maze is a maze");
                assert_eq!(parsed.maze, *maze, "as {format}");
                assert_eq!(parsed.format, format, "a printed format is recognized");
            }
            Err(error) => {
                let has_marks = format == Format::Competition;
                assert!(!is_usual && !has_marks, "as {format}: {error}");
            }
        }
    }
    let identity = Maze::from_identity_bytes(&maze.identity_bytes());
    assert_eq!(identity.as_ref(), Some(maze), "identity bytes");
    for violation in violations(maze) {
        assert!(!violation.to_string().is_empty());
    }
    let mut survey = Survey::default();
    survey.add(maze);
    if maze.dimension() <= SOLVED_DIMENSION_MAX {
        let is_solvable = oracle_steps(maze, 3).is_some();
        assert_eq!(survey.solvable == 1, is_solvable, "survey and solver agree");
    }
}

/// Specifications of generated mazes, and the names of formats and rulesets. Returns whether
/// it is one.
pub fn specification(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return false;
    };
    if let Some(rules) = Ruleset::by_name(text) {
        assert_eq!(rules.name, text);
        return true;
    }
    if let Ok(format) = text.parse::<Format>() {
        assert_eq!(format.name(), text);
        return true;
    }
    let Ok(spec) = text.parse::<GenSpec>() else {
        return false;
    };
    assert_eq!(spec.to_string().parse().as_ref(), Ok(&spec), "printed");
    let first = spec.expand().next().expect("at least one maze");
    let alone: GenSpec = first.to_string().parse().expect("a maze has a name");
    assert_eq!(alone.count(), 1, "{first}");
    let again = alone.expand().next().expect("one maze");
    assert_eq!(again.generate(), first.generate(), "{first}");
    true
}

/// Encoded transcripts after a byte that chooses the maze and the rules. Returns whether it is
/// a transcript.
pub fn transcript(bytes: &[u8]) -> bool {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return false;
    };
    let Ok(transcript) = Transcript::from_bytes(bytes) else {
        return false;
    };
    assert_eq!(transcript.to_bytes(), bytes, "the encoding is canonical");
    assert_eq!(transcript.digest(), Digest::of(bytes));
    let (maze, rules) = game(choice);
    let replayed = replay(maze, &rules, &transcript);
    let traced = trace(maze, &rules, &transcript);
    let Ok((result, trace)) = traced else {
        assert_eq!(replayed.err(), traced.err());
        return true;
    };
    assert_eq!(replayed.as_ref(), Ok(&result), "with and without a trace");
    assert_eq!(transcript.actions().count(), trace.steps().len());
    assert_eq!(result.steps.total() as usize, trace.steps().len());
    let counted = match rules.budget_scope {
        BudgetScope::BothRuns => result.steps.total(),
        BudgetScope::EachRun => result.steps.exploration.max(result.steps.speed),
    };
    assert!(counted <= rules.budget, "more steps than the budget");
    if let Verdict::Finished { score } = result.verdict {
        let steps = result.steps;
        assert_eq!(score, rules.score(steps.speed, steps.exploration));
        let floor = rules.oracle_score(maze).expect("the goal was reached");
        assert!(floor <= score, "better than the optimum");
    }
    true
}

/// Mazes without walls, without openings and with corridors; every kind of rules.
fn game(choice: u8) -> (&'static Maze, GameRules) {
    static MAZES: LazyLock<[Maze; 4]> = LazyLock::new(|| {
        let spec: GenSpec = "gen:braid:12:1".parse().expect("a specification");
        let generated = spec.expand().next().expect("one maze").generate();
        let walls = [Walls::open(3), Walls::open(64), Walls::closed(12)];
        let [small, large, closed] =
            walls.map(|walls| Maze::contest(walls).expect("start and goal fit"));
        [small, large, closed, generated]
    });
    let maze = &MAZES[usize::from(choice % 4)];
    let rules = GameRules {
        budget: [1, 5, 40, u32::MAX][usize::from(choice / 4 % 4)],
        budget_scope: match choice / 16 % 2 {
            0 => BudgetScope::BothRuns,
            _ => BudgetScope::EachRun,
        },
        longest_move: [1, 3, u8::MAX][usize::from(choice / 32 % 3)],
        ..GameRules::default()
    };
    (maze, rules)
}

/// Keys and records of matches in JSON. Returns whether it is one.
pub fn record(bytes: &[u8]) -> bool {
    if let Ok(key) = from_slice::<MatchKey>(bytes) {
        let json = to_string(&key).expect("a key serialises");
        let again: MatchKey = from_slice(json.as_bytes()).expect("a written key is read");
        assert_eq!(again, key);
        return true;
    }
    let Ok(record) = from_slice::<MatchRecord>(bytes) else {
        return false;
    };
    let json = to_string(&record).expect("a record serialises");
    let again: MatchRecord = from_slice(json.as_bytes()).expect("a written record is read");
    // Scores are compared by value, so the text is compared too.
    assert_eq!(again, record);
    assert_eq!(to_string(&again).expect("a record serialises"), json);
    assert!(record.steps.total() >= record.steps.speed, "no overflow");
    assert!(!record.verdict.title().is_empty());
    if let Some(score) = record.verdict.score() {
        assert!(!score.to_string().is_empty());
    }
    if let Some(fault) = record.verdict.fault() {
        let described = fault.describe();
        assert!(described.raw().contains(fault.detail.raw()));
    }
    true
}

#[cfg(test)]
mod tests {
    use fuzz_harness::Target;

    use super::*;
    use crate::game::{Action, FaultKind, Phase, Run, Steps};
    use crate::maze::{Turn, bundled};
    use crate::record::{EngineId, Usage};

    #[test]
    fn maze() {
        Target {
            name: "maze",
            run: super::maze,
            seeds: maze_seeds,
            words: &[
                b"o---o",
                b"+---+",
                b"+   +",
                b"| S |",
                b"| G |",
                b"\r\n",
                b"\n",
                b" 0 ",
                b"12\n",
                b"64\n",
                b"11111\n",
                b"\xef\xbb\xbf",
                b"\xc3\xa9",
                b"\x1b",
            ],
            bytes_max: 16 << 10,
            cases: 600,
        }
        .check();
    }

    /// Small mazes, a bundled and a generated one, in every format and as identity bytes.
    fn maze_seeds() -> Vec<Vec<u8>> {
        let small = parse("3\n3,5,6\n10,1,14\n9,5,12\n").expect("a maze").maze;
        let moved = {
            let goal = Area::new(Cell::new(2, 0), 1, 2).expect("not empty");
            Maze::new(small.walls().clone(), Cell::new(0, 1), goal).expect("they fit")
        };
        let spec: GenSpec = "gen:braid:12:1".parse().expect("a specification");
        let generated = spec.expand().next().expect("one maze").generate();
        let known = parse(bundled()[0].text).expect("a maze").maze;
        let mut seeds = Vec::new();
        for maze in [&small, &moved, &small, &moved, &generated, &known] {
            let texts = Format::ALL.into_iter();
            let texts = texts.filter_map(|format| print(maze, format).ok());
            seeds.extend(texts.map(String::into_bytes));
            seeds.push(maze.identity_bytes());
        }
        seeds
    }

    #[test]
    fn specification() {
        Target {
            name: "specification",
            run: super::specification,
            seeds: || {
                let texts = [
                    "gen:braid:12:1",
                    "gen:tree,loops=15:12..=20:1..=100",
                    "gen:division:14:7",
                    "gen:stretches:16:0..=3",
                    "udacity-each-run",
                    "competition",
                ];
                texts.map(|text| text.as_bytes().to_vec()).to_vec()
            },
            words: &[
                b"gen:",
                b"tree",
                b",loops=",
                b"braid",
                b"division",
                b"..=",
                b":",
                b"12",
                b"20",
                b"100",
            ],
            bytes_max: 256,
            cases: 2_000,
        }
        .check();
    }

    #[test]
    fn transcript() {
        Target {
            name: "transcript",
            run: super::transcript,
            seeds: transcript_seeds,
            words: &[&[0], &[1, 127], &[3, 128], &[1, 0]],
            bytes_max: 4 << 10,
            cases: 4_000,
        }
        .check();
    }

    fn transcript_seeds() -> Vec<Vec<u8>> {
        let straight = |advance| Action::Move {
            turn: Turn::Straight,
            advance,
        };
        let mut seeds = Vec::new();
        // All choices of `game`, so that a flipped bit is not needed to reach one.
        for choice in 0..96 {
            let mut transcript = Transcript::default();
            for action in [straight(3), Action::Reset, straight(-128), straight(41)] {
                transcript.push(action);
            }
            if choice % 2 == 0 {
                let detail = "executed `unreachable`".to_owned();
                transcript.end_with_fault(FaultKind::Unreachable, Phase::NextMove, detail);
            }
            seeds.push([vec![choice], transcript.to_bytes()].concat());
        }
        seeds
    }

    #[test]
    fn record() {
        Target {
            name: "record",
            run: super::record,
            seeds: record_seeds,
            words: &[
                b"0",
                b"-1",
                b"4294967295",
                b"18446744073709551615",
                b"1e999",
                b"null",
                b"{}",
                b"\"\"",
                b"\\u0000",
                b"\\ud800",
                b"\"finished\"",
                b"\"seed\"",
            ],
            bytes_max: 4 << 10,
            cases: 4_000,
        }
        .check();
    }

    fn record_seeds() -> Vec<Vec<u8>> {
        let key = MatchKey {
            engine: EngineId::new("wasmtime").digest(),
            rules: Ruleset::default().digest(),
            robot: Digest::of(b"robot"),
            variant: 1,
            maze: Digest::of(b"maze"),
            seed: 2,
        };
        let mut seeds = vec![to_string(&key).expect("it serialises").into_bytes()];
        let (maze, rules) = game(0b0111);
        let mut transcript = Transcript::default();
        transcript.push(Action::Reset);
        transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, "panicked");
        let result = replay(maze, &rules, &transcript).expect("a possible match");
        let fault = result.verdict.fault().expect("a fault");
        assert_eq!(fault.run, Run::Exploration);
        let verdicts = [
            result.verdict.clone(),
            Verdict::BudgetUsedUp { goal_reached: true },
            Verdict::Finished {
                score: rules.score(17, 110),
            },
        ];
        for verdict in verdicts {
            let usage = Usage::default();
            let mut record = MatchRecord::new(key, result.clone(), usage, &transcript);
            record.verdict = verdict;
            seeds.push(to_string(&record).expect("it serialises").into_bytes());
            record.steps = Steps {
                exploration: u32::MAX,
                speed: u32::MAX,
            };
            seeds.push(to_string(&record).expect("it serialises").into_bytes());
        }
        seeds
    }
}
