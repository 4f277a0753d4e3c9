//! Robots against the benchmarks of Minnett's report: text with histograms, and the JSON of
//! `wasmouse study`.
//!
//! ```json
//! {
//!   "version": 1,
//!   "rules": "udacity", "seeds": {"first": 0, "count": 1},
//!   "bin_first": -12, "bin_width": 2,
//!   "robots": [
//!     {
//!       "name": "minnett", "digest": "...", "variant": 0, "admitted": true,
//!       "matches": 500, "finished": 500,
//!       "benchmarks": [
//!         {"benchmark": "lower", "beaten": 420, "mean_margin_thousandths": 2462}
//!       ],
//!       "by_size": [
//!         {
//!           "size": 12, "matches": 100, "finished": 100,
//!           "benchmarks": [
//!             {"benchmark": "lower", "beaten": 75, "mean_margin_thousandths": 1001,
//!              "histogram": [0, 0, 3]}
//!           ]
//!         }
//!       ]
//!     }
//!   ]
//! }
//! ```
//!
//! A margin is benchmark minus score, in thousandths of a step. `histogram` counts the margins of
//! finished matches: from `bin_first` steps on, `bin_width` steps each, with the lower end.
//! `host/schema/study.schema.json` describes the document.

use std::collections::BTreeSet;

use serde::Serialize;
use wasmouse_core::{Digest, GuestText};

use super::escape::for_terminal;
use super::json;
use super::table::Lines;
use crate::contest::{Benchmark, Margins, MazeFilter, Mean, ScoreMatrix, Seeds};
use crate::report::number::counted;

/// The version of the document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 1;

/// The most lines of a histogram.
const BINS_MAX: i64 = 24;

/// The longest bar of a histogram, in characters.
const BAR_MAX: u64 = 26;

/// Robots and how they did.
#[derive(Serialize)]
pub struct Study {
    version: u32,
    rules: String,
    seeds: Seeds,
    bin_first: i64,
    bin_width: u32,
    robots: Vec<Robot>,
}

#[derive(Serialize)]
struct Robot {
    name: GuestText,
    digest: Digest,
    variant: u32,
    admitted: bool,
    #[serde(flatten)]
    all: Part,
    by_size: Vec<OfSize>,
}

#[derive(Serialize)]
struct OfSize {
    size: u8,
    #[serde(flatten)]
    part: Part,
}

/// Some matches of a robot.
#[derive(Serialize)]
struct Part {
    matches: u64,
    finished: u64,
    benchmarks: [Measured; 2],
}

#[derive(Serialize)]
struct Measured {
    benchmark: &'static str,
    beaten: u64,
    mean_margin_thousandths: Option<i64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    histogram: Vec<u64>,
}

/// The intervals of all histograms.
#[derive(Clone, Copy)]
struct Bins {
    first: i64,
    width: u32,
    count: usize,
}

impl Bins {
    /// Intervals that contain all of these numbers, of 1, 2, 5, 10, 20, ... steps.
    fn of_ranges(ranges: impl Iterator<Item = (i64, i64)>) -> Self {
        let range = ranges.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (least, most) = range.unwrap_or((0, 0));
        let widths = (0..).flat_map(|power| [1, 2, 5].map(|it| it * 10_u32.pow(power)));
        let mut bins = widths.take(24).map(|width| {
            let (first, last) = (
                least.div_euclid(width.into()),
                most.div_euclid(width.into()),
            );
            (first * i64::from(width), width, last - first + 1)
        });
        let fitting = bins.find(|(_, _, count)| *count <= BINS_MAX);
        let (first, width, count) = fitting.expect("scores are less than a billion steps");
        Self {
            first,
            width,
            count: usize::try_from(count).expect("at most BINS_MAX"),
        }
    }
}

