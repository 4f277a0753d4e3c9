//! Plots of the results, as images that the page brings with it.

use data_encoding::BASE64;
use maud::{Markup, html};

use crate::contest::Benchmark;
use crate::report::contest::view::View;
use crate::report::picture::Theme;
use crate::report::plot::{Kind, Measure, Options, svg};

/// A plot of so many points that it is larger than this is left out, in bytes.
const BYTES_MAX: usize = 150_000;

/// What is plotted, and what the image shows in words.
const PLOTS: [(Kind, &str); 4] = [
    (
        Kind::Regret,
        "For each robot, the share of matches with at most so much regret: a line that rises \
         further left is better.",
    ),
    (
        Kind::Bars(Measure::Score),
        "Average scores of robots as bars, by maze or by size of the maze: lower is better.",
    ),
    (
        Kind::Margins(Benchmark::Lower),
        "Histograms of the benchmark minus the score, for each size of the maze: further right is \
         better.",
    ),
    (
        Kind::Fuel,
        "The score of each finished match against its fuel: lower is better, further left is \
         cheaper.",
    ),
];

/// The plots that there is something to draw in; `None` if there are none, or if the report hides
/// something: plots show all mazes, and robots by name.
pub(super) fn plots(view: &View<'_>) -> Option<Markup> {
    let matrix = view.matrix();
    let is_all = view.robots.len() == matrix.robots.len() && view.mazes.len() == matrix.mazes.len();
    if !is_all || view.report.options.hide_names {
        return None;
    }
    let image = |kind, theme| {
        let options = Options { title: None, theme };
        let image = svg(kind, matrix, &options).ok()?;
        let is_small = image.len() <= BYTES_MAX;
        is_small.then(|| {
            format!(
                "data:image/svg+xml;base64,{}",
                BASE64.encode(image.as_bytes())
            )
        })
    };
    let images = PLOTS.iter().filter_map(|(kind, words)| {
        Some((
            image(*kind, Theme::Light)?,
            image(*kind, Theme::Dark)?,
            *words,
        ))
    });
    let images: Vec<_> = images.collect();
    (!images.is_empty()).then(|| {
        html! {
            @for (light, dark, words) in &images {
                figure.plot { picture {
                    source media="(prefers-color-scheme: dark)" srcset=(dark);
                    img src=(light) alt=(words);
                } }
            }
        }
    })
}
