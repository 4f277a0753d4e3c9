//! [`Keyboard`]: waiting for keys without being caught by a terminal that is closed.
//!
//! When a terminal goes away, crossterm tries to read from it forever. So it is only asked when the
//! system says that there is something to read and that the terminal is still there.

use std::io;
use std::time::Duration;

/// What came while waiting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waited {
    /// Perhaps a key, or nothing in time.
    Time,
    /// The terminal was closed.
    Closed,
}

/// Where keys come from: standard input, or the terminal of this process if it is something else.
#[derive(Debug)]
pub struct Keyboard {
    #[cfg(unix)]
    terminal: Option<std::fs::File>,
}

#[cfg(unix)]
impl Keyboard {
    /// The keyboard of this process, as crossterm finds it.
    ///
    /// # Errors
    ///
    /// When it has none.
    pub fn open() -> io::Result<Self> {
        use std::io::IsTerminal as _;
        let terminal = match io::stdin().is_terminal() {
            true => None,
            false => Some(std::fs::File::open("/dev/tty")?),
        };
        Ok(Self { terminal })
    }

    /// Waits until there is a key, or for that time.
    ///
    /// # Errors
    ///
    /// When the system cannot wait.
    pub fn wait(&self, time: Duration) -> io::Result<Waited> {
        use std::os::fd::AsRawFd as _;
        let stdin = io::stdin().as_raw_fd();
        let fd = self.terminal.as_ref().map_or(stdin, |it| it.as_raw_fd());
        let mut polled = libc::pollfd {
            fd,
            events: libc::POLLIN,
            revents: 0,
        };
        // Rounded up, so that the last part of a millisecond is not waited for in circles.
        let milliseconds = time.as_micros().div_ceil(1000);
        let milliseconds = libc::c_int::try_from(milliseconds).unwrap_or(libc::c_int::MAX);
        // SAFETY: the pointer is to one structure, as the count says, which outlives the call.
        let found = unsafe { libc::poll(&raw mut polled, 1, milliseconds) };
        if found < 0 {
            let error = io::Error::last_os_error();
            return match error.kind() {
                io::ErrorKind::Interrupted => Ok(Waited::Time),
                _ => Err(error),
            };
        }
        let gone = libc::POLLHUP | libc::POLLERR | libc::POLLNVAL;
        Ok(if polled.revents & gone != 0 {
            Waited::Closed
        } else {
            Waited::Time
        })
    }
}

#[cfg(not(unix))]
impl Keyboard {
    /// The keyboard of this process.
    ///
    /// # Errors
    ///
    /// None on this system.
    pub fn open() -> io::Result<Self> {
        Ok(Self {})
    }

    /// Waits until there is a key, or for that time.
    ///
    /// # Errors
    ///
    /// When the terminal is lost.
    pub fn wait(&self, time: Duration) -> io::Result<Waited> {
        ratatui::crossterm::event::poll(time)?;
        Ok(Waited::Time)
    }
}
