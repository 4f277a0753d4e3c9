//! Ctrl-C: ends the process with its own exit code, at once or as soon as the work
//! that is under way has been brought to an end.
//!
//! Work that has something to bring to an end, such as a contest with results to
//! print, asks the flag of [`listen`] now and then. While nobody does, there is
//! nothing to lose, and Ctrl-C ends the process at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, OnceLock};

use wasmouse_engine::CancelFlag;

use super::exit::Exit;
use super::failure::Failure;

static INTERRUPTED: LazyLock<CancelFlag> = LazyLock::new(CancelFlag::default);

/// Whether somebody asks [`INTERRUPTED`].
static HEARD: AtomicBool = AtomicBool::new(false);

/// What came of the attempt to handle the signal, which a process can make only once.
static HANDLING: OnceLock<Result<(), String>> = OnceLock::new();

/// Handles Ctrl-C from now on: by exiting, until somebody [`listen`]s.
///
/// That it cannot be handled is no failure as long as nobody listens.
pub fn handle() {
    let _ = handled();
}

/// Listens for Ctrl-C: from now on the first one makes the flag true, and only the
/// second ends the process. Called again, it gives the same flag.
///
/// # Errors
///
/// When the signal cannot be handled.
pub fn listen() -> Result<&'static CancelFlag, Failure> {
    HEARD.store(true, Ordering::Relaxed);
    match handled() {
        Ok(()) => Ok(&INTERRUPTED),
        Err(error) => Err(Failure::internal(format!(
            "failed to listen for Ctrl-C: {error}"
        ))),
    }
}

/// The flag that Ctrl-C sets. It stays unset while nobody listens.
pub fn flag() -> &'static CancelFlag {
    &INTERRUPTED
}

/// Stops listening, because there is nothing left to lose: Ctrl-C ends the process at once.
pub fn stop_listening() {
    HEARD.store(false, Ordering::Relaxed);
}

fn handled() -> &'static Result<(), String> {
    HANDLING.get_or_init(|| {
        let handler = || {
            let is_second = INTERRUPTED.is_set();
            INTERRUPTED.set();
            if is_second || !HEARD.load(Ordering::Relaxed) {
                std::process::exit(i32::from(Exit::Interrupted as u8));
            }
        };
        ctrlc::set_handler(handler).map_err(|error| error.to_string())
    })
}
