//! The exported functions. They only pass on to the [`Session`] of the instance.

use std::cell::RefCell;

use crate::session::Session;

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
}

fn with<T>(call: impl FnOnce(&mut Session) -> T) -> T {
    SESSION.with_borrow_mut(call)
}

/// Makes room for so many bytes of input. Returns their address, or 0 if it is too much.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: u32) -> *mut u8 {
    with(|session| session.reserve(length))
}

/// The address of the last output.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    with(|session| session.output().as_ptr())
}

/// The length of the last output, in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn output_length() -> u32 {
    with(|session| u32::try_from(session.output().len()).unwrap_or(0))
}

/// Opens the match in the input. Returns its handle, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn open_match() -> u32 {
    with(Session::open_match)
}

/// Opens the replay file in the input. Returns its handle, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn open_replay() -> u32 {
    with(Session::open_replay)
}

/// Outputs what there is to say about a match. Returns 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn about(handle: u32) -> u32 {
    with(|session| session.about(handle))
}

/// Outputs where the robot is at each position. Returns 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn poses(handle: u32) -> u32 {
    with(|session| session.poses(handle))
}

/// Outputs what could be known at each position. Returns 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn audit(handle: u32) -> u32 {
    with(|session| session.audit(handle))
}

/// Outputs what there is to see at a position. Returns 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn frame(handle: u32, step: u32) -> u32 {
    with(|session| session.frame(handle, step))
}

/// Closes a match. Returns 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn close(handle: u32) -> u32 {
    with(|session| session.close(handle))
}
