//! Playing a plan with a progress bar, for every command that plays.

use std::time::Duration;

use wasmouse_core::record::MatchKey;
use wasmouse_engine::Executor;

use super::bar;
use super::failure::Failure;
use super::interrupt;
use crate::contest::{self, Options, Plan, RunError, Sink};

/// How a plan is played.
#[derive(Clone, Copy)]
pub struct Pace {
    /// Threads.
    pub jobs: usize,
    /// Processor time of each robot; `None` is the default.
    pub robot_time: Option<Duration>,
}

/// Plays the matches of a plan that are wanted, `total` of them, with a progress bar on a
/// terminal. A signal ends it early.
///
/// # Errors
///
/// When the host fails or the sink does.
pub fn play(
    plan: &Plan,
    executor: &dyn Executor,
    pace: Pace,
    (wanted, total): (&(dyn Fn(&MatchKey) -> bool + Sync), u64),
    sink: &mut dyn Sink,
) -> Result<(), Failure> {
    let cancelled = interrupt::listen()?.as_atomic();
    let bar = bar::new(total, bar::matches(""));
    let options = Options {
        jobs: pace.jobs,
        cancelled,
        wanted,
        ended: &|_, _| {
            bar.inc(1);
            Ok(())
        },
        robot_time: pace.robot_time,
    };
    let played = contest::run(plan, executor, &options, sink);
    bar.finish_and_clear();
    played.map_err(|error| failure(&error))
}

/// The failure of a contest that did not come to its end.
pub fn failure(error: &RunError) -> Failure {
    match error {
        RunError::Thread(_) => {
            Failure::internal(error).hint("raise the limits of this process on memory and threads")
        }
        RunError::Sink(_) => Failure::internal(error),
    }
}

/// Plays all matches of a plan.
///
/// # Errors
///
/// As [`play`].
pub fn play_all(
    plan: &Plan,
    executor: &dyn Executor,
    pace: Pace,
    sink: &mut dyn Sink,
) -> Result<(), Failure> {
    play(plan, executor, pace, (&|_| true, plan.matches()), sink)
}

/// Whether a signal asked to end.
///
/// # Errors
///
/// When the signal cannot be handled.
pub fn is_interrupted() -> Result<bool, Failure> {
    Ok(interrupt::listen()?.is_set())
}
