//! Signals that ask the process to end: Ctrl-C, and on Unix also SIGTERM (`kill`, `timeout`, a
//! service manager) and SIGHUP (the terminal was closed). All of them do the same: they end the
//! process with an exit code of its own, at once or as soon as the work that is under way has been
//! brought to an end.
//!
//! Work that has something to bring to an end, such as a contest with results to
//! print, asks the flag of [`listen`] now and then. While nobody does, there is
//! nothing to lose, and a signal ends the process at once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, OnceLock};

use wasmouse_engine::CancelFlag;

use super::exit::Exit;
use super::failure::Failure;

static INTERRUPTED: LazyLock<CancelFlag> = LazyLock::new(CancelFlag::default);

/// The exit code of the first signal.
static FIRST: LazyLock<Arc<AtomicUsize>> =
    LazyLock::new(|| Arc::new(AtomicUsize::new(Exit::Interrupted as usize)));

/// Whether nobody asks [`INTERRUPTED`], so that a signal ends the process at once.
static UNHEARD: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));

/// What came of the attempt to handle the signals, which a process can make only once.
static HANDLING: OnceLock<Result<(), String>> = OnceLock::new();

/// Handles signals from now on: by exiting, until somebody [`listen`]s.
///
/// That they cannot be handled is no failure as long as nobody listens.
pub fn handle() {
    let _ = handled();
}

/// Listens for signals: from now on the first one makes the flag true, and only the
/// second ends the process. Called again, it gives the same flag.
///
/// # Errors
///
/// When the signals cannot be handled.
pub fn listen() -> Result<&'static CancelFlag, Failure> {
    UNHEARD.store(false, Ordering::SeqCst);
    match handled() {
        Ok(()) => Ok(&INTERRUPTED),
        Err(error) => Err(Failure::internal(format!(
            "failed to listen for Ctrl-C: {error}"
        ))),
    }
}

/// The flag that a signal sets. It stays unset while nobody listens.
pub fn flag() -> &'static CancelFlag {
    &INTERRUPTED
}

/// Stops listening, because there is nothing left to lose: a signal ends the process at once.
pub fn stop_listening() {
    UNHEARD.store(true, Ordering::SeqCst);
}

/// The exit code of a command that ended like that: for an interrupted one, that of the signal.
pub fn exit_of(exit: Exit) -> Exit {
    let first = FIRST.load(Ordering::SeqCst);
    match exit {
        Exit::Interrupted if first == Exit::Terminated as usize => Exit::Terminated,
        Exit::Interrupted if first == Exit::HungUp as usize => Exit::HungUp,
        exit => exit,
    }
}

fn handled() -> &'static Result<(), String> {
    HANDLING.get_or_init(|| handle_signals().map_err(|error| error.to_string()))
}

/// Handles signals on whichever thread they arrive. A thread that waits for them could not be
/// started where memory is short, and they would be lost then.
#[cfg(unix)]
fn handle_signals() -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag;

    for (signal, exit) in [
        (SIGINT, Exit::Interrupted),
        (SIGTERM, Exit::Terminated),
        (SIGHUP, Exit::HungUp),
    ] {
        if signal == SIGHUP && is_ignored(SIGHUP) {
            continue;
        }
        let code = i32::from(exit as u8);
        // These run in this order, for each signal.
        flag::register_conditional_shutdown(signal, code, Arc::clone(&UNHEARD))?;
        flag::register_conditional_shutdown(signal, code, INTERRUPTED.to_atomic())?;
        flag::register_usize(signal, Arc::clone(&FIRST), exit as usize)?;
        flag::register(signal, INTERRUPTED.to_atomic())?;
    }
    Ok(())
}

/// Whether the process was started with that signal ignored, as by `nohup`.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let mut action = std::mem::MaybeUninit::<libc::sigaction>::zeroed();
    // SAFETY: without a new action the call only writes the present one.
    let asked = unsafe { libc::sigaction(signal, std::ptr::null(), action.as_mut_ptr()) };
    // SAFETY: all of its fields may be zero.
    asked == 0 && unsafe { action.assume_init() }.sa_sigaction == libc::SIG_IGN
}

/// Handles Ctrl-C, on a thread that the system or the crate starts.
#[cfg(not(unix))]
fn handle_signals() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        let is_second = INTERRUPTED.is_set();
        INTERRUPTED.set();
        if is_second || UNHEARD.load(Ordering::SeqCst) {
            std::process::exit(i32::from(Exit::Interrupted as u8));
        }
    })
}
