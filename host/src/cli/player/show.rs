//! [`Show`]: a match to show.

use wasmouse_core::GuestText;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::Note;
use wasmouse_core::playback::{MilestoneKind, Playback};

/// A match to show, with the names of robot and maze.
#[derive(Clone, Debug)]
pub struct Show {
    pub(super) robot: GuestText,
    pub(super) maze: GuestText,
    pub(super) playback: Playback,
    /// Whether the robot says what it believes about walls.
    pub(super) has_beliefs: bool,
    /// Positions to jump to, in order.
    pub(super) marks: Vec<(usize, MilestoneKind)>,
}

impl Show {
    /// A match of that robot in that maze.
    pub fn new<'a>(
        robot: impl Into<GuestStr<'a>>,
        maze: impl Into<GuestStr<'a>>,
        playback: Playback,
    ) -> Self {
        let has_beliefs = playback
            .journal()
            .entries()
            .any(|entry| matches!(entry.note, Note::Wall { .. }));
        Self {
            robot: robot.into().into(),
            maze: maze.into().into(),
            has_beliefs,
            marks: marks(&playback),
            playback,
        }
    }

    /// The last position.
    pub(super) fn last(&self) -> usize {
        self.playback.last()
    }
}

/// The milestones; of bumps and the like only the first between others, because a robot can bump a
/// thousand times.
fn marks(playback: &Playback) -> Vec<(usize, MilestoneKind)> {
    let mut seen = Vec::new();
    let mut marks = Vec::new();
    for milestone in playback.milestones() {
        let kind = milestone.kind;
        if !is_small(kind) {
            seen.clear();
        } else if seen.contains(&kind) {
            continue;
        } else {
            seen.push(kind);
        }
        marks.push((milestone.position, kind));
    }
    marks
}

const fn is_small(kind: MilestoneKind) -> bool {
    matches!(
        kind,
        MilestoneKind::Bump | MilestoneKind::Clamp | MilestoneKind::IgnoredReset
    )
}

#[cfg(test)]
pub(super) mod tests {
    use wasmouse_core::game::{Action, FaultKind, GameRules, Phase};
    use wasmouse_core::journal::{Belief, Color, Journal, Level};
    use wasmouse_core::maze::{
        Cell, Heading, Maze, Metric, Path, Turn, bundled, format, shortest_path,
    };
    use wasmouse_core::record::{Transcript, trace};

    use super::*;

    fn maze() -> Maze {
        format::parse(bundled()[0].text).expect("a maze").maze
    }

    fn turn(from: Heading, to: Heading) -> Turn {
        let turns = [Turn::Left, Turn::Straight, Turn::Right];
        let found = turns.into_iter().find(|&turn| from.turned(turn) == to);
        found.expect("no path turns back")
    }

    const fn drive(turn: Turn, advance: i8) -> Action {
        Action::Move { turn, advance }
    }

    fn along(path: &Path, heading: &mut Heading, cell_by_cell: bool, actions: &mut Vec<Action>) {
        for (to, cells) in path.moves() {
            let first = turn(*heading, to);
            *heading = to;
            let cells = i8::try_from(cells).expect("at most three");
            if cell_by_cell {
                actions.push(drive(first, 1));
                actions.extend((1..cells).map(|_| drive(Turn::Straight, 1)));
            } else {
                actions.push(drive(first, cells));
            }
        }
    }

