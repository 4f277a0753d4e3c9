//! [`Outlook`]: the bounds of the optimal speed run.

/// The fewest and the most steps that the optimal speed run can have, by what is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Outlook {
    /// Steps if no unknown wall is there; `None` if the goal is known to be unreachable.
    pub optimistic: Option<u32>,
    /// Steps if all unknown walls are there: the best path through known openings. `None` if
    /// there is no such path yet.
    pub pessimistic: Option<u32>,
}

impl Outlook {
    /// Whether the best known path is proven to be optimal.
    pub fn is_certain(self) -> bool {
        self.pessimistic.is_some() && self.optimistic == self.pessimistic
    }

    /// How many steps a better path could save at most, compared with the best known one; `None`
    /// if none is known.
    pub fn might_save(self) -> Option<u32> {
        Some(self.pessimistic? - self.optimistic?)
    }
}
