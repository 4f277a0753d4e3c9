//! The worker that plays one match again to say where the robot fails: [`main`].

use std::io::{self, Write as _};

use super::begin::confined;
use super::compile::{STACK_BYTES, start_compilers};
use super::confine::{self, Role};
use super::matches::read_exactly;
use super::pipes::Pipes;
use super::wire::{self, ExplainOrder, Explained, Hello, Sandbox};
use crate::maze::Maze;
use crate::robot::{Game, Host, HostError, Recorder, Verdict};
use crate::sim::Limits;

/// Plays the match on standard input and ends.
///
/// # Errors
///
/// When the pipes break or the machine cannot run robots.
pub fn main() -> io::Result<()> {
    confine::close_inherited();
    confine::die_with_parent();
    let mut pipes = Pipes::standard()?;
    let Some(order) = wire::read::<ExplainOrder>(&mut pipes.from)? else {
        return Ok(());
    };
    let file = read_exactly(&mut pipes.from, order.length)?;
    enter(&order.rules.limits.clone(), move |host, sandbox| {
        let build = wire::build();
        wire::write(&mut pipes.to, &Hello { build, sandbox })?;
        wire::write(&mut pipes.to, &explain(host, &file, &order)?)?;
        pipes.to.flush()
    })
}

/// Confines this process and then works on a thread with a large stack.
///
/// # Errors
///
/// When the machine gives no engine or no threads, or the work fails.
pub fn enter<W>(limits: &Limits, work: W) -> io::Result<()>
where
    W: FnOnce(&Host, Sandbox) -> io::Result<()> + Send + 'static,
{
    confine::set_limits(Role::Explain);
    let failed = |error: HostError| io::Error::other(error.to_string());
    let host = Host::explaining(*limits).map_err(failed)?;
    let clock = host.clock();
    let threads = move || {
        start_compilers()?;
        clock.start().map_err(failed)
    };
    confined(Role::Explain, STACK_BYTES, threads, move |sandbox| {
        work(&host, sandbox)
    })
}

fn explain(host: &Host, file: &[u8], order: &ExplainOrder) -> io::Result<Explained> {
    let maze = Maze::from_identity_bytes(&order.maze);
    let maze = maze.ok_or_else(|| io::Error::other("the maze cannot be read"))?;
    let Ok(robot) = host.admit(file) else {
        return Ok(Explained { fault: None });
    };
    let game = Game {
        maze: &maze,
        rules: &order.rules,
        seed: order.seed,
        setting: order.setting,
    };
    let mut recorder = Recorder::default();
    let fault = match host.play(&robot, &game, &mut recorder) {
        Ok(outcome) => match outcome.verdict {
            Verdict::Fault(fault) => Some((fault.kind, recorder.frames)),
            Verdict::Finished(_) | Verdict::BudgetUsedUp { .. } => None,
        },
        Err(_) => None,
    };
    Ok(Explained { fault })
}
