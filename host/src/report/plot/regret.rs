//! The cumulative distribution of regret: in which share of its matches a robot is at most so far
//! from the oracle.

use plotters::prelude::{Color as _, PathElement};

use super::canvas::{Axes, Head, Key, document, pixel};
use super::data::{Robots, axis_end, plain};
use super::error::PlotError;
use super::look::marker;
use super::options::Options;
use crate::contest::ScoreMatrix;
use crate::report::number::counted;

/// Markers on a line.
const MARKERS: usize = 8;

pub(super) fn svg(matrix: &ScoreMatrix, options: &Options) -> Result<String, PlotError> {
    let robots = Robots::new(matrix)?;
    let mut lines: Vec<(Vec<f64>, usize)> = Vec::new();
    for &robot in &robots.shown {
        let mut regrets: Vec<f64> = robots.finished(robot).map(|it| it.regret()).collect();
        regrets.sort_by(f64::total_cmp);
        lines.push((regrets, robots.played(robot)));
    }
    let regrets: Vec<Vec<f64>> = lines.iter().map(|it| it.0.clone()).collect();
    let end = axis_end(&regrets);
    let played: usize = lines.iter().map(|it| it.1).sum();
    let head = Head {
        title: "Regret",
        note: format!(
            "share of {} with at most that regret; higher and further left is better",
            counted(played, "match")
        ),
        names: robots.names(),
        more: robots.more,
        key: Key::Marker,
    };
    let axes = Axes {
        x: 0.0..end,
        y: 0.0..100.0,
        x_title: "regret: score minus oracle score (steps)",
        y_title: "matches (%)",
        x_label: Some(&plain),
        y_label: &plain,
    };
    document(&head, options, 420, |canvas| {
        let chart = canvas.chart(canvas.place, &axes)?;
        for (position, (regrets, played)) in lines.iter().enumerate() {
            let color = canvas.colors.robots[position];
            let points = stairs(regrets, *played, end);
            let pixels: Vec<(i32, i32)> = points.iter().map(|&it| pixel(&chart, it)).collect();
            canvas
                .root
                .draw(&PathElement::new(pixels, color.stroke_width(2)))?;
            // At other shares for each robot, so that markers of lines that lie on each other are
            // seen.
            for nth in 0..MARKERS {
                let part =
                    (nth as f64 + (position as f64 + 0.5) / lines.len() as f64) / MARKERS as f64;
                let place = (part * regrets.len() as f64) as usize;
                let Some(&x) = regrets.get(place).filter(|&&it| it <= end) else {
                    continue;
                };
                let y = (place as f64 + 0.5) * 100.0 / (*played).max(1) as f64;
                marker(&canvas.root, pixel(&chart, (x, y)), position, 4, &color)?;
            }
        }
        Ok(())
    })
}

/// In percent: how many of the matches have at most that regret.
fn share(sorted: &[f64], played: usize, regret: f64) -> f64 {
    let count = sorted.partition_point(|&it| it <= regret);
    count as f64 * 100.0 / played.max(1) as f64
}

/// The corners of the line up to the end of the axis.
fn stairs(sorted: &[f64], played: usize, end: f64) -> Vec<(f64, f64)> {
    let mut points = vec![(0.0, 0.0)];
    for group in sorted.chunk_by(|a, b| a == b) {
        let regret = group[0];
        if regret > end {
            break;
        }
        let before = points.last().map_or(0.0, |it| it.1);
        points.extend([(regret, before), (regret, share(sorted, played, regret))]);
    }
    let last = points.last().map_or(0.0, |it| it.1);
    points.push((end, last));
    points
}
