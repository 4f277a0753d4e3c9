//! The supervisor's side of a compile worker: [`Compiler`].

use std::io::{self, BufRead as _, Write as _};
use std::time::Duration;

use super::super::protocol::{CompileOrder, Compiled, Examined};
use super::super::role::{COMPILE_CPU_SECONDS, COMPILE_MEMORY_BYTES, Role, SandboxStatus};
use super::host_limits::{allows_processor_time, can_provide};
use super::monitor::{Kill, Limit};
use super::process::{Process, Starter, Talk, WorkerExit};
use crate::admission::{OUT_OF_PROCESSOR_TIME, Rejection};
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::runtime::{CompiledCode, Destination};

/// How long a compile worker may take on the wall clock. Its processor time is limited too;
/// this is for one that waits.
const COMPILE_TIME_MAX: Duration = Duration::from_secs(2 * COMPILE_CPU_SECONDS);

/// Compiled code larger than this is rejected, in bytes. Python robots have 60 MB.
const CODE_BYTES_MAX: u64 = 512 << 20;

/// How often a file is tried when its worker is killed from outside.
const TRIES: u32 = 3;

/// What is wanted of a file.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// Compiled code.
    pub(super) code: bool,
    /// Its world as WIT.
    pub(super) description: bool,
    /// Whether the code is for a backtrace worker.
    pub(super) backtraces: bool,
}

/// Everything that a compile worker reported about a file.
pub(super) struct Findings {
    pub(super) examined: Examined,
    /// The code, when wanted and there.
    pub(super) code: Option<CompiledCode>,
}

/// Starts compile workers.
pub(super) struct Compiler<'a> {
    pub(super) starter: &'a Starter,
    pub(super) limits: &'a Limits,
}

impl Compiler<'_> {
    /// Has a worker look at the file and compile it, and writes the code to the
    /// destination.
    ///
    /// # Errors
    ///
    /// When the host fails: no process, no room for the code. A file whose worker crashes or
    /// takes too much is rejected.
    pub(super) fn examine(
        &self,
        file: &[u8],
        wanted: Wanted,
        destination: &dyn Fn() -> io::Result<Destination>,
    ) -> Result<Result<Findings, Rejection>, InfrastructureError> {
        let mut tries = 0;
        loop {
            tries += 1;
            let mut process = Process::start(self.starter, Role::Compile)?;
            // Whether the worker had begun with the file.
            let mut begun = false;
            let limit = Limit::wall(COMPILE_TIME_MAX);
            let attempt = process.exchange(limit, |talk| {
                self.attempt(talk, file, wanted, destination, &mut begun)
            });
            let exit = match attempt {
                Ok(findings) => return findings.map(Ok),
                Err(error) => process.reap(&error),
            };
            if exit.killed == Some(Kill::Cancelled) {
                return Err(InfrastructureError::Cancelled);
            }
            if !begun && tries == TRIES {
                return Err(InfrastructureError::Worker {
                    role: Role::Compile.name(),
                    reason: exit.to_string(),
                });
            }
            // Being killed from outside says nothing about the file, unless it goes on.
            if begun && (tries == TRIES || !exit.is_kill()) {
                return rejection(&exit).map(Err);
            }
        }
    }

    /// The outer error is one of the worker or the pipe to it, the inner one is not about the
    /// file at all.
    fn attempt(
        &self,
        talk: &mut Talk<'_>,
        file: &[u8],
        wanted: Wanted,
        destination: &dyn Fn() -> io::Result<Destination>,
        begun: &mut bool,
    ) -> io::Result<Result<Findings, InfrastructureError>> {
        let (sandbox, examined) = self.ask(talk, file, wanted, begun)?;
        if let Err(error) = self.starter.check(sandbox) {
            return Ok(Err(error));
        }
        match receive_code(talk, &examined, destination) {
            Ok(code) => Ok(Ok(Findings { examined, code })),
            Err(Broken::Pipe(error)) => Err(error),
            Err(Broken::Destination(error)) => {
                Ok(Err(InfrastructureError::Store(error.to_string())))
            }
        }
    }

    fn ask(
        &self,
        talk: &mut Talk<'_>,
        file: &[u8],
        wanted: Wanted,
        begun: &mut bool,
    ) -> io::Result<(SandboxStatus, Examined)> {
        talk.send(&CompileOrder {
            limits: *self.limits,
            length: u64::try_from(file.len()).unwrap_or(u64::MAX),
            compile: wanted.code,
            describe: wanted.description,
            backtraces: wanted.backtraces,
        })?;
        talk.writer().write_all(file)?;
        talk.flush()?;
        let sandbox = talk.greet()?;
        *begun = true;
        Ok((sandbox, talk.receive()?))
    }
}

/// Which end of the transfer broke.
enum Broken {
    Pipe(io::Error),
    Destination(io::Error),
}

/// The code that the worker announced, if any.
fn receive_code(
    talk: &mut Talk<'_>,
    examined: &Examined,
    destination: &dyn Fn() -> io::Result<Destination>,
) -> Result<Option<CompiledCode>, Broken> {
    let Compiled::Code { length, digest } = &examined.result else {
        return Ok(None);
    };
    if *length > CODE_BYTES_MAX {
        let error = io::Error::other(format!("the compiled code has {length} bytes"));
        return Err(Broken::Pipe(error));
    }
    let mut to = destination().map_err(Broken::Destination)?;
    let mut left = *length;
    while left > 0 {
        let chunk = talk.reader().fill_buf().map_err(Broken::Pipe)?;
        if chunk.is_empty() {
            return Err(Broken::Pipe(io::ErrorKind::UnexpectedEof.into()));
        }
        let taken = chunk.len().min(usize::try_from(left).unwrap_or(usize::MAX));
        to.write(&chunk[..taken]).map_err(Broken::Destination)?;
        talk.reader().consume(taken);
        left -= taken as u64;
    }
    let code = to.finish(digest).map_err(Broken::Destination)?;
    let differs = || Broken::Pipe(io::Error::other("the code does not match its digest"));
    code.map(Some).ok_or_else(differs)
}

/// The rejection of a file that its compile worker did not survive.
///
/// # Errors
///
/// When the worker ended for a reason that need not be the file's: somebody killed it, it stood
/// still, or the host allows less memory or processor time than a compile worker may use.
fn rejection(exit: &WorkerExit) -> Result<Rejection, InfrastructureError> {
    let is_out_of_memory = exit.is_out_of_memory();
    let is_out_of_time = exit.is_out_of_processor_time();
    let reason = if is_out_of_time && allows_processor_time(COMPILE_CPU_SECONDS) {
        format!("takes more than {COMPILE_CPU_SECONDS} {OUT_OF_PROCESSOR_TIME}")
    } else if is_out_of_memory && can_provide(COMPILE_MEMORY_BYTES) {
        let megabytes = COMPILE_MEMORY_BYTES >> 20;
        format!("takes more than {megabytes} MiB of memory")
    } else if !is_out_of_time && !is_out_of_memory && (exit.is_crash() || exit.is_panic()) {
        format!("crashes the compiler ({exit})")
    } else {
        return Err(InfrastructureError::Worker {
            role: Role::Compile.name(),
            reason: exit.to_string(),
        });
    };
    Ok(Rejection::Uncompilable(reason.into()))
}
