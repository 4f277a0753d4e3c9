//! Mazes of competitions between people, by the number of entrances to the goal.

use std::ops::Range;

use super::super::markdown::{Table, code, grouped};
use super::Reference;
use super::generated::{REGRET_COLUMNS, UNFINISHED_MAX, ranking, regret_cells};
use crate::contest::{CompetitionMazes, MatchResult, Tally};
use crate::robot::Verdict;

/// The sets with what they have in common.
pub(super) fn sets(mazes: &CompetitionMazes) -> [(&'static str, &Range<usize>); 2] {
    [
        ("one entrance", &mazes.single),
        ("several entrances", &mazes.several),
    ]
}

/// The section with both sets, or the word that they were absent.
pub(super) fn section(page: &Reference<'_>) -> String {
    let mut text = String::from(
        "## Competition mazes\n\n\
         Mazes of competitions between people and their robots. They break rules of the contest\n\
         that a robot may rely on: many have cells that cannot be reached, some have a start that\n\
         is open to the right, some a goal elsewhere, and some several entrances to it, which is\n\
         told apart because robots infer walls from there being one. The columns are those of the\n\
         generated mazes.\n\n",
    );
    let Some(mazes) = &page.competition else {
        text.push_str(
            "**Absent when this page was written.** `--competition FOLDER` says where they are.\n",
        );
        return text;
    };
    if mazes.unsolvable > 0 {
        text.push_str(&format!(
            "{} more were left out because their goal cannot be reached.\n\n",
            mazes.unsolvable
        ));
    }
    for (name, set) in sets(mazes) {
        text.push_str(&format!(
            "### Competition mazes with {name}: {} mazes\n\n{}\n",
            grouped(set.len() as u64),
            table(page, set)
        ));
    }
    text.push_str(&unfinished(page, mazes));
    text
}

fn table(page: &Reference<'_>, set: &Range<usize>) -> String {
    let mut header = vec!["robot"];
    header.extend(REGRET_COLUMNS);
    let mut table = Table::new(&header, 1);
    let tally = |entrant| Tally::of(page.contest(), page.study.in_mazes(entrant, set));
    for entrant in ranking(page, tally) {
        let name = [page.competitors[entrant].label()].into_iter();
        table.row(name.chain(regret_cells(&tally(entrant))));
    }
    table.finish()
}

/// Which mazes were not finished by robots that finished most of them.
fn unfinished(page: &Reference<'_>, mazes: &CompetitionMazes) -> String {
    let mut table = Table::new(&["robot", "mazes"], 2);
    let mut is_empty = true;
    for (entrant, competitor) in page.competitors.iter().enumerate() {
        let results = sets(mazes)
            .into_iter()
            .flat_map(|(_, set)| page.study.in_mazes(entrant, set));
        let is_lost =
            |result: &&MatchResult| !matches!(result.outcome.verdict, Verdict::Finished(_));
        let lost: Vec<&str> = results
            .filter(is_lost)
            .map(|result| &page.contest().mazes[result.maze].name[..])
            .collect();
        if lost.is_empty() {
            continue;
        }
        is_empty = false;
        let names = if lost.len() > UNFINISHED_MAX {
            format!("{} mazes", grouped(lost.len() as u64))
        } else {
            let names: Vec<String> = lost.into_iter().map(code).collect();
            names.join(", ")
        };
        table.row([competitor.label(), names]);
    }
    if is_empty {
        return "Every robot finished every one of them.\n".to_owned();
    }
    format!("Not finished:\n\n{}", table.finish())
}
