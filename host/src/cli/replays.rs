//! Matches that can be watched, from replay files and from stores of contests.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::Journal;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::replay::{BYTES_MAX, Replay, ReplayFileError, ReplayParts};

use super::failure::Failure;
use super::input;
use super::store_failure::store_failure;
use crate::report::match_link::{MatchLink, ParseLinkError};
use crate::report::text::{Text, text};
use crate::store::{KeptMatch, Store};

/// Matches that are read at once, at most: each takes some kilobytes, with its trace.
pub const MATCHES_MAX: usize = 10_000;

/// How every SQLite database begins.
const SQLITE: &[u8] = b"SQLite format 3\0";

/// Which matches.
#[derive(clap::Args, Debug)]
pub struct SourceArgs {
    /// Replay files, or results of contests (`contest.db`)
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Only these matches: ROBOT/MAZE/SEED, or less of it (`flood`, `flood/test_maze_01`,
    /// `/test_maze_01`); repeat it for more. A fourth part is the step to start at
    #[arg(long = "match", value_name = "ROBOT/MAZE/SEED", value_parser = link)]
    links: Vec<MatchLink>,
}

fn link(text: &str) -> Result<MatchLink, String> {
    let mut link: MatchLink = text
        .parse()
        .map_err(|error: ParseLinkError| error.to_string())?;
    // A generated maze is called by its whole specification, whatever the user leaves out.
    let spec: Option<GenSpec> = link.maze.as_deref().and_then(|maze| maze.parse().ok());
    let mut mazes = spec.iter().flat_map(GenSpec::expand);
    if let (Some(maze), None) = (mazes.next(), mazes.next()) {
        link.maze = Some(maze.to_string());
    }
    Ok(link)
}

impl SourceArgs {
    /// Reads the matches that are meant, file by file.
    ///
    /// # Errors
    ///
    /// When a file cannot be read or is damaged, there is no such match, or there are more than
    /// [`MATCHES_MAX`].
    pub fn load(&self) -> Result<Vec<Replay>, Failure> {
        let mut replays = Vec::new();
        for file in &self.files {
            if is_database(file) {
                self.load_store(file, &mut replays)?;
            } else {
                let replay = read(file)?;
                let parts = replay.parts();
                if self.means(
                    parts.robot.as_guest(),
                    parts.maze_name.as_guest(),
                    parts.record.key.seed,
                ) {
                    replays.push(replay);
                }
            }
            if replays.len() > MATCHES_MAX {
                let message = format!("there are more than {MATCHES_MAX} such matches");
                return Err(Failure::usage(message).hint("choose fewer with --match"));
            }
        }
        if replays.is_empty() {
            return Err(self.nothing());
        }
        Ok(replays)
    }

    /// The step to start at, if a link says so.
    pub fn step(&self) -> Option<usize> {
        self.links.iter().find_map(|link| link.step)
    }

    fn means(&self, robot: GuestStr<'_>, maze: GuestStr<'_>, seed: u64) -> bool {
        self.links.is_empty() || self.links.iter().any(|it| it.has_match(robot, maze, seed))
    }

    fn load_store(&self, path: &Path, replays: &mut Vec<Replay>) -> Result<(), Failure> {
        let store = Store::open_read_only(path).map_err(store_failure)?;
        let mut problem = None;
        let visited = store.kept_matches(
            &mut |name| self.means(name.robot, name.maze, name.seed),
            &mut |kept| {
                match replay_of(kept) {
                    Ok(replay) => replays.push(replay),
                    Err(error) => problem = Some(error),
                }
                problem.is_none() && replays.len() <= MATCHES_MAX
            },
        );
        visited.map_err(store_failure)?;
        match problem {
            Some(problem) => Err(Failure::input(text!(
                "failed to read `{}`: {}",
                Text::of_path(path),
                problem
            ))
            .hint("`wasmouse contest status` checks a store")),
            None => Ok(()),
        }
    }

    fn nothing(&self) -> Failure {
        let (all, link) = (MatchLink::default(), self.links.first());
        let message = match link.filter(|it| **it != all) {
            Some(link) => text!("no match of `{}` was found", link),
            None => text!("there is no match to watch"),
        };
        let is_database = |path: &PathBuf| is_database(path);
        Failure::input(message).hint(if self.files.iter().any(is_database) {
            "a contest keeps what its file says: `keep_transcripts = \"best\"` or `\"all\"`"
        } else {
            "leave --match out to take all matches"
        })
    }
}

fn is_database(path: &Path) -> bool {
    let mut start = [0; SQLITE.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == SQLITE
}

/// Reads a replay file.
///
/// # Errors
///
/// When it cannot be read or is damaged.
pub fn read(path: &Path) -> Result<Replay, Failure> {
    let bytes = input::read_file(path, BYTES_MAX)
        .map_err(|error| input::failure("replay", path, &error))?;
    serde_json::from_slice(&bytes).map_err(|error| {
        let failure = Failure::input(text!(
            "failed to read replay `{}`: {}",
            Text::of_path(path),
            error
        ));
        failure.hint("`wasmouse run --replays DIR` writes replays, and a contest keeps transcripts")
    })
}

/// The replay of a match in a store, which keeps no journals.
fn replay_of(kept: KeptMatch) -> Result<Replay, ReplayFileError> {
    Replay::new(ReplayParts {
        robot: kept.robot,
        maze_name: kept.maze_name,
        maze: kept.maze,
        rules: kept.rules,
        record: kept.record,
        transcript: kept.transcript,
        journal: Journal::default(),
    })
}
