//! What is in the mazes of a match at a position.

use wasmouse_core::game::Run;
use wasmouse_core::journal::{Belief, Journal, Note};
use wasmouse_core::maze::{Maze, Metric, distances_to_goal, shortest_path};
use wasmouse_core::playback::{Playback, Position};

use super::super::tui::Scene;
use super::control::{Overlays, Sides};
use super::show::Show;
use crate::report::picture::{Label, Paint, Wall};

/// The true maze.
pub fn of_maze(show: &Show, position: usize, overlays: Overlays) -> Scene {
    let playback = &show.playback;
    let maze = playback.maze();
    let mut scene = Scene::of(maze);
    add_match(&mut scene, playback, position, overlays);
    add_best(&mut scene, maze, playback, overlays);
    if overlays.sides == Sides::Maze && overlays.paint {
        add_marks(&mut scene, playback.journal(), position);
    }
    scene
}

/// What the robot could know, or what it says that it believes.
pub fn of_mind(show: &Show, position: usize, overlays: Overlays) -> Scene {
    let playback = &show.playback;
    let maze = playback.maze();
    let knowledge = playback.knowledge(position);
    let mut scene = Scene::new(maze, |cell, side| wall(knowledge.wall(cell, side)));
    if overlays.beliefs && show.has_beliefs {
        scene = Scene::new(maze, |_, _| Wall::Unknown);
        for note in until(playback.journal(), position) {
            if let Note::Wall { cell, side, belief } = note {
                scene.set_wall(cell, side, wall(belief));
            }
        }
        let false_ones = playback.audit().contradictions.iter();
        for claim in false_ones.filter(|it| it.step as usize <= position) {
            // It may have been corrected since.
            let is_held = scene.wall(claim.cell, claim.side) == wall(claim.belief);
            if let Some(mark) = scene.mark_mut(claim.cell).filter(|_| is_held) {
                mark.flagged = true;
            }
        }
    }
    add_match(&mut scene, playback, position, overlays);
    add_best(&mut scene, &knowledge.optimistic(), playback, overlays);
    if overlays.paint {
        add_marks(&mut scene, playback.journal(), position);
    }
    scene
}

const fn wall(belief: Belief) -> Wall {
    match belief {
        Belief::Unknown => Wall::Unknown,
        Belief::Open => Wall::Open,
        Belief::Closed => Wall::Closed,
    }
}

/// Adds the robot, its path in the speed run, and where it has been.
fn add_match(scene: &mut Scene, playback: &Playback, position: usize, overlays: Overlays) {
    let at: Position = playback.at(position);
    scene.robot = Some((at.cell, at.heading));
    // A path that crosses itself many times hides more than it shows.
    if at.run == Run::Speed {
        scene.set_path(&playback.stops(position));
    }
    if overlays.heat {
        scene.set_heat(&playback.visits(position));
    }
}

/// Adds the best path of a maze, and how far its cells are from the goal.
fn add_best(scene: &mut Scene, maze: &Maze, playback: &Playback, overlays: Overlays) {
    let longest_move = playback.rules().longest_move;
    let metric = Metric::Steps { longest_move };
    if overlays.path
        && let Some(path) = shortest_path(maze, metric)
    {
        scene.set_optimum(path.stops());
    }
    if overlays.numbers {
        let distances = distances_to_goal(maze, metric);
        for cell in maze.walls().cells() {
            if let Some(mark) = scene.mark_mut(cell) {
                mark.number = distances.get(cell);
            }
        }
    }
}

/// Adds what the robot has painted and labelled.
fn add_marks(scene: &mut Scene, journal: &Journal, position: usize) {
    for note in until(journal, position) {
        match note {
            Note::Paint { cell, color } => {
                if let Some(mark) = scene.mark_mut(cell) {
                    mark.paint = Paint::of(color);
                }
            }
            Note::Label { cell, text } => {
                if let Some(mark) = scene.mark_mut(cell) {
                    mark.label = Label::new(text);
                }
            }
            Note::Log { .. } | Note::Wall { .. } => {}
        }
    }
}

fn until(journal: &Journal, position: usize) -> impl Iterator<Item = Note<'_>> {
    let entries = journal.entries();
    entries
        .filter(move |entry| entry.step as usize <= position)
        .map(|entry| entry.note)
}
