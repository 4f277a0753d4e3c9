//! [`Depth`]: how deep the blocks of a function are in its dominator tree.
//!
//! A compiler walks up that tree: from every branch to where paths meet
//! (`regalloc2::domtree::merge_sets`), and from every new value to the block that it could be
//! computed in (`EgraphPass::depth_of_block_in_gvn_map`). Such a walk is short in what compilers of
//! languages make, however many blocks it has, because the tree is flat after every join. A chain of
//! thousands of branches makes it long.
//!
//! Code is structured, so one pass is enough: a join is at most one deeper than the least deep of
//! the blocks that lead to it, and what is dead is not compiled.

/// The construct that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Block,
    Loop,
    /// The depth of its condition, which leads to its end as long as there is no `else`.
    If {
        condition: u64,
        has_else: bool,
    },
}

#[derive(Clone, Copy, Debug)]
struct Frame {
    kind: Kind,
    /// The least depth of what leads to its end so far.
    least: u64,
    /// The depth where it begins: where nothing leads to its end, it does not matter.
    begin: u64,
}

/// The depth while a function is read.
#[derive(Debug, Default)]
pub(super) struct Depth {
    frames: Vec<Frame>,
    now: u64,
    is_dead: bool,
}

impl Depth {
    /// Begins a function.
    pub(super) fn begin(&mut self) {
        self.frames.clear();
        self.now = 1;
        self.is_dead = false;
        self.open(Kind::Block);
    }

    /// The depth of the block that the next operator is in. From 1.
    pub(super) const fn now(&self) -> u64 {
        self.now
    }

    fn open(&mut self, kind: Kind) {
        self.frames.push(Frame {
            kind,
            least: u64::MAX,
            begin: self.now,
        });
    }

    /// A `block` begins.
    pub(super) fn block(&mut self) {
        self.open(Kind::Block);
    }

    /// A `loop` begins, with its checks.
    pub(super) fn repeat(&mut self) {
        self.open(Kind::Loop);
        self.fork(3);
    }

    /// An `if` begins.
    pub(super) fn condition(&mut self) {
        self.open(Kind::If {
            condition: self.now,
            has_else: false,
        });
        self.fork(1);
    }

    /// The second branch of an `if` begins.
    pub(super) fn otherwise(&mut self) {
        let (now, is_dead) = (self.now, self.is_dead);
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        if let Kind::If {
            condition,
            has_else,
        } = &mut frame.kind
        {
            *has_else = true;
            self.now = *condition + 1;
        }
        if !is_dead {
            frame.least = frame.least.min(now);
        }
        self.is_dead = false;
    }

    /// The innermost construct ends.
    pub(super) fn close(&mut self) {
        let Some(mut frame) = self.frames.pop() else {
            return;
        };
        if !self.is_dead {
            frame.least = frame.least.min(self.now);
        }
        match frame.kind {
            // Its label is its beginning.
            Kind::Loop => return,
            Kind::If {
                condition,
                has_else: false,
            } => frame.least = frame.least.min(condition),
            Kind::Block | Kind::If { .. } => {}
        }
        self.is_dead = frame.least == u64::MAX;
        self.now = match self.is_dead {
            true => frame.begin,
            false => frame.least + 1,
        };
    }

    /// A branch to the label that many constructs outwards, over a block of its own.
    pub(super) fn branch(&mut self, label: u32) {
        let label = usize::try_from(label).unwrap_or(usize::MAX);
        let position = self.frames.len().checked_sub(label.saturating_add(1));
        if let Some(frame) = position.and_then(|position| self.frames.get_mut(position))
            && !self.is_dead
            && frame.kind != Kind::Loop
        {
            frame.least = frame.least.min(self.now + 1);
        }
    }

    /// The code goes on in a block that the present one leads to, over that many blocks.
    pub(super) const fn fork(&mut self, blocks: u64) {
        self.now += blocks;
    }

    /// The code after this is reached by branches only.
    pub(super) const fn leave(&mut self) {
        self.is_dead = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_of_branches_is_deep() {
        let mut depth = Depth::default();
        depth.begin();
        depth.block();
        for _ in 0..100 {
            depth.branch(0);
            depth.fork(1);
        }
        assert_eq!(depth.now(), 101);
        // The first branch leads there too.
        depth.close();
        assert_eq!(depth.now(), 3);
    }

    #[test]
    fn joins_make_the_tree_flat() {
        let mut depth = Depth::default();
        depth.begin();
        for _ in 0..100 {
            depth.condition();
            depth.fork(10);
            depth.repeat();
            depth.close();
            depth.close();
        }
        assert_eq!(depth.now(), 101);
        // What is dead leads nowhere.
        depth.block();
        depth.branch(1);
        depth.leave();
        depth.branch(0);
        depth.close();
        assert!(depth.is_dead);
    }
}
