//! What belongs to one running robot: its account of memory, its journal, and
//! the host functions that it may call.

use wasmtime::component::{Linker, WasmStr};
use wasmtime::{Engine, StoreContextMut, Trap};

use super::HostError;
use super::bindings::{journal as wit, types};
use super::journal::{Belief, Color, Journal, Level, Note};
use super::limiter::Limiter;
use super::version::JOURNAL;
use crate::maze::{Cell, Heading};

/// The data of a store: one per match.
pub(super) struct Guest {
    pub(super) limiter: Limiter,
    pub(super) journal: Journal,
    /// Cells along each side of the maze.
    pub(super) dimension: u8,
    /// The step in progress, 0 before the first.
    pub(super) step: u32,
}

/// Fuel that each call into the journal costs, so that calling the host is not
/// cheaper than computing: about the time of that many operators.
const CALL_FUEL: u64 = 200;

/// How much of the message of a panic is kept. Unit: bytes.
const PANIC_BYTES_MAX: usize = 2000;

/// The robot reported an error from which it cannot recover: its message, cut.
#[derive(Debug, thiserror::Error)]
#[error("panicked: {0}")]
pub(super) struct Panicked(String);

/// The linker with everything that a robot may import.
pub(super) fn linker(engine: &Engine) -> Result<Linker<Guest>, HostError> {
    let mut linker = Linker::new(engine);
    add_journal(&mut linker).map_err(HostError::engine)?;
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
            guest
                .journal
                .push(guest.step, Note::Log { level, text: &text });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "paint",
        |mut store: StoreContextMut<'_, Guest>, (cell, color): (types::Cell, wit::Color)| {
            charge(&mut store, 0)?;
            store.data_mut().note(cell, |cell| Note::Paint {
                cell,
                color: color.into(),
            });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "label",
        |mut store: StoreContextMut<'_, Guest>, (cell, text): (types::Cell, WasmStr)| {
            let text = text.to_str(&store)?.into_owned();
            charge(&mut store, text.len())?;
            let note = |cell| Note::Label { cell, text: &text };
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
                side: Heading::from(side),
                belief: belief.into(),
            });
            Ok(())
        },
    )?;
    journal.func_wrap(
        "panic",
        |mut store: StoreContextMut<'_, Guest>, (text,): (WasmStr,)| -> wasmtime::Result<()> {
            let text = text.to_str(&store)?;
            let bytes = text.len();
            let kept = text[..text.floor_char_boundary(PANIC_BYTES_MAX)].to_owned();
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

impl From<wit::Color> for Color {
    fn from(color: wit::Color) -> Self {
        match color {
            wit::Color::None => Self::None,
            wit::Color::Red => Self::Red,
            wit::Color::Orange => Self::Orange,
            wit::Color::Yellow => Self::Yellow,
            wit::Color::Green => Self::Green,
            wit::Color::Cyan => Self::Cyan,
            wit::Color::Blue => Self::Blue,
            wit::Color::Violet => Self::Violet,
            wit::Color::Gray => Self::Gray,
        }
    }
}

impl From<wit::Belief> for Belief {
    fn from(belief: wit::Belief) -> Self {
        match belief {
            wit::Belief::Unknown => Self::Unknown,
            wit::Belief::Open => Self::Open,
            wit::Belief::Closed => Self::Closed,
        }
    }
}
