//! The steps of the exploration run against those of the speed run: a panel for each robot, over
//! the matches of all.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use maud::{Markup, PreEscaped, html};

use super::parts::{more, shown};
use super::scale::{Scale, extent};
use crate::contest::Outcome;
use crate::report::contest::view::View;
use crate::report::number::counted;

/// Panels at most.
const ROBOTS_MAX: usize = 12;

/// A panel in SVG units: its size, and the borders for the texts around it.
const WIDTH: u32 = 300;
const HEIGHT: u32 = 220;
const LEFT: u32 = 36;
const TOP: u32 = 22;
const RIGHT: u32 = 12;
const BOTTOM: u32 = 36;

/// Matches as places in a panel, in units of 2: as many as there are places at most, however
/// many the matches are.
type Points = BTreeSet<(u32, u32)>;

/// The panels; `None` if no match was finished.
pub(super) fn scatter(view: &View<'_>) -> Option<Markup> {
    let total = view.robots.len();
    let runs = view
        .robots
        .iter()
        .take(ROBOTS_MAX)
        .map(|&robot| (robot, runs(view, robot)));
    let runs: Vec<(usize, Vec<(u32, u32)>)> = runs.filter(|(_, it)| !it.is_empty()).collect();
    if runs.is_empty() {
        return None;
    }
    let all = || runs.iter().flat_map(|(_, it)| it);
    let scale = |run: fn(&(u32, u32)) -> u32| {
        let mut steps: Vec<u64> = all().map(|it| run(it).into()).collect();
        steps.sort_unstable();
        let scale = Scale::new(extent(&steps), 4);
        let is_beyond = steps.last().is_some_and(|&it| it > scale.end);
        (scale, is_beyond)
    };
    let (x, is_x_beyond) = scale(|it| it.0);
    let (y, is_y_beyond) = scale(|it| it.1);
    let everything: Points = all().map(|&run| place(x, y, run)).collect();
    Some(html! {
        p { "A dot is a finished match, or several in the same place; grey dots are those of the \
             other robots. Further left: less exploration. Further down: a shorter speed run."
            @if is_x_beyond || is_y_beyond { " What lies beyond an axis is drawn at its end." } }
        svg.defs width="0" height="0" aria-hidden="true" { defs {
            path id="all-runs" d=(PreEscaped(path(&everything))) {}
        } }
        div.panels { @for (robot, runs) in &runs {
            figure {
                @let points: Points = runs.iter().map(|&run| place(x, y, run)).collect();
                (panel(x, y, &points, &averages(runs)))
                figcaption { strong { (shown(view.name(*robot))) } ": " (averages(runs)) }
            }
        } }
        (more(total.min(ROBOTS_MAX), total, "robots"))
    })
}

/// The steps of both runs of every finished match.
fn runs(view: &View<'_>, robot: usize) -> Vec<(u32, u32)> {
    let matrix = view.matrix();
    let mut runs = Vec::new();
    for maze in 0..matrix.mazes.len() {
        for seed in 0..matrix.seeds.count {
            let played = matrix.get(robot, maze, seed);
            if let Some(played) = played.filter(|it| it.outcome == Outcome::Finished) {
                runs.push((played.steps.exploration, played.steps.speed));
            }
        }
    }
    runs
}

/// The averages in words.
fn averages(runs: &[(u32, u32)]) -> String {
    let count_of = runs.len() as u64;
    let mean = |run: fn(&(u32, u32)) -> u32| {
        let sum: u64 = runs.iter().map(|it| u64::from(run(it))).sum();
        (sum + count_of / 2) / count_of
    };
    format!(
        "{}, on average {} + {} steps",
        counted(count_of, "match"),
        mean(|it| it.0),
        mean(|it| it.1)
    )
}

fn place(x: Scale, y: Scale, (exploration, speed): (u32, u32)) -> (u32, u32) {
    let across = x.place(
        u64::from(exploration) * 1000,
        f64::from(WIDTH - LEFT - RIGHT),
    );
    let up = y.place(u64::from(speed) * 1000, f64::from(HEIGHT - TOP - BOTTOM));
    let even = |place: f64| (place / 2.0).round() as u32 * 2;
    (LEFT + even(across), HEIGHT - BOTTOM - even(up))
}

fn path(points: &Points) -> String {
    let mut path = String::new();
    for (x, y) in points {
        write(&mut path, format_args!("M{x} {y}h0"));
    }
    path
}

fn write(text: &mut String, part: std::fmt::Arguments<'_>) {
    text.write_fmt(part)
        .expect("writing to a string cannot fail");
}

fn panel(x: Scale, y: Scale, points: &Points, label: &str) -> Markup {
    let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(label) {
            rect.frame x=(LEFT) y=(TOP) width=(right - LEFT) height=(bottom - TOP) {}
            @for tick in x.ticks() {
                @let (x, _) = place(x, y, (u32::try_from(tick).unwrap_or(u32::MAX), 0));
                line.grid x1=(x) x2=(x) y1=(TOP) y2=(bottom) {}
                text.tick x=(x) y=(bottom + 15) { (tick) }
            }
            @for tick in y.ticks() {
                @let (_, y) = place(x, y, (0, u32::try_from(tick).unwrap_or(u32::MAX)));
                line.grid x1=(LEFT) x2=(right) y1=(y) y2=(y) {}
                text.tick.last x=(LEFT - 5) y=(y + 4) { (tick) }
            }
            text.tick.last x=(right) y=(HEIGHT - 4) { "exploration run, steps" }
            text.tick.first x="2" y="13" { "speed run, steps" }
            use.others href="#all-runs" {}
            path.points d=(PreEscaped(path(points))) {}
        }
    }
}
