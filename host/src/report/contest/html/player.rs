//! The player: the section of the page, and the data that its script reads.
//!
//! The script and the core that it runs are made of `host/web` by `cargo xtask web`. `docs/PAGE.md`
//! describes the form of the data. It consists of ASCII characters without `<`, so that it can be
//! the text of an element, and nothing that escapes the page once more changes it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;

use data_encoding::BASE64;
use flate2::Compression;
use flate2::write::GzEncoder;
use maud::{Markup, PreEscaped, html};
use serde::Serialize;
use wasmouse_core::game::{BudgetScope, GameRules};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::{Ending, Transcript};

use crate::report::contest::playable::Place;
use crate::report::contest::view::View;

/// The script of the player.
pub(super) const SCRIPT: &str = include_str!("../../../../web/prebuilt/player.js");

/// The style sheet of the player.
pub(super) const STYLE: &str = include_str!("../../../../web/prebuilt/player.css");

/// The core as a module of WebAssembly.
const CORE: &[u8] = include_bytes!("../../../../web/prebuilt/core.wasm");

/// The version of the form of the data.
const VERSION: u32 = 1;

/// The matches that the page can play, in the form that its script reads.
pub(super) struct Player {
    index: String,
    bytes: Vec<u8>,
    /// By match, its position in the data.
    positions: BTreeMap<Place, usize>,
    left_out: bool,
}

/// What the bytes are, and what everything is called.
#[derive(Serialize)]
struct Index<'a> {
    version: u32,
    /// Budget, budget scope, longest move, divisor.
    rules: [u32; 4],
    robots: Vec<GuestStr<'a>>,
    /// The name, and the length of the identity bytes.
    mazes: Vec<(GuestStr<'a>, usize)>,
    /// In decimal, because they can be larger than the numbers of a script.
    seeds: Vec<String>,
    /// The indices of robot, maze and seed, and the length of the transcript.
    matches: Vec<(usize, usize, usize, usize)>,
}

impl Player {
    /// The matches of robots and mazes that are shown; `None` if there are none.
    pub(super) fn new(view: &View<'_>) -> Option<Self> {
        let playable = &view.report.playable;
        let is_shown =
            |it: &Place| view.robots.contains(&it.robot) && view.mazes.contains(&it.maze);
        let matches: Vec<(Place, &Transcript)> =
            playable.matches().filter(|(it, _)| is_shown(it)).collect();
        if matches.is_empty() {
            return None;
        }
        let places = || matches.iter().map(|(place, _)| *place);
        let robots: Vec<usize> = (view.robots.iter().copied())
            .filter(|&robot| places().any(|it| it.robot == robot))
            .collect();
        let mazes = positions(places().map(|it| it.maze));
        let seeds = positions(places().map(|it| it.seed));
        let mut bytes = Vec::new();
        let maze = |(&index, _): (&usize, &usize)| {
            let identity = playable.maze(index);
            bytes.extend_from_slice(identity);
            (view.maze(index).name.as_guest(), identity.len())
        };
        let maze_entries = mazes.iter().map(maze).collect();
        let robot_positions: BTreeMap<usize, usize> =
            (0..).zip(&robots).map(|(at, &it)| (it, at)).collect();
        let entry = |&(place, transcript): &(Place, &Transcript)| {
            let transcript = bytes_of(transcript, view.report.options.hide_names);
            bytes.extend_from_slice(&transcript);
            let robot = robot_positions[&place.robot];
            (
                robot,
                mazes[&place.maze],
                seeds[&place.seed],
                transcript.len(),
            )
        };
        let entries = matches.iter().map(entry).collect();
        let index = Index {
            version: VERSION,
            rules: numbers(&view.matrix().rules.game),
            robots: robots.iter().map(|&robot| view.name(robot)).collect(),
            mazes: maze_entries,
            seeds: (seeds.keys())
                .map(|&seed| view.matrix().seeds.get(seed).to_string())
                .collect(),
            matches: entries,
        };
        let index = serde_json::to_string(&index).expect("numbers and text have a JSON form");
        Some(Self {
            index: ascii(&index),
            bytes,
            positions: places().zip(0..).collect(),
            left_out: playable.is_full(),
        })
    }

    /// The position of a match in the data, for `data-play`.
    pub(super) fn position(&self, place: Place) -> Option<usize> {
        self.positions.get(&place).copied()
    }

