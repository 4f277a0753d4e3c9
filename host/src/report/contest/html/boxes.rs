//! How the scores of robots are distributed, as box plots in a table.

use maud::{Markup, html};

use super::parts::{caption, label, more};
use super::scale::{Scale, extent, percentile};
use crate::report::contest::view::View;
use crate::report::contest::words::NONE;
use crate::report::number::counted;

/// Robots that are shown, at most.
const ROBOTS_MAX: usize = 60;

/// Ticks of an axis, at most: their labels have to fit on a telephone.
const TICKS_MAX: u64 = 4;

/// The finished matches of a robot.
struct Row {
    robot: usize,
    unfinished: u64,
    /// In thousandths of a step, sorted.
    scores: Vec<u64>,
    regrets: Vec<u64>,
}

/// The plots; `None` if no match was finished.
pub(super) fn boxes(view: &View<'_>) -> Option<Markup> {
    let rows = view
        .robots
        .iter()
        .take(ROBOTS_MAX)
        .map(|&robot| row(view, robot));
    let rows: Vec<Row> = rows.filter(|row| !row.scores.is_empty()).collect();
    if rows.is_empty() {
        return None;
    }
    let scale = |values: fn(&Row) -> &Vec<u64>| {
        let mut all: Vec<u64> = rows.iter().flat_map(values).copied().collect();
        all.sort_unstable();
        let end = extent(&all).div_ceil(1000);
        let scale = Scale::new(end, TICKS_MAX);
        let is_beyond = all.last().is_some_and(|&it| it > scale.end * 1000);
        (scale, is_beyond)
    };
    let (scores, are_scores_beyond) = scale(|row| &row.scores);
    let (regrets, are_regrets_beyond) = scale(|row| &row.regrets);
    let total = view.robots.len();
    Some(html! {
        p { "Of the finished matches. Box: the middle half of them; thick line: the median; thin \
             line: from the 10th to the 90th percentile; dots: best and worst match. Regret is \
             the score minus that of a robot that knows the maze."
            @if are_scores_beyond || are_regrets_beyond {
                " What lies beyond an axis is drawn at its end."
            } }
        div.scroll tabindex="0" role="group" aria-label="Distribution of scores" {
            table.boxes {
                (caption("Scores and regrets in steps; lower is better."))
                thead { tr {
                    th.name scope="col" { "Robot" }
                    th.plot scope="col" { "Score" (axis(scores)) }
                    th scope="col" { "Median" }
                    th.plot scope="col" { "Regret" (axis(regrets)) }
                    th scope="col" { "Median" }
                    th scope="col" { "Not finished" }
                } }
                tbody { @for row in &rows { tr {
                    th.name scope="row" { (label(view.name(row.robot))) }
                    td.plot { (plot(&row.scores, scores)) }
                    td { (steps(percentile(&row.scores, 50))) }
                    td.plot { (plot(&row.regrets, regrets)) }
                    td { (steps(percentile(&row.regrets, 50))) }
                    td { (row.unfinished) }
                } } }
            }
        }
        (more(total.min(ROBOTS_MAX), total, "robots"))
    })
}

fn row(view: &View<'_>, robot: usize) -> Row {
    let matrix = view.matrix();
    let (mut scores, mut regrets, mut unfinished) = (Vec::new(), Vec::new(), 0);
    for (index, maze) in matrix.mazes.iter().enumerate() {
        for seed in 0..matrix.seeds.count {
            let Some((played, oracle)) = matrix.get(robot, index, seed).zip(maze.oracle) else {
                continue;
            };
            match played.score(&matrix.rules) {
                Some(score) => {
                    let score = score.thousandths();
                    scores.push(score);
                    regrets.push(score.saturating_sub(oracle.thousandths()));
                }
                None => unfinished += 1,
            }
        }
    }
    scores.sort_unstable();
    regrets.sort_unstable();
    Row {
        robot,
        unfinished,
        scores,
        regrets,
    }
}

/// In percent of the width.
fn at(scale: Scale, thousandths: u64) -> String {
    format!("{:.2}%", scale.place(thousandths, 100.0))
}

fn axis(scale: Scale) -> Markup {
    let label = format!("Axis from 0 to {}", counted(scale.end, "step"));
    html! {
        svg.strip.axis role="img" aria-label=(label) {
            @for tick in scale.ticks() {
                @let class = if tick == 0 { "tick first" } else if tick == scale.end { "tick last" } else { "tick" };
                text class=(class) x=(at(scale, tick * 1000)) y="14" { (tick) }
            }
        }
    }
}

fn plot(sorted: &[u64], scale: Scale) -> Markup {
    let percents = [0, 10, 25, 50, 75, 90, 100];
    let [
        Some(least),
        Some(p10),
        Some(p25),
        Some(p50),
        Some(p75),
        Some(p90),
        Some(most),
    ] = percents.map(|percent| percentile(sorted, percent))
    else {
        return html! { (NONE) };
    };
    let width = scale.place(p75, 100.0) - scale.place(p25, 100.0);
    let label = format!(
        "{} to {}, median {}, middle half from {} to {}",
        number(least),
        number(most),
        number(p50),
        number(p25),
        number(p75)
    );
    html! {
        svg.strip role="img" aria-label=(label) {
            @for tick in scale.ticks() {
                @let x = at(scale, tick * 1000);
                line.grid x1=(x) x2=(x) y1="0" y2="28" {}
            }
            line.whisker x1=(at(scale, p10)) x2=(at(scale, p90)) y1="14" y2="14" {}
            rect.box x=(at(scale, p25)) y="6" width={ (format!("{width:.2}%")) } height="16" {}
            line.median x1=(at(scale, p50)) x2=(at(scale, p50)) y1="4" y2="24" {}
            @for end in [least, most] {
                circle.end cx=(at(scale, end)) cy="14" r="2.5" {}
            }
        }
    }
}

fn steps(thousandths: Option<u64>) -> String {
    thousandths.map_or_else(|| NONE.to_owned(), number)
}

fn number(thousandths: u64) -> String {
    format!("{}.{:03}", thousandths / 1000, thousandths % 1000)
}
