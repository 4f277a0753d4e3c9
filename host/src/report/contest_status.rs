//! [`contest_status`]: what a store has of a contest.

use std::fmt::Write as _;

use wasmouse_core::{Digest, GuestText};

use super::text::text;
use crate::contest::ScoreMatrix;
use crate::report::number::counted;

/// What [`contest_status`] shows.
pub struct Status<'a> {
    /// What the contest is called.
    pub name: &'a str,
    /// The path of the store, to print it.
    pub store: String,
    /// Whether all pages and records were checked.
    pub is_checked: bool,
    /// How many matches the contest has.
    pub matches: u64,
    /// How many are left to play.
    pub left: u64,
    /// What was played.
    pub matrix: &'a ScoreMatrix,
    /// How many matches have two records.
    pub conflicts: u64,
    /// All submissions, the oldest first: name, file, variant, and the kind of its rejection.
    pub submissions: Vec<(GuestText, Digest, u32, Option<GuestText>)>,
}

/// Some lines about the contest, one for each robot, and one for each submission. Ends with a
/// newline.
pub fn contest_status(status: &Status<'_>) -> String {
    let mut text = String::new();
    let mut line = |line: super::text::Text| {
        writeln!(text, "{}", line.as_str()).expect("a string takes any text");
    };
    let matrix = status.matrix;
    line(text!("{}: {}", status.name, status.store));
    line(text!(
        "{} of {} played, {} left to play",
        matrix.played(),
        counted(status.matches, "match"),
        status.left
    ));
    if status.is_checked {
        line(text!("the store is sound"));
    }
    if status.conflicts > 0 {
        line(text!(
            "{} with two different records: this is a bug, or the store was changed",
            counted(status.conflicts, "match")
        ));
    }
    line(text!("\nrobots"));
    for (index, robot) in matrix.robots.iter().enumerate() {
        let seeds = 0..matrix.seeds.count;
        let mazes = 0..matrix.mazes.len();
        let played = mazes
            .flat_map(|maze| seeds.clone().map(move |seed| (maze, seed)))
            .filter(|&(maze, seed)| matrix.get(index, maze, seed).is_some());
        let played = counted(played.count(), "match");
        line(text!("  {}: {}", robot.name.escaped(), played));
        for (kind, fault) in &robot.faults {
            line(text!("    {} {}", counted(fault.count, "time"), kind));
        }
        for (reason, count) in &robot.unplayed {
            line(text!("    {} not played: {}", count, reason.escaped()));
        }
    }
    line(text!("\nsubmissions, the oldest first"));
    for (name, digest, variant, rejection) in &status.submissions {
        let digest = digest.to_string();
        let rejection = rejection.as_ref();
        let rejection =
            rejection.map_or_else(String::new, |it| format!(", rejected: {}", it.escaped()));
        line(text!(
            "  {}: {}, variant {}{}",
            name.escaped(),
            &digest[..12],
            variant,
            rejection
        ));
    }
    text
}