    /// The position of a robot's match with the smallest regret; without a finished one, of its
    /// first.
    pub(super) fn best(&self, view: &View<'_>, robot: usize) -> Option<usize> {
        let matrix = view.matrix();
        let regret = |place: &Place| {
            let played = matrix.get(robot, place.maze, place.seed)?;
            let score = played.score(&matrix.rules)?.thousandths();
            let oracle = view.maze(place.maze).oracle?.thousandths();
            Some(score.saturating_sub(oracle))
        };
        let of_robot = self.positions.iter().filter(|(it, _)| it.robot == robot);
        of_robot
            .min_by_key(|(place, position)| (regret(place).unwrap_or(u64::MAX), **position))
            .map(|(_, position)| *position)
    }

    /// The section that the script fills.
    pub(super) fn section(&self, view: &View<'_>) -> Markup {
        let played = view.matches_played();
        let here = self.positions.len() as u64;
        html! {
            p { "Follow a link in a table or below a picture, or choose a match here. The page \
                 replays it step by step with the core of wasmouse, from the robot's actions alone, \
                 and opens replay files." }
            @if here < played {
                p.note {
                    "Here: " (here) " of " (played) " matches"
                    @if self.left_out { ", because a page with all would be too large" }
                    @else { "; the transcripts of the others were not kept" }
                    "."
                }
            }
            div id="wasmouse-player" { noscript { p.notice { "Watching matches needs JavaScript." } } }
        }
    }

    /// The data of the script, each part as the text of an element.
    pub(super) fn data(&self) -> Markup {
        html! {
            script type="application/json" id="wasmouse-index" { (PreEscaped(&self.index)) }
            script type="text/plain" id="wasmouse-bytes" { (PreEscaped(packed(&self.bytes))) }
            script type="text/plain" id="wasmouse-core" { (PreEscaped(packed(CORE))) }
        }
    }
}

/// Different numbers in order, each with its position.
fn positions<T: Ord>(numbers: impl Iterator<Item = T>) -> BTreeMap<T, usize> {
    let numbers: std::collections::BTreeSet<T> = numbers.collect();
    numbers.into_iter().zip(0..).collect()
}

/// The bytes of a transcript, without what the robot wrote when it failed if names are hidden.
fn bytes_of(transcript: &Transcript, hides_text: bool) -> Vec<u8> {
    match transcript.ending() {
        Ending::Fault { kind, phase, .. } if hides_text => {
            let mut silent = transcript.clone();
            silent.end_with_fault(*kind, *phase, String::new());
            silent.to_bytes()
        }
        _ => transcript.to_bytes(),
    }
}

fn numbers(rules: &GameRules) -> [u32; 4] {
    let scope = match rules.budget_scope {
        BudgetScope::BothRuns => 0,
        BudgetScope::EachRun => 1,
    };
    [
        rules.budget,
        scope,
        u32::from(rules.longest_move),
        rules.exploration_divisor,
    ]
}

/// The same JSON of ASCII characters without `<`, which only occurs in its strings.
fn ascii(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for character in json.chars() {
        if character.is_ascii() && character != '<' {
            text.push(character);
            continue;
        }
        for unit in character.encode_utf16(&mut [0; 2]) {
            write!(text, "\\u{unit:04x}").expect("writing to a string");
        }
    }
    text
}

/// In base64, compressed by gzip.
fn packed(bytes: &[u8]) -> String {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    BASE64.encode(&written.expect("writing to memory"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::escape::for_terminal;

    #[test]
    fn the_index_stays_the_same_json() {
        let names = ["</script>", "a\u{202e}\u{1f600}", "\u{1b}[31m", "plain"];
        let json = serde_json::to_string(&names).expect("text");
        let escaped = ascii(&json);
        assert!(escaped.is_ascii() && !escaped.contains('<'), "{escaped}");
        assert_eq!(for_terminal(&escaped), escaped);
        let parsed: Vec<String> = serde_json::from_str(&escaped).expect("JSON");
        assert_eq!(parsed, names);
    }

    #[test]
    fn what_a_robot_wrote_is_left_out_with_its_name() {
        use wasmouse_core::game::{Action, FaultKind, Phase};
        let mut transcript = Transcript::default();
        transcript.push(Action::Reset);
        let detail = "I am Ann's robot".to_owned();
        transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, detail.clone());
        assert_eq!(bytes_of(&transcript, false), transcript.to_bytes());
        let silent = bytes_of(&transcript, true);
        assert_eq!(silent.len() + detail.len(), transcript.to_bytes().len());
        let silent = Transcript::from_bytes(&silent).expect("a transcript");
        assert!(silent.actions().eq(transcript.actions()));
    }

    /// The policy of the page names their digests, and the page is escaped line by line when it is
    /// written.
    #[test]
    fn nothing_in_the_script_would_be_escaped() {
        for text in [SCRIPT, STYLE] {
            assert!(text.lines().all(|line| for_terminal(line) == line));
            assert!(!text.contains("</"), "it would end its element");
        }
    }
}
