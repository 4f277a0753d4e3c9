//! Functions that combine what the other generators have one of each.

use wasm_encoder::{BlockType, Instruction as I};

use super::functions::{Parts, argument, holds, load, releases, uses};
use super::modules::count;

/// Constructs that are open at a time, beside the outermost block.
const OPEN_MAX: u32 = 8;

/// A function that repeats a pattern of pieces: exits, calls, loops, joins, and uses of what the
/// pieces before them made. The digits of `warp` and `weft` in base 16 are the pieces, in `turns`
/// repetitions, while floats and integers stay alive that are used after all of them.
pub fn woven(warp: u32, weft: u32, turns: u32, locals: u32, floats: u32, integers: u32) -> Vec<u8> {
    let mut body = holds(floats, integers);
    body.push(I::Block(BlockType::Empty));
    let pieces: Vec<u32> = digits(warp).chain(digits(weft)).collect();
    let mut weaver = Weaver {
        body,
        locals,
        step: 0,
        open: 0,
    };
    for _ in 0..turns {
        for &piece in &pieces {
            weaver.piece(piece);
        }
    }
    let Weaver { mut body, open, .. } = weaver;
    body.extend(vec![I::End; count(open + 1)]);
    body.extend(releases(floats, integers));
    body.extend(uses(1, locals));
    Parts::one(locals, body)
}

/// The digits of a number in base 16, the last first.
fn digits(mut number: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let digit = number % 16;
        let is_digit = number > 0;
        number /= 16;
        is_digit.then_some(digit)
    })
}

struct Weaver {
    body: Vec<I<'static>>,
    locals: u32,
    /// Pieces so far: each loads something else.
    step: u32,
    /// Constructs that are open in the outermost block.
    open: u32,
}

impl Weaver {
    fn piece(&mut self, piece: u32) {
        self.step += 1;
        let empty = BlockType::Empty;
        let condition = I::LocalGet(0);
        match piece {
            0 => self.exit(self.open),
            1 => self.exit(0),
            2 => self.body.extend([condition, I::Call(0)]),
            3 => self.open(I::Block(empty)),
            4 => self.open(I::Loop(empty)),
            5 => self.close(),
            6 => {
                self.body.extend([condition, I::If(empty)]);
                self.change(1);
                self.body.push(I::End);
            }
            7 => {
                self.body.extend([condition.clone(), I::If(empty)]);
                self.body.extend([condition, I::Call(0), I::Unreachable]);
                self.body.push(I::End);
            }
            8 => {
                self.body.push(I::Loop(empty));
                self.change(1);
                self.body.extend([condition, I::BrIf(0), I::End]);
            }
            9 => {
                self.body.extend([I::Block(empty), condition]);
                let labels: Vec<u32> = (0..=self.open + 1).collect();
                self.body.extend([I::BrTable(labels.into(), 0), I::End]);
            }
            10 => self.change(self.locals),
            11 => self.body.extend(uses(1, self.locals)),
            12 => {
                let [address, value] = load(self.step % 100);
                self.body.extend([I::LocalGet(0), address, value]);
                self.body.push(I::I32Store(argument(self.step)));
            }
            // Loaded again and again, until something is stored.
            13 => {
                for at in 0..50 {
                    self.body.extend(load(at));
                    self.body.extend([I::LocalGet(self.local()), I::I32Add]);
                    self.body.push(I::LocalSet(self.local()));
                }
            }
            14 => self.body.extend([
                condition,
                I::I32Const(0),
                I::CallIndirect {
                    type_index: 0,
                    table_index: 0,
                },
            ]),
            _ => {
                self.body.extend([condition, I::If(empty)]);
                self.change(1);
                self.body.push(I::Else);
                self.change(self.locals);
                self.body.push(I::End);
            }
        }
    }

    fn local(&self) -> u32 {
        1 + self.step % self.locals
    }

    /// Writes what is loaded here to that many locals.
    fn change(&mut self, locals: u32) {
        for local in 0..locals {
            self.body.extend(load(self.step * self.locals + local));
            self.body
                .push(I::LocalSet(1 + (self.step + local) % self.locals));
        }
    }

    /// A branch outwards, taken with other values than all others.
    fn exit(&mut self, label: u32) {
        self.change(self.locals);
        self.body.extend([I::LocalGet(0), I::BrIf(label)]);
    }

    fn open(&mut self, construct: I<'static>) {
        if self.open < OPEN_MAX {
            self.body.push(construct);
            self.open += 1;
        }
    }

    fn close(&mut self) {
        if self.open > 0 {
            self.body.push(I::End);
            self.open -= 1;
        }
    }
}
