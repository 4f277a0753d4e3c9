//! [`Process`]: one worker, seen from the supervisor.

use std::fmt;
use std::io::{self, BufReader, BufWriter, Read as _, Write as _};
use std::path::PathBuf;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::super::protocol::{self, Hello};
use super::super::role::{Role, SandboxStatus};
#[cfg(not(windows))]
use super::group::{Group, Groups};
#[cfg(windows)]
use super::job::{Group, Groups};
use super::monitor::{Kill, Limit, Monitor, Watched};
use crate::error::InfrastructureError;
use crate::time::{Control, MATCH_TIME_MAX};

/// How workers are run.
#[derive(Clone, Debug)]
pub struct WorkerOptions {
    /// The program that they are started from.
    pub executable: Executable,
    /// How long a match may take on the wall clock. It says nothing about the robot: its
    /// processor time is limited too, and this ends a worker that stalls.
    pub patience: Duration,
    /// Fail where the operating system cannot sandbox them completely.
    pub require_sandbox: bool,
    /// What ends matches besides fuel and rules.
    pub control: Control,
}

/// How long a match may take on the wall clock before its worker is killed, by default: the
/// processor time of a match on a machine that is five times as busy as it should be.
pub const PATIENCE: Duration = Duration::from_secs(5 * MATCH_TIME_MAX.as_secs());

/// Starts workers.
pub(super) struct Starter {
    pub(super) monitor: Monitor,
    pub(super) workers: WorkerOptions,
    /// Control groups or job objects for workers, where there are any.
    pub(super) groups: Option<Groups>,
}

impl Starter {
    /// Whether a worker with these layers of the sandbox may work.
    ///
    /// # Errors
    ///
    /// When a layer is missing and all are required.
    pub(super) const fn check(&self, sandbox: SandboxStatus) -> Result<(), InfrastructureError> {
        if sandbox.is_complete() || !self.workers.require_sandbox {
            return Ok(());
        }
        Err(InfrastructureError::IncompleteSandbox {
            missing: sandbox.missing(),
        })
    }
}

/// How long a worker may take to start.
pub(super) const START_TIME_MAX: Duration = Duration::from_secs(30);

/// How much of a worker's standard error is kept, in bytes.
const STDERR_BYTES_MAX: u64 = 4 << 10;

/// What is added to it when the worker's control group had no memory left.
const OUT_OF_GROUP_MEMORY: &str = "its control group ran out of memory";

/// The program that workers are started from.
#[derive(Clone, Debug)]
pub struct Executable(PathBuf);

impl Executable {
    /// The program of this process, also when its file has been replaced meanwhile.
    ///
    /// # Errors
    ///
    /// When the operating system does not know where it is.
    pub fn current() -> io::Result<Self> {
        if cfg!(target_os = "linux") {
            Ok(Self("/proc/self/exe".into()))
        } else {
            std::env::current_exe().map(Self)
        }
    }

    /// Another program that has the same roles.
    pub fn at(path: impl Into<PathBuf>) -> Self {
        Self(path.into())
    }

    fn command(&self, role: Role) -> Command {
        let mut command = Command::new(&self.0);
        command
            .args(["worker", role.name()])
            .env_clear()
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        #[cfg(unix)]
        {
            use std::os::unix::process::CommandExt as _;
            // Ctrl-C is for the supervisor, which ends its workers itself.
            command.process_group(0);
            command.arg0("wasmouse");
        }
        #[cfg(windows)]
        {
            use std::os::windows::process::CommandExt as _;
            use windows_sys::Win32::System::Threading::{
                CREATE_NEW_PROCESS_GROUP, CREATE_NO_WINDOW,
            };
            // For the same reason; and it has no console, so none that a robot could write to.
            command.creation_flags(CREATE_NO_WINDOW | CREATE_NEW_PROCESS_GROUP);
            // Some libraries of the system are found by it.
            command.envs(std::env::var_os("SystemRoot").map(|root| ("SystemRoot", root)));
        }
        command
    }
}

/// A worker with its pipes, which only an [exchange](Process::exchange) can use: whatever is
/// written or read has a deadline. Dropping it kills it.
pub(super) struct Process {
    watched: Arc<Watched>,
    to: BufWriter<ChildStdin>,
    from: BufReader<ChildStdout>,
    stderr: ChildStderr,
    /// Its control group or job object, where there is one. Dropped after the process is reaped.
    group: Option<Group>,
}

