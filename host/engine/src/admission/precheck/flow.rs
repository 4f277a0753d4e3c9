//! [`Flow`]: how many values control flow brings together in a function.
//!
//! A compiler to machine code keeps one value per local and path. Where paths meet,
//! every local that has been written along the path and is read afterwards becomes a
//! parameter of the block (*joined*), and every edge into that block carries one
//! argument for each (*carried*). The time and memory that Cranelift takes grow with
//! their number, and with its square, much more than with the size of the code:
//! they make a small file take gigabytes.
//!
//! They are counted as Cranelift makes them: the constructs and what is written in
//! them are recorded forwards ([`Flow::open`] and the like), then [`Flow::count`]
//! goes backwards and keeps which locals are still read. What is still read where a
//! loop begins is only known after a round through it, so the backward pass is repeated
//! until nothing changes, which for code without `goto` is soon. One value more is
//! carried on every edge: the fuel.

use std::ops::Range;

/// After this many backward passes without an end, every local counts as read in every loop:
/// rather too much than too long.
const ROUNDS_MAX: u32 = 12;

/// What happened, in the order of the code.
#[derive(Clone, Copy, Debug)]
enum Event {
    Read(u32),
    Write(u32),
    Open,
    Else,
    Close(u32),
    /// A branch that is always taken, to the label of the construct.
    Jump(u32),
    /// A branch that may be taken.
    Fork(u32),
    /// The end of a path: a return, a trap, or a `br_table`, whose targets come
    /// before it as forks.
    Leave,
}

/// How a construct begins and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Construct {
    /// `block`, and the body of the function: its label is its end.
    Block,
    /// `loop`: its label is its beginning.
    Loop,
    /// `if`, with or without `else`: its label is its end.
    If,
}

#[derive(Clone, Copy, Debug)]
struct Frame {
    construct: Construct,
    /// Values that its label takes.
    values: u64,
    /// Branches to its label.
    branches: u64,
    /// Those of them that may be taken or not.
    forks: u64,
    /// The operator that its label is at.
    label: u32,
    /// The operator that ends it.
    end: u32,
}

/// The values of one function that are joined and carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Joins {
    /// Parameters of all blocks.
    pub(super) joined: u64,
    /// Arguments on all edges for them.
    pub(super) carried: u64,
}

/// Where paths meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// The operator at the label that they lead to.
    pub(super) label: u32,
    /// The operator after the last branch there.
    pub(super) end: u32,
    /// Arguments on all of them.
    pub(super) carried: u64,
    /// Those of them on edges from blocks that have other edges too: each such edge has a block.
    pub(super) forked: u64,
}

/// The record of one function; reused for the next one, because functions are many.
#[derive(Debug, Default)]
pub(super) struct Flow {
    events: Vec<Event>,
    frames: Vec<Frame>,
    /// The constructs that are open, the innermost last.
    open: Vec<u32>,
    loops: u32,
    locals: u32,
    /// Words in a set of locals.
    words: usize,
    /// For each frame the set of locals that are written inside.
    written: Vec<u64>,
    /// For each frame that is a loop, the set of locals that are read after its
    /// beginning, as far as it is known.
    heads: Vec<u64>,
    /// Operators so far.
    now: u32,
    meetings: Vec<Meeting>,
}

impl Flow {
    /// Begins a function with that many locals, parameters among them, and results.
    pub(super) fn begin(&mut self, locals: u32, results: u64) {
        self.events.clear();
        self.frames.clear();
        self.open.clear();
        self.written.clear();
        self.heads.clear();
        self.loops = 0;
        self.now = 0;
        self.locals = locals;
        self.words = index(locals).div_ceil(64);
        self.open(Construct::Block, results);
    }

    /// The next operator.
    pub(super) const fn next(&mut self) {
        self.now = self.now.saturating_add(1);
    }

    /// Where paths meet, after they were counted, in no order.
    pub(super) const fn meetings(&mut self) -> &mut Vec<Meeting> {
        &mut self.meetings
    }

