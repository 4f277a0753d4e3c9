//! A worker that goes wrong on purpose: the real one, with something to do before
//! matches of certain seeds.
//!
//! Workers get no environment and no arguments of their own, so the seed says what.

use std::io;
use std::process::{ExitCode, abort};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use wasmouse::robot::worker;

/// Crashes whenever it plays this.
const CRASH: u64 = 901;
/// Crashes, unless it is the first match of the worker.
const CRASH_LATER: u64 = 902;
/// Never answers.
const HANG: u64 = 903;
/// Ends as if all was well.
const LEAVE: u64 = 904;

fn main() -> ExitCode {
    let role = std::env::args().nth(2).unwrap_or_default();
    let served = match role.as_str() {
        "play" => worker::play_main_with(&before_match),
        "compile" => worker::compile_main(),
        other => Err(io::Error::other(format!("no role `{other}`"))),
    };
    match served {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn before_match(seed: u64) {
    static PLAYED: AtomicU32 = AtomicU32::new(0);
    let played = PLAYED.fetch_add(1, Ordering::Relaxed);
    match seed {
        CRASH => abort(),
        CRASH_LATER if played > 0 => abort(),
        HANG => thread::sleep(Duration::from_secs(3600)),
        LEAVE => std::process::exit(0),
        _ => {}
    }
}
