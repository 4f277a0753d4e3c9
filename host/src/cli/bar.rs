//! The bar of matches that are played.

use std::fmt::Write;

use indicatif::{ProgressState, ProgressStyle};

/// Counts matches, with their rate and the time that the rest will take, and `below` after that.
pub fn matches(below: &str) -> ProgressStyle {
    let template = format!("{{bar:40}} {{pos}}/{{len}} matches, {{rate}}/s, {{eta}} left{below}");
    let style = ProgressStyle::with_template(&template).expect("a template of known keys");
    // The rate of indicatif has four decimals.
    let rate = |state: &ProgressState, line: &mut dyn Write| {
        write!(line, "{:.0}", state.per_sec()).expect("a line takes any text");
    };
    style.with_key("rate", rate)
}
