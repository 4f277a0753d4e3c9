//! `wasmouse man`: manual pages, one for each command.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_mangen::Man;

use super::exit::Exit;
use super::failure::Failure;
use super::output::{self, Existing};
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse man | man -l -
  wasmouse man -o ~/.local/share/man/man1";

/// Print the manual page, or write the pages of all commands
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Write all pages into DIR, as wasmouse.1, wasmouse-run.1 and so on
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Prints one page, or writes all, for a program with these commands.
pub fn run(args: &Args, mut command: Command) -> Result<Exit, Failure> {
    command.build();
    match &args.output {
        None => {
            let page = page(&command, "wasmouse")?;
            output::print_data(&String::from_utf8_lossy(&page))?;
        }
        Some(folder) => {
            fs::create_dir_all(folder).map_err(|error| {
                Failure::internal(text!(
                    "failed to create `{}`: {}",
                    Text::of_path(folder),
                    error
                ))
            })?;
            write_all(folder, &command, "wasmouse")?;
        }
    }
    Ok(Exit::Success)
}

/// Writes the page of a command and those of its subcommands.
fn write_all(folder: &Path, command: &Command, name: &str) -> Result<(), Failure> {
    let path = folder.join(format!("{name}.1"));
    output::save(&path, &page(command, name)?, Existing::Replace)?;
    command
        .get_subcommands()
        .filter(|subcommand| !subcommand.is_hide_set() && subcommand.get_name() != "help")
        .try_for_each(|subcommand| {
            write_all(
                folder,
                subcommand,
                &format!("{name}-{}", subcommand.get_name()),
            )
        })
}

fn page(command: &Command, name: &str) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    let written: io::Result<()> = Man::new(command.clone())
        .title(name.to_uppercase())
        .render(&mut page);
    written.map_err(|error| Failure::internal(format_args!("failed to write a page: {error}")))?;
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_has_a_page() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("man1");
        let args = Args {
            output: Some(path.clone()),
        };
        let check = Command::new("check");
        let program = Command::new("wasmouse")
            .subcommand(Command::new("build"))
            .subcommand(Command::new("maze").subcommand(check))
            .subcommand(Command::new("worker").hide(true));
        run(&args, program).unwrap();
        for page in ["wasmouse.1", "wasmouse-build.1", "wasmouse-maze-check.1"] {
            let text = fs::read_to_string(path.join(page)).unwrap();
            assert!(text.contains(".SH NAME"), "{page}");
        }
        assert!(!path.join("wasmouse-worker.1").exists());
    }
}
