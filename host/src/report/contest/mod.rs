//! Reports of a contest, one file per format: terminal table, Markdown, CSV, JSON, web page.
//!
//! All of them are made from a [`ContestReport`]: the scores of a contest and the rankings
//! that they make. What must not be shown to everybody is left out in one place (`view`), from
//! which all formats take robots, mazes and faults. Matches as JSON Lines are in
//! [`jsonl`](super::jsonl).

mod address;
mod csv;
mod document;
mod html;
mod json;
mod markdown;
mod picture;
mod playable;
#[cfg(test)]
mod sample;
mod table;
#[cfg(test)]
mod tests;
mod view;
mod words;

pub use csv::{matches_csv, robots_csv};
pub use document::{Compared, ContestReport, PartRanking, ReportOptions};
pub use html::html;
pub use json::{REPORT_VERSION, json};
pub use markdown::markdown;
pub use picture::{MatchPicture, PICTURES_MAX, Pictures};
pub use playable::{PLAYABLE_BYTES_MAX, Place, Playable};
pub use table::table;