    /// A construct begins whose label takes that many values.
    pub(super) fn open(&mut self, construct: Construct, values: u64) {
        let frame = u32::try_from(self.frames.len()).expect("fewer constructs than bytes");
        self.loops += u32::from(construct == Construct::Loop);
        self.frames.push(Frame {
            construct,
            values,
            branches: 0,
            forks: 0,
            label: self.now,
            end: self.now,
        });
        self.written.resize(self.written.len() + self.words, 0);
        self.heads.resize(self.heads.len() + self.words, 0);
        self.open.push(frame);
        self.events.push(Event::Open);
    }

    /// The second branch of the innermost `if`.
    pub(super) fn otherwise(&mut self) {
        self.events.push(Event::Else);
    }

    /// The innermost construct ends; that of the function at last.
    pub(super) fn close(&mut self) {
        let Some(frame) = self.open.pop() else {
            return;
        };
        let closed = &mut self.frames[index(frame)];
        closed.end = self.now;
        if closed.construct == Construct::Loop {
            self.loops -= 1;
        } else {
            closed.label = self.now;
        }
        if let Some(&outer) = self.open.last() {
            merge(&mut self.written, self.words, frame, outer);
        }
        self.events.push(Event::Close(frame));
    }

    /// A local is read.
    pub(super) fn read(&mut self, local: u32) {
        // An index out of range is rejected by validation, not here.
        if local < self.locals {
            self.events.push(Event::Read(local));
        }
    }

    /// A local is written.
    pub(super) fn write(&mut self, local: u32) {
        if let Some(&frame) = self.open.last()
            && local < self.locals
        {
            let word = index(frame) * self.words + index(local) / 64;
            self.written[word] |= 1 << (local % 64);
            self.events.push(Event::Write(local));
        }
    }

    /// A branch that is always taken, to the label that many constructs outwards.
    pub(super) fn jump(&mut self, label: u32) {
        self.branch(label, Event::Jump);
    }

    /// A branch that may be taken.
    pub(super) fn fork(&mut self, label: u32) {
        self.branch(label, Event::Fork);
        if let Some(frame) = self.target(label) {
            self.frames[index(frame)].forks += 1;
        }
    }

    /// The construct that many outwards.
    fn target(&self, label: u32) -> Option<u32> {
        let position = self.open.len().checked_sub(index(label) + 1);
        position
            .and_then(|position| self.open.get(position))
            .copied()
    }

    fn branch(&mut self, label: u32, event: fn(u32) -> Event) {
        if let Some(frame) = self.target(label) {
            self.frames[index(frame)].branches += 1;
            self.events.push(event(frame));
        }
    }

    /// The code after this is reached by branches only. The targets of a `br_table`
    /// are reported as forks before it.
    pub(super) fn leave(&mut self) {
        self.events.push(Event::Leave);
    }

    /// Where the set of a frame is.
    fn set(&self, frame: u32) -> Range<usize> {
        let start = index(frame) * self.words;
        start..start + self.words
    }

    /// How many loops are open.
    pub(super) const fn loops(&self) -> u32 {
        self.loops
    }

    /// Goes over the function backwards and counts.
    pub(super) fn count(&mut self) -> Joins {
        let mut heads = std::mem::take(&mut self.heads);
        let mut meetings = std::mem::take(&mut self.meetings);
        let mut joins = Joins::default();
        for round in 0..=ROUNDS_MAX {
            if round == ROUNDS_MAX {
                heads.fill(u64::MAX);
            }
            meetings.clear();
            let mut backwards = Backwards::new(self, &mut heads, &mut meetings);
            backwards.walk();
            joins = backwards.joins;
            if !backwards.has_changed {
                break;
            }
        }
        self.heads = heads;
        self.meetings = meetings;
        joins
    }
}

/// Adds the set of one frame to that of another.
fn merge(sets: &mut [u64], words: usize, from: u32, into: u32) {
    // A frame is always younger than the one around it.
    let (older, younger) = sets.split_at_mut(index(from) * words);
    let into = &mut older[index(into) * words..][..words];
    for (into, from) in into.iter_mut().zip(&younger[..words]) {
        *into |= from;
    }
}

fn index(number: u32) -> usize {
    usize::try_from(number).expect("usize has at least 32 bits")
}

