//! [`Value`] and [`Call`]: what `pressure` records of a function.

use super::folding::Folded;

/// A value, with where it is made and used: numbers of operators.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    pub(super) first: u32,
    pub(super) last: u32,
    /// Where it is used last by something that needs it in a register.
    pub(super) computed: u32,
    /// Its last use as an argument of a block: where paths meet, or the next round of a loop begins.
    pub(super) handed_on: u32,
    /// Machine instructions that make it, about.
    pub(super) weight: u32,
    /// Constants are made where they are used.
    pub(super) is_constant: bool,
    /// The zero of a local that was not written yet: a constant as well.
    pub(super) is_initial: bool,
    /// The one value that it is computed from, with constants; `None` if it is not computed, or from
    /// several.
    pub(super) from: Option<u32>,
    /// What the compiler knows of it, to decide branches on it.
    pub(super) folded: Folded,
    pub(super) is_float: bool,
    /// The value that it is taken for when operators on equal values are looked up.
    pub(super) root: u32,
    /// Of a block parameter: two of its arguments, the last one in the code first.
    pub(super) joins: Option<[u32; 2]>,
    /// Start of the outermost loop that writes its local: a block parameter from there on.
    pub(super) loops: u32,
    /// What it is computed from, if that has no other effect: then it is made where it is first needed.
    pub(super) pure: Option<[u32; 3]>,
    /// Where something needs it first that stays where it is in the code.
    pub(super) needed: u32,
    /// Where a branch hands it on first: it is needed there, unless all paths hand on the same.
    pub(super) carried: u32,
}

impl Value {
    /// In no loop.
    pub(super) const NO_LOOP: u32 = u32::MAX;

    /// Needed nowhere.
    const NOWHERE: u32 = u32::MAX;

    /// One that is made at an operator, with that number.
    pub(super) const fn new(at: u32, weight: u32, is_constant: bool, number: u32) -> Self {
        Self {
            first: at,
            last: at,
            computed: at,
            handed_on: 0,
            weight,
            is_constant,
            is_initial: false,
            from: None,
            folded: Folded::UNKNOWN,
            is_float: false,
            root: number,
            joins: None,
            loops: Self::NO_LOOP,
            pure: None,
            needed: Self::NOWHERE,
            carried: Self::NOWHERE,
        }
    }

    /// Where it is made, if it is computed without other effects and needed anywhere.
    pub(super) fn placed(&self) -> Option<(u32, [u32; 3])> {
        let at = match (self.needed, self.carried) {
            (Self::NOWHERE, Self::NOWHERE) => return None,
            (Self::NOWHERE, carried) => carried,
            (needed, _) => needed,
        };
        Some((at.max(self.first), self.pure?))
    }

    pub(super) fn is_used(&self) -> bool {
        self.last.max(self.handed_on) > self.first
    }

    /// Where it is live as a block parameter (`joined`), or as anything else: from and to, which are
    /// equal if it never is.
    pub(super) fn alive(&self, joined: bool) -> (u32, u32) {
        let last = self.last.max(self.handed_on);
        match (self.joins.is_some(), joined) {
            (true, true) => (self.first, last),
            (true, false) => (last, last),
            (false, true) => (self.loops.min(last), last),
            (false, false) => (self.first, self.loops.min(last)),
        }
    }
}

/// A call, or the start of a loop: it checks fuel and epoch, and calls the host in blocks at the end of
/// the function.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call {
    pub(super) at: u32,
    /// From here on all paths pass it by.
    pub(super) until: u32,
    /// Whether it depends on nothing that the compiler decides: what is never made, it drops.
    pub(super) is_certain: bool,
    pub(super) is_loop: bool,
}

impl Call {
    /// Calls that are looked at for one value.
    pub(super) const LOOKED_AT: usize = 64;
}

/// The index of what has that number.
pub(super) fn index(number: u32) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}
