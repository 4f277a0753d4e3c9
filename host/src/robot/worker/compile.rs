//! The worker that compiles one file: [`main`].

use std::io::{self, Write as _};

use wasmtime::Engine;

use super::begin::confined;
use super::confine::{self, Role};
use super::matches::read_exactly;
use super::pipes::Pipes;
use super::wire::{self, CompileOrder, Compiled, Examined, Hello, Sandbox};
use crate::robot::componentize::BinaryKind;
use crate::robot::{Digest, HostError, Refusal, admission, engine, inspection};
use crate::sim::Limits;

/// Stack of the threads that read and compile: nested things recurse.
pub(super) const STACK_BYTES: usize = 16 << 20;

/// Compiles the file on standard input and ends.
///
/// # Errors
///
/// When the pipes break or the machine cannot compile.
pub fn main() -> io::Result<()> {
    confine::close_inherited();
    confine::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(order) = wire::read::<CompileOrder>(&mut pipes.from)? else {
        return Ok(());
    };
    let file = read_exactly(&mut pipes.from, order.length)?;
    enter(&order.limits.clone(), move |engine, sandbox| {
        let build = wire::build();
        wire::write(&mut pipes.to, &Hello { build, sandbox })?;
        // So that the supervisor knows how far it came, whatever happens next.
        pipes.to.flush()?;
        let (examined, code) = examine(engine, &file, &order);
        wire::write(&mut pipes.to, &examined)?;
        pipes.to.write_all(&code)?;
        pipes.to.flush()
    })
}

/// Confines this process and then works on a thread with a large stack. The process
/// can compile afterwards, and not much more.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(limits: &Limits, work: W) -> io::Result<()>
where
    W: FnOnce(&Engine, Sandbox) -> io::Result<()> + Send + 'static,
{
    confine::set_limits(Role::Compile);
    let failed = |error: HostError| io::Error::other(error.to_string());
    let engine = engine::new_compiler(limits).map_err(failed)?;
    confined(
        Role::Compile,
        STACK_BYTES,
        start_compilers,
        move |sandbox| work(&engine, sandbox),
    )
}

/// Starts the threads that wasmtime compiles on.
pub(super) fn start_compilers() -> io::Result<()> {
    rayon::ThreadPoolBuilder::new()
        .stack_size(STACK_BYTES)
        .build_global()
        .map_err(io::Error::other)
}

/// What the file is, and its compiled code where that was wanted and can be had.
fn examine(engine: &Engine, file: &[u8], order: &CompileOrder) -> (Examined, Vec<u8>) {
    let mut examined = Examined {
        kind: None,
        shape: None,
        wit: None,
        result: Compiled::NotWanted,
    };
    let read = match admission::read(file, &order.limits) {
        Ok(read) => read,
        Err(refusal) => {
            examined.kind = known_kind(file);
            examined.result = Compiled::Refused(refusal.into());
            return (examined, Vec::new());
        }
    };
    examined.kind = Some(read.kind);
    if order.describe {
        examined.wit = inspection::world(&read.bytes);
    }
    let names = admission::check_names(&read.shape);
    examined.shape = Some(read.shape);
    if let Err(refusal) = names {
        examined.result = Compiled::Refused(refusal.into());
        return (examined, Vec::new());
    }
    if !order.compile {
        return (examined, Vec::new());
    }
    match compile(engine, &read.bytes) {
        Ok(code) => {
            examined.result = Compiled::Code {
                length: u64::try_from(code.len()).unwrap_or(u64::MAX),
                digest: Digest::of(&code),
            };
            (examined, code)
        }
        Err(refusal) => {
            examined.result = Compiled::Refused(refusal.into());
            (examined, Vec::new())
        }
    }
}

fn compile(engine: &Engine, component: &[u8]) -> Result<Vec<u8>, Refusal> {
    engine
        .precompile_component(component)
        .map_err(|error| Refusal::Invalid(format!("{error:#}")))
}

fn known_kind(file: &[u8]) -> Option<BinaryKind> {
    match BinaryKind::of(file) {
        BinaryKind::Other => None,
        kind => Some(kind),
    }
}
