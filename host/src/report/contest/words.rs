//! Words about a contest that several formats share.

use wasmouse_core::game::{BudgetScope, Ruleset};
use wasmouse_core::{GuestText, guest_text};

use super::document::Compared;
use super::view::{FaultLine, Part, Unranked, View};
use crate::contest::{
    MatchScore, Mean, Method, Outcome, PairedVerdict, RankingLine, Scoring, Seeds, TieBreak,
};
use crate::report::number::{counted, grouped};

/// What is shown where there is no value.
pub(super) const NONE: &str = "-";

/// What the value is called that robots are ranked by.
pub(super) const fn value_title(method: Method) -> &'static str {
    match method {
        Method::MeanScore => "Mean score",
        Method::Regret => "Mean regret",
        Method::RankPoints => "Points",
    }
}

/// How robots are ranked, as sentences.
pub(super) fn ranked_by(scoring: &Scoring, penalty_steps: u32) -> String {
    let unfinished = format!("an unfinished match counts as {penalty_steps} steps");
    let method = match scoring.method {
        Method::MeanScore => format!("Ranked by mean score (lower is better); {unfinished}."),
        Method::Regret => format!(
            "Ranked by mean regret (lower is better): score minus the score of a robot that \
             knows the maze; {unfinished}."
        ),
        Method::RankPoints => "Ranked by points (higher is better): one for each robot that did \
                               worse in the same match, half a point for each that did equally \
                               well."
            .to_owned(),
    };
    let ties: Vec<&str> = scoring.order().iter().map(|&it| tie_break(it)).collect();
    format!("{method} Ties: {}.", ties.join(", then "))
}

const fn tie_break(tie_break: TieBreak) -> &'static str {
    match tie_break {
        TieBreak::Finished => "more finished matches",
        TieBreak::MedianScore => "the lower median score",
        TieBreak::ExplorationSteps => "fewer exploration steps",
        TieBreak::Fuel => "less fuel per step",
        TieBreak::Memory => "less memory",
    }
}

/// What a score is under these rules.
pub(super) fn scored_by(rules: &Ruleset) -> String {
    let game = &rules.game;
    let budget = match game.budget_scope {
        BudgetScope::BothRuns => format!("{} steps for both runs", game.budget),
        BudgetScope::EachRun => format!("{} steps for each run", game.budget),
    };
    format!(
        "Score: steps of the speed run, plus steps of the exploration run divided by {}. \
         Budget: {budget}; longest move: {} cells; {}.",
        game.exploration_divisor,
        game.longest_move,
        fuel(rules)
    )
}

/// How much fuel robots have under these rules: `fuel class interpreted (200,000,000,000 a match)`.
pub(super) fn fuel(rules: &Ruleset) -> String {
    let most = grouped(rules.sandbox.match_fuel_max);
    match rules.fuel_class() {
        Some(class) => format!("fuel class {} ({most} a match)", class.name()),
        None => format!("fuel: {most} a match"),
    }
}

/// What a ranking is about: `Overall`, `Set hidden`, `Class small`.
pub(super) fn part_title(part: &Part<'_>) -> GuestText {
    match (part.set, part.class) {
        (Some(set), _) => guest_text!("Set {}", set),
        (_, Some(class)) => guest_text!("Class {}", class),
        _ => "Overall".into(),
    }
}

/// Over which mazes a ranking is.
pub(super) fn scope(part: &Part<'_>) -> String {
    let ranking = part.ranking;
    let (mazes, total) = (ranking.mazes, ranking.mazes_total);
    let mut scope = if ranking.partial {
        format!(
            "partial: ranked over {mazes} of {} that every robot has played",
            counted(total, "maze")
        )
    } else {
        format!("ranked over {}", counted(mazes, "maze"))
    };
    if ranking.mazes_unreachable > 0 {
        let unreachable = counted(ranking.mazes_unreachable, "maze");
        scope.push_str(&format!(
            "; {unreachable} without a path to the goal left out"
        ));
    }
    scope
}

/// What is not shown, as sentences; empty if everything is.
pub(super) fn left_out(view: &View<'_>) -> Vec<String> {
    let options = &view.report.options;
    let mut sentences = Vec::new();
    if let Some(since) = &options.frozen {
        sentences.push(format!("The standings are frozen ({since})."));
    }
    if view.robots_hidden() > 0 {
        let (top, robots) = (options.show_top.unwrap_or(0), view.robots_hidden() as u64);
        sentences.push(format!(
            "Only the top {top} are shown; {} not.",
            are(robots, "robot")
        ));
    }
    if options.hide_names {
        sentences
            .push("Robots are called by the beginning of the SHA-256 of their files.".to_owned());
    }
    if view.mazes_hidden() > 0 {
        let mazes = are(view.mazes_hidden() as u64, "hidden maze");
        sentences.push(format!("{mazes} not shown, but their scores count."));
    }
    sentences
}

/// `1 robot is`, `2 robots are`.
fn are(number: u64, thing: &str) -> String {
    let verb = if number == 1 { "is" } else { "are" };
    format!("{} {verb}", counted(number, thing))
}

