//! [`Frames`]: the constructs that are open, and whether what follows in them is ever reached.

use super::locals::Mark;
use super::value::index;

/// A construct that is open.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    pub(super) is_loop: bool,
    /// Whether several paths meet at its label.
    pub(super) is_joined: bool,
    /// Of an `if`: the compiler decides its condition.
    pub(super) is_decided: bool,
    /// What follows in it may never be reached.
    pub(super) is_doubtful: bool,
    /// A path surely leads to its end, whatever becomes of the others.
    pub(super) is_reached: bool,
    pub(super) began: u32,
    /// Where its changes of locals begin.
    pub(super) changes: Mark,
    /// Where its calls begin that may be passed by.
    pub(super) calls: usize,
}

/// All constructs that are open, the innermost last.
#[derive(Debug, Default)]
pub(super) struct Frames {
    all: Vec<Frame>,
    /// How many of them are doubtful.
    doubts: usize,
    /// How many of them are loops.
    loops: usize,
}

impl Frames {
    /// Has only that of the function.
    pub(super) fn begin(&mut self) {
        self.all.clear();
        self.all.push(Frame::default());
        self.doubts = 0;
        self.loops = 0;
    }

    /// Whether what is next is reached if the function is called and returns from its calls.
    pub(super) const fn is_certain(&self) -> bool {
        self.doubts == 0
    }

    /// Whether what is next may run more than once in a call.
    pub(super) const fn is_in_loop(&self) -> bool {
        self.loops > 0
    }

    pub(super) fn open(&mut self, frame: Frame) {
        self.doubts += usize::from(frame.is_doubtful);
        self.loops += usize::from(frame.is_loop);
        self.all.push(frame);
    }

    /// The innermost one.
    pub(super) fn last(&self) -> Option<&Frame> {
        self.all.last()
    }

    /// The compiler may decide a branch to the label that many constructs outwards: nothing that follows
    /// in all of them may be reached.
    pub(super) fn doubt(&mut self, label: u32) {
        let inside = self.all.iter_mut().rev();
        for frame in inside.take(index(label).saturating_add(1)) {
            self.doubts += usize::from(!frame.is_doubtful);
            frame.is_doubtful = true;
        }
    }

    /// A branch to the label that many constructs outwards.
    pub(super) fn branch(&mut self, label: u32) {
        let is_certain = self.is_certain();
        let target = self.all.len().checked_sub(index(label).saturating_add(1));
        if let Some(frame) = target.and_then(|target| self.all.get_mut(target)) {
            frame.is_joined = true;
            frame.is_reached |= is_certain && !frame.is_loop;
        }
    }

    /// The second branch of an `if` begins.
    pub(super) fn otherwise(&mut self) {
        let Some(frame) = self.all.last_mut() else {
            return;
        };
        frame.is_reached &= !frame.is_doubtful;
        if frame.is_doubtful && !frame.is_decided {
            frame.is_doubtful = false;
            self.doubts -= 1;
        }
    }

    /// Closes the innermost one. What follows is reached if its end is.
    pub(super) fn close(&mut self) -> Option<Frame> {
        let frame = self.all.pop()?;
        self.doubts -= usize::from(frame.is_doubtful);
        self.loops -= usize::from(frame.is_loop);
        if frame.is_doubtful && !frame.is_reached {
            self.doubt(0);
        }
        Some(frame)
    }

    /// What follows in the innermost one is reached by branches only. Returns where its calls began, and
    /// has them begin at `calls`: only once, also if what follows and is never reached leaves again.
    pub(super) fn leave(&mut self, calls: usize) -> Option<usize> {
        self.doubt(0);
        let frame = self.all.last_mut()?;
        Some(std::mem::replace(&mut frame.calls, calls))
    }
}
