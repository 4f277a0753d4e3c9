//! What belongs to one running robot: its account of memory, its journal, and
//! the host functions that it may call.

use wasmtime::component::{Linker, WasmStr};
use wasmtime::{Engine, StoreContextMut, Trap};

use wasmouse_core::GuestText;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Belief, Color, Journal, Level, Note};
use wasmouse_core::maze::Cell;

use super::bindings::{self, journal as wit, types};
use super::limiter::Limiter;
use crate::admission::JOURNAL;
use crate::error::InfrastructureError;

/// The data of a store: one per match.
pub(crate) struct Guest {
    pub(crate) limiter: Limiter,
    pub(crate) journal: Journal,
    /// Cells along each side of the maze.
    pub(crate) dimension: u8,
    /// The step in progress, 0 before the first.
    pub(crate) step: u32,
    /// Calls of the host into the robot so far: instantiation, `start`, steps.
    pub(crate) calls: usize,
}

/// Fuel that each call into the journal costs, so that calling the host is not
/// cheaper than computing: about the time of that many operators.
const CALL_FUEL: u64 = 200;

/// How much of the message of a panic is kept, in bytes.
const PANIC_BYTES_MAX: usize = 2000;

/// The robot reported an error from which it cannot recover: its message, cut.
#[derive(Debug, thiserror::Error)]
#[error("the robot panicked")]
pub(super) struct Panicked(pub(super) GuestText);

/// The linker with everything that a robot may import.
pub(super) fn linker(engine: &Engine) -> Result<Linker<Guest>, InfrastructureError> {
    let mut linker = Linker::new(engine);
    add_journal(&mut linker).map_err(InfrastructureError::engine)?;
    Ok(linker)
}

fn add_journal(linker: &mut Linker<Guest>) -> wasmtime::Result<()> {
    // A robot built for another patch version of the interface links as well.
    let mut journal = linker.instance(JOURNAL)?;
    journal.func_wrap(
        "log",
        |mut store: StoreContextMut<'_, Guest>, (level, text): (wit::Level, WasmStr)| {
            let level = match level {
                wit::Level::Debug => Level::Debug,
                wit::Level::Info => Level::Info,
                wit::Level::Warning => Level::Warning,
                wit::Level::Error => Level::Error,
            };
            let text = text.to_str(&store)?.into_owned();
            charge(&mut store, text.len())?;
            let guest = store.data_mut();
            let text = GuestStr::from(&text);
            guest.journal.push(guest.step, Note::Log { level, text });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "paint",
        |mut store: StoreContextMut<'_, Guest>, (cell, color): (types::Cell, wit::Color)| {
            charge(&mut store, 0)?;
            store.data_mut().note(cell, |cell| Note::Paint {
                cell,
                color: self::color(color),
            });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "label",
        |mut store: StoreContextMut<'_, Guest>, (cell, text): (types::Cell, WasmStr)| {
            let text = text.to_str(&store)?.into_owned();
            charge(&mut store, text.len())?;
            let text = GuestStr::from(&text);
            let note = |cell| Note::Label { cell, text };
            store.data_mut().note(cell, note);
            Ok(())
        },
    )?;
    journal.func_wrap(
        "wall",
        |mut store: StoreContextMut<'_, Guest>,
         (cell, side, belief): (types::Cell, types::Heading, wit::Belief)| {
            charge(&mut store, 0)?;
            store.data_mut().note(cell, |cell| Note::Wall {
                cell,
                side: bindings::heading(side),
                belief: self::belief(belief),
            });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "panic",
        |mut store: StoreContextMut<'_, Guest>, (text,): (WasmStr,)| -> wasmtime::Result<()> {
            let text = text.to_str(&store)?;
            let bytes = text.len();
            let kept = GuestText::from(&text[..text.floor_char_boundary(PANIC_BYTES_MAX)]);
            charge(&mut store, bytes)?;
            Err(Panicked(kept).into())
        },
    )?;
    Ok(())
}

/// Takes the fuel of one call into the journal with that many bytes of text.
fn charge(store: &mut StoreContextMut<'_, Guest>, text_bytes: usize) -> wasmtime::Result<()> {
    let cost = CALL_FUEL.saturating_add(u64::try_from(text_bytes).unwrap_or(u64::MAX));
    match store.get_fuel()?.checked_sub(cost) {
        Some(rest) => store.set_fuel(rest),
        None => {
            store.set_fuel(0)?;
            Err(Trap::OutOfFuel.into())
        }
    }
}

impl Guest {
    /// Adds a note about a cell; cells outside the maze are ignored.
    fn note<'a>(&mut self, cell: types::Cell, note: impl FnOnce(Cell) -> Note<'a>) {
        let inside = |at: u32| u8::try_from(at).ok().filter(|&at| at < self.dimension);
        if let (Some(x), Some(y)) = (inside(cell.x), inside(cell.y)) {
            self.journal.push(self.step, note(Cell::new(x, y)));
        }
    }
}

const fn color(color: wit::Color) -> Color {
    match color {
        wit::Color::None => Color::None,
        wit::Color::Red => Color::Red,
        wit::Color::Orange => Color::Orange,
        wit::Color::Yellow => Color::Yellow,
        wit::Color::Green => Color::Green,
        wit::Color::Cyan => Color::Cyan,
        wit::Color::Blue => Color::Blue,
        wit::Color::Violet => Color::Violet,
        wit::Color::Gray => Color::Gray,
    }
}

const fn belief(belief: wit::Belief) -> Belief {
    match belief {
        wit::Belief::Unknown => Belief::Unknown,
        wit::Belief::Open => Belief::Open,
        wit::Belief::Closed => Belief::Closed,
    }
}
