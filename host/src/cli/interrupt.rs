//! Ctrl-C: the first asks running work to stop, the second stops the process.

use std::sync::atomic::{AtomicBool, Ordering};

use super::exit::Exit;
use super::failure::Failure;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Starts to listen for Ctrl-C; the flag becomes true with the first one.
///
/// # Errors
///
/// When the signal cannot be handled.
pub fn listen() -> Result<&'static AtomicBool, Failure> {
    ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(Exit::Interrupted as u8));
        }
    })
    .map_err(|error| Failure::host(format!("failed to listen for Ctrl-C: {error}")))?;
    Ok(&INTERRUPTED)
}