    fn playback(actions: Vec<Action>, fault: Option<&str>, journal: Journal) -> Playback {
        let rules = GameRules::default();
        let mut transcript = Transcript::default();
        for action in actions {
            transcript.push(action);
        }
        if let Some(detail) = fault {
            transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, detail.to_owned());
        }
        let maze = maze();
        let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
        Playback::new(maze, rules, trace, result.verdict, journal)
    }

    /// A robot that drives to the goal and back cell by cell, and then finishes.
    pub fn explorer() -> Show {
        let maze = maze();
        let path = shortest_path(&maze, Metric::STEPS).expect("a path");
        let mut actions = Vec::new();
        let mut heading = Heading::Up;
        along(&path, &mut heading, true, &mut actions);
        let there: Vec<Heading> = path
            .moves()
            .flat_map(|(heading, cells)| vec![heading; usize::from(cells)])
            .collect();
        actions.push(drive(Turn::Left, 0));
        heading = heading.turned(Turn::Left);
        for back in there.iter().rev().map(|it| it.opposite()) {
            actions.push(drive(turn(heading, back), 1));
            heading = back;
        }
        actions.push(Action::Reset);
        along(&path, &mut Heading::Up.clone(), false, &mut actions);
        let mut journal = Journal::default();
        journal.clear(100_000);
        for (at, stop) in path.trail().into_iter().enumerate() {
            let step = u32::try_from(at).expect("a few");
            let label = step.to_string();
            journal.push(
                step,
                Note::Label {
                    cell: stop,
                    text: GuestStr::from(&label),
                },
            );
            let color = match at % 3 {
                0 => Color::Red,
                1 => Color::None,
                _ => Color::Blue,
            };
            journal.push(step, Note::Paint { cell: stop, color });
            for side in Heading::ALL {
                // It is wrong about one wall.
                let open = maze.walls().is_open(stop, side) != (at == 5 && side == Heading::Up);
                let belief = if open { Belief::Open } else { Belief::Closed };
                journal.push(
                    step,
                    Note::Wall {
                        cell: stop,
                        side,
                        belief,
                    },
                );
            }
            if at % 10 == 0 {
                let text = format!("{at} cells from the start");
                let level = if at == 20 {
                    Level::Warning
                } else {
                    Level::Info
                };
                journal.push(
                    step,
                    Note::Log {
                        level,
                        text: GuestStr::from(&text),
                    },
                );
            }
        }
        Show::new("explorer", "test_maze_01", playback(actions, None, journal))
    }

    /// A robot that never reaches the goal: it bumps, and its resets are ignored.
    pub fn lost() -> Show {
        let pattern = [
            drive(Turn::Straight, 3),
            drive(Turn::Right, 2),
            Action::Reset,
            drive(Turn::Left, -1),
            drive(Turn::Left, 9),
        ];
        let actions = pattern.into_iter().cycle().take(1000).collect();
        Show::new(
            "lost",
            "test_maze_01",
            playback(actions, None, Journal::default()),
        )
    }

    /// A robot that tries to control the terminal with everything that it can name.
    pub fn hostile() -> Show {
        let evil = "\u{1b}[2J\u{1b}]0;owned\u{7}\u{202e}\r\n\u{9b}31m\u{feff}e\u{301}\u{1f1e9}\u{1f1ea}\u{8ff7}\t";
        let long = format!("{evil}{}", "x".repeat(10_000));
        let mut journal = Journal::default();
        journal.clear(1_000_000);
        let cell = Cell::new(0, 1);
        for step in 0..5 {
            let level = Level::Error;
            journal.push(
                step,
                Note::Log {
                    level,
                    text: GuestStr::from(&long),
                },
            );
            journal.push(
                step,
                Note::Label {
                    cell,
                    text: evil.into(),
                },
            );
            let cell = Cell::new(200, 255);
            journal.push(
                step,
                Note::Label {
                    cell,
                    text: evil.into(),
                },
            );
            let (side, belief) = (Heading::Right, Belief::Closed);
            journal.push(step, Note::Wall { cell, side, belief });
        }
        let actions = vec![drive(Turn::Straight, 1); 5];
        let robot = format!("{evil}robot{}", "y".repeat(300));
        Show::new(&robot, &long, playback(actions, Some(&long), journal))
    }

    #[test]
    fn only_the_first_bump_is_marked() {
        use MilestoneKind::{Bump, Clamp, End, IgnoredReset};
        assert!(lost().playback.milestones().len() > 500);
        let kinds: Vec<MilestoneKind> = lost().marks.iter().map(|it| it.1).collect();
        assert_eq!(kinds, [Bump, IgnoredReset, Clamp, End]);
    }
}
