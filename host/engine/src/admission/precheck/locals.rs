//! [`Locals`]: the values of the locals, and what open constructs changed of them.

use super::value::index;

/// Where the changes of a construct begin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mark {
    changes: usize,
    /// If it is an `if`: of those that its first branch made.
    before: usize,
}

/// The locals of a function while it is read.
#[derive(Debug, Default)]
pub(super) struct Locals {
    values: Vec<u32>,
    /// Locals with the values that they had before.
    changes: Vec<(u32, u32)>,
    /// Changes that the first branches of open constructs made.
    before: Vec<(u32, u32)>,
    /// For each local the last `meet` that it was part of.
    met: Vec<u32>,
    meetings: u32,
}

impl Locals {
    pub(super) fn clear(&mut self) {
        self.values.clear();
        self.changes.clear();
        self.before.clear();
        self.met.clear();
        self.meetings = 0;
    }

    /// Adds a local.
    pub(super) fn push(&mut self, value: u32) {
        self.values.push(value);
        self.met.push(0);
    }

    /// The value of a local; `None` if there is no such local, which validation rejects.
    pub(super) fn get(&self, local: u32) -> Option<u32> {
        self.values.get(index(local)).copied()
    }

    /// Writes a local.
    pub(super) fn write(&mut self, local: u32, value: u32) {
        if let Some(present) = self.values.get_mut(index(local)) {
            self.changes.push((local, *present));
            *present = value;
        }
    }

    /// The mark of a construct that begins here.
    pub(super) const fn mark(&self) -> Mark {
        Mark {
            changes: self.changes.len(),
            before: self.before.len(),
        }
    }

    /// Gives all locals the values that they had at a mark.
    pub(super) fn restore(&mut self, mark: Mark) {
        while self.changes.len() > mark.changes {
            if let Some((local, value)) = self.changes.pop() {
                self.values[index(local)] = value;
                self.before.push((local, value));
            }
        }
    }

    /// Gives each local that was changed since a mark on any path the value that `meet` makes of its
    /// present value and the one at the mark. Each counts as one change from here on.
    pub(super) fn meet(&mut self, mark: Mark, mut meet: impl FnMut(u32, u32) -> u32) {
        // The oldest change of a local is the last one there.
        let before = self.before.drain(mark.before..).rev();
        self.changes.extend(before);
        self.meetings += 1;
        let mut kept = mark.changes;
        for at in mark.changes..self.changes.len() {
            let (local, previous) = self.changes[at];
            let last = std::mem::replace(&mut self.met[index(local)], self.meetings);
            if last == self.meetings {
                continue;
            }
            self.changes[kept] = (local, previous);
            kept += 1;
            let present = &mut self.values[index(local)];
            *present = meet(*present, previous);
        }
        self.changes.truncate(kept);
    }
}
