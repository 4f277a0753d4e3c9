//! `wasmouse contest commit`: publishes a digest of the hidden mazes before a contest.

use std::path::{Path, PathBuf};

use wasmouse_core::Digest;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output::{self, Draft, Existing, message};
use super::load::{ContestFolder, FILE_NAME};
use super::resolve;
use crate::contest::{COMMITMENT_VERSION, OpenedSet, Opening};
use crate::report::number::counted;
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Before submissions close, publish the commitment and keep the opening secret:
  wasmouse contest commit contest.toml
After the contest, publish the opening. Anyone can check it:
  wasmouse contest reveal contest.commitment.json contest.opening.json --store contest.db";

/// Fix the hidden mazes of a contest before it begins
///
/// Writes two files: a commitment to publish, with a salted digest of each hidden set, and an
/// opening to keep secret until the contest has ended, with the salts and the mazes.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The contest file, or a folder with a contest.toml
    #[arg(value_name = "FILE", default_value = FILE_NAME)]
    file: PathBuf,
    /// The file to publish [default: the contest file's name with `.commitment.json`]
    #[arg(long, value_name = "FILE")]
    commitment: Option<PathBuf>,
    /// The file to keep secret [default: the contest file's name with `.opening.json`]
    #[arg(long, value_name = "FILE")]
    opening: Option<PathBuf>,
    /// Overwrite the files if they exist
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let folder = ContestFolder::read(&args.file)?;
    let hidden = resolve::all_mazes(&folder)?.into_iter();
    let hidden: Vec<_> = hidden.filter(|it| it.set.is_hidden).collect();
    if hidden.is_empty() {
        let message = text!("`{}` has no hidden mazes", Text::of_path(folder.path()));
        return Err(Failure::input(message).hint("`hidden = true` in `[[mazes]]` hides a set"));
    }
    let commitment = path(&args.commitment, &folder, "commitment.json");
    let opening = path(&args.opening, &folder, "opening.json");
    let existing = Existing::from_flag(args.force);
    // The secret one first: a commitment without its opening is worth nothing.
    let mut secret = Draft::create(&opening, existing)?;
    let mut public = Draft::create(&commitment, existing)?;
    let mut sets = Vec::with_capacity(hidden.len());
    for set in hidden {
        sets.push(OpenedSet::new(set.set.name, salt()?, &set.mazes));
    }
    let opened = Opening {
        version: COMMITMENT_VERSION,
        contest: folder.file.name.as_str().to_owned(),
        sets,
    };
    let committed = opened.commitment();
    output::write_json(&mut secret, &opening, &opened)?;
    output::write_json(&mut public, &commitment, &committed)?;
    secret.commit()?;
    public.commit()?;
    for set in &committed.sets {
        let line = text!(
            "{}: {}, {}\n",
            set.name,
            counted(set.mazes, "maze"),
            set.digest
        );
        output::print(line.as_str())?;
    }
    message!(
        "publish {}; keep {} secret until the contest has ended",
        Text::of_path(&commitment),
        Text::of_path(&opening)
    );
    Ok(Exit::Success)
}

fn path(given: &Option<PathBuf>, folder: &ContestFolder, extension: &str) -> PathBuf {
    let default = || Path::with_extension(folder.path(), extension);
    given.clone().unwrap_or_else(default)
}

/// 32 bytes that nobody can guess.
fn salt() -> Result<Digest, Failure> {
    let mut bytes = [0; 32];
    getrandom::fill(&mut bytes)
        .map_err(|error| Failure::internal(format!("the system has no random numbers: {error}")))?;
    Ok(Digest::from_bytes(bytes))
}
