//! How far scores are from a benchmark, as a histogram for each size: figure 3 of Minnett's report.

use std::collections::BTreeSet;

use plotters::prelude::{Color as _, PathElement};

use super::area::Drawn;
use super::canvas::{Axes, Canvas, Head, Key, Place, document, pixel};
use super::data::{Robots, plain};
use super::error::PlotError;
use super::look::marker;
use super::options::Options;
use crate::contest::{Benchmark, Margins, MazeFilter, ScoreMatrix};

/// Intervals of a histogram, at most.
const BINS_MAX: i64 = 24;

/// The height of the histogram of one size, in pixels.
const PANEL: i32 = 130;

/// What is below the last histogram.
const AXIS: i32 = 40;

/// Sizes that are shown, at most.
const SIZES_MAX: usize = 10;

/// The intervals of all histograms.
#[derive(Clone, Copy, Debug)]
struct Bins {
    first: i64,
    width: u32,
    count: usize,
}

pub(super) fn svg(
    benchmark: Benchmark,
    matrix: &ScoreMatrix,
    options: &Options,
) -> Result<String, PlotError> {
    let robots = Robots::new(matrix)?;
    let sizes: BTreeSet<u8> = matrix.mazes.iter().map(|maze| maze.dimension).collect();
    let margins = |robot: usize, filter| Margins::new(matrix, robot, filter, benchmark);
    let all: Vec<Margins> = robots
        .shown
        .iter()
        .map(|&robot| margins(robot, MazeFilter::All))
        .collect();
    let Some(bins) = bins(&all) else {
        return Err(PlotError::Empty);
    };
    let mut panels: Vec<(u8, Vec<Vec<u64>>)> = Vec::new();
    for size in sizes.into_iter().take(SIZES_MAX) {
        let counts = robots.shown.iter().map(|&robot| {
            let of_size = margins(robot, MazeFilter::Size(size));
            of_size.histogram(bins.first, bins.width, bins.count)
        });
        panels.push((size, counts.collect()));
    }
    let steps = match benchmark {
        Benchmark::Lower => "1 step",
        Benchmark::Upper => "2 steps",
    };
    let counted: u64 = panels.iter().flat_map(|it| it.1.iter().flatten()).sum();
    let (beaten, finished) = all.iter().fold((0, 0), |(beaten, finished), it| {
        (beaten + it.beaten(), finished + it.finished())
    });
    let beyond = match finished - counted.min(finished) {
        0 => String::new(),
        beyond => format!("; {beyond} not shown"),
    };
    let head = Head {
        title: match benchmark {
            Benchmark::Lower => "Margin to the lower benchmark",
            Benchmark::Upper => "Margin to the upper benchmark",
        },
        note: format!(
            "benchmark: optimal speed run, {steps} of exploration per cell; beaten in {beaten} of \
             {finished}{beyond}"
        ),
        names: robots.names(),
        more: robots.more,
        key: Key::Marker,
    };
    let height = panels.len() as i32 * PANEL + AXIS;
    document(&head, options, height, |canvas| {
        for (index, (size, counts)) in panels.iter().enumerate() {
            let is_last = index + 1 == panels.len();
            panel(canvas, (index, is_last), *size, (bins, counts))?;
        }
        Ok(())
    })
}

