//! [`html()`]: a contest as one self-contained web page.
//!
//! Nothing is loaded from elsewhere, and the content security policy forbids it. Everything can
//! be read without the script, which sorts and filters tables. Untrusted text is escaped for
//! HTML by maud, and [`shown`] makes invisible characters visible. Cells and pictures
//! of matches have the address of their match in `data-match`.

use data_encoding::BASE64;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use wasmouse_core::Digest;

use super::parts::shown;
use super::player::{self, Player};
use super::{boxes, method, pictures, plots, scatter, scores, standings};
use crate::report::contest::document::ContestReport;
use crate::report::contest::view::View;
use crate::report::contest::words;
use crate::report::number::counted;
use crate::report::picture::SVG_STYLE;

const STYLE: &str = include_str!("page.css");

const SCRIPT: &str = include_str!("page.js");

/// A part of the page: its id, its heading and what stands below.
struct Section {
    id: &'static str,
    title: &'static str,
    content: Markup,
}

/// The page. A contest of 5 robots in 500 mazes takes about half a megabyte; of larger ones only
/// a part of the matches is shown, and the page says so.
pub fn html(report: &ContestReport<'_>) -> String {
    let view = View::new(report);
    let player = Player::new(&view);
    let player = player.as_ref();
    let sections = [
        (
            "standings",
            "Standings",
            standings::standings(&view, player),
        ),
        ("watch", "Watch", player.map(|it| it.section(&view))),
        ("comparisons", "Comparisons", standings::comparisons(&view)),
        ("not-ranked", "Not ranked", standings::unranked(&view)),
        ("faults", "Faults", standings::faults(&view)),
        (
            "distribution",
            "Distribution of scores",
            boxes::boxes(&view),
        ),
        ("runs", "Exploration and speed run", scatter::scatter(&view)),
        ("plots", "Plots", plots::plots(&view)),
        ("matches", "Robots by mazes", scores::scores(&view, player)),
        (
            "best",
            "Best match of each robot",
            pictures::best(&view, player),
        ),
        ("hardest", "Hardest mazes", pictures::hardest(&view, player)),
        ("method", "Method", method::method(&view)),
    ];
    let sections = sections
        .into_iter()
        .filter_map(|(id, title, content)| content.map(|content| Section { id, title, content }));
    page(&view, &sections.collect::<Vec<_>>(), player)
}

fn page(view: &View<'_>, sections: &[Section], player: Option<&Player>) -> String {
    let report = view.report;
    let name = shown(report.name);
    let player_style = player.map_or("", |_| player::STYLE);
    let style = format!("{STYLE}{SVG_STYLE}\n{player_style}");
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy(&style, player.is_some()));
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (name) }
                style { (PreEscaped(&style)) }
            }
            body {
                header {
                    h1 { (name) }
                    p.quiet {
                        (counted(view.matrix().robots.len() as u64, "robot")) ", "
                        (counted(view.matrix().mazes.len() as u64, "maze")) ", "
                        (counted(view.matches_played(), "match"))
                        "; ruleset " (shown(&report.matrix.rules.name))
                        " version " (report.matrix.rules.version)
                        @if let Some(class) = report.matrix.rules.fuel_class() {
                            ", fuel class " (class.name())
                        }
                    }
                    @if let Some(missing) = words::missing(view) { p.notice { strong { (missing) } } }
                    @for sentence in words::left_out(view) { p.notice { (shown(&sentence)) } }
                    nav aria-label="Contents" { ul {
                        @for section in sections { li { a href={ "#" (section.id) } { (section.title) } } }
                    } }
                }
                main {
                    @for section in sections {
                        section aria-labelledby=(section.id) {
                            h2 id=(section.id) { (section.title) }
                            (section.content)
                        }
                    }
                }
                script { (PreEscaped(SCRIPT)) }
                @if let Some(player) = player {
                    (player.data())
                    script { (PreEscaped(player::SCRIPT)) }
                }
            }
        }
    }
    .into_string()
}

/// A policy that allows this style sheet, these scripts and images inside the page, and nothing else;
/// the player compiles the WebAssembly that the page brings.
fn policy(style: &str, has_player: bool) -> String {
    let source = |text: &str| {
        let hash = BASE64.encode(Digest::of(text.as_bytes()).as_bytes());
        format!("'sha256-{hash}'")
    };
    let player = if has_player {
        format!(" {} 'wasm-unsafe-eval'", source(player::SCRIPT))
    } else {
        String::new()
    };
    format!(
        "default-src 'none'; img-src data:; style-src {}; script-src {}{player}; base-uri 'none'; \
         form-action 'none'",
        source(style),
        source(SCRIPT)
    )
}
