//! `--replays`: keeps matches of a run in files, to be watched without their robots.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use wasmouse_core::GuestText;
use wasmouse_core::journal::Journal;
use wasmouse_core::replay::{NAME_CHARS_MAX, Replay, ReplayParts};
use wasmouse_engine::Executor;

use super::again::play_again;
use super::failure::Failure;
use super::output::{self, Existing, message};
use crate::contest::{BestMatch, BestMatches, ContestMatch, ContestMaze, Plan, Player, Sink};
use crate::report::text::{Text, text};

/// Replays of a run, at most. A contest keeps more than that in its store.
const REPLAYS_MAX: u64 = 10_000;

/// Characters of a name that become part of a file name, at most.
const FILE_NAME_CHARS_MAX: usize = 60;

/// Which matches are kept, and where.
#[derive(clap::Args, Debug)]
pub struct KeepArgs {
    /// Write replays of matches into the folder DIR, to be watched with `wasmouse replay`
    #[arg(long, value_name = "DIR", group = "files")]
    replays: Option<PathBuf>,
    /// Which matches --replays writes: the best one of each robot, or all
    #[arg(long, value_enum, default_value_t = Kept::Best, requires = "replays")]
    keep: Kept,
}

/// Which matches are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Kept {
    /// The best match of each robot: the one with the smallest regret
    Best,
    /// All matches
    All,
}

impl KeepArgs {
    /// What collects the matches; `None` if none are kept. Creates the folder.
    ///
    /// # Errors
    ///
    /// When the folder cannot be created, or there are too many matches.
    pub fn sink(&self, plan: &Plan) -> Result<Option<ReplaySink>, Failure> {
        let Some(folder) = &self.replays else {
            return Ok(None);
        };
        if self.keep == Kept::All && plan.matches() > REPLAYS_MAX {
            let message = format!(
                "--keep all writes at most {REPLAYS_MAX} replays, and there are {} matches",
                plan.matches()
            );
            return Err(Failure::usage(message)
                .hint("use --keep best, or a contest file with `keep_transcripts = \"all\"`"));
        }
        fs::create_dir_all(folder).map_err(|error| output::failure(folder, &error))?;
        Ok(Some(match self.keep {
            Kept::Best => ReplaySink::Best(BestMatches::default()),
            Kept::All => ReplaySink::All {
                maze: None,
                matches: Vec::new(),
            },
        }))
    }

    /// Writes what was collected. A robot that has written a journal plays again, because
    /// journals are not kept while a contest is played.
    ///
    /// # Errors
    ///
    /// When a file cannot be written.
    pub fn write(
        &self,
        sink: ReplaySink,
        plan: &Plan,
        players: &[Player],
        executor: &dyn Executor,
        existing: Existing,
    ) -> Result<(), Failure> {
        let folder = self.replays.as_deref().unwrap_or(Path::new("."));
        let (mut names, mut count) = (BTreeSet::new(), 0_u64);
        for kept in sink.into_matches() {
            let replay = replay(&kept, plan, players, executor)?;
            let path = folder.join(file_name(&replay, &mut names));
            let mut json = serde_json::to_vec(&replay).expect("a replay has a JSON form");
            json.push(b'\n');
            output::save(&path, &json, existing)?;
            count += 1;
        }
        let folder = Text::of_path(folder);
        match count {
            1 => message!("wrote 1 replay to `{}`", folder),
            _ => message!("wrote {} replays to `{}`", count, folder),
        }
        Ok(())
    }
}

/// Collects matches while they are played.
#[derive(Debug)]
pub enum ReplaySink {
    /// The best of each player.
    Best(BestMatches),
    /// All of them.
    All {
        /// The maze that is being played.
        maze: Option<ContestMaze>,
        /// The matches so far.
        matches: Vec<BestMatch>,
    },
}

impl ReplaySink {
    fn into_matches(self) -> Vec<BestMatch> {
        match self {
            Self::Best(best) => best.into_best().into_iter().flatten().collect(),
            Self::All { matches, .. } => matches,
        }
    }
}

impl Sink for ReplaySink {
    fn maze(&mut self, next: &ContestMaze) -> io::Result<()> {
        match self {
            Self::Best(best) => best.maze(next),
            Self::All { maze, .. } => {
                *maze = Some(next.clone());
                Ok(())
            }
        }
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        match self {
            Self::Best(best) => best.played(played),
            Self::All { maze, matches } => {
                let maze = maze.clone().expect("a maze comes before its matches");
                let played = played.clone();
                matches.push(BestMatch { played, maze });
                Ok(())
            }
        }
    }
}

fn replay(
    kept: &BestMatch,
    plan: &Plan,
    players: &[Player],
    executor: &dyn Executor,
) -> Result<Replay, Failure> {
    let played = &kept.played;
    let robot = &plan.entrants[players[played.player].entrants[0]].name;
    let journal = journal(kept, plan, players, executor);
    Replay::new(ReplayParts {
        robot: shortened(robot),
        maze_name: shortened(&kept.maze.name),
        maze: (*kept.maze.maze).clone(),
        rules: (*plan.rules).clone(),
        record: played.record.clone(),
        transcript: played.transcript.clone(),
        journal,
    })
    .map_err(|error| Failure::internal(text!("the replay of `{}`: {}", robot.escaped(), error)))
}

fn shortened(name: &GuestText) -> GuestText {
    let (short, _) = name.as_guest().cut(NAME_CHARS_MAX);
    short.into()
}

/// What the robot writes when it plays again; empty if that is not possible.
fn journal(kept: &BestMatch, plan: &Plan, players: &[Player], executor: &dyn Executor) -> Journal {
    let record = &kept.played.record;
    if record.journal.entries == 0 {
        return Journal::default();
    }
    let problem = match play_again(plan, players, executor, record) {
        Ok(Some(again)) if again.detailed.record.transcript == record.transcript => {
            return again.detailed.recording.journal;
        }
        Ok(_) => "the match was another one when played again".to_owned(),
        Err(error) => error.to_string(),
    };
    let robot = &plan.entrants[players[kept.played.player].entrants[0]].name;
    message!(
        "warning: the replay of `{}` in `{}` has no journal: {}",
        robot.escaped(),
        kept.maze.name.escaped(),
        problem
    );
    Journal::default()
}

/// A name for the file that no other one has, of letters, digits and `-_.` alone.
fn file_name(replay: &Replay, taken: &mut BTreeSet<String>) -> String {
    let parts = replay.parts();
    let safe = |name: &GuestText| -> String {
        let safe = |it: char| match it {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '-' | '_' => it,
            _ => '-',
        };
        let start = name.raw().chars().take(FILE_NAME_CHARS_MAX);
        start.map(safe).collect()
    };
    let (robot, maze) = (safe(&parts.robot), safe(&parts.maze_name));
    let stem = format!("{robot}.{maze}.{}", parts.record.key.seed);
    let numbered = (2_u64..).map(|number| format!("{stem}.{number}"));
    let mut stems = std::iter::once(stem.clone()).chain(numbered);
    // File systems may not tell case apart.
    let stem = stems.find(|stem| taken.insert(stem.to_lowercase()));
    format!("{}.replay.json", stem.expect("there are enough numbers"))
}
