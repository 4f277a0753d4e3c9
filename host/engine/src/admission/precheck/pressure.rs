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
use super::value::{Call, index};
use super::values::{Pressed, Values};

/// Numbered values for which memory is kept from function to function. Emptying a map takes time for
/// its capacity.
const NUMBERS_KEPT: usize = 1 << 12;

/// A construct that is open.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    is_loop: bool,
    /// Whether several paths meet at its label.
    is_joined: bool,
    /// Of an `if`: the compiler decides its condition.
    is_decided: bool,
    /// What follows in it may never be reached.
    is_doubtful: bool,
    /// A path surely leads to its end, whatever becomes of the others.
    is_reached: bool,
    began: u32,
    /// Where its changes of locals begin.
    changes: usize,
    /// Where those begin that its first branch made, if it is an `if`.
    changes_before: usize,
    /// Where its calls begin that may be passed by.
    calls: usize,
}

/// The values while a function is read.
#[derive(Debug, Default)]
pub(super) struct Pressure {
    now: u32,
    operands: Vec<u32>,
    locals: Vec<u32>,
    values: Values,
    numbers: HashMap<u64, u32>,
    /// The number of what may have changed memory so far.
    epoch: u32,
    frames: Vec<Frame>,
    /// Locals with the values that they had before.
    changes: Vec<(u32, u32)>,
    /// Changes that the first branches of open constructs made.
    changes_before: Vec<(u32, u32)>,
    /// For each local the construct at whose end it was last given a new value.
    joined: Vec<u32>,
    joins: u32,
    /// Open constructs that are doubtful.
    doubts: usize,
    /// Loops that are open.
    loops: usize,
}

