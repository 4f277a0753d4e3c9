//! The languages that robots are written in, one file for each.
//!
//! A new language is a file here with a static `LANGUAGE`, a line in [`LANGUAGES`], and a
//! template in `example-robots/languages`.

mod go;
mod node;
mod python;
mod rust;
mod table;

pub use table::LANGUAGES;
