//! [`Values`]: the values of a function, and what its compiler has to do for them.

use super::flow::Meeting;
use super::scans::Scans;
use super::value::{Call, Value, index};

/// Values that find a register, about: some are taken by what each function has.
const IN_REGISTERS: i64 = 12;

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
    /// Block arguments that `regalloc2` walks past (`scans`).
    pub(super) scans: u64,
}

impl Pressed {
    /// The greater of each.
    pub(super) fn max(self, other: Self) -> Self {
        Self {
            operators: self.operators.max(other.operators),
            alive: self.alive.max(other.alive),
            pressed: self.pressed.max(other.pressed),
            made: self.made.max(other.made),
            passed_by: self.passed_by.max(other.passed_by),
            scans: self.scans.max(other.scans),
        }
    }
}

/// All values of a function and its calls.
#[derive(Debug, Default)]
pub(super) struct Values {
    all: Vec<Value>,
    /// In the order of the code.
    calls: Vec<Call>,
    scans: Scans,
    curve: Vec<i64>,
    /// What is made before each operator.
    made: Vec<u64>,
}

impl Values {
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.calls.clear();
        self.scans.clear();
    }

    /// Adds a value that is made at an operator and numbers it.
    pub(super) fn make(&mut self, at: u32, weight: u32, is_constant: bool) -> u32 {
        let number = u32::try_from(self.all.len()).unwrap_or(u32::MAX);
        self.all.push(Value::new(at, weight, is_constant, number));
        number
    }

    /// The value of a number that was given.
    pub(super) fn get(&self, number: u32) -> Value {
        self.all[index(number)]
    }

    pub(super) fn get_mut(&mut self, number: u32) -> &mut Value {
        &mut self.all[index(number)]
    }

    pub(super) fn call(&mut self, call: Call) {
        self.calls.push(call);
    }

    /// The number of calls so far.
    pub(super) const fn calls(&self) -> usize {
        self.calls.len()
    }

    /// All paths pass the calls from one on by, after that operator.
    pub(super) fn leave(&mut self, from: usize, at: u32) {
        for call in &mut self.calls[from..] {
            call.until = call.until.min(at);
        }
    }

    /// That many blocks of machine code begin at an operator.
    pub(super) fn blocks(&mut self, at: u32, number: u64) {
        self.scans.start(at, number);
    }

    /// The function has that many operators.
    pub(super) fn finish(&mut self, now: u32, meetings: &mut [Meeting]) -> Pressed {
        self.place();
        self.hand_on();
        let scans = self.scans.count(&self.all, &self.calls, meetings);
        self.unite();
        let operators = index(now).saturating_add(1);
        self.curve.clear();
        self.curve.resize(operators + 1, 0);
        self.made.clear();
        self.made.resize(operators + 1, 0);
        let index = |at: u32| index(at).min(operators);
        for value in &self.all {
            self.made[index(value.first)] += u64::from(value.weight);
            if !value.is_constant {
                self.curve[index(value.first)] += 1;
                self.curve[index(value.last)] -= 1;
            }
        }
        let mut pressed = Pressed {
            operators: u64::from(now),
            scans,
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
        for value in self.all.iter().filter(|value| !value.is_constant) {
            let next = self.calls.partition_point(|call| call.at <= value.first);
            let calls = self.calls[next..].iter().filter(|call| !call.is_loop);
            let call = calls
                .take(Call::LOOKED_AT)
                .find(|call| call.at >= value.last || value.last <= call.until);
            let end = call.map_or(value.last, |call| value.last.min(call.at));
            let passed = self.made[index(end)] - self.made[index(value.first)];
            pressed.passed_by = pressed.passed_by.max(passed);
        }
        pressed
    }

    /// Moves what has no effect but its result to where that is first needed. What it is computed from is
    /// live until then: the additions of many loaded numbers, the sum of which is needed at the end, are
    /// all made there.
    fn place(&mut self) {
        for at in (0..self.all.len()).rev() {
            let value = self.all[at];
            if let Some(joins) = value.joins.filter(|_| value.is_used()) {
                for joined in joins {
                    let carried = &mut self.all[index(joined)].carried;
                    *carried = value.first.min(*carried);
                }
            }
            let Some((place, from)) = value.placed() else {
                continue;
            };
            let placed = &mut self.all[at];
            placed.first = place;
            placed.last = placed.last.max(place);
            for source in from {
                if let Some(source) = self.all.get_mut(index(source)) {
                    source.last = source.last.max(place);
                    source.computed = source.computed.max(place);
                    source.needed = source.needed.min(place);
                }
            }
        }
    }

    /// Arguments are live until the block that takes them, if its parameter is used.
    fn hand_on(&mut self) {
        for at in (0..self.all.len()).rev() {
            let joined = self.all[at];
            if let Some(joins) = joined.joins.filter(|_| joined.is_used()) {
                for value in joins {
                    let handed_on = &mut self.all[index(value)].handed_on;
                    *handed_on = joined.first.max(*handed_on);
                }
            }
        }
    }

    /// Makes one value of each block parameter and its arguments: they share a register if they can.
    fn unite(&mut self) {
        for at in (0..self.all.len()).rev() {
            let joined = self.all[at];
            if let Some([value, _]) = joined.joins
                && joined.last > joined.first
            {
                let last = &mut self.all[index(value)].last;
                *last = joined.last.max(*last);
            }
        }
        self.all.retain(|value| value.joins.is_none());
    }
}
