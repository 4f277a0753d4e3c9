//! The exit code of grades, and what the user should know about robots that did not play.

use wasmouse_core::guest_text::GuestStr;

use super::super::exit::Exit;
use super::super::interrupt;
use super::super::output::message;
use crate::contest::grade::{Grade, Participation};
use crate::report::escape::for_terminal;
use crate::report::grade::for_workflow;

/// The exit code; says on stderr why robots did not play.
pub fn exit(grades: &[Grade]) -> Exit {
    for grade in grades {
        if let Some(reason) = grade.participation.reason() {
            let text = |it: GuestStr<'_>| for_workflow(&for_terminal(it));
            message!(
                "{} `{}`: {}",
                grade.participation.name(),
                text(GuestStr::from(&grade.robot)),
                text(reason.as_guest())
            );
            if let Participation::Rejected { hint, .. } = &grade.participation {
                message!("  hint: {}", text(hint.as_guest()));
            }
        }
    }
    let is_complete = grades.iter().all(Grade::is_complete);
    if interrupt::flag().is_set() && !is_complete {
        return Exit::Interrupted;
    }
    let any = |is_so: fn(&Grade) -> bool| grades.iter().any(is_so);
    let is_withdrawn =
        |it: &Grade| !it.is_passed && matches!(it.participation, Participation::Withdrawn(_));
    let is_robots_fault = |it: &Grade| {
        let is_rejected = matches!(it.participation, Participation::Rejected { .. });
        !it.is_passed && (is_rejected || it.matches.faults > 0)
    };
    if !is_complete || any(is_withdrawn) {
        Exit::Internal
    } else if any(|it| matches!(it.participation, Participation::Missing(_))) {
        Exit::Input
    } else if any(is_robots_fault) {
        Exit::Robot
    } else if any(|it| !it.is_passed) {
        Exit::CheckFailed
    } else {
        Exit::Success
    }
}
