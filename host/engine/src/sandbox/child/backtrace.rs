//! The backtrace worker: plays one match again to find out where the robot fails.

use std::io::{self, Write as _};
use std::sync::Arc;
use std::time::Duration;

use wasmouse_core::Digest;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{MatchKey, MatchSpec};

use super::super::protocol::{self, Backtrace, BacktraceOrder, Hello, Profiled};
use super::super::role::{Role, SandboxStatus};
use super::compile::{STACK_BYTES, start_compilers};
use super::pipes::{Pipes, read_exactly};
use super::privileges;
use super::setup::sandboxed;
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::profile::{Expected, Profiler};
use crate::runner::Recording;
use crate::runtime::{Clock, Runtime, engine_id};
use crate::time::{Control, MatchClock};

/// Plays the match on standard input and exits.
///
/// # Errors
///
/// When the pipes break or the machine cannot run robots.
pub fn main() -> io::Result<()> {
    privileges::close_inherited();
    privileges::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(order) = protocol::read::<BacktraceOrder>(&mut pipes.from)? else {
        return Ok(());
    };
    let file = read_exactly(&mut pipes.from, order.length)?;
    let limits = order.limits;
    match order.profile.clone() {
        None => enter_with(
            || backtraces(limits),
            move |runtime, sandbox| {
                let build = protocol::build();
                protocol::write(&mut pipes.to, &Hello { build, sandbox })?;
                protocol::write(&mut pipes.to, &backtrace(runtime, &file, &order)?)?;
                pipes.to.flush()
            },
        ),
        Some(expected) => enter_with(
            || {
                let profiler = Profiler::new(limits)?;
                Ok((profiler.clock(), profiler))
            },
            move |profiler, sandbox| {
                let build = protocol::build();
                protocol::write(&mut pipes.to, &Hello { build, sandbox })?;
                let profiled = profile(profiler, &file, &order, expected)?;
                protocol::write(&mut pipes.to, &profiled)?;
                pipes.to.flush()
            },
        ),
    }
}

/// Sandboxes this process and then works on a thread with a large stack.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(limits: &Limits, work: W) -> io::Result<()>
where
    W: FnOnce(&Runtime, SandboxStatus) -> io::Result<()> + Send + 'static,
{
    enter_with(|| backtraces(*limits), work)
}

/// A runtime for backtraces, and its clock.
fn backtraces(limits: Limits) -> Result<(Clock, Runtime), InfrastructureError> {
    let runtime = Runtime::for_backtraces(limits)?;
    Ok((runtime.clock(), runtime))
}

/// [`enter`] with something that is made before this process is sandboxed.
fn enter_with<R: Send + 'static>(
    new: impl FnOnce() -> Result<(Clock, R), InfrastructureError>,
    work: impl FnOnce(&R, SandboxStatus) -> io::Result<()> + Send + 'static,
) -> io::Result<()> {
    privileges::set_limits(Role::Backtrace);
    let isolation = privileges::isolate()?;
    let failed = |error: InfrastructureError| io::Error::other(error.to_string());
    let (clock, runtime) = new().map_err(failed)?;
    let threads = move || {
        start_compilers()?;
        clock.start().map_err(failed)
    };
    sandboxed(
        (Role::Backtrace, isolation),
        STACK_BYTES,
        threads,
        move |sandbox| work(&runtime, sandbox),
    )
}

fn spec(file: &[u8], order: &BacktraceOrder) -> io::Result<MatchSpec> {
    let maze = Maze::from_identity_bytes(&order.maze);
    let maze = maze.ok_or_else(|| io::Error::other("the maze cannot be read"))?;
    Ok(MatchSpec {
        key: MatchKey {
            engine: engine_id().digest(),
            rules: order.rules.digest(),
            robot: Digest::of(file),
            variant: order.variant,
            maze: maze.digest(),
            seed: order.seed,
        },
        maze: Arc::new(maze),
        rules: Arc::new(order.rules.clone()),
    })
}

fn profile(
    profiler: &Profiler,
    file: &[u8],
    order: &BacktraceOrder,
    expected: Expected,
) -> io::Result<Profiled> {
    // The supervisor watches the time.
    let control = Control {
        match_time: Duration::MAX,
        ..Control::default()
    };
    let clock = MatchClock::start(control, None);
    let profile = profiler.profile(file, &spec(file, order)?, expected, &clock);
    let profile = profile.map_err(|error| error.to_string());
    Ok(Profiled { profile })
}

fn backtrace(runtime: &Runtime, file: &[u8], order: &BacktraceOrder) -> io::Result<Backtrace> {
    let spec = spec(file, order)?;
    let Ok(robot) = runtime.admit(file) else {
        return Ok(Backtrace { fault: None });
    };
    let mut recording = Recording::default();
    let fault = match runtime.run(&robot, &spec, &mut recording) {
        Ok((result, _)) => result.verdict.fault().map(|fault| fault.kind),
        Err(_) => None,
    };
    Ok(Backtrace {
        fault: fault.map(|kind| (kind, recording.frames)),
    })
}
