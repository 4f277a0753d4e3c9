//! Signals that ask the process to end: Ctrl-C, and on Unix also SIGTERM (`kill`, `timeout`, a
//! service manager) and SIGHUP (the terminal was closed). All of them do the same: they end the
//! process with an exit code of its own, at once or as soon as the work that is under way has been
//! brought to an end.
//!
//! Work that has something to bring to an end, such as a contest with results to
//! print, asks the flag of [`listen`] now and then. While nobody does, there is
//! nothing to lose, and a signal ends the process at once.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{LazyLock, OnceLock};

use wasmouse_engine::CancelFlag;

use super::exit::Exit;
use super::failure::Failure;

static INTERRUPTED: LazyLock<CancelFlag> = LazyLock::new(CancelFlag::default);

/// The exit code of the first signal.
static FIRST: AtomicU8 = AtomicU8::new(Exit::Interrupted as u8);

/// Whether somebody asks [`INTERRUPTED`].
static HEARD: AtomicBool = AtomicBool::new(false);

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
    HEARD.store(true, Ordering::Relaxed);
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
    HEARD.store(false, Ordering::Relaxed);
}

/// The exit code of a command that ended like that: for an interrupted one, that of the signal.
pub fn exit_of(exit: Exit) -> Exit {
    let first = FIRST.load(Ordering::Relaxed);
    match exit {
        Exit::Interrupted if first == Exit::Terminated as u8 => Exit::Terminated,
        Exit::Interrupted if first == Exit::HungUp as u8 => Exit::HungUp,
        exit => exit,
    }
}

fn handled() -> &'static Result<(), String> {
    HANDLING.get_or_init(|| handle_with(received).map_err(|error| error.to_string()))
}

/// What a signal with that exit code does.
fn received(exit: Exit) {
    let is_second = INTERRUPTED.is_set();
    if !is_second {
        FIRST.store(exit as u8, Ordering::Relaxed);
    }
    INTERRUPTED.set();
    if is_second || !HEARD.load(Ordering::Relaxed) {
        std::process::exit(i32::from(exit as u8));
    }
}

/// Calls a function for each signal, on a thread that does nothing else.
#[cfg(unix)]
fn handle_with(received: fn(Exit)) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut signals = vec![SIGINT, SIGTERM];
    if !is_ignored(SIGHUP) {
        signals.push(SIGHUP);
    }
    let mut signals = Signals::new(signals)?;
    let thread = std::thread::Builder::new().name("signals".to_owned());
    thread.spawn(move || {
        for signal in signals.forever() {
            received(match signal {
                SIGTERM => Exit::Terminated,
                SIGHUP => Exit::HungUp,
                _ => Exit::Interrupted,
            });
        }
    })?;
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

/// Calls a function for each Ctrl-C.
#[cfg(not(unix))]
fn handle_with(received: fn(Exit)) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(move || received(Exit::Interrupted))
}
