//! [`scene`]: a match at a position, with the [`Overlays`] that are wanted.

use wasmouse_core::game::Run;
use wasmouse_core::knowledge::Knowledge;
use wasmouse_core::maze::{
    Distances, Heading, Maze, Metric, distances_from, distances_to_goal, shortest_path,
};
use wasmouse_core::playback::Playback;

use super::journal::{draw_beliefs, draw_marks, has_beliefs, wall};
use crate::report::picture::Picture;

/// Stops of the exploration run that are drawn, at most: a path that crosses itself many times
/// hides more than it shows.
const TRAIL: usize = 20;

/// Visits that make a cell hot, at least: a first visit should look like one.
const HOT_VISITS: u32 = 4;

/// What is drawn besides the maze and the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Overlay {
    /// The path of the speed run, or the last 20 steps of the exploration run.
    Path,
    /// Walls of which the robot cannot know are dots; without it, the whole maze is drawn.
    Knowledge,
    /// Only the walls that the robot says that it believes in, as it says in its journal; others are
    /// dots. Draws the whole maze if the robot says nothing about walls. [`Overlay::Knowledge`]
    /// wins over it.
    Beliefs,
    /// How often the robot was in each cell, as heat.
    Heat,
    /// The least number of steps from the start to each cell, as heat.
    Costs,
    /// The steps from each cell to the goal, as numbers. With [`Overlay::Knowledge`], as if there
    /// were no unknown walls.
    Distances,
    /// An optimal path, below the other one.
    Optimum,
    /// What the robot has painted and labelled.
    Journal,
}

/// A set of overlays. [`Overlay::Heat`] wins over [`Overlay::Costs`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overlays(Vec<Overlay>);

impl FromIterator<Overlay> for Overlays {
    fn from_iter<I: IntoIterator<Item = Overlay>>(overlays: I) -> Self {
        Self(overlays.into_iter().collect())
    }
}

impl Overlays {
    /// Whether it is in the set.
    pub fn has(&self, overlay: Overlay) -> bool {
        self.0.contains(&overlay)
    }
}

/// Draws a match at a position; beyond the last one, at the last.
pub fn scene(playback: &Playback, position: usize, overlays: &Overlays) -> Picture {
    let maze = playback.maze();
    let metric = Metric::Steps {
        longest_move: playback.rules().longest_move,
    };
    let knowledge = overlays
        .has(Overlay::Knowledge)
        .then(|| playback.knowledge(position));
    let journal = playback.journal();
    let mut picture = match &knowledge {
        Some(knowledge) => known(maze, knowledge),
        None if overlays.has(Overlay::Beliefs) && has_beliefs(journal) => {
            let mut picture = Picture::unknown(maze.dimension(), maze.start(), maze.goal());
            draw_beliefs(&mut picture, journal, position);
            picture
        }
        None => Picture::of(maze),
    };
    if overlays.has(Overlay::Heat) {
        let visits = playback.visits(position);
        picture.set_hot(HOT_VISITS);
        for cell in maze.walls().cells() {
            if let Some(mark) = picture.mark_mut(cell) {
                mark.heat = Some(visits[maze.walls().index(cell)]);
            }
        }
    } else if overlays.has(Overlay::Costs) {
        picture.set_heat(&distances_from(maze, maze.start(), metric));
    }
    if overlays.has(Overlay::Distances) {
        let distances: Distances = match &knowledge {
            Some(knowledge) => distances_to_goal(&knowledge.optimistic(), metric),
            None => distances_to_goal(maze, metric),
        };
        picture.set_numbers(&distances);
    }
    if overlays.has(Overlay::Optimum)
        && let Some(path) = shortest_path(maze, metric)
    {
        picture.set_optimum(&path);
    }
    let at = playback.at(position);
    if overlays.has(Overlay::Path) {
        let stops = playback.stops(position);
        let first = match at.run {
            Run::Exploration => stops.len().saturating_sub(TRAIL + 1),
            Run::Speed => 0,
        };
        picture.set_stops(&stops[first..]);
    }
    if overlays.has(Overlay::Journal) {
        draw_marks(&mut picture, journal, position);
    }
    picture.set_robot(at.cell, at.heading);
    picture
}

fn known(maze: &Maze, knowledge: &Knowledge) -> Picture {
    let mut picture = Picture::unknown(maze.dimension(), maze.start(), maze.goal());
    for cell in maze.walls().cells() {
        for side in [Heading::Up, Heading::Right] {
            picture.set_wall(cell, side, wall(knowledge.wall(cell, side)));
        }
    }
    picture
}
