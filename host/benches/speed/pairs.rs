//! [`side_by_side`]: two things timed in turns, so that whatever else the machine
//! does slows down both, and their ratio stays true.

use std::time::{Duration, Instant};

/// What two things took.
pub struct Pair {
    /// The median time of the first.
    pub first: Duration,
    /// The median time of the second.
    pub second: Duration,
    /// The median of the ratios of neighbouring times, first over second.
    pub ratio: f64,
}

/// Rounds of a measurement; enough that a busy moment does not move a median.
const ROUNDS: usize = 301;

/// Times one and the other in turns. Each should take some 10 us or more.
pub fn side_by_side(mut first: impl FnMut(), mut second: impl FnMut()) -> Pair {
    for _ in 0..ROUNDS / 10 {
        first();
        second();
    }
    let mut times = Vec::with_capacity(ROUNDS);
    for _ in 0..ROUNDS {
        times.push((time(&mut first), time(&mut second)));
    }
    let ratio =
        |&(first, second): &(Duration, Duration)| first.as_secs_f64() / second.as_secs_f64();
    Pair {
        first: median(times.iter().map(|it| it.0)),
        second: median(times.iter().map(|it| it.1)),
        ratio: middle(times.iter().map(ratio).collect(), f64::total_cmp),
    }
}

/// The median time of something, over that many rounds.
pub fn alone(rounds: usize, mut task: impl FnMut()) -> Duration {
    task();
    median((0..rounds).map(|_| time(&mut task)))
}

fn time(task: &mut impl FnMut()) -> Duration {
    let begin = Instant::now();
    task();
    begin.elapsed()
}

fn median(times: impl Iterator<Item = Duration>) -> Duration {
    middle(times.collect(), Duration::cmp)
}

fn middle<T: Copy>(mut values: Vec<T>, order: impl Fn(&T, &T) -> std::cmp::Ordering) -> T {
    let place = values.len() / 2;
    *values.select_nth_unstable_by(place, |a, b| order(a, b)).1
}
