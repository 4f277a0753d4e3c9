//! [`Report`]: what all formats are made of, and what they say about a criterion in words.

use wasmouse_core::{GuestText, guest_text};

use crate::contest::grade::{
    Criterion, CriterionGrade, Expectation, Grade, Missed, Participation, Rubric, Status, Target,
};
use crate::report::number::counted;

/// Grades of one rubric.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// What robots were graded by.
    pub rubric: &'a Rubric,
    /// The engine that played.
    pub engine: &'a str,
    /// The grades, in the order in which the robots were given.
    pub grades: &'a [Grade],
}

impl<'a> Report<'a> {
    /// The criteria of a grade with what they came to.
    pub(super) fn criteria(
        &self,
        grade: &'a Grade,
    ) -> impl Iterator<Item = (&'a Criterion, &'a CriterionGrade)> {
        self.rubric.criteria.iter().zip(&grade.criteria)
    }

    /// The same report about one of the robots.
    pub fn of(&self, grade: &'a Grade) -> Self {
        Self {
            grades: std::slice::from_ref(grade),
            ..*self
        }
    }
}

/// What a criterion came to, in words. May quote text of the robot.
pub(super) fn sentence(criterion: &Criterion, result: &CriterionGrade) -> GuestText {
    let (found, reason) = (result.value_thousandths, result.reason.as_ref());
    let Some(found) = found else {
        return reason.map_or_else(|| "nothing was measured".into(), GuestText::clone);
    };
    let matches = result.matches;
    let limit = criterion.expectation.threshold().map_or(0, |it| it.full);
    match &criterion.expectation {
        Expectation::Measure(target, _) => {
            let measured = measured(*target, found);
            let expected = expected(*target, limit);
            guest_text!(
                "{} in {}; {}",
                measured,
                counted(matches, "match"),
                expected
            )
        }
        Expectation::Beats { robot, .. } => guest_text!(
            "better than `{}` in {} % of {}, where as good counts half; \
             expected at least {} %",
            robot,
            decimal(found),
            counted(matches, "match"),
            decimal(limit)
        ),
        Expectation::Baseline { .. } => guest_text!(
            "a mean score {} than the baseline in {}; expected {}",
            compared(found),
            counted(matches, "match"),
            match limit {
                0 => "no more".to_owned(),
                1.. => format!("at most {} more", decimal(limit)),
                _ => format!("at least {} less", decimal(-limit)),
            }
        ),
        Expectation::NoWorseThan { robot } => {
            let verdict = match result.status {
                Status::Passed => "not significantly worse",
                _ => "significantly worse",
            };
            let reason = reason.map_or_else(GuestText::new, |it| guest_text!(": {}", it));
            guest_text!(
                "{} than `{}` in {}, with a mean score {}{}",
                verdict,
                robot,
                counted(matches, "match"),
                match found {
                    0 => "that is the same".to_owned(),
                    _ => format!("that is {}", compared(found)),
                },
                reason
            )
        }
    }
}

/// The faults of a robot in words, one line for each kind.
pub(super) fn faults(grade: &Grade) -> impl Iterator<Item = GuestText> {
    grade.faults.iter().map(|fault| {
        guest_text!(
            "{} in {} of {}, first in {} with seed {}: {}",
            fault.kind,
            fault.count,
            counted(grade.matches.played, "match"),
            fault.maze,
            fault.seed,
            fault.message
        )
    })
}

/// That a robot missed a threshold, in words: the rest of a sentence about it.
pub fn missed(missed: &Missed) -> String {
    let Missed {
        target,
        limit_thousandths,
        found_thousandths,
    } = *missed;
    let expected = expected(target, limit_thousandths);
    match found_thousandths {
        Some(found) => format!("{}; {expected}", measured(target, found)),
        None => format!("nothing was measured; {expected}"),
    }
}

fn measured(target: Target, found: i64) -> String {
    let is_one = found == 1000;
    let found = decimal(found);
    match target {
        Target::Faults if is_one => "1 fault".to_owned(),
        Target::FinishedPercent => format!("finished {found} %"),
        Target::MeanScore => format!("a mean score of {found}"),
        Target::MeanRegret => format!("a mean regret of {found}"),
        Target::Faults => format!("{found} faults"),
        Target::StepFuelMean => format!("{found} units of fuel a step"),
        Target::StepFuelMax => format!("at most {found} units of fuel in a step"),
        Target::MemoryBytesMax => format!("at most {found} bytes of memory"),
    }
}

fn expected(target: Target, limit: i64) -> String {
    let limit = decimal(limit);
    match target {
        Target::FinishedPercent => format!("expected at least {limit} %"),
        _ => format!("expected at most {limit}"),
    }
}

fn compared(difference: i64) -> String {
    match difference {
        0.. => format!("{} higher", decimal(difference)),
        _ => format!("{} lower", decimal(-difference)),
    }
}

/// Thousandths as a decimal number, without zeros at the end.
pub(super) fn decimal(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let size = thousandths.unsigned_abs();
    let decimals = format!("{:03}", size % 1000);
    match decimals.trim_end_matches('0') {
        "" => format!("{sign}{}", size / 1000),
        decimals => format!("{sign}{}.{decimals}", size / 1000),
    }
}

/// Points as a decimal number.
pub(super) fn points(thousandths: u64) -> String {
    decimal(i64::try_from(thousandths).unwrap_or(i64::MAX))
}

/// What became of a robot in a word or two.
pub(super) fn verdict(grade: &Grade) -> &'static str {
    match (&grade.participation, grade.is_passed) {
        (_, true) => "passed",
        (Participation::Missing(_), _) => "missing",
        (Participation::Rejected { .. }, _) => "rejected",
        (Participation::Withdrawn(_), _) => "withdrawn",
        (Participation::HostFailed(_), _) => "not graded",
        (Participation::Admitted, false) if !grade.is_complete() => "incomplete",
        (Participation::Admitted, false) => "below the mark",
    }
}