/// The backward pass through the events of a function.
struct Backwards<'a> {
    flow: &'a Flow,
    heads: &'a mut [u64],
    /// Whether more has been found to be read at the beginning of a loop.
    has_changed: bool,
    /// Locals whose present value is read later.
    live: Vec<u64>,
    /// For each frame that is open, what is live at its label.
    labels: Vec<Label>,
    spare: Vec<Vec<u64>>,
    joins: Joins,
    meetings: &'a mut Vec<Meeting>,
}

struct Label {
    frame: u32,
    live: Vec<u64>,
    /// What is live where the second branch of an `if` begins.
    otherwise: Option<Vec<u64>>,
}

impl<'a> Backwards<'a> {
    fn new(flow: &'a Flow, heads: &'a mut [u64], meetings: &'a mut Vec<Meeting>) -> Self {
        Self {
            flow,
            heads,
            has_changed: false,
            live: vec![0; flow.words],
            labels: Vec::new(),
            spare: Vec::new(),
            joins: Joins::default(),
            meetings,
        }
    }

    fn walk(&mut self) {
        for &event in self.flow.events.iter().rev() {
            match event {
                Event::Read(local) => self.live[index(local) / 64] |= 1 << (local % 64),
                Event::Write(local) => self.live[index(local) / 64] &= !(1 << (local % 64)),
                Event::Close(frame) => self.close(frame),
                Event::Else => self.otherwise(),
                Event::Open => self.open(),
                Event::Jump(frame) => {
                    self.live.fill(0);
                    self.reach(frame);
                }
                Event::Fork(frame) => self.reach(frame),
                Event::Leave => self.live.fill(0),
            }
        }
    }

    fn close(&mut self, frame: u32) {
        let mut live = self.spare.pop().unwrap_or_default();
        live.clear();
        live.extend_from_slice(match self.flow.frames[index(frame)].construct {
            Construct::Loop => &self.heads[self.flow.set(frame)],
            Construct::Block | Construct::If => &self.live,
        });
        self.labels.push(Label {
            frame,
            live,
            otherwise: None,
        });
    }

    fn otherwise(&mut self) {
        let Some(label) = self.labels.last_mut() else {
            return;
        };
        let at_end = label.live.clone();
        label.otherwise = Some(std::mem::replace(&mut self.live, at_end));
    }

    fn open(&mut self) {
        let Some(label) = self.labels.pop() else {
            return;
        };
        let frame = self.flow.frames[index(label.frame)];
        let set = self.flow.set(label.frame);
        if frame.construct == Construct::Loop {
            self.has_changed |= add(&mut self.heads[set.clone()], &self.live);
        }
        let locals: u64 = self.flow.written[set]
            .iter()
            .zip(&label.live)
            .map(|(written, live)| u64::from((written & live).count_ones()))
            .sum();
        // A block that nothing branches to ends with one path into it.
        let paths = match frame.construct {
            Construct::Block => frame.branches,
            Construct::Loop | Construct::If => frame.branches + 1,
        };
        let fuel = 1;
        let values = frame.values + if paths > 0 { locals + fuel } else { 0 };
        self.joins.joined += values;
        let carried = values.saturating_mul(paths + 1);
        self.joins.carried += carried;
        let skips = frame.construct == Construct::If && label.otherwise.is_none();
        self.meetings.push(Meeting {
            label: frame.label,
            end: frame.end,
            carried,
            forked: values.saturating_mul(frame.forks + u64::from(skips)),
        });
        if frame.construct == Construct::If {
            match &label.otherwise {
                Some(otherwise) => add(&mut self.live, otherwise),
                None => add(&mut self.live, &label.live),
            };
        }
        self.spare.push(label.live);
    }

    fn reach(&mut self, frame: u32) {
        // Frames are open in the order of their numbers.
        let position = self
            .labels
            .binary_search_by_key(&frame, |label| label.frame);
        if let Ok(position) = position {
            add(&mut self.live, &self.labels[position].live);
        }
    }
}

/// Adds a set to another and says whether that has become larger.
fn add(into: &mut [u64], from: &[u64]) -> bool {
    let mut has_grown = false;
    for (into, from) in into.iter_mut().zip(from) {
        has_grown |= from & !*into != 0;
        *into |= from;
    }
    has_grown
}