/// How a worker exited that should not have.
#[derive(Debug)]
pub(super) struct WorkerExit {
    /// How the process ended; `None` when it had to be killed.
    pub(super) status: Option<ExitStatus>,
    /// Why the supervisor killed it, if it did.
    pub(super) killed: Option<Kill>,
    /// What went wrong on the supervisor's side of the pipe.
    pub(super) error: String,
    /// The end of what it wrote to standard error.
    pub(super) stderr: String,
}

impl Process {
    /// Starts a worker.
    pub(super) fn start(starter: &Starter, role: Role) -> Result<Self, InfrastructureError> {
        if starter.workers.control.cancel.is_set() {
            return Err(InfrastructureError::Cancelled);
        }
        let take =
            |child: &mut Child| (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let command = starter.workers.executable.command(role);
        let spawned = starter.monitor.spawn(command, take);
        let failed = |reason: String| InfrastructureError::Worker {
            role: role.name(),
            reason,
        };
        let (watched, pipes) = spawned.map_err(|error| failed(error.to_string()))?;
        let (Some(stdin), Some(stdout), Some(stderr)) = pipes else {
            return Err(failed("it has no pipes".into()));
        };
        // It waits to be told what to do, so it has used nothing and started nothing by now.
        let groups = starter.groups.as_ref();
        let group = groups.and_then(|groups| groups.create(role));
        let group = group.filter(|group| group.add(&watched.child()).is_ok());
        Ok(Self {
            group,
            watched,
            to: BufWriter::with_capacity(64 << 10, stdin),
            from: BufReader::with_capacity(64 << 10, stdout),
            stderr,
        })
    }

    /// Writes to the worker and reads from it. It is killed when it takes more than the limit,
    /// and the pipes then break.
    pub(super) fn exchange<T>(
        &mut self,
        limit: Limit,
        talk: impl FnOnce(&mut Talk<'_>) -> io::Result<T>,
    ) -> io::Result<T> {
        self.watched.begin(limit);
        let talked = talk(&mut Talk {
            to: &mut self.to,
            from: &mut self.from,
            watched: &self.watched,
            has_group: self.group.is_some(),
        });
        self.watched.end();
        talked
    }

    /// Kills and reaps it after `error`, and returns its exit status.
    pub(super) fn reap(mut self, error: &io::Error) -> WorkerExit {
        let broken = matches!(
            error.kind(),
            io::ErrorKind::UnexpectedEof | io::ErrorKind::BrokenPipe
        );
        let killed = self.watched.killed();
        let mut child = self.watched.child();
        // A broken pipe means that it is ending by itself, and how it does says why.
        let status = if broken && killed.is_none() {
            ended(&mut child)
        } else {
            None
        };
        kill(&mut child);
        drop(child);
        let mut stderr = Vec::new();
        // All that is left is its last stderr; the writing end is closed.
        let _ = (&mut self.stderr)
            .take(STDERR_BYTES_MAX)
            .read_to_end(&mut stderr);
        if self.group.as_ref().is_some_and(Group::is_out_of_memory) {
            stderr.push(b'\n');
            stderr.extend_from_slice(OUT_OF_GROUP_MEMORY.as_bytes());
        }
        WorkerExit {
            status,
            killed,
            error: error.to_string(),
            stderr: plain(&String::from_utf8_lossy(&stderr)),
        }
    }
}

/// The pipes of a worker during an exchange.
pub(super) struct Talk<'a> {
    to: &'a mut BufWriter<ChildStdin>,
    from: &'a mut BufReader<ChildStdout>,
    watched: &'a Watched,
    has_group: bool,
}

impl Talk<'_> {
    /// Sends a frame, perhaps later.
    pub(super) fn send(&mut self, value: &impl Serialize) -> io::Result<()> {
        protocol::write(self.to, value)
    }

    /// Sends everything that waits.
    pub(super) fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }

    /// Where large bytes are written to.
    pub(super) const fn writer(&mut self) -> &mut BufWriter<ChildStdin> {
        self.to
    }

    /// Where large bytes are read from.
    pub(super) const fn reader(&mut self) -> &mut BufReader<ChildStdout> {
        self.from
    }

    /// Waits for a frame.
    pub(super) fn receive<T: DeserializeOwned>(&mut self) -> io::Result<T> {
        protocol::expect(self.from)
    }

    /// Whether a frame has come that was not received yet.
    pub(super) fn has_frame(&self) -> bool {
        protocol::has_frame(self.from.buffer())
    }

    /// Waits for the first frame and checks that the worker is the same build.
    pub(super) fn greet(&mut self) -> io::Result<SandboxStatus> {
        let hello: Hello = self.receive()?;
        let build = protocol::build();
        if hello.build == build {
            Ok(SandboxStatus {
                control_group: self.has_group,
                ..hello.sandbox
            })
        } else {
            let other = plain(&hello.build.chars().take(80).collect::<String>());
            Err(io::Error::other(format!(
                "the worker is build `{other}` and the supervisor is build `{build}`"
            )))
        }
    }

    /// The next match of the exchange begins, with the whole limit.
    pub(super) fn next_match(&self) {
        self.watched.next_match();
    }
}

