//! The `wasmouse` command. Everything it does is in [`wasmouse::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    wasmouse::cli::main()
}
