//! Ctrl-C: the first asks running work to stop, the second stops the process.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::exit::Exit;
use super::failure::Failure;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What came of the attempt to listen, which a process can make only once.
static LISTENING: OnceLock<Result<(), String>> = OnceLock::new();

/// Starts to listen for Ctrl-C; the flag becomes true with the first one. Called
/// again, it gives the same flag.
///
/// # Errors
///
/// When the signal cannot be handled.
pub fn listen() -> Result<&'static AtomicBool, Failure> {
    let listening = LISTENING.get_or_init(|| {
        let handler = || {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(Exit::Interrupted as u8));
            }
        };
        ctrlc::set_handler(handler).map_err(|error| error.to_string())
    });
    match listening {
        Ok(()) => Ok(&INTERRUPTED),
        Err(error) => Err(Failure::host(format!(
            "failed to listen for Ctrl-C: {error}"
        ))),
    }
}