impl Pressure {
    /// Begins a function with that many locals, of which the first are parameters.
    pub(super) fn begin(&mut self, locals: u32, parameters: u64, is_float: impl Fn(u32) -> bool) {
        self.now = 0;
        self.operands.clear();
        self.locals.clear();
        self.values.clear();
        self.frames.clear();
        self.changes.clear();
        self.epoch = 0;
        self.changes_before.clear();
        self.joined.clear();
        self.joined.resize(index(locals), 0);
        self.joins = 0;
        self.doubts = 0;
        self.loops = 0;
        if self.numbers.capacity() > NUMBERS_KEPT {
            self.numbers = HashMap::new();
        }
        self.numbers.clear();
        self.frames.push(Frame::default());
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
        match operator {
            Operator::LocalGet { local_index } => {
                let value = self.local(*local_index);
                self.operands.push(value);
            }
            Operator::LocalSet { local_index } => {
                let value = self.pop();
                self.write(*local_index, value);
            }
            Operator::LocalTee { local_index } => {
                let value = self.pop();
                self.operands.push(value);
                self.write(*local_index, value);
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
                self.apply(condition);
                let is_decided = self.is_decided(condition);
                self.open(Frame {
                    is_joined: true,
                    is_decided,
                    is_doubtful: is_decided,
                    // By those who do not take it.
                    is_reached: !is_decided && self.doubts == 0,
                    ..Frame::default()
                });
            }
            Operator::Else => {
                self.otherwise();
                self.restore();
            }
            Operator::End => self.close(),
            Operator::Br { relative_depth } => {
                self.take(arity.0);
                self.branch(*relative_depth);
                self.leave();
            }
            Operator::BrIf { relative_depth } => {
                self.doubt(*relative_depth);
                self.branch(*relative_depth);
                self.compute(operator, bytes, arity, weight);
            }
            Operator::BrTable { targets } => {
                let labels = || targets.targets().flatten().chain([targets.default()]);
                self.doubt(labels().max().unwrap_or(0));
                self.take(arity.0);
                for label in labels() {
                    self.branch(label);
                }
                self.leave();
            }
            Operator::Return | Operator::Unreachable => {
                self.take(arity.0);
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
        let local = usize::try_from(local).ok();
        match local.and_then(|local| self.locals.get(local)) {
            Some(value) => *value,
            // Validation rejects it.
            None => self.make(0, false),
        }
    }

    fn write(&mut self, local: u32, value: u32) {
        let at = usize::try_from(local).ok();
        if let Some(present) = at.and_then(|at| self.locals.get_mut(at)) {
            self.changes.push((local, *present));
            *present = value;
        }
    }

    /// A value is used here.
    fn apply(&mut self, value: u32) {
        self.values.get_mut(value).last = self.now;
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
        // What a branch hands on may be anywhere.
        if bytes.first() != Some(&0x0d) {
            for &value in &on {
                self.values.get_mut(value).computed = self.now;
            }
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
        match bytes.first() {
            // Loads, and the SIMD operators, some of which load.
            Some(0x28..=0x35 | 0xfd) if given == 1 => {
                on.push(self.epoch);
                let value = self.number(bytes, &on, weight, false);
                self.values.get_mut(value).folded = folded;
                self.operands.push(value);
                return;
            }
            Some(0x45..=0xc4) => {
                let value = self.number(bytes, &on, weight, false);
                let number = self.values.get_mut(value);
                number.folded = folded;
                number.from = from.filter(|_| !is_other);
                self.operands.push(value);
                return;
            }
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

    fn call(&mut self, is_loop: bool) {
        self.values.call(Call {
            at: self.now,
            until: u32::MAX,
            is_certain: self.doubts == 0,
            is_loop,
        });
    }

    fn open(&mut self, frame: Frame) {
        self.doubts += usize::from(frame.is_doubtful);
        self.loops += usize::from(frame.is_loop);
        self.frames.push(Frame {
            began: self.now,
            changes: self.changes.len(),
            changes_before: self.changes_before.len(),
            calls: self.values.calls(),
            ..frame
        });
    }

    /// Whether the compiler may know which way a branch on a value goes.
    fn is_decided(&self, value: u32) -> bool {
        let value = self.values.get(value);
        // In a loop, its local may be written in an earlier round.
        value.folded.is_known || value.is_initial && self.loops == 0
    }

    /// A branch to the label that many constructs outwards, on the last operand. If the compiler decides
    /// it, nothing that follows in all of them may be reached.
    fn doubt(&mut self, label: u32) {
        let condition = self.operands.last();
        if condition.is_some_and(|&value| self.is_decided(value)) {
            let inside = self.frames.iter_mut().rev();
            for frame in inside.take(index(label).saturating_add(1)) {
                self.doubts += usize::from(!frame.is_doubtful);
                frame.is_doubtful = true;
            }
        }
    }

    /// A branch to the label that many constructs outwards.
    fn branch(&mut self, label: u32) {
        let target = self
            .frames
            .len()
            .checked_sub(index(label).saturating_add(1));
        if let Some(frame) = target.and_then(|target| self.frames.get_mut(target)) {
            frame.is_joined = true;
            frame.is_reached |= self.doubts == 0 && !frame.is_loop;
        }
    }

    fn otherwise(&mut self) {
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        frame.is_reached &= !frame.is_doubtful;
        if frame.is_doubtful && !frame.is_decided {
            frame.is_doubtful = false;
            self.doubts -= 1;
        }
    }

    /// Gives the locals the values that they had where the innermost construct began.
    fn restore(&mut self) {
        let begin = self.frames.last().map_or(0, |frame| frame.changes);
        while self.changes.len() > begin {
            if let Some((local, value)) = self.changes.pop() {
                self.locals[index(local)] = value;
                self.changes_before.push((local, value));
            }
        }
    }

    /// Where paths meet, each local that one of them changed has a new value. A loop hands on the last
    /// ones to its next round.
    fn close(&mut self) {
        let Some(frame) = self.frames.pop() else {
            return;
        };
        self.doubts -= usize::from(frame.is_doubtful);
        self.loops -= usize::from(frame.is_loop);
        if frame.is_doubtful
            && !frame.is_reached
            && let Some(outer) = self.frames.last_mut()
        {
            self.doubts += usize::from(!outer.is_doubtful);
            outer.is_doubtful = true;
        }
        if !frame.is_joined || self.frames.is_empty() {
            return;
        }
        // The oldest change of a local is the last one there.
        let before = self.changes_before.drain(frame.changes_before..).rev();
        self.changes.extend(before);
        self.joins += 1;
        let mut kept = frame.changes;
        for at in frame.changes..self.changes.len() {
            let (local, previous) = self.changes[at];
            let last = std::mem::replace(&mut self.joined[index(local)], self.joins);
            if last == self.joins {
                continue;
            }
            self.changes[kept] = (local, previous);
            kept += 1;
            if frame.is_loop {
                let present = self.locals[index(local)];
                self.values.get_mut(present).handed_on = self.now;
                // What the first round has of it is not what the next ones have.
                let previous = self.values.get_mut(previous);
                previous.loops = previous.loops.min(frame.began);
            } else {
                let is_float = self.values.get(previous).is_float;
                let present = self.locals[index(local)];
                let root = self.values.get(present).root;
                let joined = self.make(0, false);
                let value = self.values.get_mut(joined);
                value.joins = Some([present, previous]);
                value.root = root;
                value.is_float = is_float;
                self.locals[index(local)] = joined;
            }
        }
        self.changes.truncate(kept);
    }

    /// The code after this is reached by branches only, which pass by the calls of this construct.
    fn leave(&mut self) {
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        self.doubts += usize::from(!frame.is_doubtful);
        frame.is_doubtful = true;
        // Only once, also if what follows and is never reached leaves again.
        frame.calls = self.values.leave(frame.calls, self.now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load of that offset from the first local, added to the second.
    fn add_loaded(pressure: &mut Pressure, offset: u8) {
        let [address, sum] = [0, 1].map(|local_index| Operator::LocalGet { local_index });
        pressure.operator(&address, &[0x20, 0], 0, (0, 1), 0);
        // Which load it is does not matter: the bytes tell.
        pressure.operator(&Operator::I32Eqz, &[0x28, 2, offset], 1, (1, 1), 2);
        pressure.operator(&sum, &[0x20, 1], 1, (0, 1), 0);
        pressure.operator(&Operator::I32Add, &[0x6a], 2, (2, 1), 1);
        pressure.operator(
            &Operator::LocalSet { local_index: 1 },
            &[0x21, 1],
            1,
            (1, 0),
            0,
        );
    }

    fn loaded(times: u8, calls: bool) -> Pressed {
        let mut pressure = Pressure::default();
        pressure.begin(2, 2, |_| false);
        for _ in 0..times {
            for offset in 0..100 {
                add_loaded(&mut pressure, offset);
            }
            if calls {
                let call = Operator::Call { function_index: 0 };
                pressure.operator(&call, &[0x10, 0], 0, (0, 0), 8);
            }
        }
        pressure.finish(&mut [])
    }

    #[test]
    fn what_is_loaded_again_stays_alive() {
        let once = loaded(1, false);
        assert!(once.alive < 5 * once.operators, "{once:?}");
        assert_eq!(once.pressed, 0);
        let again = loaded(4, false);
        assert!(again.alive > 70 * again.operators, "{again:?}");
        // The loads of the first time, and all additions but the first few.
        assert_eq!(again.made, 100 * 2 + 400);
        assert!(again.pressed > 550, "{again:?}");
        assert!(again.passed_by > 550, "{again:?}");
    }

    #[test]
    fn calls_end_it() {
        let again = loaded(4, true);
        assert!(again.alive < 5 * again.operators, "{again:?}");
        assert_eq!(again.pressed, 0);
        assert!(again.passed_by <= 300, "{again:?}");
    }

    #[test]
    fn a_call_that_is_passed_by_ends_nothing() {
        let mut pressure = Pressure::default();
        pressure.begin(2, 2, |_| false);
        for _ in 0..4 {
            for offset in 0..100 {
                add_loaded(&mut pressure, offset);
            }
            let nothing: &[u8] = &[];
            let call = Operator::Call { function_index: 0 };
            let ty = wasmparser::BlockType::Empty;
            pressure.operator(&Operator::Block { blockty: ty }, nothing, 0, (0, 0), 0);
            pressure.operator(&call, &[0x10, 0], 0, (0, 0), 8);
            pressure.operator(&Operator::Unreachable, nothing, 0, (0, 0), 0);
            pressure.operator(&Operator::End, nothing, 0, (0, 0), 0);
        }
        let passed = pressure.finish(&mut []);
        assert!(passed.passed_by > 800, "{passed:?}");
    }
}
