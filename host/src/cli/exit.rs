//! The exit codes of the `wasmouse` command: a public table, never renumbered.

use std::process::ExitCode;

/// How a command ended. The numbers are documented in `wasmouse --help`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Exit {
    /// The command did what was asked.
    Success = 0,
    /// A check failed: a maze breaks the contest rules or has no solution, a recorded result
    /// has changed, a contest is not reproducible, a robot is below the mark or a threshold.
    CheckFailed = 1,
    /// The command line is wrong (also clap's own code).
    Usage = 2,
    /// An input, or a tool that the command needs, is missing or invalid.
    Input = 3,
    /// A robot was rejected or ended a match with a fault.
    Robot = 4,
    /// An internal error: a full disk, standard output that is closed, a broken pipe to a worker,
    /// a bug. Also when some matches could not be played, or a robot took too long.
    Internal = 5,
    /// Everything was played, and no robot finished any match.
    NoneFinished = 6,
    /// A result was recorded with another version of the engine, so it cannot be verified.
    OtherEngine = 7,
    /// A result was verified, but its file was reformatted.
    Reformatted = 8,
    /// Interrupted by SIGHUP, because the terminal was closed; what was finished by then has been
    /// written. This and the other codes of signals are those that a shell reports.
    HungUp = 129,
    /// Interrupted by Ctrl-C; what was finished by then has been written.
    Interrupted = 130,
    /// Everything was done, but the reader of standard output went away before the end. As the
    /// shell reports a program that the signal for a broken pipe ends.
    Unread = 141,
    /// Interrupted by SIGTERM; what was finished by then has been written.
    Terminated = 143,
}

impl Exit {
    /// What clap's own exit code means: 0 after help was printed, else 2.
    pub const fn from_clap(code: i32) -> Self {
        match code {
            0 => Self::Success,
            _ => Self::Usage,
        }
    }
}

/// The table as `--help` prints it.
pub const EXIT_CODES_HELP: &str = "\
Exit codes:
    0  success
    1  a check failed: an illegal or unsolvable maze, a changed result, a robot below
       the mark
    2  invalid command line
    3  an input file or a required tool is missing or invalid
    4  a robot was rejected or faulted
    5  internal error, such as a full disk or a closed standard output
    6  no robot finished any match
    7  a result was recorded with another engine version
    8  a result is verified, but its file was reformatted
  129  interrupted because the terminal was closed (SIGHUP)
  130  interrupted by Ctrl-C
  141  the reader of standard output closed it before the end
  143  interrupted by SIGTERM";

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
