//! [`Pressure`]: how many values of a function are alive at the same time.
//!
//! Neither locals nor operands say it: the compiler numbers values, and keeps one that is computed or
//! loaded again later, although nothing in the code names it. So the values are numbered here too, in
//! one pass forwards: equal operators on equal values are one value, from where it is made first to
//! where it is used last. A load is another one after each store and call.
//!
//! What paths through a function change is only followed roughly: a value that is carried around a
//! loop counts until its last use in the text. Locals have terms of their own for that.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use wasmparser::Operator;

use super::flow::Meeting;
use super::folding::Folded;
use super::frames::{Frame, Frames};
use super::locals::Locals;
use super::value::{Call, index};
use super::values::{Pressed, Values};

/// Numbered values for which memory is kept from function to function. Emptying a map takes time for
/// its capacity.
const NUMBERS_KEPT: usize = 1 << 12;

/// How long the compiler knows what it has loaded. Where paths meet it may or may not: in code that checks
/// fuel it often does not, and either can be what takes longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Loads {
    /// Until memory changes.
    #[default]
    Kept,
    /// Also until a construct begins or ends, or a branch is not taken.
    Lost,
}

impl Loads {
    pub(super) const ALL: [Self; 2] = [Self::Kept, Self::Lost];
}

/// The values while a function is read.
#[derive(Debug, Default)]
pub(super) struct Pressure {
    loads: Loads,
    now: u32,
    operands: Vec<u32>,
    locals: Locals,
    frames: Frames,
    values: Values,
    numbers: HashMap<u64, u32>,
    /// The number of what may have changed memory so far.
    epoch: u32,
}

impl Pressure {
    /// Begins a function with that many locals, of which the first are parameters.
    pub(super) fn begin(
        &mut self,
        loads: Loads,
        locals: u32,
        parameters: u64,
        is_float: impl Fn(u32) -> bool,
    ) {
        self.loads = loads;
        self.now = 0;
        self.operands.clear();
        self.locals.clear();
        self.values.clear();
        self.frames.begin();
        self.epoch = 0;
        if self.numbers.capacity() > NUMBERS_KEPT {
            self.numbers = HashMap::new();
        }
        self.numbers.clear();
        for local in 0..locals {
            let value = self.make(0, false);
            let first = self.values.get_mut(value);
            first.is_float = is_float(local);
            first.is_initial = u64::from(local) >= parameters;
            self.locals.push(value);
        }
    }

    /// An operator begins. `bytes` are its own, `height` the number of operands before it, `arity` how
    /// many it takes and gives, and `weight` about the machine instructions that it becomes.
    pub(super) fn operator(
        &mut self,
        operator: &Operator<'_>,
        bytes: &[u8],
        height: u32,
        arity: (u32, u32),
        weight: u32,
    ) {
        self.now = self.now.saturating_add(1);
        self.reach(height);
        let is_end = matches!(
            operator,
            Operator::Loop { .. }
                | Operator::If { .. }
                | Operator::Else
                | Operator::End
                | Operator::BrIf { .. }
        );
        if is_end && self.loads == Loads::Lost {
            self.epoch += 1;
        }
        match operator {
            Operator::LocalGet { local_index } => {
                let value = self.local(*local_index);
                self.operands.push(value);
            }
            Operator::LocalSet { local_index } => {
                let value = self.pop();
                self.locals.write(*local_index, value);
            }
            Operator::LocalTee { local_index } => {
                let value = self.pop();
                self.operands.push(value);
                self.locals.write(*local_index, value);
            }
            Operator::Drop => {
                self.pop();
            }
            Operator::Block { .. } => self.open(Frame::default()),
            Operator::Loop { .. } => {
                self.call(true);
                self.open(Frame {
                    is_loop: true,
                    ..Frame::default()
                });
            }
            Operator::If { .. } => {
                let condition = self.pop();
                self.need(condition);
                let is_decided = self.is_decided(condition);
                self.open(Frame {
                    is_joined: true,
                    is_decided,
                    is_doubtful: is_decided,
                    // By those who do not take it.
                    is_reached: !is_decided && self.frames.is_certain(),
                    ..Frame::default()
                });
            }
            Operator::Else => {
                self.carry(arity.0);
                self.frames.otherwise();
                if let Some(frame) = self.frames.last() {
                    self.locals.restore(frame.changes);
                }
            }
            Operator::End => {
                self.carry(arity.0);
                self.close();
            }
            Operator::Br { relative_depth } => {
                self.carry(arity.0);
                self.frames.branch(*relative_depth);
                self.leave();
            }
            Operator::BrIf { relative_depth } => {
                self.doubt(*relative_depth);
                self.frames.branch(*relative_depth);
                let condition = self.pop();
                self.need(condition);
                // What it hands on stays for those who do not take it.
                self.carry(arity.0.saturating_sub(1));
            }
            Operator::BrTable { targets } => {
                let labels = || targets.targets().flatten().chain([targets.default()]);
                self.doubt(labels().max().unwrap_or(0));
                let index = self.pop();
                self.need(index);
                self.carry(arity.0.saturating_sub(1));
                for label in labels() {
                    self.frames.branch(label);
                }
                self.leave();
            }
            Operator::Return | Operator::Unreachable => {
                for value in self.take(arity.0) {
                    self.need(value);
                }
                self.leave();
            }
            Operator::I32Const { .. }
            | Operator::I64Const { .. }
            | Operator::F32Const { .. }
            | Operator::F64Const { .. } => {
                let value = self.number(bytes, &[], 0, true);
                self.values.get_mut(value).folded = Folded::of(operator);
                self.operands.push(value);
            }
            _ => self.compute(operator, bytes, arity, weight),
        }
    }

