//! Pixels of our own SVG documents: [`draw`] makes an [`Image`] of one, and [`png`] a file of that.
//!
//! The same document gives the same pixels on every machine: there is one font, which is part of
//! the program, and nothing is read from the system. A document cannot name files or addresses.

mod image;
mod png;
mod render;

pub use image::Image;
pub use png::png;
pub use render::{PIXELS_MAX, RasterError, draw};
