//! Reading configuration files in TOML, with errors that show their place.
//!
//! [`read`] makes a value of a text, or a [`ConfigError`] with line, column, key and hint.
//! [`decode`] makes a text of the bytes of a file before that. Whatever concerns more than one
//! value is checked afterwards, by the owner of the file format: [`Document::error`] finds the
//! place of a key for such errors. Opens no files; `report::config` shows errors.
//!
//! ```
//! use serde::Deserialize;
//! use wasmouse::contest::config::{self, Integer};
//!
//! #[derive(Debug, Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Rubric {
//!     points: Integer<1, 100>,
//! }
//!
//! let rubric: Rubric = config::read("points = 7").expect("a rubric");
//! assert_eq!(rubric.points.get(), 7);
//!
//! let error = config::read::<Rubric>("point = 7").expect_err("an unknown key");
//! assert_eq!((error.line, error.column), (1, 1));
//! assert_eq!(error.message, "unknown key `point`");
//! assert_eq!(error.hint.as_deref(), Some("did you mean `points`?"));
//!
//! let error = config::read::<Rubric>("# of a task\npoints = 0").expect_err("out of range");
//! assert_eq!((error.line, error.column, error.key.as_str()), (2, 10, "points"));
//! assert_eq!(error.message, "`points`: expected an integer from 1 to 100, found 0");
//! ```

mod document;
mod error;
mod explain;
mod place;
mod suggest;
mod tables;
mod values;

pub use document::{BYTES_MAX, Document, decode, read};
pub use error::{ConfigError, Excerpt};
pub use suggest::suggestion;
pub use tables::{table, tables};
pub use values::{FilePath, Integer, Name};
