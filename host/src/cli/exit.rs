//! The exit codes of the `wasmouse` command: a public table, never renumbered.

use std::process::ExitCode;

/// How a command ended. The numbers are documented in `wasmouse --help`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// The command did what was asked.
    Success = 0,
    /// The command worked and its answer is no: a maze breaks the contest
    /// rules, or has no solution; a result is not what its matches give.
    No = 1,
    /// The command line is wrong (also clap's own code).
    Usage = 2,
    /// A file, folder or specification cannot be read or understood.
    Input = 3,
    /// A robot was refused at admission or ended a match with a fault.
    Robot = 4,
    /// The host failed: a full disk, a broken pipe to a child, a bug.
    Host = 5,
    /// Interrupted by Ctrl-C; what was finished by then has been printed.
    Interrupted = 130,
}

/// The table as `--help` prints it.
pub const EXIT_CODES_HELP: &str = "\
Exit codes:
    0  success
    1  the answer is no (an illegal or unsolvable maze, a false result)
    2  wrong command line
    3  an input cannot be read or understood
    4  a robot was refused or ended a match with a fault
    5  the host failed
  130  interrupted";

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
