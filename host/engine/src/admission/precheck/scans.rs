//! [`Scans`]: how many block arguments `regalloc2` walks past when it inserts moves.
//!
//! After allocation, `regalloc2::ion::moves` visits every value, and for each value every block that
//! starts while the value is live. At each such block it walks the list of all arguments of all blocks
//! (`blockparam_ins`) from a saved position up to the value. The position only advances at a value
//! that was split, past everything before that value. Until one was, time is the product of two numbers
//! that a small file can make large: pairs of a value and a block, and arguments.
//!
//! Values are visited in the order of their numbers: block parameters first, in the order of the
//! blocks, then everything else, from the end of the function to its beginning. A value is split when
//! a call clobbers its register, when it is live where a loop starts, or when more values are needed
//! in registers than there are. Which one is split in that case is not known, but one is: so all of
//! them count until the first that does not fit. Values may be split for other reasons, which makes
//! this about an upper bound. It is as good as what `pressure` knows of the values.

use std::ops::Range;

use super::flow::Meeting;
use super::value::{Call, Value, index};

/// Registers for integers, and as many for floats.
const REGISTERS: u32 = 14;

/// The blocks and the values that are live where they start.
#[derive(Debug, Default)]
pub(super) struct Scans {
    /// Where blocks of machine code begin, ascending, and how many.
    starts: Vec<(u32, u64)>,
    /// The values counted so far that are live at each: integers and floats.
    alive: Vec<[u32; 2]>,
    order: Vec<Alive>,
    /// The arguments of the first meetings together, for each number of them.
    carried: Vec<u64>,
}

/// A value that is live where blocks start.
#[derive(Clone, Copy, Debug)]
struct Alive {
    first: u32,
    /// The blocks.
    begin: u32,
    end: u32,
    /// The end of those of them after which it is needed in a register.
    needed: u32,
    is_float: bool,
    place: Place,
}

/// Where a value is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// In a register if there is one.
    Register,
    /// In memory, and nothing loads it.
    Memory,
    /// In several places: in memory while a call is made and later in a register, or also in a block at
    /// the end of the function.
    Split,
}

impl Scans {
    pub(super) fn clear(&mut self) {
        self.starts.clear();
    }

    /// That many blocks begin at an operator, which is none before the last one.
    pub(super) fn start(&mut self, at: u32, blocks: u64) {
        match self.starts.last_mut() {
            Some((last, all)) if *last == at => *all += blocks,
            _ => self.starts.push((at, blocks)),
        }
    }

    /// The arguments walked past.
    pub(super) fn count(
        &mut self,
        values: &[Value],
        calls: &[Call],
        meetings: &mut [Meeting],
    ) -> u64 {
        meetings.sort_unstable_by_key(|meeting| meeting.label);
        self.carried.clear();
        self.carried.push(0);
        let mut all = 0_u64;
        for meeting in &*meetings {
            all = all.saturating_add(meeting.carried);
            self.carried.push(all);
        }
        let (of_joined, widest, stood) = self.joined(values, calls, meetings);
        let (of_others, split) = self.others(values, calls, all - stood);
        // A branch with other targets has a block on each edge, where its arguments are live.
        let mut handed_on = 0_u64;
        for meeting in &*meetings {
            let each = if meeting.end < split {
                widest
            } else {
                widest.max(all - stood)
            };
            handed_on = handed_on.saturating_add(meeting.forked.saturating_mul(each));
        }
        of_joined
            .saturating_add(of_others)
            .saturating_add(handed_on)
    }

    /// Block parameters, from the first to the last. Returns the arguments walked past, the most of
    /// them for one value and block, and the position after the last value that was split.
    fn joined(
        &mut self,
        values: &[Value],
        calls: &[Call],
        meetings: &[Meeting],
    ) -> (u64, u64, u64) {
        self.sort(values, calls, true);
        self.alive.clear();
        self.alive.resize(self.starts.len(), [0; 2]);
        let mut scans = 0_u64;
        let mut widest = 0;
        let mut stood = 0;
        let mut since = 0;
        for at in 0..self.order.len() {
            let value = self.order[at];
            let (blocks, is_split) = self.keep(value);
            // With its own.
            let to = self.before(meetings, value.first.saturating_add(1));
            let each = to.saturating_sub(stood);
            widest = widest.max(each);
            scans = scans.saturating_add(blocks.saturating_mul(each));
            if is_split {
                stood = self.before(meetings, value.first);
                for value in &self.order[since..=at] {
                    self.alive[value.blocks()].fill([0; 2]);
                }
                since = at + 1;
            }
        }
        (scans, widest, stood)
    }

    /// All other values, from the last to the first, with that many arguments for each block. Returns
    /// the arguments walked past, and where the value is made that was split.
    fn others(&mut self, values: &[Value], calls: &[Call], each: u64) -> (u64, u32) {
        self.sort(values, calls, false);
        self.alive.fill([0; 2]);
        let mut scans = 0_u64;
        for at in (0..self.order.len()).rev() {
            let value = self.order[at];
            let (blocks, is_split) = self.keep(value);
            scans = scans.saturating_add(blocks.saturating_mul(each));
            if is_split {
                return (scans, value.first);
            }
        }
        (scans, 0)
    }

    /// The arguments of all meetings before an operator.
    fn before(&self, meetings: &[Meeting], at: u32) -> u64 {
        self.carried[meetings.partition_point(|meeting| meeting.label < at)]
    }

