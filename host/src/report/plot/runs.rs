//! The exploration run against the speed run: who explores long, and what it gains.

use super::canvas::{Axes, Head, Key, document, pixel};
use super::data::{Robots, axis_end, plain};
use super::error::PlotError;
use super::look::marker;
use super::options::Options;
use crate::contest::ScoreMatrix;
use crate::report::number::counted;
use plotters::prelude::Color as _;

/// Points of a robot that are drawn, at most.
const POINTS_MAX: usize = 1000;

pub(super) fn svg(matrix: &ScoreMatrix, options: &Options) -> Result<String, PlotError> {
    let robots = Robots::new(matrix)?;
    let points = robots.shown.iter().map(|&robot| {
        let steps = robots.finished(robot).map(|it| it.played.steps);
        let points = steps.map(|it| (f64::from(it.exploration), f64::from(it.speed)));
        points.collect()
    });
    let points: Vec<Vec<(f64, f64)>> = points.collect();
    let head = Head {
        title: "Exploration run and speed run",
        note: format!(
            "{} finished; lower and further left is better",
            counted(robots.finished_count(), "match")
        ),
        names: robots.names(),
        more: robots.more,
        key: Key::Marker,
    };
    let axes = Axes {
        x: 0.0..axis_end(&parts(&points, |it| it.0)),
        y: 0.0..axis_end(&parts(&points, |it| it.1)),
        x_title: "exploration run (steps)",
        y_title: "speed run (steps)",
        x_label: Some(&plain),
        y_label: &plain,
    };
    scatter(&head, options, &axes, &points)
}

/// One coordinate of the points of each robot.
pub(super) fn parts(points: &[Vec<(f64, f64)>], part: fn(&(f64, f64)) -> f64) -> Vec<Vec<f64>> {
    let robots = points.iter();
    robots.map(|it| it.iter().map(part).collect()).collect()
}

/// Draws the points of each robot. Those beyond the axes are not drawn, and of more than 1,000 of a
/// robot only every n-th.
pub(super) fn scatter(
    head: &Head<'_>,
    options: &Options,
    axes: &Axes<'_>,
    points: &[Vec<(f64, f64)>],
) -> Result<String, PlotError> {
    let is_inside = |point: &&(f64, f64)| axes.x.contains(&point.0) && axes.y.contains(&point.1);
    let beyond = points.iter().flatten().filter(|it| !is_inside(it)).count();
    let mut head = head.clone();
    if beyond > 0 {
        head.note += &format!("; {beyond} beyond the axes");
    }
    document(&head, options, 420, |canvas| {
        let chart = canvas.chart(canvas.place, axes)?;
        for (position, points) in points.iter().enumerate() {
            let color = canvas.colors.robots[position];
            let nth = points.len().div_ceil(POINTS_MAX).max(1);
            for &point in points.iter().filter(is_inside).step_by(nth) {
                let at = pixel(&chart, point);
                marker(&canvas.root, at, position, 3, &color.mix(0.65))?;
            }
        }
        Ok(())
    })
}
