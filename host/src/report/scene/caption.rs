//! What a match has come to at a position, in a few words.

use wasmouse_core::game::{Run, Verdict};
use wasmouse_core::playback::Playback;

/// `exploration run, step 12 of 127`, or at the end `score 20.667 (110 + 17 steps)`.
pub(super) fn step(playback: &Playback, position: usize) -> String {
    let last = playback.last();
    if position >= last {
        return ending(playback);
    }
    let run = match playback.at(position).run {
        Run::Exploration => "exploration run",
        Run::Speed => "speed run",
    };
    format!("{run}, step {position} of {last}")
}

/// How the match ended.
pub(super) fn ending(playback: &Playback) -> String {
    let steps = playback.at(playback.last()).steps;
    let parts = format!("{} + {} steps", steps.exploration, steps.speed);
    match playback.verdict() {
        Verdict::Finished { score } => format!("score {score} ({parts})"),
        verdict => format!("{} ({parts})", verdict.title()),
    }
}
