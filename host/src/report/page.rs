//! A contest as one self-contained web page: standings, pictures, every match.
//!
//! No scripts and nothing loaded from elsewhere; readable in light and dark, and
//! without colours. Names and fault texts may come from strangers: maud escapes
//! them, and [`visible`] shows what the eye would not see.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::visible;
use crate::contest::{Contest, MatchResult, Mean, Standing};
use crate::robot::{Verdict, engine_id};

/// A match with its picture.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// Index into the results.
    pub result: usize,
    /// The picture as an SVG element.
    pub svg: String,
}

const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin-bottom: 0; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { padding: .25rem .75rem; text-align: right; border-bottom: 1px solid color-mix(in srgb, currentColor 20%, transparent); }
th.name, td.name { text-align: left; }
.scroll { overflow-x: auto; }
.portraits { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem; }
figure { margin: 0; }
figure svg { width: 100%; height: auto; }
.quiet { opacity: .75; }
code { font-size: .85em; overflow-wrap: anywhere; }
";

/// The page.
pub fn page(
    contest: &Contest,
    results: &[MatchResult],
    standings: &[Standing],
    portraits: &[Portrait],
) -> String {
    let complete = results.len() == contest.matches();
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "wasmouse contest" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Contest" }
                p.quiet {
                    (contest.entrants.len()) " robots, " (contest.mazes.len()) " mazes, "
                    (results.len()) " matches; ruleset " (contest.rules.name)
                    " version " (contest.rules.version)
                }
                @if !complete {
                    p { strong { "Not complete: " (contest.matches() - results.len()) " matches were not played." } }
                }
                h2 { "Standings" }
                p { "More finished matches rank higher; among as many, the lower mean score. "
                    "Regret is the score minus that of a robot that knows the maze." }
                (standings_table(contest, standings))
                @if !portraits.is_empty() {
                    h2 { "Best runs" }
                    p { "The line is the way of run 2; the shade of a cell says how often run 1 stopped there." }
                    div.portraits {
                        @for portrait in portraits { (figure(contest, results, portrait)) }
                    }
                }
                h2 { "Matches" }
                (matches_table(contest, results))
                h2 { "To play it again" }
                p { "wasmouse " (env!("CARGO_PKG_VERSION")) ", engine " code { (engine_id()) } }
                (hashes(contest))
            }
        }
    }
    .into_string()
}

fn standings_table(contest: &Contest, standings: &[Standing]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th { "Rank" } th.name { "Robot" } th { "Finished" } th { "Mean score" }
                th { "Mean regret" } th { "Faults" }
            } }
            tbody { @for line in standings { tr {
                td { (line.rank.map_or_else(|| "-".into(), |rank| rank.to_string())) }
                td.name { (visible(&contest.entrants[line.entrant].name)) }
                td { @if line.rank.is_some() { (line.finished) " of " (line.matches) } @else { "refused" } }
                td { (mean(line.score)) }
                td { (mean(line.regret)) }
                td { (line.faults) }
            } } }
        } }
        @for entrant in &contest.entrants {
            @if let Err(refusal) = &entrant.admission {
                p { "Refused " strong { (visible(&entrant.name)) } ": " (visible(&refusal.to_string())) ". "
                    (refusal.hint()) "." }
            }
        }
    }
}

fn mean(mean: Option<Mean>) -> String {
    mean.map_or_else(|| "-".into(), |mean| mean.to_string())
}

fn figure(contest: &Contest, results: &[MatchResult], portrait: &Portrait) -> Markup {
    let result = &results[portrait.result];
    html! {
        figure {
            (PreEscaped(&portrait.svg))
            figcaption {
                strong { (visible(&contest.entrants[result.entrant].name)) }
                " in " (visible(&contest.mazes[result.maze].name)) ": "
                (score(result)) " (" (result.outcome.steps[0]) " + " (result.outcome.steps[1]) " steps)"
            }
        }
    }
}

fn score(result: &MatchResult) -> String {
    match &result.outcome.verdict {
        Verdict::Finished(score) => score.to_string(),
        Verdict::BudgetUsedUp { .. } | Verdict::Fault(_) => "no score".into(),
    }
}

fn matches_table(contest: &Contest, results: &[MatchResult]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th.name { "Robot" } th.name { "Maze" } th { "Seed" } th.name { "Verdict" } th { "Score" }
                th { "Floor" } th { "Run 1" } th { "Run 2" } th { "Bumps" } th { "Fuel" }
            } }
            tbody { @for result in results { tr {
                td.name { (visible(&contest.entrants[result.entrant].name)) }
                td.name { (visible(&contest.mazes[result.maze].name)) }
                td { (result.seed) }
                td.name {
                    (result.outcome.verdict.title())
                    @if let Verdict::Fault(fault) = &result.outcome.verdict {
                        br; span.quiet { (visible(&fault.to_string())) }
                    }
                }
                td { (score(result)) }
                td { (contest.mazes[result.maze].floor.map_or_else(|| "-".into(), |floor| floor.to_string())) }
                td { (result.outcome.steps[0]) }
                td { (result.outcome.steps[1]) }
                td { (result.outcome.counts.bumps) }
                td { (result.outcome.fuel.start + result.outcome.fuel.steps) }
            } } }
        } }
    }
}

fn hashes(contest: &Contest) -> Markup {
    html! {
        div.scroll { table {
            thead { tr { th.name { "Robot or maze" } th.name { "SHA-256" } } }
            tbody {
                @for entrant in &contest.entrants {
                    tr { td.name { (visible(&entrant.name)) } td.name { code { (entrant.digest.hex()) } } }
                }
                @for maze in &contest.mazes {
                    tr { td.name { (visible(&maze.name)) } td.name { code { (maze.digest.hex()) } } }
                }
            }
        } }
    }
}
