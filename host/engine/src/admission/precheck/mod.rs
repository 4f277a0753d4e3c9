//! The check of a file before anything of it is compiled.
//!
//! [`precheck`] reads a component or core module once, validates it with exactly the
//! proposals that the engine has, and measures meanwhile ([`Measure`]) what would
//! make compiling or instantiating it take too long or too much memory. It compiles
//! and runs nothing, knows no engine, and takes time proportional to the size of the
//! file: whatever validation does more than once is limited before it begins.
//!
//! # What real robots have
//!
//! Measured on a robot that drives straight on, built with componentize-py 0.25.1
//! (18.3 MB), jco 1.35 with QuickJS (1.6 MB) and componentize-js 0.23 (12.0 MB).
//! Compiling them took 15, 2.7 and 18 s of CPU and 350, 97 and 413 MB.
//!
//! | measure | limit | Python | QuickJS | StarlingMonkey |
//! |---|---|---|---|---|
//! | core instances | 64 | 38 | 11 | 3 |
//! | component depth | 100 | 2 | 4 | 2 |
//! | component items | 10,000 | 1,790 | 1,500 | 121 |
//! | the same, instantiated | 20,000 | 3,374 | 1,849 | 143 |
//! | values in lowered functions | 20,000 | 35 | 408 | 35 |
//! | parts of a type | 2,000 | 66 | 63 | 19 |
//! | bytes in a name | 2,000 | 162 | 78 | 51 |
//! | items of one kind | 100,000 | 4,955 | 5,290 | 10,000 |
//! | function types | 5,000 | 509 | 127 | 141 |
//! | functions | 60,000 | 13,486 | 1,710 | 12,675 |
//! | parameters and results | 200 | 19 | 14 | 18 |
//! | locals | 12,000 | 273 | 86 | 122 |
//! | bytes in a function | 1,048,576 | 426,843 | 54,010 | 171,628 |
//! | nested blocks | 4,000 | 781 | 281 | 456 |
//! | nested loops | 64 | 6 | 21 | 6 |
//! | operands | 500 | 54 | 15 | 64 |
//! | targets of a `br_table` | 20,000 | 3,202 | 254 | 453 |
//! | blocks of a function | 40,000 | 14,002 | 5,810 | 17,716 |
//! | variables times blocks | 64,000,000 | 315,600 | 952,840 | 19,394,640 |
//! | values carried | 80,000 | 9,773 | 8,879 | 24,146 |
//! | estimated MiB, one function | 600 | 184 | 79 | 290 |
//! | estimated ms, one function | 20,000 | 2,521 | 663 | 5,017 |
//! | estimated ms, the file | 65,000 | 22,813 | 4,772 | 41,471 |
//!
//! # What the estimate is worth
//!
//! Generators of bad files, each pushing one or two terms, were compiled with
//! wasmtime 48 on one thread, and the terms were raised to what they took. Of files
//! within the limits, those that come nearest to their estimate reach nine tenths of
//! it: indirect calls, arithmetic after a long chain of blocks, and values that are
//! spilled. The most that one function within the limits was seen to take is 11 s
//! and 425 MB. Checking alone, with a process for it, takes 0.2 s for the Python robot in
//! a release build, and 0.01 s for one in C. Whatever the estimate misses, the process that compiles has its own
//! limits on time and memory.

mod check;
mod component;
mod expansion;
mod flow;
mod function;
mod measure;
mod module;
mod names;
mod parts;
mod shape;

pub use check::precheck;
pub use measure::{Measure, Measures};
pub use shape::Shape;
