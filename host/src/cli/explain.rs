//! Where in its code a robot failed, for the person who wrote it.
//!
//! Matches do not gather this, because it costs; the first failing match of a robot is
//! played again for it, away from the contest.

use super::failure::Failure;
use super::robots::Specification;
use crate::contest::{Contest, MatchResult};
use crate::report::visible;
use crate::robot::{Digest, FaultKind, Frame, Referee, Verdict};

/// Robots that are explained: each is compiled once more.
const ROBOTS_MAX: usize = 5;

/// Tells on standard error where the robots were in their code when they failed first.
/// The specifications are those of the contest's entrants, in order.
///
/// # Errors
///
/// When the host fails.
pub fn tell(
    contest: &Contest,
    referee: &Referee,
    specifications: &[Specification],
    results: &[MatchResult],
) -> Result<(), Failure> {
    let mut last = None;
    let first_faults = results.iter().filter(|result| {
        matches!(result.outcome.verdict, Verdict::Fault(_))
            && last.replace(result.entrant) != Some(result.entrant)
    });
    for result in first_faults.take(ROBOTS_MAX) {
        let entrant = &contest.entrants[result.entrant];
        let (Verdict::Fault(fault), Ok(player)) = (&result.outcome.verdict, &entrant.admission)
        else {
            continue;
        };
        if fault.kind == FaultKind::Crash {
            continue;
        }
        let max = contest.rules.limits.component_bytes_max;
        // The verdict stands without an explanation.
        let Ok(bytes) = specifications[result.entrant].read(max) else {
            continue;
        };
        if Digest::of(&bytes) != entrant.digest {
            continue;
        }
        let game = contest.game_of(result);
        let explained = referee.explain(player, &bytes, &game, fault);
        if let Some(frames) = explained.map_err(Failure::host)?
            && !frames.is_empty()
        {
            tell_frames(&entrant.name, &frames);
        }
    }
    Ok(())
}

fn tell_frames(robot: &str, frames: &[Frame]) {
    let mut lines = format!("`{}` was here, the innermost call first:", visible(robot));
    let shown = Frame::of_robot(frames);
    for (depth, frame) in shown.iter().enumerate() {
        let function = visible(&frame.function);
        lines.push_str(&format!("\n  {depth:>2}: {function}"));
        if let Some(source) = &frame.source {
            lines.push_str(&format!(" at {}", visible(source)));
        } else if let Some(offset) = frame.offset {
            lines.push_str(&format!(" (byte {offset} of its module)"));
        }
    }
    match frames.len() - shown.len() {
        0 => {}
        1 => lines.push_str("\n  (1 frame of the Rust runtime hidden)"),
        hidden => lines.push_str(&format!("\n  ({hidden} frames of the Rust runtime hidden)")),
    }
    tell!("{lines}");
}
