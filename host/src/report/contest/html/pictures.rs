//! Pictures of matches: the optimal path, and what the robot did.

use std::collections::BTreeMap;

use maud::{Markup, PreEscaped, html};

use super::parts::shown;
use super::player::Player;
use crate::report::contest::address::Addresses;
use crate::report::contest::picture::MatchPicture;
use crate::report::contest::playable::Place;
use crate::report::contest::view::View;
use crate::report::contest::words;
use wasmouse_core::guest_text;

/// The best matches; `None` if there is none to show.
pub(super) fn best(view: &View<'_>, player: Option<&Player>) -> Option<Markup> {
    let pictures = visible(view, &view.report.pictures.best);
    (!pictures.is_empty()).then(|| {
        html! {
            p { "The match with the smallest regret. " (key()) }
            div.panels { @for picture in pictures { (figure(view, player, picture, true)) } }
        }
    })
}

/// The matches in the hardest mazes, maze by maze; `None` if there is none to show.
pub(super) fn hardest(view: &View<'_>, player: Option<&Player>) -> Option<Markup> {
    let pictures = visible(view, &view.report.pictures.hardest);
    let mut by_maze: BTreeMap<usize, Vec<&MatchPicture>> = BTreeMap::new();
    for picture in pictures {
        by_maze.entry(picture.maze).or_default().push(picture);
    }
    (!by_maze.is_empty()).then(|| {
        html! {
            p { "The mazes in which the robots' regrets add up to most. " (key()) }
            @for (maze, pictures) in by_maze {
                @let maze = view.maze(maze);
                h3 { (shown(&maze.name)) }
                p.quiet {
                    (maze.dimension) " x " (maze.dimension) " cells"
                    @if let Some(oracle) = maze.oracle { ", oracle score " (oracle) }
                }
                div.panels { @for picture in pictures { (figure(view, player, picture, false)) } }
            }
        }
    })
}

const fn key() -> &'static str {
    "Wide green line: an optimal path. Blue line: the speed run, with a dot where a step ended; \
     without a speed run, the exploration run. Red shade: how often the exploration run stopped \
     in a cell."
}

/// The pictures of robots and mazes that are shown, the best robots first.
fn visible<'a>(view: &View<'_>, pictures: &'a [MatchPicture]) -> Vec<&'a MatchPicture> {
    let place = |picture: &MatchPicture| view.robots.iter().position(|&it| it == picture.robot);
    let is_shown = |it: &&MatchPicture| place(it).is_some() && view.mazes.contains(&it.maze);
    let mut pictures: Vec<&MatchPicture> = pictures.iter().filter(is_shown).collect();
    pictures.sort_by_key(|it| place(it));
    pictures
}

fn figure(
    view: &View<'_>,
    player: Option<&Player>,
    picture: &MatchPicture,
    names_maze: bool,
) -> Markup {
    let MatchPicture {
        robot,
        maze,
        seed,
        picture,
    } = picture;
    let (name, maze_name) = (view.name(*robot), &view.maze(*maze).name);
    let mut picture = picture.clone();
    picture.set_title(&guest_text!("{} in {}", name, maze_name));
    let played = view.matrix().get(*robot, *maze, *seed);
    let address = (!view.report.options.hide_names)
        .then(|| Addresses::new(view.report).get(*robot, *maze, *seed));
    let place = Place {
        maze: *maze,
        robot: *robot,
        seed: *seed,
    };
    let play = player.and_then(|it| it.position(place));
    html! {
        figure data-match=[address] data-play=[play] {
            (PreEscaped(picture.to_svg_element()))
            figcaption {
                strong { (shown(name)) }
                @if names_maze { " in " (shown(maze_name)) }
                @if let Some(played) = played {
                    ": "
                    @match played.score(&view.matrix().rules) {
                        Some(score) => { "score " (score) },
                        None => { (words::outcome(played)) },
                    }
                    " (" (played.steps.exploration) " + " (played.steps.speed) " steps)"
                }
            }
        }
    }
}
