//! The player: matches on the terminal, at any step, forwards and backwards.
//!
//! A match takes less than a millisecond, so it is played first and shown afterwards, from its
//! [`Playback`](wasmouse_core::playback::Playback) alone. [`Show`] is a match to show,
//! `control` what keys do, `account` what happened in words, `scenes` what is in the mazes,
//! and `view` where everything is on the screen. [`play`] needs a terminal; [`Player`] draws
//! into any buffer of cells.

mod account;
mod app;
mod control;
mod live;
mod logs;
mod scenes;
mod show;
mod start;
mod timeline;
mod view;

pub use account::{action_in_words, step_in_words};
pub use control::Player;
pub use live::watch;
pub use show::Show;
pub use start::{Options, play};
