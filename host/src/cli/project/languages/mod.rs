//! The languages that robots are written in, one file for each.
//!
//! A new language is a file here with a static `LANGUAGE`, a line in [`LANGUAGES`], and a
//! template in `example-robots/languages`.

mod assemblyscript;
mod c;
mod c_family;
mod cpp;
mod go;
mod node;
mod python;
mod rust;
mod table;
mod wat;
mod zig;
mod zig_compiler;

pub use table::LANGUAGES;
