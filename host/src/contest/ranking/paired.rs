//! [`PairedComparison`]: two robots in the same mazes.

use super::bootstrap::{Bootstrap, Item};
use super::points::Points;
use super::selection::MazeFilter;
use crate::contest::matrix::ScoreMatrix;
use crate::contest::mean::Mean;
use crate::contest::scoring::Scoring;

/// How one robot did compared with another in the same mazes.
///
/// It is about the mazes that both have played with every seed and whose goal can be reached. An
/// unfinished match counts as the penalty of the [`Scoring`]. Matches of one maze resemble each
/// other, so the seeds of a maze are averaged first, and the mazes are what is sampled: more seeds
/// do not pretend to be more mazes.
///
/// Differences are the first robot's score minus the second's: negative ones are in favour of the
/// first. Each maze counts as often as its set says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairedComparison {
    /// How many mazes were compared.
    pub mazes: u64,
    /// Mazes in which the first robot scored better on average.
    pub wins: u64,
    /// Mazes in which both scored equally well.
    pub ties: u64,
    /// Mazes in which the first robot scored worse.
    pub losses: u64,
    /// The average difference, in steps; `None` without mazes.
    pub difference: Option<Mean>,
    /// The 95 % interval of the average difference, in thousandths of a step: a bootstrap over
    /// mazes, bias-corrected and accelerated (BCa; Efron and Tibshirani, "An Introduction to the
    /// Bootstrap", 1993, chapter 14), with 10,000 resamples, or fewer, but at least 1000, for more
    /// than 20,000 mazes. `None` with fewer than two mazes.
    pub interval_thousandths: Option<[i64; 2]>,
    /// The standard error of the average difference, in thousandths of a step; `None` as above.
    pub standard_error_thousandths: Option<u64>,
    /// Who is better.
    pub verdict: PairedVerdict,
    /// About how many such mazes would decide, in 4 of 5 attempts, if the average difference
    /// really is what it seems to be: `((1.96 + 0.84) * deviation / difference)^2`, where the
    /// deviation of a maze is the standard error times the root of the number of mazes (the sample
    /// size of a paired comparison; Cohen, "Statistical Power Analysis", 1988, chapter 2). `None`
    /// without a difference or an interval.
    pub mazes_to_decide: Option<u64>,
}

/// Who is better, the first robot or the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairedVerdict {
    /// The first: the interval has only negative differences.
    Better,
    /// The second: the interval has only positive differences.
    Worse,
    /// The interval contains 0, or fewer than [`PairedComparison::DECIDING_MAZES_MIN`] mazes make a difference.
    Undecided,
}

/// The normal distribution's quantiles at 97.5 % and at 80 %, added up.
const Z_POWER: f64 = 1.959_964 + 0.841_621;

impl PairedVerdict {
    /// `better`, `worse` or `undecided`: what the first robot is.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Better => "better",
            Self::Worse => "worse",
            Self::Undecided => "undecided",
        }
    }
}

impl PairedComparison {
    /// The least number of mazes with a difference that can decide. Were both robots equally good,
    /// five mazes would all favour the same one in 6 % of comparisons (sign test), which is more
    /// than the 5 % that the interval allows.
    pub const DECIDING_MAZES_MIN: u64 = 6;

    /// Compares two robots, given by their indices in the matrix.
    pub fn new(
        matrix: &ScoreMatrix,
        scoring: &Scoring,
        filter: MazeFilter,
        (first, second): (usize, usize),
    ) -> Self {
        let points = Points::new(&matrix.rules, scoring);
        let mut items = Vec::new();
        for maze in filter.mazes(matrix) {
            let is_reachable = matrix.mazes[maze].oracle.is_some();
            let value = is_reachable
                .then(|| difference(matrix, &points, maze, (first, second)))
                .flatten();
            let weight = matrix.weight(maze);
            items.extend(value.map(|value| Item { value, weight }));
        }
        // What a step is in the values of the items.
        let step = i128::from(points.divisor) * i128::from(matrix.seeds.count);
        Self::of_items(&items, step)
    }

    fn of_items(items: &[Item], step: i128) -> Self {
        let count = |is_counted: fn(i64) -> bool| {
            let counted = items.iter().filter(|item| is_counted(item.value));
            counted.count() as u64
        };
        let (wins, losses) = (count(|it| it < 0), count(|it| it > 0));
        let weighted = |item: &Item| i128::from(item.value) * i128::from(item.weight);
        let sum: i128 = items.iter().map(weighted).sum();
        let weight: i128 = items.iter().map(|item| i128::from(item.weight)).sum();
        let bootstrap = Bootstrap::new(items);
        let thousandths = |value: f64| value * 1000.0 / step as f64;
        let interval = bootstrap.map(|it| it.interval.map(|end| thousandths(end).round() as i64));
        let verdict = match interval {
            Some([_, high]) if high < 0 => PairedVerdict::Better,
            Some([low, _]) if low > 0 => PairedVerdict::Worse,
            _ => PairedVerdict::Undecided,
        };
        let mazes_to_decide = bootstrap.filter(|_| sum != 0).map(|it| {
            let deviation = it.standard_error * (items.len() as f64).sqrt();
            let effect = (sum as f64 / weight as f64).abs();
            let root = Z_POWER * deviation / effect;
            ((root * root).ceil() as u64).max(Self::DECIDING_MAZES_MIN)
        });
        Self {
            mazes: items.len() as u64,
            wins,
            ties: items.len() as u64 - wins - losses,
            losses,
            difference: (weight > 0).then(|| Mean::fraction(sum, step * weight)),
            interval_thousandths: interval,
            standard_error_thousandths: bootstrap
                .map(|it| thousandths(it.standard_error).round() as u64),
            verdict: match wins + losses >= Self::DECIDING_MAZES_MIN {
                true => verdict,
                false => PairedVerdict::Undecided,
            },
            mazes_to_decide,
        }
    }
}

