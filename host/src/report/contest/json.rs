//! [`json()`]: the standings of a contest as a JSON document, for programs.
//!
//! Its JSON Schema is `host/schema/contest-report.schema.json`. It has no matches: those are in
//! JSON Lines and CSV. Averages are in thousandths, so that all numbers are integers.

use std::collections::BTreeMap;

use serde::Serialize;
use wasmouse_core::game::{FuelClass, Ruleset, Score};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::{EngineId, MatchRecord};
use wasmouse_core::{Digest, GuestText};

use super::document::{Compared, ContestReport};
use super::view::{Part, View};
use super::words::thousandths;
use crate::contest::{Method, NotAdmitted, RankingLine, RobotState, Seeds, TieBreak};
use crate::report::json::document;
use crate::report::paired::PairedNumbers;

/// The version of the document; raised when a reader of the old one would go wrong.
pub const REPORT_VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    name: &'a str,
    frozen: Option<&'a str>,
    wasmouse: &'static str,
    engine: &'a EngineId,
    rules: &'a Ruleset,
    fuel_class: Option<&'static str>,
    seeds: Seeds,
    scoring: ScoringEntry<'a>,
    matches: MatchCounts,
    results_digest: Option<Digest>,
    left_out: LeftOut,
    sets: Vec<SetEntry<'a>>,
    mazes: Vec<MazeEntry<'a>>,
    robots: Vec<RobotEntry<'a>>,
    rankings: Vec<RankingEntry<'a>>,
    comparisons: Vec<ComparisonEntry<'a>>,
}

#[derive(Serialize)]
struct ScoringEntry<'a> {
    method: Method,
    unfinished_steps: u32,
    tie_breaks: &'a [TieBreak],
}

#[derive(Serialize)]
struct MatchCounts {
    planned: u64,
    played: u64,
}

/// How many are not in the document.
#[derive(Serialize)]
struct LeftOut {
    robots: usize,
    mazes: usize,
    are_names_hidden: bool,
}

#[derive(Serialize)]
struct SetEntry<'a> {
    name: &'a str,
    is_hidden: bool,
    weight: u32,
}

#[derive(Serialize)]
struct MazeEntry<'a> {
    name: &'a GuestText,
    set: &'a str,
    digest: Digest,
    dimension: u8,
    oracle: Option<Score>,
}

#[derive(Serialize)]
struct RobotEntry<'a> {
    name: GuestStr<'a>,
    author: Option<GuestStr<'a>>,
    class: Option<GuestStr<'a>>,
    digest: Option<Digest>,
    variant: u32,
    state: &'static str,
    rejection: Option<Rejection<'a>>,
    failure: Option<&'a GuestText>,
    unplayed: Option<&'a BTreeMap<GuestText, u64>>,
    faults: Vec<FaultEntry<'a>>,
}

#[derive(Serialize)]
struct Rejection<'a> {
    kind: GuestStr<'a>,
    reason: Option<GuestText>,
    hint: GuestStr<'a>,
}

#[derive(Serialize)]
struct FaultEntry<'a> {
    kind: &'static str,
    matches: u64,
    first: Option<&'a MatchRecord>,
}

#[derive(Serialize)]
struct RankingEntry<'a> {
    set: Option<GuestStr<'a>>,
    class: Option<GuestStr<'a>>,
    mazes: u64,
    mazes_total: u64,
    mazes_unreachable: u64,
    partial: bool,
    lines: Vec<LineEntry<'a>>,
}

#[derive(Serialize)]
struct LineEntry<'a> {
    rank: Option<u32>,
    robot: GuestStr<'a>,
    value_thousandths: Option<i64>,
    matches: u64,
    finished: u64,
    budget_used_up: u64,
    goal_reached: u64,
    faults: u64,
    unplayed: u64,
    optimal_speed_runs: u64,
    finish_rate_thousandths: Option<i64>,
    mean_score_thousandths: Option<i64>,
    mean_finished_score_thousandths: Option<i64>,
    score_percentiles_thousandths: Option<PercentilesEntry>,
    rank_points_thousandths: Option<i64>,
    mean_regret_thousandths: Option<i64>,
    finished_regret_thousandths: Option<RegretEntry>,
    mean_exploration_steps_thousandths: Option<i64>,
    step_fuel_mean_thousandths: Option<i64>,
    step_fuel_max: u64,
    memory_bytes_max: u64,
}

#[derive(Serialize)]
struct PercentilesEntry {
    p10: i64,
    p25: i64,
    p50: i64,
    p75: i64,
    p90: i64,
}

#[derive(Serialize)]
struct RegretEntry {
    total: i64,
    exploration: i64,
    speed: i64,
}

#[derive(Serialize)]
struct ComparisonEntry<'a> {
    first: GuestStr<'a>,
    second: GuestStr<'a>,
    #[serde(flatten)]
    numbers: PairedNumbers,
}

