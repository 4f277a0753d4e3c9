//! The targets of `wasmouse_tests::fuzz` for libFuzzer, which changes inputs by what code
//! they reach.

use std::cell::RefCell;

use wasmouse_tests::fuzz::{Run, targets};

#[doc(hidden)]
pub use libfuzzer_sys::fuzz_target;

thread_local! {
    static RUN: RefCell<Option<Run>> = const { RefCell::new(None) };
}

/// Tries an input with the target of that name, which is the same in each call.
///
/// # Panics
///
/// When there is no such target, or something is wrong with the input.
pub fn run(name: &str, input: &[u8]) {
    RUN.with_borrow_mut(|run| {
        let run = run.get_or_insert_with(|| {
            let named = targets().into_iter().find(|target| target.name == name);
            (named.expect("a target").make)()
        });
        run(input);
    });
}

/// A program of libFuzzer for the target of that name.
#[macro_export]
macro_rules! target {
    ($name:literal) => {
        $crate::fuzz_target!(|input: &[u8]| $crate::run($name, input));
    };
}