/// The difference of two robots in a maze, added up over the seeds; `None` unless both have played
/// it with every seed.
fn difference(
    matrix: &ScoreMatrix,
    points: &Points,
    maze: usize,
    (first, second): (usize, usize),
) -> Option<i64> {
    let mut sum = 0_i128;
    for seed in 0..matrix.seeds.count {
        let row = matrix.row(maze, seed);
        let score = |robot: usize| {
            let played = row[robot].as_ref()?;
            Some(points.score(played).unwrap_or(points.penalty))
        };
        sum += i128::from(score(first)?) - i128::from(score(second)?);
    }
    // Larger sums need rules with billions of steps.
    Some(sum.clamp(i64::MIN.into(), i64::MAX.into()) as i64)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::testing::{Sketch, failed, finished, sketches};
    use super::*;

    fn compare(matrix: &ScoreMatrix, robots: (usize, usize)) -> PairedComparison {
        PairedComparison::new(matrix, &Scoring::default(), MazeFilter::All, robots)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn exchanging_the_robots_exchanges_everything(sketch in sketches()) {
            let matrix = sketch.matrix();
            let last = sketch.robots - 1;
            let (one, other) = (compare(&matrix, (0, last)), compare(&matrix, (last, 0)));
            let zero = Mean::fraction(0, 1);
            let mirrored = PairedComparison {
                wins: other.losses,
                losses: other.wins,
                difference: other.difference.map(|it| zero.minus(it)),
                interval_thousandths: other.interval_thousandths.map(|[low, high]| [-high, -low]),
                verdict: match other.verdict {
                    PairedVerdict::Better => PairedVerdict::Worse,
                    PairedVerdict::Worse => PairedVerdict::Better,
                    PairedVerdict::Undecided => PairedVerdict::Undecided,
                },
                ..other
            };
            prop_assert_eq!(one, mirrored);
        }

        #[test]
        fn a_robot_is_not_better_than_itself(sketch in sketches()) {
            let found = compare(&sketch.matrix(), (0, 0));
            prop_assert_eq!((found.wins, found.losses, found.ties), (0, 0, found.mazes));
            prop_assert_eq!(found.verdict, PairedVerdict::Undecided);
            prop_assert_eq!(found.difference.map_or(0, Mean::thousandths), 0);
            prop_assert_eq!(found.interval_thousandths.unwrap_or_default(), [0, 0]);
            prop_assert_eq!(found.mazes_to_decide, None);
        }
    }

    /// Two robots, the first of which needs so many steps less in the speed run of each maze.
    fn gains(gains: &[u32]) -> ScoreMatrix {
        let rows = gains
            .iter()
            .map(|gain| vec![finished(60, 20 - gain), finished(60, 20)]);
        Sketch::of_rows(&rows.collect::<Vec<_>>()).matrix()
    }

    #[test]
    fn a_clear_difference_decides_from_six_mazes_on() {
        let six = compare(&gains(&[1, 2, 1, 3, 2, 1]), (0, 1));
        assert_eq!(six.verdict, PairedVerdict::Better);
        assert_eq!((six.wins, six.ties, six.losses), (6, 0, 0));
        assert_eq!(six.difference, Some(Mean::fraction(-10, 6)));
        let [low, high] = six.interval_thousandths.expect("six mazes");
        assert!(
            -3000 < low && low < -1667 && -1667 < high && high < 0,
            "{low} {high}"
        );
        // Ties say nothing, however many there are.
        let five = compare(&gains(&[1, 2, 1, 3, 2, 0, 0]), (0, 1));
        assert_eq!(five.verdict, PairedVerdict::Undecided);
        assert!(five.interval_thousandths.is_some_and(|[_, high]| high < 0));
    }

    #[test]
    fn few_penalties_decide_nothing_yet() {
        let mut rows = vec![vec![finished(60, 20), finished(60, 21)]; 30];
        rows[4][0] = failed();
        let found = compare(&Sketch::of_rows(&rows).matrix(), (0, 1));
        assert_eq!((found.wins, found.losses), (29, 1));
        assert_eq!(found.verdict, PairedVerdict::Undecided);
        // (977 - 29) / 30 on average, with a deviation of about 178 steps.
        assert_eq!(found.difference, Some(Mean::fraction(977 - 29, 30)));
        let needed = found.mazes_to_decide.expect("a difference");
        assert!((200..300).contains(&needed), "{needed}");
    }

    #[test]
    fn seeds_of_a_maze_are_one_observation() {
        let mut sketch = Sketch::of_rows(&[vec![finished(60, 20), finished(60, 21)]]);
        sketch.seeds = 10;
        let cells = sketch.mazes[0].cells.repeat(10);
        sketch.mazes[0].cells = cells;
        let found = compare(&sketch.matrix(), (0, 1));
        assert_eq!((found.mazes, found.wins), (1, 1));
        assert_eq!(found.difference, Some(Mean::fraction(-1, 1)));
        assert_eq!(found.interval_thousandths, None);
        // A maze with a missing match cannot be compared.
        sketch.mazes[0].cells[3] = None;
        assert_eq!(compare(&sketch.matrix(), (0, 1)).mazes, 0);
    }
}
