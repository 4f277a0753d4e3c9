//! How the ranks were made, and what it takes to check them.

use maud::{Markup, html};

use super::parts::{caption, label, more, shown};
use crate::report::contest::view::View;
use crate::report::contest::words;

/// Digests of mazes that are listed, at most.
const MAZES_MAX: usize = 1000;

/// The rules, the engine, and the digests of everything.
pub(super) fn method(view: &View<'_>) -> Option<Markup> {
    let report = view.report;
    let matrix = report.matrix;
    Some(html! {
        ul {
            li { (words::ranked_by(report.scoring, report.overall.penalty_steps)) }
            li { "A maze counts when every ranked robot has played it with every seed." }
            li { (words::scored_by(&matrix.rules)) }
            @for set in matrix.sets.iter().filter(|_| matrix.sets.len() > 1) {
                li { "Set " (shown(&set.name)) ": weight " (set.weight)
                    @if set.is_hidden { ", hidden" } "." }
            }
            li { "Played with " (words::seeds(matrix.seeds)) " in every maze, each match in a fresh \
                  sandbox. A match is a pure function of engine, rules, robot, maze and seed." }
            li { "wasmouse " (env!("CARGO_PKG_VERSION")) ", engine "
                code { (shown(report.engine.as_str())) } ", rules "
                code { (matrix.rules.digest()) }
                @if let Some(digest) = report.results_digest { ", results " code { (digest) } } }
        }
        details {
            summary { "Digests (SHA-256)" }
            div.scroll tabindex="0" role="group" aria-label="Digests" { table {
                (caption("Digests of robots and mazes. A robot is the bytes of its file."))
                thead { tr { th.name scope="col" { "Robot or maze" } th.name scope="col" { "SHA-256" } } }
                tbody {
                    @for &robot in &view.robots {
                        @if let Some(digest) = view.digest(robot) { tr {
                            th.name scope="row" { (label(view.name(robot))) }
                            td.name { code { (digest) } }
                        } }
                    }
                    @for maze in view.mazes.iter().take(MAZES_MAX).map(|&maze| view.maze(maze)) { tr {
                        th.name scope="row" { (label(&maze.name)) }
                        td.name { code { (maze.digest) } }
                    } }
                }
            } }
            (more(view.mazes.len().min(MAZES_MAX), view.mazes.len(), "mazes"))
        }
    })
}
