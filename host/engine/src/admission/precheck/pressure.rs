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

/// Values that find a register, about: some are taken by what each function has.
const IN_REGISTERS: i64 = 12;

/// Numbered values for which memory is kept from function to function. Emptying a map takes time for
/// its capacity.
const NUMBERS_KEPT: usize = 1 << 12;

/// What a function has of values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Pressed {
    /// Operators.
    pub(super) operators: u64,
    /// The values that are alive at each operator, together.
    pub(super) alive: u64,
    /// What is made while more values are alive than there are registers, about in machine
    /// instructions.
    pub(super) pressed: u64,
    /// All that is made.
    pub(super) made: u64,
    /// The most that is made while one value is alive, up to a call: a call empties all registers.
    pub(super) passed_by: u64,
}

#[derive(Clone, Copy, Debug)]
struct Value {
    first: u32,
    last: u32,
    /// Machine instructions that make it, about.
    weight: u32,
    /// Constants are made where they are used.
    is_constant: bool,
}

#[derive(Clone, Copy, Debug)]
struct Call {
    at: u32,
    /// From here on all paths pass it by.
    until: u32,
}

/// Calls that are looked at for one value.
const CALLS_MAX: usize = 64;

/// A construct that is open.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    /// Where its changes of locals begin.
    changes: usize,
    /// Where its calls begin that may be passed by.
    calls: usize,
}

/// The values while a function is read.
#[derive(Debug, Default)]
pub(super) struct Pressure {
    now: u32,
    operands: Vec<u32>,
    locals: Vec<u32>,
    values: Vec<Value>,
    numbers: HashMap<u64, u32>,
    /// The number of what may have changed memory so far.
    epoch: u32,
    frames: Vec<Frame>,
    /// Locals with the values that they had before.
    changes: Vec<(u32, u32)>,
    calls: Vec<Call>,
    curve: Vec<i64>,
    /// What is made before each operator.
    made: Vec<u64>,
}

impl Pressure {
    /// Begins a function with that many locals, parameters among them.
    pub(super) fn begin(&mut self, locals: u32) {
        self.now = 0;
        self.operands.clear();
        self.locals.clear();
        self.values.clear();
        self.frames.clear();
        self.changes.clear();
        self.epoch = 0;
        self.calls.clear();
        if self.numbers.capacity() > NUMBERS_KEPT {
            self.numbers = HashMap::new();
        }
        self.numbers.clear();
        self.frames.push(Frame::default());
        for _ in 0..locals {
            let value = self.make(0, false);
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
            Operator::Block { .. } | Operator::Loop { .. } => self.open(),
            Operator::If { .. } => {
                let condition = self.pop();
                self.apply(condition);
                self.open();
            }
            Operator::Else => self.restore(),
            Operator::End => self.close(),
            Operator::Br { .. }
            | Operator::BrTable { .. }
            | Operator::Return
            | Operator::Unreachable => {
                self.take(arity.0);
                self.leave();
            }
            Operator::I32Const { .. }
            | Operator::I64Const { .. }
            | Operator::F32Const { .. }
            | Operator::F64Const { .. } => {
                let value = self.number(bytes, &[], 0, true);
                self.operands.push(value);
            }
            _ => self.compute(bytes, arity, weight),
        }
    }

    /// The function ends.
    pub(super) fn finish(&mut self) -> Pressed {
        let operators = usize::try_from(self.now).unwrap_or(0) + 1;
        self.curve.clear();
        self.curve.resize(operators + 1, 0);
        self.made.clear();
        self.made.resize(operators + 1, 0);
        let index = |at: u32| usize::try_from(at).unwrap_or(0).min(operators);
        for value in &self.values {
            self.made[index(value.first)] += u64::from(value.weight);
            if !value.is_constant {
                self.curve[index(value.first)] += 1;
                self.curve[index(value.last)] -= 1;
            }
        }
        let mut pressed = Pressed {
            operators: u64::from(self.now),
            ..Pressed::default()
        };
        let mut alive = 0;
        for (step, made) in self.curve.iter_mut().zip(&mut self.made) {
            alive += *step;
            *step = alive;
            pressed.alive += alive.unsigned_abs();
            if alive > IN_REGISTERS {
                pressed.pressed += *made;
            }
            pressed.made += std::mem::replace(made, pressed.made);
        }
        for value in self.values.iter().filter(|value| !value.is_constant) {
            let next = self.calls.partition_point(|call| call.at <= value.first);
            let mut calls = self.calls[next..].iter().take(CALLS_MAX);
            let call = calls.find(|call| call.at >= value.last || value.last <= call.until);
            let end = call.map_or(value.last, |call| value.last.min(call.at));
            let passed = self.made[index(end)] - self.made[index(value.first)];
            pressed.passed_by = pressed.passed_by.max(passed);
        }
        pressed
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
        let value = u32::try_from(self.values.len()).unwrap_or(u32::MAX);
        self.values.push(Value {
            first: self.now,
            last: self.now,
            weight,
            is_constant,
        });
        value
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
        let at = usize::try_from(value).ok();
        if let Some(value) = at.and_then(|at| self.values.get_mut(at)) {
            value.last = self.now;
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

    fn compute(&mut self, bytes: &[u8], (taken, given): (u32, u32), weight: u32) {
        let mut on = self.take(taken);
        match bytes.first() {
            // Loads, and the SIMD operators, some of which load.
            Some(0x28..=0x35 | 0xfd) if given == 1 => {
                on.push(self.epoch);
                let value = self.number(bytes, &on, weight, false);
                self.operands.push(value);
                return;
            }
            Some(0x45..=0xc4) => {
                let value = self.number(bytes, &on, weight, false);
                self.operands.push(value);
                return;
            }
            // Calls.
            Some(0x10..=0x15) => {
                self.epoch += 1;
                self.calls.push(Call {
                    at: self.now,
                    until: u32::MAX,
                });
            }
            // Everything but reading and writing globals may change memory.
            Some(0x23 | 0x24) => {}
            _ => self.epoch += 1,
        }
        for result in 0..given {
            let value = self.make(if result == 0 { weight } else { 1 }, false);
            self.operands.push(value);
        }
    }

    fn open(&mut self) {
        self.frames.push(Frame {
            changes: self.changes.len(),
            calls: self.calls.len(),
        });
    }

    /// Gives the locals the values that they had where the innermost construct began.
    fn restore(&mut self) {
        let begin = self.frames.last().map_or(0, |frame| frame.changes);
        while self.changes.len() > begin {
            if let Some((local, value)) = self.changes.pop()
                && let Ok(local) = usize::try_from(local)
            {
                self.locals[local] = value;
            }
        }
    }

    fn close(&mut self) {
        self.frames.pop();
    }

    /// The code after this is reached by branches only, which pass by the calls of this construct.
    fn leave(&mut self) {
        let Some(frame) = self.frames.last_mut() else {
            return;
        };
        for call in &mut self.calls[frame.calls..] {
            call.until = call.until.min(self.now);
        }
        // Only once, also if what follows and is never reached leaves again.
        frame.calls = self.calls.len();
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
        pressure.begin(2);
        for _ in 0..times {
            for offset in 0..100 {
                add_loaded(&mut pressure, offset);
            }
            if calls {
                let call = Operator::Call { function_index: 0 };
                pressure.operator(&call, &[0x10, 0], 0, (0, 0), 8);
            }
        }
        pressure.finish()
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
        pressure.begin(2);
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
        let passed = pressure.finish();
        assert!(passed.passed_by > 800, "{passed:?}");
    }
}
