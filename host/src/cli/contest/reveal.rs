//! `wasmouse contest reveal`: checks that the hidden mazes are those that were committed to.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use wasmouse_core::Digest;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::input;
use super::super::output::{self, message};
use super::super::store_failure::store_failure;
use crate::contest::{COMMITMENT_VERSION, Commitment, Opening};
use crate::report::number::counted;
use crate::report::text::{Text, text};
use crate::store::Store;

/// A generous limit on the size of both documents: 100,000 mazes of 64 cells along a side.
const BYTES_MAX: u64 = 4 << 30;

const EXIT_CODES: &str = "\
Exit codes:
  0  the mazes are those that were committed to
  1  they are not, or the store does not have them
  3  a file is missing or invalid";

/// Check an opening against the commitment that was published
///
/// Generates and digests all mazes of the opening again. With a store, also checks that these
/// mazes were played in that contest.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXIT_CODES)]
pub struct Args {
    /// What was published before the contest
    #[arg(value_name = "COMMITMENT")]
    commitment: PathBuf,
    /// What was published after the contest
    #[arg(value_name = "OPENING")]
    opening: PathBuf,
    /// A store with the results of the contest
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let commitment: Commitment = read("commitment", &args.commitment)?;
    check_version("commitment", &args.commitment, commitment.version)?;
    let opening: Opening = read("opening", &args.opening)?;
    check_version("opening", &args.opening, opening.version)?;
    let broken = opening.check(&commitment);
    for problem in &broken {
        message!("error: {}", problem);
    }
    let mut missing = 0;
    if let Some(path) = &args.store {
        let store = Store::open_read_only(path).map_err(store_failure)?;
        let played = store.maze_digests().map_err(store_failure)?;
        let played: HashSet<Digest> = played.into_iter().collect();
        for set in &opening.sets {
            for maze in set.mazes.iter().filter(|it| !played.contains(&it.digest)) {
                missing += 1;
                message!(
                    "error: maze `{}` of set `{}` was not played in {}",
                    maze.name.escaped(),
                    set.name,
                    Text::of_path(path)
                );
            }
        }
    }
    if !broken.is_empty() || missing > 0 {
        return Ok(Exit::CheckFailed);
    }
    for set in &commitment.sets {
        let line = text!(
            "{}: {}, as committed to\n",
            set.name,
            counted(set.mazes, "maze")
        );
        output::print(line.as_str())?;
    }
    Ok(Exit::Success)
}

fn read<T: DeserializeOwned>(what: &'static str, path: &Path) -> Result<T, Failure> {
    let bytes = input::read_file(path, BYTES_MAX);
    let bytes = bytes.map_err(|error| input::failure(what, path, &error))?;
    serde_json::from_slice(&bytes).map_err(|error| {
        let path = Text::of_path(path);
        Failure::input(text!("failed to parse {} `{}`: {}", what, path, error))
            .hint("`wasmouse contest commit` writes both files; the commitment comes first")
    })
}

fn check_version(what: &str, path: &Path, version: u32) -> Result<(), Failure> {
    if version == COMMITMENT_VERSION {
        return Ok(());
    }
    Err(Failure::input(text!(
        "{} `{}` has version {}; only version {} is supported",
        what,
        Text::of_path(path),
        version,
        COMMITMENT_VERSION
    )))
}
