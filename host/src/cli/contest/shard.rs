//! [`Shard`]: the part of a contest that one of several machines plays.

use std::str::FromStr;

/// One of `count` parts of the mazes of a contest: every `count`th maze. So a part has mazes of all
/// sets, and every robot plays all mazes of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Counted from 0.
    index: u32,
    /// At least 1.
    count: u32,
}

impl Shard {
    /// The whole contest.
    pub const ALL: Self = Self { index: 0, count: 1 };

    /// Whether a maze is in this part, by its position in the contest.
    pub const fn has(self, maze: usize) -> bool {
        maze % self.count as usize == self.index as usize
    }

    /// Whether it is the whole contest.
    pub const fn is_all(self) -> bool {
        self.count == 1
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, &'static str> {
        const EXPECTED: &str = "expected I/N with I from 1 to N, such as 2/4";
        let (index, count) = text.split_once('/').ok_or(EXPECTED)?;
        let number = |text: &str| text.parse::<u32>().map_err(|_| EXPECTED);
        let (index, count) = (number(index)?, number(count)?);
        if index < 1 || index > count {
            return Err(EXPECTED);
        }
        let index = index - 1;
        Ok(Self { index, count })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_maze_is_in_one_shard() {
        let shards = ["1/3", "2/3", "3/3"].map(|it| it.parse::<Shard>().expect("a shard"));
        for maze in 0..20 {
            assert_eq!(shards.iter().filter(|it| it.has(maze)).count(), 1);
        }
        assert!((0..20).all(|maze| Shard::ALL.has(maze)));
    }

    #[test]
    fn what_is_no_shard_is_rejected() {
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/3", "1/3/5", "a/b", " 1/3"] {
            text.parse::<Shard>().expect_err(text);
        }
    }
}