/// The intervals in which the margins are, with a round width; `None` of no margin. They reach as
/// far down as the robots need, but at most three times as far as half of the robots do, or 15 steps.
fn bins(all: &[Margins]) -> Option<Bins> {
    let mut ranges: Vec<(i64, i64)> = all.iter().filter_map(Margins::range).collect();
    let most = ranges.iter().map(|it| it.1).max()?.max(0);
    ranges.sort_by_key(|it| std::cmp::Reverse(it.0));
    let half = ranges[(ranges.len() - 1) / 2].0.min(-5).saturating_mul(3);
    let least = ranges.last()?.0.max(half).min(0);
    let widths = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 10_000, 1_000_000];
    let bins = |width: i64| most.div_euclid(width) - least.div_euclid(width) + 1;
    let fits = |width: &i64| i128::from(most) - i128::from(least) < i128::from(BINS_MAX * width);
    let width = widths
        .into_iter()
        .find(|it| fits(it) && bins(*it) <= BINS_MAX);
    let width = width.unwrap_or(i64::from(u32::MAX));
    Some(Bins {
        first: least.div_euclid(width).saturating_mul(width),
        width: u32::try_from(width).unwrap_or(u32::MAX),
        // Numbers that no match has may not fit.
        count: usize::try_from(bins(width).min(BINS_MAX)).unwrap_or(1),
    })
}

fn panel(
    canvas: &Canvas<'_>,
    (index, is_last): (usize, bool),
    size: u8,
    (bins, counts): (Bins, &[Vec<u64>]),
) -> Result<(), PlotError> {
    let place = Place {
        top: canvas.place.top + index as i32 * PANEL,
        height: if is_last { PANEL + AXIS } else { PANEL },
        ..canvas.place
    };
    let most = counts.iter().flatten().max().copied().unwrap_or(0);
    let width = f64::from(bins.width);
    let first = bins.first as f64;
    let title = format!("{size} x {size} (matches)");
    let axes = Axes {
        x: first..first + width * bins.count as f64,
        y: 0.0..(most.max(1) as f64 * 1.15),
        x_title: if is_last {
            "benchmark minus score (steps); beaten to the right of 0"
        } else {
            ""
        },
        y_title: &title,
        x_label: if is_last { Some(&plain) } else { None },
        y_label: &whole,
    };
    let chart = canvas.chart(place, &axes)?;
    let (zero, bottom) = pixel(&chart, (0.0, 0.0));
    let (_, top) = pixel(&chart, (0.0, axes.y.end));
    let line = vec![(zero, top), (zero, bottom)];
    let style = canvas.colors.text.stroke_width(1);
    canvas.root.draw(&PathElement::new(line, style))?;
    let robots = counts.len();
    for (position, counts) in counts.iter().enumerate() {
        let corner =
            |bin: usize, count: u64| pixel(&chart, (first + width * bin as f64, count as f64));
        outline(canvas, (position, robots), counts, &corner)?;
    }
    Ok(())
}

/// The histogram of a robot as an outline, with a marker on each of its intervals.
fn outline(
    canvas: &Canvas<'_>,
    (position, robots): (usize, usize),
    counts: &[u64],
    corner: &dyn Fn(usize, u64) -> (i32, i32),
) -> Drawn {
    let color = canvas.colors.robots[position];
    // One line for each row of intervals that are not empty.
    let bins: Vec<usize> = (0..counts.len()).collect();
    for row in bins.chunk_by(|&a, &b| (counts[a] > 0) == (counts[b] > 0)) {
        let (first, last) = (row[0], row[row.len() - 1]);
        if counts[first] == 0 {
            continue;
        }
        let mut points = vec![corner(first, 0)];
        for &bin in row {
            points.extend([corner(bin, counts[bin]), corner(bin + 1, counts[bin])]);
        }
        points.push(corner(last + 1, 0));
        canvas
            .root
            .draw(&PathElement::new(points, color.stroke_width(2)))?;
    }
    // At another place for each robot, because outlines often lie on each other.
    let robots = robots as i32;
    for (bin, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let ((left, y), (right, _)) = (corner(bin, count), corner(bin + 1, count));
        let x = left + (right - left) * (2 * position as i32 + 1) / (2 * robots);
        marker(&canvas.root, (x, y), position, 4, &color)?;
    }
    Ok(())
}

/// A count of matches; nothing between two.
fn whole(number: &f64) -> String {
    if number.fract().abs() < 1e-6 {
        plain(number)
    } else {
        String::new()
    }
}
