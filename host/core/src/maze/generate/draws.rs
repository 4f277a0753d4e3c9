//! [`Draws`]: the only source of randomness of the generators.
//!
//! It maps the output of ChaCha8 to numbers itself. The helper functions of random number
//! libraries may return other numbers in a later version, and published mazes must not change.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A stream of random numbers that depends only on its key.
pub(super) struct Draws(ChaCha8Rng);

impl Draws {
    /// The stream for one maze. The 32 bytes of the ChaCha key are the seed (8 bytes, little
    /// endian), the size (1 byte), and the name of the kind, padded with zeros.
    pub(super) fn new(kind: &str, dimension: u8, seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8] = dimension;
        key[9..9 + kind.len()].copy_from_slice(kind.as_bytes());
        Self(ChaCha8Rng::from_seed(key))
    }

    /// A uniform random number from 0 to `bound` - 1.
    ///
    /// Multiplies instead of dividing, and rejects the few values that would make some results
    /// more likely (Lemire, "Fast random integer generation in an interval", 2019).
    ///
    /// # Panics
    ///
    /// If `bound` is 0.
    pub(super) fn below(&mut self, bound: u32) -> u32 {
        assert!(bound > 0, "no number is below 0");
        let unfair = bound.wrapping_neg() % bound;
        loop {
            let product = u64::from(self.0.next_u32()) * u64::from(bound);
            let [low, high] = [product as u32, (product >> 32) as u32];
            if low >= unfair {
                return high;
            }
        }
    }

    /// True in `percent` of 100 cases.
    pub(super) fn percent(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }

    /// A random index of a list of `len` elements, at least 1.
    pub(super) fn index(&mut self, len: usize) -> usize {
        let len = u32::try_from(len).expect("lists of edges and cells are short");
        self.below(len) as usize
    }

    /// A random item; `None` for no items, without a draw.
    pub(super) fn pick<T: Copy>(&mut self, items: &[T]) -> Option<T> {
        (!items.is_empty()).then(|| items[self.index(items.len())])
    }

    /// Shuffles the items (Fisher and Yates).
    pub(super) fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            let other = self.index(last + 1);
            items.swap(last, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_below_the_bound_are_uniform() {
        let mut draws = Draws::new("test", 12, 1);
        let mut counts = [0_u32; 7];
        for _ in 0..7_000 {
            counts[draws.below(7) as usize] += 1;
        }
        assert!(
            counts.iter().all(|count| (850..1150).contains(count)),
            "{counts:?}"
        );
    }

    #[test]
    fn a_shuffle_keeps_every_item() {
        let mut items: Vec<u32> = (0..50).collect();
        Draws::new("test", 12, 2).shuffle(&mut items);
        assert_ne!(items, (0..50).collect::<Vec<_>>());
        items.sort_unstable();
        assert_eq!(items, (0..50).collect::<Vec<_>>());
    }

    #[test]
    fn streams_differ_by_kind_size_and_seed() {
        let first = |kind, dimension, seed| Draws::new(kind, dimension, seed).below(u32::MAX);
        let base = first("tree", 12, 1);
        assert_eq!(base, first("tree", 12, 1));
        assert_ne!(base, first("braid", 12, 1));
        assert_ne!(base, first("tree", 14, 1));
        assert_ne!(base, first("tree", 12, 2));
        assert_ne!(base, first("tree", 12, 1 << 40));
    }
}
