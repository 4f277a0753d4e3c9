//! `reference`: plays the bundled robots in official, generated and competition mazes and
//! writes the page that compares them with the published reports, `docs/REFERENCE.md`.
//!
//! `cargo xtask reference` runs it.

mod host;
mod mazes;
mod page;
mod played;
mod published;
mod tables;

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use host::Host;
use page::Page;

/// Play the bundled robots and compare them with the published reports
#[derive(Parser)]
#[command(name = "cargo xtask reference", bin_name = "cargo xtask reference")]
struct Cli {
    /// Bundled robots to play, such as `flood` or `flood:certain` [default: all]
    #[arg(value_name = "ROBOT", requires = "output")]
    robots: Vec<String>,
    /// Play 4 mazes of each kind instead of 100 or more
    #[arg(long, requires = "output")]
    quick: bool,
    /// Directory with test_maze_02.txt and test_maze_03.txt
    /// [default: $WASMOUSE_SHARED/mazes/udacity]
    #[arg(long, value_name = "DIR")]
    official: Option<PathBuf>,
    /// Directory with competition mazes [default: $WASMOUSE_SHARED/mazes/competition]
    #[arg(long, value_name = "DIR")]
    competition: Option<PathBuf>,
    /// Write the page to FILE [default: docs/REFERENCE.md]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

fn main() -> ExitCode {
    match write_page(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn write_page(cli: &Cli) -> Result<(), String> {
    let official = mazes::official(cli.official.as_deref())?;
    let competition = mazes::competition(cli.competition.as_deref())?;
    let host = Host::new(&cli.robots)?;
    let (seeds, tries, most) = match cli.quick {
        true => (4, 60, 4),
        false => (100, 600, usize::MAX),
    };
    let page = Page {
        official: host.official(official)?,
        generated: host.generated(seeds)?,
        competition: host.competition(competition, most)?,
        random: host.random(tries)?,
        entrants: host.entrants,
        rules: host.rules,
    };
    let path = cli.output.clone();
    let path = path.unwrap_or_else(|| PathBuf::from("docs/REFERENCE.md"));
    fs::write(&path, page.to_markdown())
        .map_err(|error| format!("failed to write `{}`: {error}", path.display()))
}
