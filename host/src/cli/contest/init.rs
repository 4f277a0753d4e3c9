//! `wasmouse contest init`: a contest file to begin with.

use std::fs;
use std::path::{Path, PathBuf};

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output::{self, Existing};
use super::load::FILE_NAME;
use crate::contest::config::Name;
use crate::contest::template;
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse contest init               contest.toml in the current folder
  wasmouse contest init spring        spring/contest.toml
  wasmouse contest init spring.toml";

/// The folder that the template's robots are in.
const SUBMISSIONS: &str = "submissions";

/// Write a contest file with comments, to be changed.
///
/// Also creates the folder that the file is in, and a folder `submissions` beside it.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The contest file, if it ends in .toml, or the folder for a contest.toml
    #[arg(value_name = "DIR|FILE", default_value = ".")]
    path: PathBuf,
    /// Overwrite the file if it exists
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let is_file = args.path.extension().is_some_and(|it| it == "toml") && !args.path.is_dir();
    let path = if is_file {
        args.path.clone()
    } else {
        args.path.join(FILE_NAME)
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    create(folder)?;
    let name = contest_name(is_file.then_some(path.as_path()), folder);
    let existing = Existing::from_flag(args.force);
    output::save(&path, template(&name).as_bytes(), existing)?;
    create(&folder.join(SUBMISSIONS))?;
    let shown = Text::of_path(path.strip_prefix(".").unwrap_or(&path));
    let next = text!("wrote {}\n\n  wasmouse contest check {}\n", shown, shown);
    output::print(next.as_str())?;
    Ok(Exit::Success)
}

/// Creates a folder and those that it is in, if it does not exist.
fn create(folder: &Path) -> Result<(), Failure> {
    if folder == Path::new("") {
        return Ok(());
    }
    fs::create_dir_all(folder).map_err(|error| {
        Failure::input(text!(
            "failed to create folder `{}`: {}",
            Text::of_path(folder),
            error
        ))
    })
}

/// The name of the file or of its folder, if a contest can be called so.
fn contest_name(file: Option<&Path>, folder: &Path) -> String {
    let here = if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    };
    let folder = fs::canonicalize(here).ok();
    let name = match file {
        Some(file) if file.file_name().is_some_and(|it| it != FILE_NAME) => file.file_stem(),
        _ => folder.as_deref().and_then(Path::file_name),
    };
    let name = name.and_then(|it| Name::new(it.to_str()?).ok());
    name.map_or_else(|| "contest".to_owned(), Name::into_string)
}
