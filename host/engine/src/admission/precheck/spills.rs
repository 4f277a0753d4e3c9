//! [`Spills`]: what a function leaves behind that makes the others take longer.
//!
//! `conflict_set` of `regalloc2::ion` has the values that are in the way of another one in a register.
//! It belongs to what a thread of the compiler keeps from function to function, and never becomes
//! smaller. It is emptied before each try to find a register, if the last one found something in the
//! way, and emptying it takes time for its capacity. So after one function that made it large, every
//! function with more values than registers takes longer: 60 functions of 30 KB took 0.06 s each alone,
//! and 0.27 s each after one of 800 KB.
//!
//! How functions are given to threads is not known, so all of a file take place with the largest set
//! that any of them makes.

/// What the allocator of registers does for a function.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spills {
    /// Tries to find a register that find other values in the way.
    pub(super) tries: u64,
    /// The most values that are in the way of one, in one register.
    pub(super) conflicts: u64,
}

impl Spills {
    /// Adds another function.
    pub(super) fn add(&mut self, other: Self) {
        self.tries = self.tries.saturating_add(other.tries);
        self.conflicts = self.conflicts.max(other.conflicts);
    }

    /// The time to empty the set for all tries, in ns: 40 bytes in each.
    pub(super) const fn work_ns(&self) -> u64 {
        // One byte for each slot, of which one in eight stays free.
        let slots = (self.conflicts.saturating_mul(8) / 7).saturating_add(1);
        let bytes = match slots.checked_next_power_of_two() {
            Some(bytes) => bytes,
            None => u64::MAX,
        };
        self.tries.saturating_mul(bytes) / 40
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_set_is_emptied_for_all() {
        let mut all = Spills::default();
        all.add(Spills {
            tries: 10,
            conflicts: 100_000,
        });
        all.add(Spills {
            tries: 1_000_000,
            conflicts: 10,
        });
        assert_eq!(all.work_ns(), 1_000_010 * 131_072 / 40);
    }
}
