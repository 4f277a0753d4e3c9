//! The official mazes: every robot in every setting.

use super::super::markdown::{Table, thousandths};
use super::published::{BEST_ELSEWHERE, OFFICIAL};
use super::{Reference, score, score_with_steps, sum};
use crate::sim::Score;

/// The section with the scores of all robots.
pub(super) fn section(page: &Reference<'_>) -> String {
    let mut text = String::from(
        "## Official mazes\n\n\
         Score (steps of run 1, with the reset, + steps of run 2). The floor is the score of a\n\
         robot that knows the maze; the best known elsewhere are the two robots with the lowest\n\
         sums that were published by others, which are not part of wasmouse.\n\n",
    );
    let absent: Vec<String> = OFFICIAL
        .iter()
        .zip(page.official)
        .filter(|(_, place)| place.is_none())
        .map(|(maze, _)| format!("`{}`", maze.name))
        .collect();
    if !absent.is_empty() {
        text.push_str(&format!(
            "**Absent when this page was written: {}.** `--official FOLDER` says where they are.\n\n",
            absent.join(", ")
        ));
    }
    text.push_str(&table(page));
    text
}

fn table(page: &Reference<'_>) -> String {
    let header = ["robot", "maze 01", "maze 02", "maze 03", "sum"];
    let mut table = Table::new(&header, 1);
    for (entrant, competitor) in page.competitors.iter().enumerate() {
        let mut row = vec![competitor.label()];
        let results = [0, 1, 2].map(|number| page.in_official(entrant, number));
        row.extend(results.iter().zip(page.official).map(|(result, maze)| {
            match (result, maze) {
                (Some(result), _) => score_with_steps(result),
                // Entrants that were admitted have played every maze.
                (None, Some(_)) => "refused".to_owned(),
                (None, None) => "-".to_owned(),
            }
        }));
        let scores = results.map(|result| result.and_then(score));
        row.push(match scores {
            [Some(a), Some(b), Some(c)] => sum([a, b, c]),
            _ => "-".to_owned(),
        });
        table.row(row);
    }
    for scores in BEST_ELSEWHERE {
        let mut row = vec!["best known elsewhere".to_owned()];
        row.extend(scores.map(thousandths));
        row.push(thousandths(scores.iter().sum()));
        table.row(row);
    }
    let floors: [Score; 3] = OFFICIAL.map(|maze| maze.floor);
    let mut row = vec!["**floor**".to_owned()];
    row.extend(floors.map(|floor| {
        let steps = (floor.exploration_steps(), floor.speed_steps());
        format!("{floor} ({} + {})", steps.0, steps.1)
    }));
    row.push(sum(floors));
    table.row(row);
    table.finish()
}