/// How many matches are missing, as a sentence; `None` if everything was played.
pub(super) fn missing(view: &View<'_>) -> Option<String> {
    let planned = view.report.matches_planned;
    let missing = planned.saturating_sub(view.matches_played());
    (missing > 0).then(|| {
        let verb = if missing == 1 { "was" } else { "were" };
        format!(
            "Incomplete: {missing} of {} {verb} not played.",
            counted(planned, "match")
        )
    })
}

/// Why a robot has no rank, as a sentence after its name, with line breaks left out.
pub(super) fn unranked(unranked: &Unranked<'_>) -> GuestText {
    let mut text = GuestText::from(unranked.state);
    if let Some((reason, hint)) = &unranked.rejection {
        text.push(&guest_text!(": {} (hint: {})", reason, *hint));
    }
    for (index, (reason, count_of)) in unranked.reasons.iter().enumerate() {
        text.push(if index == 0 { ": " } else { "; " });
        text.push(*reason);
        if let Some(number) = count_of {
            text.push(&format!(" ({} not played)", counted(*number, "match")));
        }
    }
    text
}

/// A kind of fault of a robot, as a sentence after its name.
pub(super) fn fault(line: &FaultLine<'_>) -> GuestText {
    let (kind, count, matches) = (line.kind, line.count, line.matches);
    let mut text = guest_text!("{} in {} of {}", kind, count, counted(matches, "match"));
    match &line.first {
        None => text.push(", first in a hidden maze"),
        Some(first) => {
            text.push(&guest_text!(
                ", first in {}, seed {}",
                first.maze,
                first.seed
            ));
            if let Some(detail) = &first.detail {
                text.push(&guest_text!(": {}", detail));
            }
        }
    }
    text
}

/// What came of a comparison, as a sentence.
pub(super) fn comparison(view: &View<'_>, compared: &Compared) -> GuestText {
    let it = &compared.comparison;
    let (first, second) = (view.name(compared.first), view.name(compared.second));
    if it.wins + it.losses == 0 {
        return guest_text!(
            "{} and {} scored equally in every maze ({})",
            first,
            second,
            counted(it.mazes, "maze")
        );
    }
    let thousandths = |value: i64| Mean::fraction(value.into(), 1000).to_string();
    let difference = it.difference.map(Mean::thousandths);
    let interval = it.interval_thousandths;
    let interval_of = |[low, high]: [i64; 2]| {
        format!(
            " (95 % interval {} to {})",
            thousandths(low),
            thousandths(high)
        )
    };
    let (head, interval) = match (it.verdict, difference) {
        (PairedVerdict::Better, Some(difference)) => (
            guest_text!(
                "{} is better than {} by {} steps",
                first,
                second,
                thousandths(-difference)
            ),
            interval.map(|[low, high]| interval_of([-high, -low])),
        ),
        (PairedVerdict::Worse, Some(difference)) => (
            guest_text!(
                "{} is worse than {} by {} steps",
                first,
                second,
                thousandths(difference)
            ),
            interval.map(interval_of),
        ),
        _ => (
            guest_text!(
                "{} and {}: undecided, mean difference {}",
                first,
                second,
                mean(it.difference)
            ),
            interval.map(interval_of),
        ),
    };
    let (wins, ties, losses) = (it.wins, it.ties, it.losses);
    let mut text = guest_text!("{}{}", head, interval.unwrap_or_default());
    text.push(&format!(
        ", in {}: {wins} better, {ties} equal, {losses} worse",
        counted(it.mazes, "maze")
    ));
    if let (PairedVerdict::Undecided, Some(mazes)) = (it.verdict, it.mazes_to_decide) {
        text.push(&format!("; about {} would decide", counted(mazes, "maze")));
    }
    text
}

/// An average with three decimals.
pub(super) fn mean(mean: Option<Mean>) -> String {
    mean.map_or_else(|| NONE.to_owned(), |mean| mean.to_string())
}

/// An average in thousandths.
pub(super) fn thousandths(mean: Option<Mean>) -> Option<i64> {
    mean.map(Mean::thousandths)
}

/// A share in percent, rounded down, so that only everything is 100 %.
pub(super) fn percent(share: Option<Mean>) -> String {
    share.map_or_else(
        || NONE.to_owned(),
        |share| format!("{} %", share.times(100).thousandths().div_euclid(1000)),
    )
}

/// The rank of a line.
pub(super) fn rank(line: &RankingLine) -> String {
    line.rank
        .map_or_else(|| NONE.to_owned(), |rank| rank.to_string())
}

/// How a match ended, in a word for tables of many matches.
pub(super) const fn outcome(score: &MatchScore) -> &'static str {
    match score.outcome {
        Outcome::Finished => "finished",
        Outcome::BudgetUsedUp { goal_reached: true } => "budget used up, goal reached",
        Outcome::BudgetUsedUp { .. } => "budget used up",
        Outcome::Fault(_) => "fault",
    }
}

/// An average to the nearest whole number.
pub(super) fn whole(mean: Option<Mean>) -> String {
    mean.map_or_else(
        || NONE.to_owned(),
        |mean| ((mean.thousandths() + 500).div_euclid(1000)).to_string(),
    )
}

/// The seeds of every maze: `seed 0`, `seeds 0 to 4`.
pub(super) fn seeds(seeds: Seeds) -> String {
    match seeds.count {
        0 | 1 => format!("seed {}", seeds.first),
        count => format!("seeds {} to {}", seeds.first, seeds.get(count - 1)),
    }
}
