//! The backtrace worker: plays one match again to find out where the robot fails.

use std::io::{self, Write as _};
use std::sync::Arc;

use wasmouse_core::Digest;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{MatchKey, MatchSpec};

use super::super::protocol::{self, Backtrace, BacktraceOrder, Hello};
use super::super::role::{Role, SandboxStatus};
use super::compile::{STACK_BYTES, start_compilers};
use super::pipes::{Pipes, read_exactly};
use super::privileges;
use super::setup::sandboxed;
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::runner::Recording;
use crate::runtime::{Runtime, engine_id};

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
    enter(&order.limits.clone(), move |runtime, sandbox| {
        let build = protocol::build();
        protocol::write(&mut pipes.to, &Hello { build, sandbox })?;
        protocol::write(&mut pipes.to, &backtrace(runtime, &file, &order)?)?;
        pipes.to.flush()
    })
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
    privileges::set_limits(Role::Backtrace);
    let isolation = privileges::isolate()?;
    let failed = |error: InfrastructureError| io::Error::other(error.to_string());
    let runtime = Runtime::for_backtraces(*limits).map_err(failed)?;
    let clock = runtime.clock();
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

fn backtrace(runtime: &Runtime, file: &[u8], order: &BacktraceOrder) -> io::Result<Backtrace> {
    let maze = Maze::from_identity_bytes(&order.maze);
    let maze = maze.ok_or_else(|| io::Error::other("the maze cannot be read"))?;
    let Ok(robot) = runtime.admit(file) else {
        return Ok(Backtrace { fault: None });
    };
    let spec = MatchSpec {
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
