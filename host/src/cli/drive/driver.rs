//! [`Driver`]: a match in progress, and what keys do in it.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use wasmouse_core::GuestText;
use wasmouse_core::game::{Action, BudgetScope, GameRules, Score, Simulation, Trace, Verdict};
use wasmouse_core::knowledge::Knowledge;
use wasmouse_core::maze::{Cell, Maze, Turn};

use super::super::tui::{Camera, Flow, Look, Zoom};

/// A match that is steered by hand.
pub struct Driver<'a> {
    /// What the maze is called.
    pub name: GuestText,
    /// The rules.
    pub rules: &'a GameRules,
    /// The score of a robot that knows the maze; only shown at the end.
    pub oracle: Option<Score>,
    /// The match. Only its readings may be shown, and what follows from the driver's moves.
    pub simulation: Simulation<'a>,
    /// All steps so far.
    pub trace: Trace,
    /// What the readings have shown.
    pub knowledge: Knowledge,
    /// Where the steps of the run in progress ended.
    pub stops: Vec<Cell>,
    /// Cells that the next move drives, from 0 to the longest move.
    pub cells: u8,
    /// Whether it drives them backwards.
    pub backwards: bool,
    /// Whether there is a map.
    pub has_map: bool,
    /// Whether the map shows the best path that may exist.
    pub path: bool,
    /// Whether the keys are explained.
    pub help: bool,
    /// Whether the driver was asked to give up.
    pub asking: bool,
    /// Whether the driver wants to watch the match.
    pub wants_to_watch: bool,
    /// Characters and colours.
    pub look: Look,
    /// Which part of the map is shown.
    pub camera: Camera,
    /// The size of the cells that were drawn last.
    pub zoom: Zoom,
}

impl<'a> Driver<'a> {
    /// A match before its first step.
    pub fn new(
        name: impl Into<GuestText>,
        maze: &'a Maze,
        rules: &'a GameRules,
        look: Look,
    ) -> Self {
        let mut driver = Self {
            name: name.into(),
            rules,
            oracle: rules.oracle_score(maze),
            simulation: Simulation::new(maze, rules),
            trace: Trace::default(),
            knowledge: Knowledge::of_nothing(maze),
            stops: vec![maze.start()],
            cells: 1,
            backwards: false,
            has_map: true,
            path: false,
            help: false,
            asking: false,
            wants_to_watch: false,
            look,
            camera: Camera::default(),
            zoom: Zoom::Small,
        };
        driver.sense();
        driver
    }

    /// How the match ended; `None` if it has not.
    pub fn verdict(&self) -> Option<Verdict> {
        self.simulation.verdict()
    }

    /// A robot gets no reading after the end of its match.
    fn sense(&mut self) {
        if !self.simulation.has_ended() {
            let (cell, heading) = (self.simulation.cell(), self.simulation.heading());
            self.knowledge.see(cell, heading, self.simulation.sense());
        }
    }

    fn step(&mut self, action: Action) {
        if self.simulation.has_ended() {
            return;
        }
        let run = self.simulation.run();
        self.trace.apply(&mut self.simulation, action);
        if let Some(step) = self.trace.steps().last() {
            self.knowledge.drive(step);
        }
        let cell = self.simulation.cell();
        if self.simulation.run() != run {
            self.stops = vec![cell];
        } else if self.stops.last() != Some(&cell) {
            self.stops.push(cell);
        }
        self.sense();
        self.camera.follow();
    }

    fn drive(&mut self, turn: Turn, backwards: bool) {
        let cells = i8::try_from(self.cells).unwrap_or(i8::MAX);
        let advance = if backwards { -cells } else { cells };
        self.step(Action::Move { turn, advance });
    }

    /// What a key does.
    pub fn key(&mut self, key: KeyEvent) -> Flow {
        if self.help {
            self.help = false;
            return Flow::Go;
        }
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        if self.asking {
            return match key.code {
                KeyCode::Char('y') => Flow::End,
                KeyCode::Char('c') if control => Flow::End,
                _ => {
                    self.asking = false;
                    Flow::Go
                }
            };
        }
        match key.code {
            KeyCode::Char('c') if control => return self.quit(),
            KeyCode::Char(_) if control => {}
            KeyCode::Char('q') | KeyCode::Esc => return self.quit(),
            KeyCode::Enter if self.simulation.has_ended() => {
                self.wants_to_watch = true;
                return Flow::End;
            }
            KeyCode::Up | KeyCode::Char('w') => self.drive(Turn::Straight, self.backwards),
            KeyCode::Left | KeyCode::Char('a') => self.drive(Turn::Left, self.backwards),
            KeyCode::Right | KeyCode::Char('d') => self.drive(Turn::Right, self.backwards),
            KeyCode::Down | KeyCode::Char('s') => self.drive(Turn::Straight, true),
            KeyCode::Char('b') => self.backwards = !self.backwards,
            KeyCode::Char('r') => self.step(Action::Reset),
            KeyCode::Char(digit @ '0'..='9') => {
                let cells = digit.to_digit(10).and_then(|it| u8::try_from(it).ok());
                let allowed = cells.filter(|&it| it <= self.rules.longest_move);
                self.cells = allowed.unwrap_or(self.cells);
            }
            KeyCode::Char('o') => self.path = !self.path,
            KeyCode::Char('z') => self.camera.zoom(self.zoom, true),
            KeyCode::Char('Z') => self.camera.zoom(self.zoom, false),
            KeyCode::Char('x') => self.camera.reset(),
            KeyCode::Char('?') | KeyCode::F(1) => self.help = true,
            _ => {}
        }
        Flow::Go
    }

