//! What a robot wrote to its journal, drawn: colours, labels, and the walls that it believes in.

use wasmouse_core::journal::{Belief, Entry, Journal, Note};

use crate::report::picture::{Label, Paint, Picture, Wall};

/// Draws what the robot has painted and labelled in its first `steps` steps.
pub(super) fn draw_marks(picture: &mut Picture, journal: &Journal, steps: usize) {
    for entry in written(journal, steps) {
        match entry.note {
            Note::Log { .. } | Note::Wall { .. } => {}
            Note::Paint { cell, color } => {
                if let Some(mark) = picture.mark_mut(cell) {
                    mark.paint = Paint::of(color);
                }
            }
            Note::Label { cell, text } => {
                if let Some(mark) = picture.mark_mut(cell) {
                    mark.label = Label::new(text);
                }
            }
        }
    }
}

/// Whether the robot says anything about walls in the whole match.
pub(super) fn has_beliefs(journal: &Journal) -> bool {
    let mut entries = journal.entries();
    entries.any(|entry| matches!(entry.note, Note::Wall { .. }))
}

/// Draws the walls of which the robot has said in its first `steps` steps what it believes.
pub(super) fn draw_beliefs(picture: &mut Picture, journal: &Journal, steps: usize) {
    for entry in written(journal, steps) {
        if let Note::Wall { cell, side, belief } = entry.note {
            picture.set_wall(cell, side, wall(belief));
        }
    }
}

/// How a wall is drawn of which that is known or believed.
pub(super) const fn wall(belief: Belief) -> Wall {
    match belief {
        Belief::Unknown => Wall::Unknown,
        Belief::Open => Wall::Open,
        Belief::Closed => Wall::Closed,
    }
}

fn written(journal: &Journal, steps: usize) -> impl Iterator<Item = Entry<'_>> {
    let seen = move |step: u32| usize::try_from(step).is_ok_and(|step| step <= steps);
    journal.entries().filter(move |entry| seen(entry.step))
}
