//! What `wasmouse build` says about a component: what it holds and what it costs, beside the
//! limits.

use std::time::Duration;

use wasmouse_core::GuestText;
use wasmouse_core::game::{FuelClass, Verdict};
use wasmouse_core::record::MatchRecord;

use super::number::grouped;
use super::text::{Text, text};

/// Steps of a match for which the class of a robot is estimated: the budget of all bundled rules.
pub const CLASS_STEPS: u64 = 1000;

/// A match that was played to see what it costs.
#[derive(Debug)]
pub struct SampleMatch {
    /// What the maze is called.
    pub maze: GuestText,
    /// What came of it.
    pub record: MatchRecord,
    /// Processor time; includes what the host does.
    pub time: Duration,
}

/// The lines about a file and what it imports.
pub fn component(path: &Text, bytes: usize, bytes_max: u64, imports: &[String]) -> Text {
    let imports = match imports {
        [] => "nothing".to_owned(),
        imports => imports.join(", "),
    };
    text!(
        "{}\n  size     {} bytes (limit {})\n  imports  {}\n",
        path,
        grouped(u64::try_from(bytes).unwrap_or(u64::MAX)),
        grouped(bytes_max),
        imports
    )
}

/// The lines about sample matches: how they ended, their fuel beside the limits of both classes,
/// and the class that the robot needs. At least one match.
pub fn samples(samples: &[SampleMatch]) -> Text {
    let mut lines = Text::default();
    for SampleMatch { maze, record, time } in samples {
        lines = text!(
            "{}  match    {}: {}, {} ms\n",
            lines,
            maze.escaped(),
            ending(record),
            format!("{:.1}", time.as_secs_f64() * 1e3)
        );
    }
    let most = |of: fn(&MatchRecord) -> u64| samples.iter().map(|it| of(&it.record)).max();
    let start = most(|it| it.fuel.start).unwrap_or(0);
    let step = most(|it| it.fuel.step_max).unwrap_or(0);
    let limits = FuelClass::Compiled.limits();
    lines = text!(
        "{}  fuel     start {} (limit {}), longest step {} (limit {})\n",
        lines,
        grouped(start),
        grouped(limits.start_fuel_max),
        grouped(step),
        grouped(limits.step_fuel_max)
    );
    let needed = start.saturating_add(step.saturating_mul(CLASS_STEPS));
    let class = match class(start, step) {
        Some(class) => text!(
            "{}: {} such steps take {} of {} units",
            class.name(),
            grouped(CLASS_STEPS),
            grouped(needed),
            grouped(class.limits().match_fuel_max)
        ),
        None => text!(
            "none: {} such steps take {} units, and the class interpreted has {}",
            grouped(CLASS_STEPS),
            grouped(needed),
            grouped(FuelClass::Interpreted.limits().match_fuel_max)
        ),
    };
    text!("{}  class    {}\n", lines, class)
}

/// The first class whose fuel is enough for a robot that uses that much in `start` and in its
/// most expensive step; `None` if none is.
fn class(start: u64, step: u64) -> Option<FuelClass> {
    FuelClass::ALL.into_iter().find(|class| {
        let limits = class.limits();
        start <= limits.start_fuel_max
            && step <= limits.step_fuel_max
            && start.saturating_add(step.saturating_mul(CLASS_STEPS)) <= limits.match_fuel_max
    })
}

fn ending(record: &MatchRecord) -> Text {
    match &record.verdict {
        Verdict::Finished { score, .. } => text!(
            "score {} ({} + {} steps)",
            score,
            record.steps.exploration,
            record.steps.speed
        ),
        Verdict::Fault { fault } => {
            text!("{}: {}", record.verdict.title(), fault.describe().escaped())
        }
        verdict @ Verdict::BudgetUsedUp { .. } => text!("{}", verdict.title()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_class_is_the_first_with_enough_fuel() {
        assert_eq!(class(101, 29_000), Some(FuelClass::Compiled));
        assert_eq!(class(0, 20_000_000), Some(FuelClass::Compiled));
        assert_eq!(class(1, 20_000_000), Some(FuelClass::Interpreted));
        assert_eq!(class(646_000, 42_000_000), Some(FuelClass::Interpreted));
        assert_eq!(class(0, 200_000_001), None);
        assert_eq!(class(3_000_000_000, 1), None);
        assert_eq!(class(u64::MAX, u64::MAX), None);
    }
}
