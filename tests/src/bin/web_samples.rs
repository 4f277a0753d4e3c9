//! `web-samples FOLDER`: writes what the browser tests of web pages open (`host/web/tests`).
//!
//! The variable `WASMOUSE` names the program that plays matches.

use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::{env, fs, io};

use serde_json::{Value, json};
use wasmouse::contest::{
    MatchScore, MatrixMaze, MatrixRobot, Outcome, ScoreMatrix, Scoring, Seeds,
};
use wasmouse::report::contest::{ContestReport, Place, Playable, ReportOptions, html};
use wasmouse_core::Digest;
use wasmouse_core::game::{Action, FaultKind, GameRules, Phase, Ruleset, Simulation};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Belief, Color, Journal, Level, Note};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Cell, Heading, Maze, Turn};
use wasmouse_core::record::{
    EngineId, FuelUse, MatchKey, MatchRecord, Transcript, Usage, replay, trace,
};
use wasmouse_core::replay::{Replay, ReplayParts};

/// Random transcripts.
const TRANSCRIPTS: u64 = 100;

/// Text that would be markup, script, a control sequence or another line wherever it is not shown
/// as text.
const HOSTILE: &str = "</script><script>document.title='owned'</script><img src=x \
    onerror=\"document.title='owned'\">\u{1b}[31m\u{202e}\"'&`${7*7}{{7*7}}\u{2028}\u{0}%2F/#+\u{fffd}";

fn main() -> ExitCode {
    let Some(folder) = env::args_os().nth(1) else {
        eprintln!("usage: web-samples FOLDER");
        return ExitCode::FAILURE;
    };
    match write(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("web-samples: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let transcripts: Vec<Value> = (0..TRANSCRIPTS).map(random_match).collect();
    fs::write(
        folder.join("transcripts.json"),
        serde_json::to_vec(&transcripts)?,
    )?;
    fs::write(folder.join("hostile.html"), hostile_page())?;
    for (name, robot, maze, note) in [
        ("good", "mouse", "hall", "all is well"),
        ("other", "rat", "hall", "slower"),
        ("hostile", HOSTILE, HOSTILE, HOSTILE),
    ] {
        let replay = sample_replay(robot, maze, note, name == "other");
        let path = folder.join(format!("{name}.replay.json"));
        fs::write(path, serde_json::to_vec(&replay)?)?;
    }
    let robots = "flood champion minnett count-expansion wall-follower";
    play(folder, "contest.html", robots)?;
    play(
        folder,
        "small.html",
        "flood wall-follower gen:tree:12:1..=2",
    )?;
    play(folder, "one.html", "wall-follower gen:tree:16:3")?;
    let robots = "flood champion minnett count-expansion dfs";
    play(
        folder,
        "big.html",
        &format!("{robots} gen:braid:16:1..=200"),
    )
}

/// Plays a contest with the program and writes its page.
fn play(folder: &Path, page: &str, arguments: &str) -> io::Result<()> {
    let program = env::var_os("WASMOUSE").unwrap_or_else(|| "wasmouse".into());
    let status = Command::new(program)
        .arg("run")
        .args(arguments.split(' '))
        .args(["--force", "--html"])
        .arg(folder.join(page))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()?;
    // 0, or the code for robots that did not finish.
    match status.code() {
        Some(_) if folder.join(page).is_file() => Ok(()),
        _ => Err(io::Error::other(format!("`run {arguments}`: {status}"))),
    }
}

/// Numbers that look random and are the same each time (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ mixed >> 31) % limit
    }
}

/// A match of random actions in a random maze, with the digest of its trace by this program's core.
fn random_match(seed: u64) -> Value {
    let mut random = Random(seed);
    let kind = ["tree", "braid", "division", "stretches"][random.below(4) as usize];
    let size = 12 + 2 * random.below(5);
    let maze = generated(&format!("gen:{kind}:{size}:{seed}"));
    let rules = GameRules {
        budget: 1 + random.below(1000) as u32,
        longest_move: 1 + random.below(5) as u8,
        ..GameRules::default()
    };
    let mut simulation = Simulation::new(&maze, &rules);
    let mut transcript = Transcript::default();
    let faults_at = random.below(2000);
    while !simulation.has_ended() {
        if u64::from(simulation.steps().total()) == faults_at {
            transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, "random".to_owned());
            break;
        }
        let action = match random.below(40) {
            0 => Action::Reset,
            1 => moved(&mut random, 256),
            _ => moved(&mut random, 7),
        };
        simulation.apply(action);
        transcript.push(action);
    }
    let (_, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
    json!({
        "rules": [rules.budget, 0, rules.longest_move, rules.exploration_divisor],
        "maze": maze.identity_bytes(),
        "transcript": transcript.to_bytes(),
        "steps": trace.steps().len(),
        "digest": Digest::of(&trace.identity_bytes()).to_string(),
    })
}

