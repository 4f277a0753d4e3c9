//! `wasi`: builds what keeps WASI inside of robots; `cargo xtask wasi` runs it.

use std::process::ExitCode;

use wasmouse_tests::{bindings, wasi};

fn main() -> ExitCode {
    match wasi::build(&bindings::repository()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