    /// Collects the values of one kind that are live where blocks start, in the order of the code.
    fn sort(&mut self, values: &[Value], calls: &[Call], joined: bool) {
        self.order.clear();
        for value in values {
            let (first, last) = value.alive(joined);
            let is_constant = value.is_constant || value.is_initial;
            if first == last || is_constant && !joined {
                continue;
            }
            let begin = self.starts.partition_point(|start| start.0 < first);
            let end = self.starts.partition_point(|start| start.0 < last);
            if begin >= end {
                continue;
            }
            // A parameter is often handed on to the next one, which needs it.
            let needed = if joined {
                last
            } else {
                value.computed.min(last)
            };
            let place = place(calls, first, needed, last);
            let number = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
            self.order.push(Alive {
                first,
                begin: number(begin),
                end: number(end),
                needed: number(self.starts.partition_point(|start| start.0 < needed)),
                is_float: value.is_float,
                place,
            });
        }
        self.order.sort_by_key(|it| it.first);
    }

    /// Counts a value. Returns the blocks that start while it is live, and whether it or one that was
    /// counted before it is split.
    fn keep(&mut self, value: Alive) -> (u64, bool) {
        let starts = &self.starts[value.blocks()];
        let blocks = starts.iter().map(|start| start.1).sum();
        if value.place != Place::Register {
            return (blocks, value.place == Place::Split);
        }
        let mut is_split = false;
        // One that is only handed on stays in memory once it is there, which is no split that counts.
        for alive in &mut self.alive[value.needed()] {
            let alive = &mut alive[usize::from(value.is_float)];
            *alive += 1;
            is_split |= *alive > REGISTERS;
        }
        (blocks, is_split)
    }
}

/// Where a value is kept from `first` to `last` that is needed in a register until `needed`.
fn place(calls: &[Call], first: u32, needed: u32, last: u32) -> Place {
    let next = calls.partition_point(|call| call.at < first);
    let calls = calls[next..].iter().filter(|call| call.is_certain);
    let mut place = Place::Register;
    for call in calls.take(Call::LOOKED_AT) {
        if call.at >= last {
            break;
        }
        let is_live = |until: u32| call.at < until && until <= call.until;
        // A parameter of the loop begins with it, the result of a call after it.
        if call.is_loop && is_live(last) || call.at > first && is_live(needed) {
            return Place::Split;
        }
        if call.at > first && is_live(last) {
            place = Place::Memory;
        }
    }
    place
}

impl Alive {
    fn blocks(&self) -> Range<usize> {
        index(self.begin)..index(self.end)
    }

    fn needed(&self) -> Range<usize> {
        index(self.begin)..index(self.needed.max(self.begin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value that is made before ten blocks begin and used after them.
    fn held() -> Value {
        Value {
            last: 100,
            computed: 100,
            ..Value::new(1, 1, false, 0)
        }
    }

    /// Ten blocks, and one after them where 50 arguments arrive.
    fn count(values: &[Value], calls: &[Call]) -> u64 {
        let mut scans = Scans::default();
        for block in 0..10 {
            scans.start(20 + block, 1);
        }
        let mut meetings = [Meeting {
            label: 90,
            end: 90,
            carried: 50,
            forked: 0,
        }];
        scans.count(values, calls, &mut meetings)
    }

    const CALL: Call = Call {
        at: 50,
        until: u32::MAX,
        is_certain: true,
        is_loop: false,
    };

    #[test]
    fn each_value_in_a_register_is_one_more_for_each_block() {
        assert_eq!(count(&[held()], &[]), 10 * 50);
        assert_eq!(count(&[held(); 14], &[]), 14 * 10 * 50);
        let constant = Value {
            is_constant: true,
            ..held()
        };
        assert_eq!(count(&[constant], &[]), 0);
    }

    #[test]
    fn more_than_there_are_registers_end_it() {
        assert_eq!(count(&[held(); 15], &[]), 15 * 10 * 50);
        assert_eq!(count(&[held(); 40], &[]), 15 * 10 * 50);
        let floats = [true, false].map(|is_float| [Value { is_float, ..held() }; 14]);
        assert_eq!(count(floats.as_flattened(), &[]), 28 * 10 * 50);
    }

    #[test]
    fn a_call_ends_it_if_it_is_made() {
        assert_eq!(count(&[held(); 14], &[CALL]), 10 * 50);
        let dropped = Call {
            is_certain: false,
            ..CALL
        };
        assert_eq!(count(&[held(); 14], &[dropped]), 14 * 10 * 50);
        let passed_by = Call { until: 60, ..CALL };
        assert_eq!(count(&[held(); 14], &[passed_by]), 14 * 10 * 50);
        // What is only handed on stays in memory, in one piece.
        let handed_on = Value {
            computed: 1,
            ..held()
        };
        assert_eq!(count(&[handed_on; 20], &[CALL]), 20 * 10 * 50);
        assert_eq!(count(&[handed_on; 20], &[]), 20 * 10 * 50);
        let start_of_loop = Call {
            is_loop: true,
            ..CALL
        };
        assert_eq!(count(&[handed_on; 20], &[start_of_loop]), 10 * 50);
    }

    #[test]
    fn parameters_of_blocks_go_through_those_before_them() {
        let joined = |first: u32| Value {
            first,
            joins: Some([0, 0]),
            ..held()
        };
        // Nothing arrives before them.
        assert_eq!(count(&[joined(1); 14], &[]), 0);
        let after = Meeting {
            label: 1,
            end: 1,
            carried: 7,
            forked: 3,
        };
        let mut scans = Scans::default();
        scans.start(20, 10);
        // Also for the blocks of the edges that hand something on.
        assert_eq!(scans.count(&[joined(1)], &[], &mut [after]), 10 * 7 + 3 * 7);
    }
}
