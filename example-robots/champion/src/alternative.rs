//! Things that could be done, compared by what they cost in the same imagined mazes:
//! [`Alternative`].

use wasmouse_sdk::Hop;

/// An alternative is dropped when it is worse than the best by this many standard
/// errors; the first one only by [`FIRST_PATIENCE`] times as many.
const DROP: f32 = 1.5;

/// See [`DROP`].
const FIRST_PATIENCE: f32 = 2.5;

/// Something that could be done now.
pub struct Alternative {
    /// The hops to drive, until there is news. None where it says not to explore on.
    pub hops: Vec<Hop>,
    /// What it costs in each imagined maze, in steps of exploring.
    pub costs: Vec<f32>,
    /// Whether it is out of the question by now.
    pub is_dropped: bool,
}

impl Alternative {
    /// Not played yet.
    pub const fn new(hops: Vec<Hop>) -> Self {
        Self {
            hops,
            costs: Vec::new(),
            is_dropped: false,
        }
    }

    fn mean(&self) -> f32 {
        self.costs.iter().sum::<f32>() / self.costs.len() as f32
    }

    /// By how much this one is dearer than another, and the standard error of that:
    /// in each maze the two are compared, so what the mazes have in common cancels.
    fn excess(&self, other: &Self) -> (f32, f32) {
        let pairs = self.costs.iter().zip(&other.costs);
        let differences: Vec<f32> = pairs.map(|(a, b)| a - b).collect();
        let count = differences.len() as f32;
        let mean = differences.iter().sum::<f32>() / count;
        let squares = differences.iter().map(|it| (it - mean) * (it - mean));
        let variance = squares.sum::<f32>() / (count - 1.0).max(1.0);
        (mean, (variance / count).sqrt())
    }
}

/// Drops what is clearly worse than the best; how many are left.
pub fn drop_bad(alternatives: &mut [Alternative]) -> usize {
    let best = cheapest(alternatives);
    for index in 0..alternatives.len() {
        if index == best || alternatives[index].is_dropped {
            continue;
        }
        let (excess, error) = alternatives[index].excess(&alternatives[best]);
        let patience = if index == 0 { FIRST_PATIENCE } else { 1.0 };
        alternatives[index].is_dropped = excess > patience * DROP * error;
    }
    alternatives.iter().filter(|it| !it.is_dropped).count()
}

/// The index of the one to choose: the cheapest, if it is cheaper than the first by
/// that many standard errors, and otherwise the first.
pub fn choose(alternatives: &[Alternative], clear: f32) -> usize {
    let best = cheapest(alternatives);
    let first = &alternatives[0];
    if first.is_dropped || best == 0 {
        return best;
    }
    let (excess, error) = first.excess(&alternatives[best]);
    if excess > clear * error { best } else { 0 }
}

/// The one with the smallest mean, the first of equals.
fn cheapest(alternatives: &[Alternative]) -> usize {
    let mut best = None;
    for (index, alternative) in alternatives.iter().enumerate() {
        let mean = alternative.mean();
        if !alternative.is_dropped && best.is_none_or(|(_, least)| mean < least) {
            best = Some((index, mean));
        }
    }
    best.expect("the best one is never dropped").0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alternatives(costs: &[&[f32]]) -> Vec<Alternative> {
        let of = |costs: &&[f32]| Alternative {
            costs: costs.to_vec(),
            ..Alternative::new(Vec::new())
        };
        costs.iter().map(of).collect()
    }

    #[test]
    fn the_first_is_overruled_when_it_is_clear() {
        // Always 2 cheaper, however much the mazes differ.
        let clear = alternatives(&[&[50.0, 10.0, 30.0], &[48.0, 8.1, 27.9]]);
        assert_eq!(choose(&clear, 2.0), 1);
        // Cheaper on average, by chance.
        let unclear = alternatives(&[&[50.0, 10.0, 30.0], &[20.0, 20.0, 40.0]]);
        assert_eq!(choose(&unclear, 2.0), 0);
        assert_eq!(choose(&unclear, 0.1), 1);
    }

    #[test]
    fn bad_ones_are_dropped() {
        let mut all = alternatives(&[&[9.0, 5.5], &[5.0, 5.0], &[7.0, 7.1], &[2.0, 9.0]]);
        assert_eq!(drop_bad(&mut all), 3);
        assert!(all[2].is_dropped);
    }
}
