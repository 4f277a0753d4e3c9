//! Records journal calls natively: a list per thread, while a [`testing`](crate::testing)
//! match runs.

use std::cell::RefCell;

use crate::bindings::wasmouse::robot::journal::{Belief, Color, Level};
use crate::{Cell, Heading};

/// One journal call, with the number of the step in which it was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Steps of both runs, counted from 1; 0 during `start`.
    pub step: u32,
    /// What was reported.
    pub note: Note,
}

/// What one journal call reported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Note {
    /// A line of text.
    Log(Level, String),
    /// A colour for a cell.
    Paint(Cell, Color),
    /// A text in a cell.
    Label(Cell, String),
    /// A belief about a wall.
    Wall(Cell, Heading, Belief),
}

struct Recording {
    step: u32,
    entries: Vec<Entry>,
}

thread_local! {
    static RECORDING: RefCell<Option<Recording>> = const { RefCell::new(None) };
}

/// Records this thread's journal calls until it is dropped or finished. Dropping
/// matters when a robot panics: the next test on the thread starts clean.
pub(crate) struct Recorder(());

impl Recorder {
    pub(crate) fn start() -> Self {
        RECORDING.set(Some(Recording {
            step: 0,
            entries: Vec::new(),
        }));
        Self(())
    }

    pub(crate) fn step(&self, step: u32) {
        RECORDING.with_borrow_mut(|recording| {
            if let Some(recording) = recording {
                recording.step = step;
            }
        });
    }

    pub(crate) fn finish(self) -> Vec<Entry> {
        RECORDING.take().map_or_else(Vec::new, |it| it.entries)
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        RECORDING.set(None);
    }
}

/// Takes a closure so that no text is copied while nobody records.
fn push(note: impl FnOnce() -> Note) {
    RECORDING.with_borrow_mut(|recording| {
        if let Some(Recording { step, entries }) = recording {
            entries.push(Entry {
                step: *step,
                note: note(),
            });
        }
    });
}

pub(crate) fn log(level: Level, message: &str) {
    push(|| Note::Log(level, message.to_owned()));
}

pub(crate) fn paint(cell: Cell, color: Color) {
    push(|| Note::Paint(cell, color));
}

pub(crate) fn label(cell: Cell, text: &str) {
    push(|| Note::Label(cell, text.to_owned()));
}

pub(crate) fn wall(cell: Cell, side: Heading, belief: Belief) {
    push(|| Note::Wall(cell, side, belief));
}