/// A move with one of so many advances around 0.
fn moved(random: &mut Random, advances: i64) -> Action {
    let turn = [Turn::Left, Turn::Straight, Turn::Right][random.below(3) as usize];
    let advance = random.below(advances.unsigned_abs()) as i64 - advances / 2;
    Action::Move {
        turn,
        advance: i8::try_from(advance).expect("at most 256 advances"),
    }
}

fn generated(spec: &str) -> Maze {
    let spec: GenSpec = spec.parse().expect("a specification");
    spec.expand().next().expect("a maze").generate()
}

/// A whole match of random actions by rules with a small budget.
fn small_match(maze: &Maze, rules: &Ruleset, seed: u64) -> Transcript {
    let mut random = Random(seed);
    let mut simulation = Simulation::new(maze, &rules.game);
    let mut transcript = Transcript::default();
    while !simulation.has_ended() {
        let action = moved(&mut random, 7);
        simulation.apply(action);
        transcript.push(action);
    }
    transcript
}

fn small_rules() -> Ruleset {
    let mut rules = Ruleset::default();
    rules.game.budget = 60;
    rules
}

fn sample_replay(robot: &str, maze_name: &str, note: &str, is_other: bool) -> Replay {
    let maze = generated("gen:braid:12:7");
    let rules = small_rules();
    let transcript = small_match(&maze, &rules, u64::from(is_other));
    let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
    let mut journal = Journal::default();
    journal.clear(u64::MAX);
    for step in 0..60 {
        let cell = Cell::new((step % 12) as u8, (step / 12) as u8);
        let level = [Level::Debug, Level::Info, Level::Warning, Level::Error][step as usize % 4];
        journal.push(
            step,
            Note::Log {
                level,
                text: note.into(),
            },
        );
        journal.push(
            step,
            Note::Label {
                cell,
                text: note.into(),
            },
        );
        let color = [Color::Red, Color::Violet, Color::None][step as usize % 3];
        journal.push(step, Note::Paint { cell, color });
        let belief = [Belief::Open, Belief::Closed, Belief::Unknown][step as usize % 3];
        let side = Heading::ALL[step as usize % 4];
        journal.push(step, Note::Wall { cell, side, belief });
    }
    let key = MatchKey {
        engine: Digest::of(b"an engine"),
        rules: rules.digest(),
        robot: Digest::of(robot.as_bytes()),
        variant: 0,
        maze: maze.digest(),
        seed: u64::MAX,
    };
    let usage = Usage {
        journal: journal.counts(),
        ..Usage::default()
    };
    let record = MatchRecord::new(key, result, usage, &transcript);
    Replay::new(ReplayParts {
        robot: GuestStr::from(robot).cut(200).0.into(),
        maze_name: GuestStr::from(maze_name).cut(200).0.into(),
        maze,
        rules,
        record,
        transcript,
        journal,
    })
    .expect("it fits together")
}

/// A page in which everything that may be untrusted is hostile.
fn hostile_page() -> String {
    let rules = small_rules();
    let names = [HOSTILE.to_owned(), format!("b{HOSTILE}"), "c".repeat(255)];
    let robots = names.map(|name| {
        let digest = Digest::of(name.as_bytes());
        MatrixRobot::new(name, digest, 0)
    });
    let seeds = Seeds {
        first: u64::MAX - 1,
        count: 1,
    };
    let mut matrix = ScoreMatrix::new(rules.clone(), seeds, robots.into());
    let mut playable = Playable::default();
    for number in 0..2 {
        let maze = generated(&format!("gen:tree:12:{number}"));
        let index = matrix.push_maze(MatrixMaze {
            name: format!("{HOSTILE}{number}").into(),
            digest: maze.digest(),
            dimension: 12,
            oracle: rules.game.oracle_score(&maze),
            set: 0,
        });
        for robot in 0..matrix.robots.len() {
            let mut transcript = small_match(&maze, &rules, robot as u64);
            if robot == 1 {
                transcript.clear();
                let detail = HOSTILE.to_owned();
                transcript.end_with_fault(FaultKind::Panic, Phase::Start, detail);
            }
            let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
            let outcome = match robot {
                1 => Outcome::Fault(FaultKind::Panic),
                _ => Outcome::BudgetUsedUp {
                    goal_reached: false,
                },
            };
            let score = MatchScore {
                outcome,
                steps: result.steps,
                fuel: FuelUse::default(),
                memory_bytes: 0,
            };
            matrix.set(robot, index, 0, score);
            let place = Place {
                maze: index,
                robot,
                seed: 0,
            };
            playable.add(place, &maze, &transcript);
        }
    }
    let (scoring, engine) = (Scoring::default(), EngineId::new(HOSTILE));
    let options = ReportOptions::default();
    let report = ContestReport::new(HOSTILE, &matrix, &scoring, &engine, 6, options);
    html(&report.with_playable(playable))
}
