//! The score against fuel: what a better score costs.

use super::canvas::{Axes, Head, Key};
use super::data::{Robots, axis_end, plain};
use super::error::PlotError;
use super::options::Options;
use super::runs::{parts, scatter};
use crate::contest::ScoreMatrix;
use crate::report::number::counted;

pub(super) fn svg(matrix: &ScoreMatrix, options: &Options) -> Result<String, PlotError> {
    let robots = Robots::new(matrix)?;
    let points = robots.shown.iter().map(|&robot| {
        let matches = robots.finished(robot);
        let points = matches.map(|it| {
            let fuel = &it.played.fuel;
            let fuel = fuel.start.saturating_add(fuel.steps).max(1);
            // Not the logarithm of the platform, which may differ in its last bits.
            (libm::log10(fuel as f64), it.score_steps())
        });
        points.collect()
    });
    let points: Vec<Vec<(f64, f64)>> = points.collect();
    let logarithms = || points.iter().flatten().map(|it| it.0);
    let least = logarithms().fold(f64::INFINITY, f64::min).floor();
    let most = logarithms().fold(0.0, f64::max).ceil();
    let head = Head {
        title: "Score and fuel",
        note: format!(
            "{} finished; lower is better, further left is cheaper",
            counted(robots.finished_count(), "match")
        ),
        names: robots.names(),
        more: robots.more,
        key: Key::Marker,
    };
    let axes = Axes {
        x: least..most.max(least + 1.0),
        y: 0.0..axis_end(&parts(&points, |it| it.1)),
        x_title: "fuel of a match (units, logarithmic)",
        y_title: "score (steps)",
        x_label: Some(&power),
        y_label: &plain,
    };
    scatter(&head, options, &axes, &points)
}

/// The power of ten, where it is a whole number: `10 k`, `1 M`, `100 M`.
fn power(logarithm: &f64) -> String {
    if (logarithm - logarithm.round()).abs() > 1e-6 {
        return String::new();
    }
    let exponent = logarithm.round() as u32;
    let unit = match exponent / 3 {
        0 => "",
        1 => " k",
        2 => " M",
        3 => " G",
        4 => " T",
        5 => " P",
        _ => " E",
    };
    format!("{}{unit}", 10_u32.pow(exponent % 3))
}
