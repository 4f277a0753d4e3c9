//! [`start`]: the threads that wasmtime compiles on, in a process that is not a worker.

use std::io;
use std::sync::OnceLock;

use crate::error::InfrastructureError;

/// Starts the threads that wasmtime compiles on, unless they have been started. It would panic
/// where there is no room for them.
///
/// # Errors
///
/// When they cannot be started, now or the first time: rayon tries it only once.
pub(super) fn start() -> Result<(), InfrastructureError> {
    static STARTED: OnceLock<Result<(), String>> = OnceLock::new();
    let started = STARTED.get_or_init(|| {
        let built = rayon::ThreadPoolBuilder::new().build_global();
        // Only a failure of the system has a source; otherwise they have been started elsewhere.
        built.or_else(|error| match std::error::Error::source(&error) {
            Some(source) => Err(source.to_string()),
            None => Ok(()),
        })
    });
    started
        .clone()
        .map_err(|reason| InfrastructureError::Thread(io::Error::other(reason)))
}
