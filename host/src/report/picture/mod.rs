//! [`Picture`]: everything that can be seen in a drawing of a maze, and the renderers that
//! draw it as text and as SVG.
//!
//! Knows no terminal, no file and no match. Unknown walls and cells are dots, as in the
//! drawings of Minnett's report.

mod drawing;
mod label;
mod paint;
mod sheet;
mod svg;
#[cfg(test)]
mod tests;
mod text;
mod theme;

pub use drawing::{Mark, Picture, Wall};
pub(super) use label::replace_hostile;
pub use label::{LABEL_CHARS_MAX, Label};
pub use paint::Paint;
pub use sheet::{Caption, Sheet};
pub(super) use svg::escaped;
pub use text::{Charset, TextStyle};
pub use theme::{SVG_STYLE, Theme};