    fn quit(&mut self) -> Flow {
        let has_begun = !self.trace.steps().is_empty();
        if self.simulation.has_ended() || !has_begun {
            return Flow::End;
        }
        self.asking = true;
        Flow::Go
    }
}

/// The run in progress, and the steps that it and the other one have left of the budget.
pub fn budget(driver: &Driver<'_>) -> String {
    let simulation = &driver.simulation;
    let run = simulation.run();
    let used = match driver.rules.budget_scope {
        BudgetScope::BothRuns => simulation.steps().total(),
        BudgetScope::EachRun => simulation.steps().of(run),
    };
    format!(
        "{}, {used} of {} steps used",
        run.name(),
        driver.rules.budget
    )
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::{Event as GameEvent, Run};
    use wasmouse_core::maze::{Metric, Walls, bundled, format, shortest_path};

    use super::super::super::tui::testing::press;
    use super::*;
    use crate::report::picture::Charset;

    const PLAIN: Look = Look {
        charset: Charset::Unicode,
        color: false,
    };

    #[test]
    fn keys_are_steps_of_the_game() {
        let maze = Maze::contest(Walls::open(6)).expect("start and goal fit");
        let rules = GameRules::default();
        let mut driver = Driver::new("open", &maze, &rules, PLAIN);
        press(&mut driver, "3<up>2<right>1<left>s0ab2dr9<up>");
        let steps: Vec<Action> = driver.trace.steps().iter().map(|it| it.action).collect();
        let drive = |turn, advance| Action::Move { turn, advance };
        assert_eq!(
            steps,
            [
                drive(Turn::Straight, 3),
                drive(Turn::Right, 2),
                drive(Turn::Left, 1),
                drive(Turn::Straight, -1),
                drive(Turn::Left, 0),
                drive(Turn::Right, -2),
                Action::Reset,
                drive(Turn::Straight, -2),
            ]
        );
        let ignored = driver.trace.steps()[6].event;
        assert_eq!(ignored, GameEvent::Reset, "(2, 3) is in the goal");
        assert_eq!(driver.simulation.run(), Run::Speed);
    }

    /// The official maze, driven as an oracle would.
    #[test]
    fn a_match_that_is_driven_scores_like_one_that_is_played() {
        let maze = format::parse(bundled()[0].text).expect("a maze").maze;
        let rules = GameRules::default();
        let mut driver = Driver::new("maze", &maze, &rules, PLAIN);
        let path = shortest_path(&maze, Metric::STEPS).expect("a path");
        for _ in 0..2 {
            for (heading, cells) in path.moves() {
                let turns = [(Turn::Left, 'a'), (Turn::Straight, 'w'), (Turn::Right, 'd')];
                let at = driver.simulation.heading();
                let turn = turns.iter().find(|it| at.turned(it.0) == heading);
                let keys = format!("{cells}{}", turn.expect("no turning back").1);
                press(&mut driver, &keys);
            }
            press(&mut driver, "r");
        }
        let score = driver.verdict().and_then(|it| it.score());
        assert_eq!(score, rules.oracle_score(&maze));
        assert_eq!(
            driver.trace.steps().len(),
            35,
            "keys after the end do nothing"
        );
        assert_eq!(press(&mut driver, "<enter>"), Flow::End);
        assert!(driver.wants_to_watch);
    }

    #[test]
    fn quitting_asks_when_there_is_something_to_lose() {
        let maze = Maze::contest(Walls::open(6)).expect("start and goal fit");
        let rules = GameRules {
            budget: 2,
            ..GameRules::default()
        };
        let mut driver = Driver::new("open", &maze, &rules, PLAIN);
        assert_eq!(press(&mut driver, "q"), Flow::End);
        assert_eq!(press(&mut driver, "wq"), Flow::Go);
        assert_eq!(press(&mut driver, "w"), Flow::Go);
        assert_eq!(driver.trace.steps().len(), 1, "the key was an answer");
        assert_eq!(press(&mut driver, "qy"), Flow::End);
        press(&mut driver, "<esc>n");
        assert_eq!(press(&mut driver, "wq"), Flow::End, "the match is over");
        assert_eq!(
            driver.verdict(),
            Some(Verdict::BudgetUsedUp {
                goal_reached: false
            })
        );
    }

    /// The map has what the readings show, at every step, and nothing else.
    #[test]
    fn the_map_is_what_a_robot_could_know() {
        use wasmouse_core::journal::Journal;
        use wasmouse_core::playback::Playback;
        let maze = format::parse(bundled()[0].text).expect("a maze").maze;
        let rules = GameRules {
            budget: 40,
            ..GameRules::default()
        };
        let mut driver = Driver::new("maze", &maze, &rules, PLAIN);
        let keys = "w2wd3wsar1wd2dwwbaab";
        let mut known = vec![driver.knowledge.clone()];
        while driver.verdict().is_none() {
            for key in keys.chars() {
                let steps = driver.trace.steps().len();
                press(&mut driver, &key.to_string());
                if driver.trace.steps().len() > steps {
                    known.push(driver.knowledge.clone());
                }
            }
        }
        let verdict = driver.verdict().expect("it has ended");
        let trace = driver.trace.clone();
        let playback = Playback::new(maze.clone(), rules, trace, verdict, Journal::default());
        for (position, known) in known.iter().enumerate() {
            assert_eq!(known, &playback.knowledge(position), "at {position}");
        }
    }
}
