//! What `wasmouse contest check` prints: who plays what in a contest.

use wasmouse_core::GuestText;
use wasmouse_core::game::Ruleset;

use super::escape::for_terminal;
use crate::contest::{MazeSet, Seeds};

/// A contest before it is played.
pub struct Overview<'a> {
    /// What reports call it.
    pub name: &'a str,
    /// The rules.
    pub rules: &'a Ruleset,
    /// The seeds of every maze.
    pub seeds: Seeds,
    /// The robots.
    pub robots: Vec<RobotLine>,
    /// The sets, each with the number of its mazes.
    pub sets: Vec<(&'a MazeSet, u64)>,
    /// How many matches there are.
    pub matches: u64,
    /// The database with the results.
    pub store: String,
    /// The reports that will be written: key and file.
    pub outputs: Vec<(&'static str, String)>,
}

/// A robot of an [`Overview`].
pub struct RobotLine {
    /// What results call it.
    pub name: GuestText,
    /// Who submitted it.
    pub author: Option<GuestText>,
    /// The class that it declares.
    pub class: Option<GuestText>,
    /// Its file; `None` if it is bundled.
    pub file: Option<String>,
}

/// The overview as lines. Names are escaped.
pub fn contest_check(overview: &Overview<'_>) -> String {
    let Overview { rules, seeds, .. } = overview;
    let mut lines = vec![
        format!("contest: {}", for_terminal(overview.name)),
        format!(
            "rules: {} version {}",
            for_terminal(&rules.name),
            rules.version
        ),
        match seeds.count {
            1 => format!("seed: {}", seeds.first),
            count => format!("seeds: {} to {}", seeds.first, seeds.get(count - 1)),
        },
        format!("robots: {}", overview.robots.len()),
    ];
    lines.extend(overview.robots.iter().map(robot));
    let mazes: u64 = overview.sets.iter().map(|(_, mazes)| mazes).sum();
    lines.push(format!("mazes: {mazes}"));
    lines.extend(overview.sets.iter().map(|&(it, mazes)| set(it, mazes)));
    lines.push(format!("matches: {}", overview.matches));
    lines.push(format!("store: {}", for_terminal(&overview.store)));
    let output = |(key, file): &(&str, String)| format!("{key}: {}", for_terminal(file));
    lines.extend(overview.outputs.iter().map(output));
    lines.join("\n") + "\n"
}

fn robot(robot: &RobotLine) -> String {
    let mut line = format!("  {}", for_terminal(&robot.name));
    if let Some(author) = &robot.author {
        line += &format!(" by {}", for_terminal(author));
    }
    if let Some(class) = &robot.class {
        line += &format!(" in class {}", for_terminal(class));
    }
    let file = robot.file.as_deref().map(for_terminal);
    line + &format!(" ({})", file.as_deref().unwrap_or("bundled"))
}

fn set(set: &MazeSet, mazes: u64) -> String {
    let name = for_terminal(&set.name);
    let hidden = if set.is_hidden { ", hidden" } else { "" };
    format!("  {name}: {mazes}, weight {}{hidden}", set.weight)
}
