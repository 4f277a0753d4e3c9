//! [`Listed`]: the first items of a list, and how many follow.
//!
//! Messages name cells, and stay readable if a file has hundreds of invalid ones.

use std::fmt;

/// The most items that a message names.
const NAMED_MAX: usize = 8;

/// Displays the first [`NAMED_MAX`] items and counts the rest: `a, b and 3 more`.
pub(super) struct Listed<'a, T>(pub &'a [T]);

impl<T: fmt::Display> fmt::Display for Listed<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = self.0.len().min(NAMED_MAX);
        for (place, item) in self.0[..named].iter().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            write!(f, "{separator}{item}")?;
        }
        match self.0.len() - named {
            0 => Ok(()),
            rest => write!(f, " and {rest} more"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_are_shortened() {
        let items: Vec<usize> = (1..=10).collect();
        assert_eq!(Listed(&items[..2]).to_string(), "1, 2");
        assert_eq!(Listed(&items[..8]).to_string(), "1, 2, 3, 4, 5, 6, 7, 8");
        assert_eq!(
            Listed(&items).to_string(),
            "1, 2, 3, 4, 5, 6, 7, 8 and 2 more"
        );
    }
}
