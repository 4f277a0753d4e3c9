//! [`Picture`]: everything that can be seen in a drawing of a maze, and the renderers that
//! draw it as text and as SVG.
//!
//! Knows no terminal, no file and no match. Unknown walls and cells are dots, as in the
//! drawings of Minnett's report.

mod drawing;
mod label;
mod paint;
mod svg;
#[cfg(test)]
mod tests;
mod text;

pub use drawing::{Mark, Picture, Wall};
pub use label::{LABEL_CHARS_MAX, Label};
pub use paint::Paint;
pub use svg::SVG_STYLE;
pub use text::{Charset, TextStyle};
