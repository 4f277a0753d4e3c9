//! [`Sets`]: disjoint sets, for cells or posts that are connected.

/// A partition of the numbers from 0 to `size` - 1: union-find with path halving.
///
/// There are no ranks, because path halving alone keeps sets of this size shallow.
#[derive(Clone)]
pub(super) struct Sets {
    parents: Vec<u16>,
}

impl Sets {
    /// `size` sets of one number each.
    pub(super) fn new(size: usize) -> Self {
        let size = u16::try_from(size).expect("a maze has few cells and posts");
        Self {
            parents: (0..size).collect(),
        }
    }

    /// Unites the sets of two numbers; false if they were in the same set.
    pub(super) fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[usize::from(a)] = b;
        a != b
    }

    fn root(&mut self, of: usize) -> u16 {
        let mut at = of;
        loop {
            let parent = usize::from(self.parents[at]);
            if parent == at {
                return self.parents[at];
            }
            self.parents[at] = self.parents[parent];
            at = usize::from(self.parents[at]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joining_is_transitive() {
        let mut sets = Sets::new(6);
        assert!(sets.join(0, 1) && sets.join(2, 3) && sets.join(1, 2));
        assert!(!sets.join(3, 0));
        assert!(sets.join(4, 0) && sets.join(5, 4) && !sets.join(5, 2));
    }
}
