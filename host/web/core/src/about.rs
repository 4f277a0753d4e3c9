//! [`About`]: what does not change while a match is watched.

use serde::Serialize;
use wasmouse_core::game::{GameRules, Verdict};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Belief, Color, Level, Note};
use wasmouse_core::maze::{Heading, Maze, oracle_steps};
use wasmouse_core::playback::{MilestoneKind, Playback};
use wasmouse_core::{Digest, GuestText};

/// Notes of a journal that a page gets, at most.
pub const NOTES_MAX: usize = 200_000;

/// What a replay file says about its match.
#[derive(Clone, Debug, Serialize)]
pub struct Origin {
    /// The name of the robot.
    pub robot: GuestText,
    /// The name of the maze.
    pub maze: GuestText,
    /// The seed, in decimal: it may be larger than the numbers of JavaScript.
    pub seed: String,
}

/// What does not change while a match is watched.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct About<'a> {
    origin: Option<&'a Origin>,
    dimension: u8,
    start: [u8; 2],
    /// x, y, width and height.
    goal: [u8; 4],
    /// By cell, the sum of 1 up, 2 right, 4 down and 8 left for sides that are open.
    walls: Vec<u8>,
    /// Identifies the maze: only robots in the same one can be compared.
    maze_digest: Digest,
    rules: &'a GameRules,
    /// The last position.
    last: usize,
    exploration_steps: u32,
    speed_steps: u32,
    /// In a few words.
    verdict: String,
    /// The robot's message, if it failed.
    fault: Option<GuestStr<'a>>,
    score: Option<String>,
    /// Of a robot that knows the maze.
    oracle_score: Option<String>,
    oracle_speed_steps: Option<u32>,
    /// Position and name.
    milestones: Vec<(usize, &'static str)>,
    certain_at: Option<usize>,
    /// With the last reading before the reset: optimistic and pessimistic.
    at_reset: Option<[Option<u32>; 2]>,
    idle_steps: u32,
    /// Exploration run and speed run.
    regret: Option<[u32; 2]>,
    contradictions: usize,
    notes: Vec<PageNote<'a>>,
    notes_left_out: u64,
    /// Of the trace, in the form of a SHA-256.
    trace_digest: Digest,
}

/// A note of the journal: the step and what it says.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum PageNote<'a> {
    Log(usize, &'static str, &'static str, GuestStr<'a>),
    Paint(usize, &'static str, u8, u8, &'static str),
    Label(usize, &'static str, u8, u8, GuestStr<'a>),
    Wall(usize, &'static str, u8, u8, u8, u8),
}

impl<'a> About<'a> {
    /// What there is to say about a match.
    pub(crate) fn new(playback: &'a Playback, origin: Option<&'a Origin>) -> Self {
        let (maze, rules, audit) = (playback.maze(), playback.rules(), playback.audit());
        let (walls, goal, start) = (maze.walls(), maze.goal(), maze.start());
        let verdict = playback.verdict();
        let steps = playback.at(playback.last()).steps;
        let milestones = playback.milestones().iter();
        Self {
            origin,
            dimension: maze.dimension(),
            start: [start.x, start.y],
            goal: [
                goal.origin().x,
                goal.origin().y,
                goal.width(),
                goal.height(),
            ],
            walls: walls.cells().map(|cell| walls.value(cell)).collect(),
            maze_digest: maze.digest(),
            rules,
            last: playback.last(),
            exploration_steps: steps.exploration,
            speed_steps: steps.speed,
            verdict: verdict.title().into_owned(),
            fault: verdict.fault().map(|it| it.detail.as_guest()),
            score: score(verdict),
            oracle_score: rules.oracle_score(maze).map(|it| it.to_string()),
            oracle_speed_steps: oracle(maze, rules),
            milestones: milestones
                .map(|it| (it.position, MilestoneKind::name(it.kind)))
                .collect(),
            certain_at: audit.certain_at,
            at_reset: audit.at_reset.map(|it| [it.optimistic, it.pessimistic]),
            idle_steps: audit.idle_steps,
            regret: audit
                .regret
                .map(|it| [it.exploration_steps, it.speed_steps]),
            contradictions: audit.contradictions.len(),
            notes: notes(playback),
            notes_left_out: playback.journal().dropped()
                + playback.journal().len().saturating_sub(NOTES_MAX) as u64,
            trace_digest: playback.trace_digest(),
        }
    }
}

fn score(verdict: &Verdict) -> Option<String> {
    verdict.score().map(|it| it.to_string())
}

fn oracle(maze: &Maze, rules: &GameRules) -> Option<u32> {
    oracle_steps(maze, rules.longest_move).map(|it| it.speed_steps)
}

fn notes(playback: &Playback) -> Vec<PageNote<'_>> {
    let walls = playback.maze().walls();
    let entries = playback.journal().entries().take(NOTES_MAX);
    entries
        .filter_map(|entry| {
            let step = entry.step as usize;
            Some(match entry.note {
                Note::Log { level, text } => PageNote::Log(step, "log", level_name(level), text),
                Note::Paint { cell, color } if walls.contains(cell) => {
                    PageNote::Paint(step, "paint", cell.x, cell.y, color_name(color))
                }
                Note::Label { cell, text } if walls.contains(cell) => {
                    PageNote::Label(step, "label", cell.x, cell.y, text)
                }
                Note::Wall { cell, side, belief } if walls.contains(cell) => {
                    let belief = match belief {
                        Belief::Unknown => 0,
                        Belief::Open => 1,
                        Belief::Closed => 2,
                    };
                    PageNote::Wall(step, "wall", cell.x, cell.y, heading(side), belief)
                }
                Note::Paint { .. } | Note::Label { .. } | Note::Wall { .. } => return None,
            })
        })
        .collect()
}

const fn heading(side: Heading) -> u8 {
    side as u8
}

const fn level_name(level: Level) -> &'static str {
    match level {
        Level::Debug => "debug",
        Level::Info => "info",
        Level::Warning => "warning",
        Level::Error => "error",
    }
}

const fn color_name(color: Color) -> &'static str {
    match color {
        Color::None => "none",
        Color::Red => "red",
        Color::Orange => "orange",
        Color::Yellow => "yellow",
        Color::Green => "green",
        Color::Cyan => "cyan",
        Color::Blue => "blue",
        Color::Violet => "violet",
        Color::Gray => "gray",
    }
}