/// The document, indented, with a newline at its end.
pub fn json(report: &ContestReport<'_>) -> String {
    let view = View::new(report);
    let matrix = report.matrix;
    document(&Document {
        version: REPORT_VERSION,
        name: report.name,
        frozen: report.options.frozen.as_deref(),
        wasmouse: env!("CARGO_PKG_VERSION"),
        engine: report.engine,
        rules: &matrix.rules,
        fuel_class: matrix.rules.fuel_class().map(FuelClass::name),
        seeds: matrix.seeds,
        scoring: ScoringEntry {
            method: report.scoring.method,
            unfinished_steps: report.overall.penalty_steps,
            tie_breaks: report.scoring.order(),
        },
        matches: MatchCounts {
            planned: report.matches_planned,
            played: view.matches_played(),
        },
        results_digest: report.results_digest,
        left_out: LeftOut {
            robots: view.robots_hidden(),
            mazes: view.mazes_hidden(),
            are_names_hidden: report.options.hide_names,
        },
        sets: matrix
            .sets
            .iter()
            .map(|set| SetEntry {
                name: &set.name,
                is_hidden: set.is_hidden,
                weight: set.weight,
            })
            .collect(),
        mazes: view
            .mazes
            .iter()
            .map(|&maze| {
                let maze = view.maze(maze);
                MazeEntry {
                    name: &maze.name,
                    set: &matrix.sets[maze.set].name,
                    digest: maze.digest,
                    dimension: maze.dimension,
                    oracle: maze.oracle,
                }
            })
            .collect(),
        robots: view.robots.iter().map(|&it| robot(&view, it)).collect(),
        rankings: view
            .parts()
            .iter()
            .map(|part| ranking(&view, part))
            .collect(),
        comparisons: view
            .comparisons()
            .into_iter()
            .map(|it| comparison(&view, it))
            .collect(),
    })
}

fn robot<'a>(view: &'a View<'a>, robot: usize) -> RobotEntry<'a> {
    let entry = view.robot(robot);
    let are_texts_shown = !view.report.options.hide_names;
    let (mut rejection, mut failure) = (None, None);
    match &entry.not_admitted {
        Some(NotAdmitted::Rejected(it)) => {
            rejection = Some(Rejection {
                kind: it.name(),
                reason: are_texts_shown.then(|| it.reason()),
                hint: it.hint(),
            });
        }
        Some(NotAdmitted::Failed(reason)) => failure = Some(reason),
        None => {}
    }
    RobotEntry {
        name: view.name(robot),
        author: view.author(robot),
        class: entry.class.as_ref().map(GuestStr::from),
        digest: view.digest(robot),
        variant: entry.variant,
        state: match view.line(robot).state {
            RobotState::Ranked => "ranked",
            RobotState::Incomplete => "incomplete",
            RobotState::NotStarted => "not-started",
            RobotState::NotAdmitted if rejection.is_some() => "rejected",
            RobotState::NotAdmitted => "not-admitted",
        },
        rejection,
        failure: failure.filter(|_| are_texts_shown),
        unplayed: are_texts_shown.then_some(&entry.unplayed),
        faults: entry
            .faults
            .iter()
            .map(|(kind, fault)| FaultEntry {
                kind,
                matches: fault.count,
                first: Some(&fault.first).filter(|first| {
                    are_texts_shown && view.maze_by_digest(&first.key.maze).is_some()
                }),
            })
            .collect(),
    }
}

fn ranking<'a>(view: &'a View<'a>, part: &Part<'a>) -> RankingEntry<'a> {
    RankingEntry {
        set: part.set,
        class: part.class,
        mazes: part.ranking.mazes,
        mazes_total: part.ranking.mazes_total,
        mazes_unreachable: part.ranking.mazes_unreachable,
        partial: part.ranking.partial,
        lines: part.lines.iter().map(|it| line(view, it)).collect(),
    }
}

fn comparison<'a>(view: &'a View<'a>, compared: &Compared) -> ComparisonEntry<'a> {
    ComparisonEntry {
        first: view.name(compared.first),
        second: view.name(compared.second),
        numbers: PairedNumbers::new(&compared.comparison),
    }
}

fn line<'a>(view: &'a View<'a>, line: &RankingLine) -> LineEntry<'a> {
    LineEntry {
        rank: line.rank,
        robot: view.name(line.robot),
        value_thousandths: thousandths(line.value),
        matches: line.matches,
        finished: line.finished,
        budget_used_up: line.budget_used_up,
        goal_reached: line.goal_reached,
        faults: line.faults,
        unplayed: line.unplayed,
        optimal_speed_runs: line.optimal_speed_runs,
        finish_rate_thousandths: thousandths(line.finish_rate),
        mean_score_thousandths: thousandths(line.mean_score),
        mean_finished_score_thousandths: thousandths(line.mean_finished_score),
        score_percentiles_thousandths: line.percentiles.map(|it| PercentilesEntry {
            p10: it.p10.thousandths(),
            p25: it.p25.thousandths(),
            p50: it.p50.thousandths(),
            p75: it.p75.thousandths(),
            p90: it.p90.thousandths(),
        }),
        rank_points_thousandths: thousandths(line.rank_points),
        mean_regret_thousandths: thousandths(line.mean_regret),
        finished_regret_thousandths: line.finished_regret.map(|it| RegretEntry {
            total: it.total.thousandths(),
            exploration: it.exploration.thousandths(),
            speed: it.speed.thousandths(),
        }),
        mean_exploration_steps_thousandths: thousandths(line.mean_exploration_steps),
        step_fuel_mean_thousandths: thousandths(line.step_fuel_mean),
        step_fuel_max: line.step_fuel_max,
        memory_bytes_max: line.memory_bytes_max,
    }
}
