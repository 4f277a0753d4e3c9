//! The real worker, except that it fails on purpose before matches with certain seeds.
//!
//! Workers get no environment and no arguments of their own, so the seed says how.

use std::io;
use std::process::abort;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use wasmouse_engine::sandbox::child;

/// Crashes every time.
const CRASH: u64 = 901;
/// Crashes, unless it is the first match of the worker.
const CRASH_LATER: u64 = 902;
/// Never reports.
const HANG: u64 = 903;
/// Exits with success.
const LEAVE: u64 = 904;

fn main() -> io::Result<()> {
    let role = std::env::args().nth(2).unwrap_or_default();
    match role.as_str() {
        "compile" => child::compile_main(),
        "run" => child::run_main_with(&before_match),
        "backtrace" => child::backtrace_main(),
        other => Err(io::Error::other(format!("no role `{other}`"))),
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
