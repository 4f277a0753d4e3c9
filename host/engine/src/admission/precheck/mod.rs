//! The check of a file before anything of it is compiled.
//!
//! [`precheck`] reads a component or core module once, validates it with exactly the
//! proposals that the engine has, and measures meanwhile ([`Measure`]) what would
//! make compiling or instantiating it take too long or too much memory. It compiles
//! and runs nothing, knows no engine, and takes time proportional to the size of the
//! file: whatever validation does more than once is limited before it begins. Items of
//! components are validated one by one for that.
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
//! | component items | 10,000 | 1,796 | 1,512 | 127 |
//! | the same, instantiated | 20,000 | 3,382 | 1,863 | 151 |
//! | values in lowered functions | 20,000 | 37 | 410 | 37 |
//! | lowered functions | 500 | 5 | 34 | 5 |
//! | parts of a type | 2,000 | 66 | 63 | 20 |
//! | parts of types to compare | 1,000,000 | 14,338 | 25,456 | 1,977 |
//! | bytes in a name | 2,000 | 162 | 78 | 51 |
//! | core modules | 200 | 38 | 11 | 3 |
//! | items of one kind | 100,000 | 4,955 | 5,665 | 10,000 |
//! | items of all modules | 200,000 | 9,717 | 6,082 | 10,032 |
//! | elements in segments | 200,000 | 5,792 | 772 | 7,695 |
//! | bytes of data | 67,108,864 | 11,989,969 | 225,502 | 2,632,707 |
//! | bytes of images | 134,217,728 | 12,841,189 | 591,829 | 8,627,017 |
//! | state of a core instance | 1,048,576 | 242,400 | 27,544 | 200,980 |
//! | state of all instances | 2,097,152 | 433,380 | 108,436 | 210,668 |
//! | function types of a module | 5,000 | 509 | 127 | 141 |
//! | function types | 10,000 | 1,331 | 188 | 147 |
//! | functions | 60,000 | 13,488 | 1,712 | 12,677 |
//! | parameters and results | 200 | 19 | 14 | 18 |
//! | locals | 12,000 | 273 | 86 | 122 |
//! | bytes in a function | 1,048,576 | 426,843 | 54,010 | 171,628 |
//! | nested blocks | 4,000 | 781 | 281 | 456 |
//! | nested loops | 64 | 6 | 21 | 6 |
//! | operands | 500 | 54 | 15 | 64 |
//! | targets of a `br_table` | 20,000 | 3,202 | 254 | 453 |
//! | blocks of a function | 40,000 | 14,002 | 5,810 | 17,716 |
//! | variables times blocks | 64,000,000 | 315,600 | 952,840 | 19,394,640 |
//! | values carried | 80,000 | 15,119 | 8,948 | 48,533 |
//! | estimated MiB, one function | 600 | 115 | 68 | 277 |
//! | estimated MiB, the file | 1,000 | 638 | 196 | 941 |
//! | estimated ms, one function | 20,000 | 1,070 | 466 | 8,486 |
//! | estimated ms, the file | 49,000 | 26,350 | 5,570 | 48,480 |
//!
//! # What the estimate is worth
//!
//! Generators of bad files, each pushing one or two terms, were compiled with
//! wasmtime 48 on one thread, and the terms were raised to what they took. The robots
//! above take 0.4 to 0.6 of their estimate, and the generators, each by itself, up to 0.85 of it.
//! Functions that combine constructs at random (`bombs::woven` of the tests) take up to 0.7.
//! After a function that spills a lot, others that spill take longer (`spills`); that part is less
//! certain, because how large the table of the compiler becomes is only known up to a factor of 2.
//! One loop of the allocator, which small files can keep busy for long, is followed closely
//! (`scans`). It stops at a value that a call passes by. Calls that the compiler finds to be never
//! made do not count (`folding`), as far as that is known: one that Cranelift drops by a rule that is
//! not known here would make a file take more than its estimate. What has no effect but its result is
//! made where that is needed, however far from where it is in the code, and what it is computed from
//! stays alive until then (`values`).
//!
//! Memory is estimated for the two functions that take the most, which two threads may compile at the
//! same time, and for what is kept of all others. Real robots take 0.45 to 0.6 of it, and
//! generators, with as many functions as are admitted, up to 1.0.
//! `cargo xtask fuzz compile_cost` searches for files that take more. Checking alone,
//! with a process for it, takes 0.3 s for the Python robot in a release build, and
//! 0.01 s for one in C. Whatever the estimate misses, the process that compiles has
//! its own limits on time and memory.
//!
//! # What the engine would refuse to load
//!
//! The engine checks the modules of a component against the slots of its pool, also those
//! that are never instantiated. The same limits hold here, and what the engine computes
//! (the state of an instance in bytes) is computed in the same way or bounded from above,
//! so that nothing is compiled in vain and every mode rejects the same files.

mod check;
mod component;
mod context;
mod cost;
mod declared;
mod depth;
mod expansion;
mod flow;
mod folding;
mod frames;
mod function;
mod gauge;
mod items;
mod locals;
mod measure;
mod module;
mod names;
mod parts;
mod pressure;
mod scans;
mod shape;
mod spills;
mod startup;
mod value;
mod values;

pub use check::precheck;
pub use measure::{Measure, Measures};
pub use shape::Shape;
