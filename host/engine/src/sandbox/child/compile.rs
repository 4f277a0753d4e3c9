//! The compile worker: examines and compiles one file.

use std::io::{self, Write as _};

use wasmouse_core::Digest;
use wasmtime::Engine;

use super::super::protocol::{self, CompileOrder, Compiled, Examined, Hello};
use super::super::role::{Role, SandboxStatus};
use super::pipes::{Pipes, read_exactly};
use super::privileges;
use super::setup::sandboxed;
use crate::admission::{examine, world};
use crate::error::InfrastructureError;
use crate::limits::{COMPILE_THREADS, Limits};
use crate::runtime::{AdmissionError, new_backtrace_compiler, new_compiler, precompile};

/// Stack of the threads that read and compile: nested things recurse.
pub(super) const STACK_BYTES: usize = 16 << 20;

/// Compiles the file on standard input and exits.
///
/// # Errors
///
/// When the pipes break or the machine cannot compile.
pub fn main() -> io::Result<()> {
    privileges::close_inherited();
    privileges::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(order) = protocol::read::<CompileOrder>(&mut pipes.from)? else {
        return Ok(());
    };
    let file = read_exactly(&mut pipes.from, order.length)?;
    let limits = order.limits;
    let is_for_backtraces = order.backtraces;
    let engine = move || match is_for_backtraces {
        true => new_backtrace_compiler(&limits),
        false => new_compiler(&limits),
    };
    enter_with(engine, move |engine, sandbox| {
        let build = protocol::build();
        protocol::write(&mut pipes.to, &Hello { build, sandbox })?;
        // The supervisor then knows that the worker had begun, whatever happens next.
        pipes.to.flush()?;
        let (examined, code) = compile(engine, &file, &order)?;
        protocol::write(&mut pipes.to, &examined)?;
        pipes.to.write_all(&code)?;
        pipes.to.flush()
    })
}

/// Sandboxes this process and then works on a thread with a large stack. The process can
/// compile afterwards, and not much more.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(limits: &Limits, work: W) -> io::Result<()>
where
    W: FnOnce(&Engine, SandboxStatus) -> io::Result<()> + Send + 'static,
{
    enter_with(|| new_compiler(limits), work)
}

/// [`enter`] with an engine that is made before this process is sandboxed.
fn enter_with<W>(
    engine: impl FnOnce() -> Result<Engine, InfrastructureError>,
    work: W,
) -> io::Result<()>
where
    W: FnOnce(&Engine, SandboxStatus) -> io::Result<()> + Send + 'static,
{
    privileges::set_limits(Role::Compile);
    let isolation = privileges::isolate()?;
    let failed = |error: InfrastructureError| io::Error::other(error.to_string());
    let engine = engine().map_err(failed)?;
    sandboxed(
        (Role::Compile, isolation),
        STACK_BYTES,
        start_compilers,
        move |sandbox| work(&engine, sandbox),
    )
}

/// Starts the threads that wasmtime compiles on.
pub(super) fn start_compilers() -> io::Result<()> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(COMPILE_THREADS)
        .stack_size(STACK_BYTES)
        .build_global()
        .map_err(io::Error::other)
}

/// What the file is, and its compiled code where that was wanted and can be had.
///
/// # Errors
///
/// When the host cannot compile it.
fn compile(engine: &Engine, file: &[u8], order: &CompileOrder) -> io::Result<(Examined, Vec<u8>)> {
    let examination = examine(file, &order.limits);
    let mut examined = Examined {
        kind: examination.kind,
        shape: examination.shape,
        wit: None,
        result: Compiled::NotWanted,
    };
    let mut code = Vec::new();
    let compile = || {
        let component = examination.component?;
        if order.describe {
            examined.wit = world(&component);
        }
        if order.compile {
            code = precompile(engine, &component).map_err(AdmissionError::of_engine)?;
        }
        Ok(())
    };
    match compile() {
        Err(AdmissionError::Host(error)) => return Err(io::Error::other(error)),
        Err(AdmissionError::Rejected(rejection)) => {
            examined.result = Compiled::Rejected(rejection.into())
        }
        Ok(()) if order.compile => {
            examined.result = Compiled::Code {
                length: u64::try_from(code.len()).unwrap_or(u64::MAX),
                digest: Digest::of(&code),
            };
        }
        Ok(()) => {}
    }
    Ok((examined, code))
}
