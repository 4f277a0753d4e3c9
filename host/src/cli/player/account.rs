//! What happens in a match, in words.

use wasmouse_core::game::{Action, BudgetScope, Event, Sensors, Step, Verdict};
use wasmouse_core::maze::Turn;
use wasmouse_core::playback::{MilestoneKind, Playback};
use wasmouse_core::{GuestText, guest_text};

/// What the step that led to a position did: `speed run, step 212: sensors 4 0 1, turned left, drove
/// 3`. The readings are those before the step.
pub fn step_of(playback: &Playback, position: usize) -> String {
    let position = position.min(playback.last());
    let Some(step) = position
        .checked_sub(1)
        .and_then(|index| playback.trace().steps().get(index))
    else {
        let readings = readings(playback.at(0).sensors);
        return format!("before the first step: {readings}");
    };
    let (run, readings, action) = (step.run.name(), readings(step.sensors), step_in_words(step));
    let mut text = format!("{run}, step {position}: {readings}, {action}");
    for milestone in playback.milestones() {
        if milestone.position == position {
            match milestone.kind {
                MilestoneKind::GoalReached => text.push_str("; the goal is reached"),
                MilestoneKind::Certain => text.push_str("; the best path is certain from here"),
                // The action says it.
                MilestoneKind::Reset
                | MilestoneKind::IgnoredReset
                | MilestoneKind::Bump
                | MilestoneKind::Clamp
                | MilestoneKind::End => {}
            }
        }
    }
    text
}

fn readings(sensors: Sensors) -> String {
    let (left, front, right) = (sensors.left, sensors.front, sensors.right);
    format!("sensors {left} {front} {right}")
}

/// What a step did: `turned left, drove 3`.
pub fn step_in_words(step: &Step) -> String {
    match (step.action, step.event) {
        (
            Action::Move { turn, advance },
            Event::Moved {
                cells,
                bumped,
                clamped,
                ..
            },
        ) => {
            let turned = match turn {
                Turn::Left => "turned left, ",
                Turn::Straight => "",
                Turn::Right => "turned right, ",
            };
            let drove = match (advance, cells) {
                (0, _) => "stayed".to_owned(),
                (..0, cells) => format!("drove back {cells}"),
                (_, cells) => format!("drove {cells}"),
            };
            let wanted = format!(" of {}", advance.unsigned_abs());
            let wanted = if bumped || clamped {
                wanted.as_str()
            } else {
                ""
            };
            let why = match (bumped, clamped) {
                (true, _) => ", stopped by a wall",
                (false, true) => ", as far as a step may go",
                (false, false) => "",
            };
            format!("{turned}{drove}{wanted}{why}")
        }
        (_, Event::Reset) => "reset; the speed run begins".to_owned(),
        (_, Event::ResetBeforeGoal) => "reset ignored: the goal was not reached yet".to_owned(),
        (_, Event::ResetInSpeedRun) => "reset ignored: this is the speed run".to_owned(),
        (Action::Reset, Event::Moved { .. }) => "reset".to_owned(),
    }
}

/// What a robot wants to do in a step: `turn left, drive 3`.
pub fn action_in_words(action: Action) -> String {
    let Action::Move { turn, advance } = action else {
        return "reset".to_owned();
    };
    let turn = match turn {
        Turn::Left => "turn left, ",
        Turn::Straight => "",
        Turn::Right => "turn right, ",
    };
    let cells = advance.unsigned_abs();
    match advance {
        0 => format!("{turn}stay"),
        ..0 => format!("{turn}drive back {cells}"),
        _ => format!("{turn}drive {cells}"),
    }
}

/// How the match stands at a position: `212 of 1000 steps used; goal reached in step 57; best path
/// certain since step 140`. At the end, how it ended.
pub fn standing(playback: &Playback, position: usize) -> GuestText {
    let position = position.min(playback.last());
    let mut text = GuestText::new();
    if position == playback.last() {
        text.push(&ending(playback));
        text.push("; ");
    }
    let mut parts = Vec::new();
    if playback.verdict().score().is_none() || position < playback.last() {
        parts.push(used(playback, position));
    }
    let goal = first(playback, position, MilestoneKind::GoalReached);
    let ignored = match count(playback, position, MilestoneKind::IgnoredReset) {
        0 => String::new(),
        1 => "1 reset ignored".to_owned(),
        count => format!("{count} resets ignored"),
    };
    match (ignored.is_empty(), goal) {
        (true, None) => parts.push("goal not reached".to_owned()),
        (false, None) => parts.push(format!("{ignored}: goal not reached")),
        (is_empty, Some(step)) => {
            if !is_empty {
                parts.push(ignored);
            }
            if position < playback.last() {
                parts.push(format!("goal reached in step {step}"));
            }
        }
    }
    parts.push(certainty(playback, position));
    text.push(&parts.join("; "));
    text
}

