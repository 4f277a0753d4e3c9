//! Grades as text, one file per format.
//!
//! All formats are made of a [`Report`]. Names of robots and what robots say may hold anything,
//! so each format escapes it for whatever reads it: control characters that XML does not have,
//! Markdown, commands of a workflow, formulas of a spreadsheet.

mod annotations;
mod classroom;
mod csv;
mod gradescope;
mod json;
mod junit;
mod markdown;
#[cfg(test)]
mod sample;
mod sentence;
mod table;
mod tap;

pub use annotations::{annotations, for_workflow};
pub use classroom::{ClassroomContext, classroom};
pub use csv::csv;
pub use gradescope::gradescope;
pub use json::{GRADE_VERSION, json};
pub use junit::junit;
pub use markdown::{STEP_SUMMARY_BYTES_MAX, markdown};
pub use sentence::{Report, missed};
pub use table::table;
pub use tap::tap;