/// How a process ends that closed its pipe, which takes it a moment.
fn ended(child: &mut Child) -> Option<ExitStatus> {
    const LOOKS: u32 = 1000;
    for _ in 0..LOOKS {
        if let Ok(Some(status)) = child.try_wait() {
            return Some(status);
        }
        thread::sleep(Duration::from_millis(1));
    }
    None
}

impl Drop for Process {
    fn drop(&mut self) {
        kill(&mut self.watched.child());
    }
}

/// Kills and reaps a process and what it may have started, which would keep the pipes open.
fn kill(child: &mut Child) {
    // It may have ended by itself; what matters is that nothing stays behind.
    #[cfg(unix)]
    {
        use rustix::process::{Pid, Signal, kill_process_group};
        // Its number names the group, also while only other members are left.
        let _ = kill_process_group(Pid::from_child(child), Signal::KILL);
    }
    let _ = child.kill();
    let _ = child.wait();
}

impl WorkerExit {
    /// The signal that ended it.
    #[cfg(unix)]
    fn signal(&self) -> Option<i32> {
        use std::os::unix::process::ExitStatusExt as _;
        self.status.and_then(|status| status.signal())
    }

    /// The code that it ended with.
    fn code(&self) -> Option<i32> {
        self.status.and_then(|status| status.code())
    }

    /// Whether it was killed by somebody else than the supervisor, which says nothing
    /// about what it did.
    pub(super) fn is_kill(&self) -> bool {
        #[cfg(unix)]
        {
            use rustix::process::Signal;
            let outside = [Signal::KILL, Signal::TERM, Signal::HUP, Signal::INT];
            self.signal()
                .is_some_and(|signal| outside.iter().any(|other| other.as_raw() == signal))
        }
        // What the Task Manager and `taskkill` end a process with; no worker ends with it itself.
        #[cfg(not(unix))]
        {
            self.code() == Some(1)
        }
    }

    /// Whether it ended by a signal that a process brings about by what it does: a bad
    /// access, an illegal instruction, an abort.
    pub(super) fn is_crash(&self) -> bool {
        #[cfg(unix)]
        {
            use rustix::process::Signal;
            let own = [
                Signal::SEGV,
                Signal::BUS,
                Signal::ILL,
                Signal::ABORT,
                Signal::FPE,
                Signal::TRAP,
                Signal::SYS,
            ];
            self.signal()
                .is_some_and(|signal| own.iter().any(|other| other.as_raw() == signal))
        }
        // The code is then that of an exception, and those of errors have the highest bits set.
        #[cfg(not(unix))]
        {
            self.code().is_some_and(|code| code < 0)
        }
    }

    /// Whether it was refused memory.
    pub(super) fn is_out_of_memory(&self) -> bool {
        self.stderr.contains("memory allocation of") || self.stderr.contains(OUT_OF_GROUP_MEMORY)
    }

    /// Whether it panicked, by the exit code that Rust programs then have.
    pub(super) fn is_panic(&self) -> bool {
        self.code() == Some(101)
    }

    /// Whether it used up its processor time.
    pub(super) fn is_out_of_processor_time(&self) -> bool {
        #[cfg(unix)]
        {
            self.signal() == Some(rustix::process::Signal::XCPU.as_raw())
        }
        #[cfg(not(unix))]
        false
    }
}

impl fmt::Display for WorkerExit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.killed.is_some() {
            write!(f, "timed out and was killed")?;
        } else if let Some(status) = self.status {
            write!(f, "{status}")?;
        } else {
            write!(f, "{}", self.error)?;
        }
        if let Some(line) = self.stderr.lines().last() {
            write!(f, ": {line}")?;
        }
        Ok(())
    }
}

/// The text without anything but printable ASCII and line ends: a worker that a robot
/// has taken over may say anything.
fn plain(text: &str) -> String {
    let printable = |&c: &char| c == '\n' || c == ' ' || c.is_ascii_graphic();
    let kept: String = text.chars().filter(printable).collect();
    kept.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn stderr_is_plain_text() {
        assert_eq!(plain("a\u{1b}[31m b\u{202e}c\r\nd \n"), "a[31m bc\nd");
    }
}