impl Study {
    /// Measures all robots of a matrix.
    pub fn new(matrix: &ScoreMatrix) -> Self {
        let sizes: BTreeSet<u8> = matrix.mazes.iter().map(|maze| maze.dimension).collect();
        let margins = |robot: usize, filter: MazeFilter| {
            Benchmark::ALL.map(|it| Margins::new(matrix, robot, filter, it))
        };
        let robots = || 0..matrix.robots.len();
        let ranges = robots().flat_map(|robot| margins(robot, MazeFilter::All));
        let bins = Bins::of_ranges(ranges.filter_map(|it| it.range()));
        let robots = robots().zip(&matrix.robots).map(|(index, robot)| Robot {
            name: robot.name.clone(),
            digest: robot.digest,
            variant: robot.variant,
            admitted: robot.not_admitted.is_none(),
            all: Part::new(&margins(index, MazeFilter::All), None),
            by_size: sizes
                .iter()
                .map(|&size| OfSize {
                    size,
                    part: Part::new(&margins(index, MazeFilter::Size(size)), Some(bins)),
                })
                .collect(),
        });
        Self {
            version: VERSION,
            rules: matrix.rules.name.clone(),
            seeds: matrix.seeds,
            bin_first: bins.first,
            bin_width: bins.width,
            robots: robots.collect(),
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// The study for people. Ends with a newline.
    pub fn to_text(&self, lines: Lines) -> String {
        let mut text = String::new();
        for robot in self.robots.iter().filter(|it| it.admitted) {
            let name = for_terminal(&robot.name);
            text += &format!("{name}: {}\n\n", robot.all.summary());
            for of_size in &robot.by_size {
                let (size, part) = (of_size.size, &of_size.part);
                text += &format!("{name}, size {size}: {}\n", part.summary());
                if part.finished > 0 {
                    text += &self.histograms(part, lines);
                }
                text.push('\n');
            }
        }
        text += "Margin: benchmark minus score, in steps; positive beats the benchmark. \
                 Benchmarks:\nthe optimal speed run after 1 (lower) or 2 (upper) exploration steps \
                 for each cell.\n";
        text
    }

    /// The histograms of both benchmarks, side by side.
    fn histograms(&self, part: &Part, lines: Lines) -> String {
        let [lower, upper] = part.benchmarks.each_ref().map(|it| &it.histogram);
        let most = lower.iter().chain(upper).max().copied().unwrap_or(0).max(1);
        let bar = |count: u64| {
            let symbol = match lines {
                Lines::Unicode => "█",
                Lines::Ascii => "#",
            };
            // Something is never shown as nothing.
            let length = (count * BAR_MAX).div_ceil(most);
            match count {
                0 => String::new(),
                _ => format!("{} {count}", symbol.repeat(length as usize)),
            }
        };
        let mut text = format!(
            "{:>14}  {:<32}  upper benchmark\n",
            "margin", "lower benchmark"
        );
        let is_empty = |bin: &usize| lower[*bin] == 0 && upper[*bin] == 0;
        let first = (0..lower.len()).find(|bin| !is_empty(bin)).unwrap_or(0);
        let last = (0..lower.len()).rfind(|bin| !is_empty(bin)).unwrap_or(0);
        for bin in first..=last {
            let from = self.bin_first + bin as i64 * i64::from(self.bin_width);
            let to = from + i64::from(self.bin_width);
            let range = format!("{from} to {to}");
            let line = format!("{range:>14}  {:<32}  {}", bar(lower[bin]), bar(upper[bin]));
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

impl Part {
    /// The matches with these margins to the lower and the upper benchmark.
    fn new(margins: &[Margins; 2], bins: Option<Bins>) -> Self {
        let [lower, upper] = margins;
        let measured = |margins: &Margins, benchmark: Benchmark| Measured {
            benchmark: benchmark.name(),
            beaten: margins.beaten(),
            mean_margin_thousandths: margins.mean().map(Mean::thousandths),
            histogram: bins.map_or_else(
                Vec::new,
                |Bins {
                     first,
                     width,
                     count,
                 }| { margins.histogram(first, width, count) },
            ),
        };
        let [first, second] = Benchmark::ALL;
        Self {
            matches: lower.matches,
            finished: lower.finished(),
            benchmarks: [measured(lower, first), measured(upper, second)],
        }
    }

    fn summary(&self) -> String {
        let mut text = format!(
            "finished {} of {}",
            self.finished,
            counted(self.matches, "match")
        );
        for measured in &self.benchmarks {
            if let Some(margin) = measured.mean_margin_thousandths {
                let share = Mean::fraction(i128::from(measured.beaten) * 100, self.finished.into());
                let hundredths = (share.thousandths() + 5) / 10;
                text += &format!(
                    "\n  beats the {} benchmark in {} ({}.{:02} %), mean margin {}",
                    measured.benchmark,
                    measured.beaten,
                    hundredths / 100,
                    hundredths % 100,
                    signed(margin),
                );
            }
        }
        text
    }
}

/// Thousandths of a step as steps, with a sign.
fn signed(thousandths: i64) -> String {
    let sign = if thousandths >= 0 { "+" } else { "" };
    format!("{sign}{}", Mean::fraction(thousandths.into(), 1000))
}

#[cfg(test)]
mod tests {
    use super::super::sample_matrix::matrix;
    use super::*;

    #[test]
    fn bins_contain_all_margins() {
        for (ranges, (first, width, count)) in [
            (&[][..], (0, 1, 1)),
            (&[(-3, 7), (0, 20)], (-3, 1, 24)),
            (&[(-4, 20)], (-4, 2, 13)),
            (&[(-900, 11)], (-900, 50, 19)),
        ] {
            let bins = Bins::of_ranges(ranges.iter().copied());
            assert_eq!((bins.first, bins.width, bins.count), (first, width, count));
        }
    }

    #[test]
    fn every_finished_match_is_in_both_histograms() {
        let study = Study::new(&matrix(&[12, 12, 12, 14]));
        for robot in &study.robots {
            for OfSize { part, .. } in &robot.by_size {
                for measured in &part.benchmarks {
                    assert_eq!(measured.histogram.iter().sum::<u64>(), part.finished);
                }
            }
        }
        let text = study.to_text(Lines::Ascii);
        assert!(
            text.contains("b, size 12: finished 2 of 3 matches\n"),
            "{text}"
        );
        // The oracle has 10 speed steps; `a` has 12 after 60 steps in 144 cells: 4.8 - 2 - 2.
        let summary = "beats the lower benchmark in 3 (100.00 %), mean margin +0.800";
        assert!(text.contains(summary), "{text}");
    }
}