    /// The function ends.
    pub(super) fn finish(&mut self, meetings: &mut [Meeting]) -> Pressed {
        self.values.finish(self.now, meetings)
    }

    /// Has as many operands as the validator: code that nothing reaches has any.
    fn reach(&mut self, height: u32) {
        let height = usize::try_from(height).unwrap_or(0);
        self.operands.truncate(height);
        while self.operands.len() < height {
            let value = self.make(0, false);
            self.operands.push(value);
        }
    }

    fn make(&mut self, weight: u32, is_constant: bool) -> u32 {
        self.values.make(self.now, weight, is_constant)
    }

    fn pop(&mut self) -> u32 {
        match self.operands.pop() {
            Some(value) => value,
            None => self.make(0, false),
        }
    }

    fn local(&mut self, local: u32) -> u32 {
        match self.locals.get(local) {
            Some(value) => value,
            // Validation rejects it.
            None => self.make(0, false),
        }
    }

    /// A value is used here.
    fn apply(&mut self, value: u32) {
        self.values.get_mut(value).last = self.now;
    }

    /// What stays where it is in the code needs a value.
    fn need(&mut self, value: u32) {
        self.apply(value);
        let now = self.now;
        let value = self.values.get_mut(value);
        value.needed = value.needed.min(now);
    }

    /// A branch hands on that many operands.
    fn carry(&mut self, number: u32) {
        let now = self.now;
        let first = self.operands.len().saturating_sub(index(number));
        for &value in &self.operands[first..] {
            let value = self.values.get_mut(value);
            value.last = now;
            value.carried = value.carried.min(now);
        }
    }

    /// Uses that many operands and returns them, the last first.
    fn take(&mut self, number: u32) -> Vec<u32> {
        let number = usize::try_from(number).unwrap_or(0);
        let number = number.min(self.operands.len());
        let mut taken = Vec::with_capacity(number);
        for _ in 0..number {
            let value = self.pop();
            self.apply(value);
            taken.push(value);
        }
        taken
    }

    /// The value of an operator on other values: the one that it had before, or a new one.
    fn number(&mut self, bytes: &[u8], on: &[u32], weight: u32, is_constant: bool) -> u32 {
        let mut hasher = DefaultHasher::new();
        (bytes, on).hash(&mut hasher);
        let key = hasher.finish();
        if let Some(&value) = self.numbers.get(&key) {
            self.apply(value);
            return value;
        }
        let value = self.make(weight, is_constant);
        self.numbers.insert(key, value);
        value
    }

    fn compute(
        &mut self,
        operator: &Operator<'_>,
        bytes: &[u8],
        (taken, given): (u32, u32),
        weight: u32,
    ) {
        let mut on = self.take(taken);
        let is_pure = given == 1 && self.is_pure(bytes, &on);
        for &value in &on {
            self.values.get_mut(value).computed = self.now;
            if !is_pure {
                self.need(value);
            }
        }
        let mut sources = [u32::MAX; 3];
        for (source, &value) in sources.iter_mut().zip(&on) {
            *source = value;
        }
        let (from, is_same) = self.sources(&on);
        let folded = |at: usize| self.values.get(on[at]).folded;
        let is_other = on.len() == 2 && Folded::is_other(operator, folded(0));
        let folded = match on.len() {
            1 if matches!(bytes.first(), Some(0x45..=0xc4)) => folded(0).one(operator),
            // The last operand was taken first.
            2 if matches!(bytes.first(), Some(0x45..=0xc4)) => {
                folded(1).two(folded(0), is_same, operator)
            }
            3 if matches!(bytes.first(), Some(0x1b | 0x1c)) => {
                folded(2).chosen(folded(1), on[2] == on[1])
            }
            _ => Folded::of(operator),
        };
        for value in &mut on {
            *value = self.values.get(*value).root;
        }
        // SIMD operators that are not pure may load.
        let is_load = given == 1 && !is_pure && matches!(bytes.first(), Some(0x28..=0x35 | 0xfd));
        let is_numeric = matches!(bytes.first(), Some(0x45..=0xc4));
        if is_pure || is_load || is_numeric {
            if is_load {
                on.push(self.epoch);
            }
            let value = self.number(bytes, &on, weight, false);
            let number = self.values.get_mut(value);
            number.folded = folded;
            if is_pure {
                number.pure = number.pure.or(Some(sources));
            }
            if is_numeric {
                number.from = from.filter(|_| !is_other);
            }
            self.operands.push(value);
            return;
        }
        match bytes.first() {
            // Calls.
            Some(0x10..=0x15) => {
                self.epoch += 1;
                self.call(false);
            }
            // Everything but reading and writing globals may change memory.
            Some(0x23 | 0x24) => {}
            _ => self.epoch += 1,
        }
        for result in 0..given {
            let value = self.make(if result == 0 { weight } else { 1 }, false);
            self.values.get_mut(value).folded = folded;
            self.operands.push(value);
        }
    }