fn ending(playback: &Playback) -> GuestText {
    match playback.verdict() {
        Verdict::Finished { score } => {
            let (speed, exploration) = (score.speed_steps(), score.exploration_steps());
            let divisor = score.divisor();
            let regret = playback.audit().regret.map_or_else(String::new, |regret| {
                let (exploration, speed) = (regret.exploration_steps, regret.speed_steps);
                format!("; regret: {speed} steps of the speed run, {exploration} of exploration")
            });
            format!("finished, score {score} = {speed} + {exploration}/{divisor}{regret}").into()
        }
        Verdict::BudgetUsedUp { .. } => "budget used up".into(),
        Verdict::Fault { fault } => guest_text!("fault: {}", fault.describe()),
    }
}

fn used(playback: &Playback, position: usize) -> String {
    let at = playback.at(position);
    let budget = playback.rules().budget;
    match playback.rules().budget_scope {
        BudgetScope::BothRuns => format!("{} of {budget} steps used", at.steps.total()),
        BudgetScope::EachRun => {
            let (run, steps) = (at.run.name(), at.steps.of(at.run));
            format!("{steps} of {budget} steps of the {run} used")
        }
    }
}

/// What is known about the best path; at the end, what was known when the speed run began.
fn certainty(playback: &Playback, position: usize) -> String {
    let audit = playback.audit();
    if let (true, Some(outlook)) = (position == playback.last(), audit.at_reset) {
        return match outlook.might_save() {
            Some(0) => "the best path was certain at the reset".to_owned(),
            Some(1) => "at the reset, 1 step might still have been saved".to_owned(),
            Some(steps) => format!("at the reset, {steps} steps might still have been saved"),
            None => "no path was known at the reset".to_owned(),
        };
    }
    if let Some(step) = audit.certain_at.filter(|&step| step <= position) {
        return format!("best path certain since step {step}");
    }
    let outlook = audit.steps.get(position).map(|it| it.outlook);
    let bounds = outlook.map(|it| (it.optimistic, it.pessimistic));
    match bounds {
        Some((Some(best), Some(known))) => {
            format!("best known path {known} steps, perhaps {best}")
        }
        Some((Some(best), None)) => format!("no path known, at least {best} steps"),
        Some((None, _)) => "the goal cannot be reached".to_owned(),
        None => String::new(),
    }
}

fn count(playback: &Playback, position: usize, kind: MilestoneKind) -> usize {
    let until = playback.milestones().iter();
    until
        .take_while(|it| it.position <= position)
        .filter(|it| it.kind == kind)
        .count()
}

fn first(playback: &Playback, position: usize, kind: MilestoneKind) -> Option<usize> {
    let found = playback.milestones().iter().find(|it| it.kind == kind);
    found.map(|it| it.position).filter(|&it| it <= position)
}

#[cfg(test)]
mod tests {
    use super::super::show::tests::{explorer, hostile, lost};
    use super::*;

    fn lines_at(playback: &Playback, at: usize) -> String {
        let (step, standing) = (step_of(playback, at), standing(playback, at));
        format!("{step}\n  {}", standing.escaped())
    }

    #[test]
    fn a_finished_match_in_words() {
        let playback = explorer().playback;
        let goal = first(&playback, usize::MAX, MilestoneKind::GoalReached).expect("reached");
        let reset = first(&playback, usize::MAX, MilestoneKind::Reset).expect("a reset");
        let positions = [0, 1, 2, goal, reset, playback.last()];
        let lines: Vec<String> = positions
            .iter()
            .map(|&at| lines_at(&playback, at))
            .collect();
        insta::assert_snapshot!("finished", lines.join("\n"));
    }

    #[test]
    fn an_unfinished_match_in_words() {
        let playback = lost().playback;
        let last = playback.last();
        let lines: Vec<String> = [1, 2, 3, 4, 5, last - 1, last]
            .iter()
            .map(|&at| lines_at(&playback, at))
            .collect();
        insta::assert_snapshot!("unfinished", lines.join("\n"));
    }

    #[test]
    fn a_fault_in_words() {
        let playback = hostile().playback;
        let text = standing(&playback, playback.last());
        assert!(text.as_guest().starts_with("fault: "), "{text:?}");
    }
}
