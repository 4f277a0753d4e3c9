//! Robots side by side, maze by maze or size by size: the bars of Lobato's report.

use std::collections::BTreeSet;

use plotters::style::text_anchor::HPos;
use wasmouse_core::GuestText;

use super::area::Drawn;
use super::canvas::{Axes, Canvas, Chart, Head, Key, document, pixel};
use super::data::{Finished, Robots, axis_end, in_maze, plain};
use super::error::PlotError;
use super::look::bar;
use super::options::Options;
use crate::contest::ScoreMatrix;
use crate::report::number::counted;

/// Mazes that have bars of their own, at most; otherwise mazes of one size share them.
const MAZES_MAX: usize = 8;

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The score.
    Score,
    /// Steps of the exploration run.
    Exploration,
    /// Steps of the speed run.
    Speed,
}

impl Measure {
    const fn title(self) -> &'static str {
        match self {
            Self::Score => "Scores",
            Self::Exploration => "Steps of the exploration run",
            Self::Speed => "Steps of the speed run",
        }
    }

    const fn axis(self) -> &'static str {
        match self {
            Self::Score => "score (steps)",
            Self::Exploration => "exploration run (steps)",
            Self::Speed => "speed run (steps)",
        }
    }

    fn of(self, finished: &Finished<'_>) -> f64 {
        match self {
            Self::Score => finished.score_steps(),
            Self::Exploration => f64::from(finished.played.steps.exploration),
            Self::Speed => f64::from(finished.played.steps.speed),
        }
    }
}

/// Mazes that share bars.
struct Group {
    name: GuestText,
    mazes: Vec<usize>,
}

pub(super) fn svg(
    measure: Measure,
    matrix: &ScoreMatrix,
    options: &Options,
) -> Result<String, PlotError> {
    let robots = Robots::new(matrix)?;
    let groups = groups(matrix);
    let values: Vec<Vec<Option<f64>>> = groups
        .iter()
        .map(|group| {
            let shown = robots.shown.iter();
            shown
                .map(|&robot| mean(matrix, robot, group, measure))
                .collect()
        })
        .collect();
    let robot = |position: usize| values.iter().filter_map(|it| it[position]).collect();
    let by_robot: Vec<Vec<f64>> = (0..robots.shown.len()).map(robot).collect();
    let end = axis_end(&by_robot);
    let is_by_size = groups.len() != matrix.mazes.len();
    let averages = match (is_by_size, matrix.seeds.count) {
        (false, 1) => "",
        _ => "averages of finished matches; ",
    };
    let head = Head {
        title: measure.title(),
        note: format!(
            "{}; {averages}lower is better; \u{2013} where no match is finished",
            counted(matrix.mazes.len(), "maze")
        ),
        names: robots.names(),
        more: robots.more,
        key: Key::Bar,
    };
    let axes = Axes {
        x: 0.0..groups.len() as f64,
        // Room for the numbers above.
        y: 0.0..end * 1.05,
        x_title: if is_by_size {
            "size of the maze (cells along a side)"
        } else {
            "maze"
        },
        y_title: measure.axis(),
        x_label: None,
        y_label: &plain,
    };
    document(&head, options, 400, |canvas| {
        let chart = canvas.chart(canvas.place, &axes)?;
        Ok(draw(canvas, (&chart, end), &groups, &values)?)
    })
}

fn draw(
    canvas: &Canvas<'_>,
    (chart, end): (&Chart<'_>, f64),
    groups: &[Group],
    values: &[Vec<Option<f64>>],
) -> Drawn {
    // All numbers with a decimal, or none.
    let is_whole = values
        .iter()
        .flatten()
        .flatten()
        .all(|it| it.fract() == 0.0);
    let decimals = usize::from(!is_whole);
    for (index, (group, values)) in groups.iter().zip(values).enumerate() {
        let (left, bottom) = pixel(chart, (index as f64, 0.0));
        let (right, _) = pixel(chart, (index as f64 + 1.0, 0.0));
        let room = right - left;
        // A share of the room, but no wider than is good to look at.
        let width = (room * 8 / 10 / values.len() as i32).clamp(2, 60);
        let first = i32::midpoint(left, right) - width * values.len() as i32 / 2;
        for (position, value) in values.iter().enumerate() {
            let x = first + width * position as i32;
            let middle = x + width / 2;
            let Some(value) = value else {
                canvas.label("\u{2013}", (middle, bottom - 16), room, HPos::Center)?;
                continue;
            };
            // A bar that is too long is cut, and says how long it is.
            let shown = value.min(end);
            let (_, top) = pixel(chart, (0.0, shown));
            let gap = i32::from(width > 6);
            bar(
                &canvas.root,
                ((x, top), (x + width - gap, bottom)),
                position,
                canvas.colors,
            )?;
            let text = format!("{value:.decimals$}");
            if shown < *value {
                let text = format!("{text} \u{2191}");
                canvas.label(&text, (x + width, top - 16), room, HPos::Right)?;
            } else if width >= 34 {
                canvas.label(&text, (middle, top - 16), width + 8, HPos::Center)?;
            }
        }
        let at = (i32::midpoint(left, right), bottom + 6);
        canvas.label(&group.name, at, room - 6, HPos::Center)?;
    }
    Ok(())
}

/// A group for each maze, or for each size of many mazes.
fn groups(matrix: &ScoreMatrix) -> Vec<Group> {
    if matrix.mazes.len() <= MAZES_MAX {
        let mazes = matrix.mazes.iter().enumerate();
        let groups = mazes.map(|(index, maze)| Group {
            name: maze.name.clone(),
            mazes: vec![index],
        });
        return groups.collect();
    }
    let sizes: BTreeSet<u8> = matrix.mazes.iter().map(|maze| maze.dimension).collect();
    let groups = sizes.into_iter().map(|size| {
        let mazes = 0..matrix.mazes.len();
        Group {
            name: size.to_string().into(),
            mazes: mazes
                .filter(|&it| matrix.mazes[it].dimension == size)
                .collect(),
        }
    });
    groups.collect()
}

/// The average over the finished matches in the mazes of a group; `None` if there is none.
fn mean(matrix: &ScoreMatrix, robot: usize, group: &Group, measure: Measure) -> Option<f64> {
    let mazes = group.mazes.iter();
    let matches = mazes.flat_map(|&maze| in_maze(matrix, robot, maze));
    let values: Vec<f64> = matches.map(|it| measure.of(&it)).collect();
    let sum: f64 = values.iter().sum();
    (!values.is_empty()).then(|| sum / values.len() as f64)
}
