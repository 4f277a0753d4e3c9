//! `wasmouse maze edit`: a maze in the terminal, with what it breaks and how hard it is.
//!
//! [`board`] has the walls and what undoes a change, [`facts`] what follows from them, [`file`] the
//! file, [`editor`] the keys and the mouse, and [`view`] what is drawn; [`app`] makes a program of
//! them.

mod app;
mod board;
mod editor;
mod facts;
mod file;
mod start;
mod view;

pub use start::{Args, run};
