//! The rankings, and what kept robots from being ranked.

use maud::{Markup, html};
use wasmouse_core::guest_text::GuestStr;

use super::parts::{caption, label, playable, shown};
use super::player::Player;
use crate::contest::{Mean, RankingLine};
use crate::report::contest::view::{Part, View, state};
use crate::report::contest::words::{self, mean, percent};
use crate::report::number::grouped;

/// The overall ranking, and those of sets and classes below it.
pub(super) fn standings(view: &View<'_>, player: Option<&Player>) -> Option<Markup> {
    let report = view.report;
    let by = words::ranked_by(report.scoring, report.overall.penalty_steps);
    Some(html! {
        p { (by) }
        @for (index, part) in view.parts().iter().enumerate() {
            @if index > 0 { h3 { (shown(&words::part_title(part))) } }
            (ranking(view, player, part, index))
        }
    })
}

fn ranking(view: &View<'_>, player: Option<&Player>, part: &Part<'_>, index: usize) -> Markup {
    let has_classes = view.robots.iter().any(|&it| view.robot(it).class.is_some());
    let title = shown(&words::part_title(part));
    let value = words::value_title(view.report.scoring.method);
    html! {
        div.scroll tabindex="0" role="group" aria-label={ "Standings: " (title) } {
            table.sortable id={ "ranking-" (index) } {
                (caption(&format!("{title}: {}.", words::scope(part))))
                thead { tr {
                    th scope="col" { "Rank" }
                    th.name scope="col" { "Robot" }
                    @if has_classes { th.name scope="col" { "Class" } }
                    th scope="col" { (value) }
                    th scope="col" { "Finished" }
                    th scope="col" { "Faults" }
                    th scope="col" { "Median score" small { "10 % to 90 %" } }
                    th scope="col" { "Mean regret" small { "finished: exploration + speed" } }
                    th scope="col" { "Optimal speed runs" }
                    th scope="col" { "Fuel per step" }
                    th scope="col" { "Memory, KiB" }
                } }
                tbody { @for line in &part.lines { (row(view, player, line, has_classes)) } }
            }
        }
    }
}

fn row(view: &View<'_>, player: Option<&Player>, line: &RankingLine, has_classes: bool) -> Markup {
    let robot = view.robot(line.robot);
    let best = player.and_then(|it| it.best(view, line.robot));
    html! {
        tr {
            td { (words::rank(line)) }
            th.name scope="row" {
                (playable(view.name(line.robot), best))
                @if let Some(state) = state(robot, line.state) { " (" (state) ")" }
                @if let Some(author) = view.author(line.robot) {
                    " " span.quiet { "by " (shown(author)) }
                }
            }
            @if has_classes { td.name { (label(robot.class.as_ref().map_or(words::NONE.into(), GuestStr::from))) } }
            td.value { (mean(line.value)) }
            td data-value=(share(line.finish_rate)) {
                (line.finished) "/" (line.matches) small { (percent(line.finish_rate)) }
            }
            td { (line.faults) }
            td data-value=(mean(line.percentiles.map(|it| it.p50))) {
                (mean(line.percentiles.map(|it| it.p50)))
                @if let Some(it) = line.percentiles {
                    small { (it.p10) " to " (it.p90) }
                }
            }
            td data-value=(mean(line.mean_regret)) {
                (mean(line.mean_regret))
                @if let Some(regret) = line.finished_regret {
                    small { (regret.exploration) " + " (regret.speed) }
                }
            }
            td { (line.optimal_speed_runs) }
            td { (line.step_fuel_mean.map_or_else(
                || words::NONE.to_owned(),
                |fuel| grouped(fuel.thousandths().unsigned_abs().div_ceil(1000)),
            )) }
            td { (grouped(line.memory_bytes_max.div_ceil(1024))) }
        }
    }
}

fn share(share: Option<Mean>) -> String {
    mean(share)
}

/// The paired comparisons of neighbours in the ranking.
pub(super) fn comparisons(view: &View<'_>) -> Option<Markup> {
    let comparisons = view.comparisons();
    (!comparisons.is_empty()).then(|| {
        html! {
            p { "Neighbours in the ranking, in the same mazes. The interval is a bootstrap over \
                 mazes." }
            ul { @for it in comparisons {
                li { (shown(&words::comparison(view, it))) "." }
            } }
        }
    })
}

/// Robots without a rank, and why.
pub(super) fn unranked(view: &View<'_>) -> Option<Markup> {
    let unranked = view.unranked();
    (!unranked.is_empty()).then(|| {
        html! { ul { @for it in unranked {
            li { strong { (shown(view.name(it.robot))) } ": " (shown(&words::unranked(&it))) }
        } } }
    })
}

/// The faults in words.
pub(super) fn faults(view: &View<'_>) -> Option<Markup> {
    let faults = view.faults();
    (!faults.is_empty()).then(|| {
        html! { ul { @for it in faults {
            li {
                strong { (shown(view.name(it.robot))) } ": " (shown(&words::fault(&it)))
                @if let Some(complaint) = it.complaint { pre { @for line in &complaint.lines { (shown(line)) "\n" } } }
            }
        } } }
    })
}