    /// That many blocks of machine code begin at the operator that is next.
    pub(super) fn blocks(&mut self, number: u64) {
        self.values.blocks(self.now.saturating_add(1), number);
    }

    /// The last result is a constant that is not in the code.
    pub(super) fn is_constant(&mut self) {
        if let Some(&value) = self.operands.last() {
            self.values.get_mut(value).folded = Folded::PERHAPS;
        }
    }

    /// The last result is a float or a vector.
    pub(super) fn is_float(&mut self) {
        if let Some(&value) = self.operands.last() {
            self.values.get_mut(value).is_float = true;
        }
    }

    /// The one value that operands are computed from, if there is only one, and whether two are computed
    /// from the same one: what compares or adds those may be a constant, as `(x + 1) - x` is.
    fn sources(&self, on: &[u32]) -> (Option<u32>, bool) {
        let mut source = None;
        let mut others = on.iter().filter_map(|&number| {
            let value = self.values.get(number);
            (!value.is_constant).then(|| value.from.unwrap_or(number))
        });
        let is_same = match (others.next(), others.next()) {
            (first, None) => {
                source = first;
                false
            }
            (Some(first), Some(second)) if first == second => {
                source = Some(first);
                true
            }
            _ => false,
        };
        (source, is_same)
    }

    /// Whether the compiler may make a result where it is needed, and not where it is in the code: it has no
    /// effects and cannot trap.
    fn is_pure(&self, bytes: &[u8], on: &[u32]) -> bool {
        // The last operand was taken first.
        let by_constant = || {
            on.first()
                .is_some_and(|&by| self.values.get(by).is_constant)
        };
        match bytes {
            // Divisions, which are other operators if the divisor is known.
            [0x6d..=0x70 | 0x7f..=0x82, ..] => by_constant(),
            // Conversions that trap.
            [0xa8..=0xab | 0xae..=0xb1, ..] => false,
            // `select`, other numeric operators, and `ref.is_null`.
            [0x1b | 0x1c | 0x45..=0xc4 | 0xd1, ..] => true,
            // Conversions that do not trap.
            [0xfc, 0..=7, ..] => true,
            // SIMD, without loads and stores.
            [0xfd, 0..=11 | 84..=93, ..] => false,
            [0xfd, ..] => true,
            _ => false,
        }
    }

    fn call(&mut self, is_loop: bool) {
        self.values.call(Call {
            at: self.now,
            until: u32::MAX,
            is_certain: self.frames.is_certain(),
            is_loop,
        });
    }

    fn open(&mut self, frame: Frame) {
        self.frames.open(Frame {
            began: self.now,
            changes: self.locals.mark(),
            calls: self.values.calls(),
            ..frame
        });
    }

    /// Whether the compiler may know which way a branch on a value goes.
    fn is_decided(&self, value: u32) -> bool {
        let value = self.values.get(value);
        // In a loop, its local may be written in an earlier round.
        value.folded.is_known || value.is_initial && !self.frames.is_in_loop()
    }

    /// A branch to the label that many constructs outwards, on the last operand.
    fn doubt(&mut self, label: u32) {
        let condition = self.operands.last();
        if condition.is_some_and(|&value| self.is_decided(value)) {
            self.frames.doubt(label);
        }
    }

    /// Where paths meet, each local that one of them changed has a new value. A loop hands on the last
    /// ones to its next round.
    fn close(&mut self) {
        let Some(frame) = self.frames.close() else {
            return;
        };
        if !frame.is_joined || self.frames.last().is_none() {
            return;
        }
        let Self {
            now,
            locals,
            values,
            ..
        } = self;
        locals.meet(frame.changes, |present, previous| {
            if present == previous {
                return present;
            }
            if frame.is_loop {
                values.get_mut(present).handed_on = *now;
                // What the first round has of it is not what the next ones have.
                let previous = values.get_mut(previous);
                previous.loops = previous.loops.min(frame.began);
                return present;
            }
            let is_float = values.get(previous).is_float;
            let root = values.get(present).root;
            let joined = values.make(*now, 0, false);
            let value = values.get_mut(joined);
            value.joins = Some([present, previous]);
            value.root = root;
            value.is_float = is_float;
            joined
        });
    }

    /// The code after this is reached by branches only, which pass by the calls of this construct.
    fn leave(&mut self) {
        if let Some(from) = self.frames.leave(self.values.calls()) {
            self.values.leave(from, self.now);
        }
    }
}

#[cfg(test)]
mod tests;
