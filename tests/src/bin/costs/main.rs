//! `costs`: creates, builds and plays the example robot of every language, and writes what it
//! costs into the table of `docs/LANGUAGES.md`.
//!
//! `cargo xtask costs` runs it. Sizes and fuel are the same on every machine; times are not.

mod measure;

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use xtask::languages::Kit;

use measure::Cost;

/// Build and play a robot in every language, and write the table of costs
#[derive(Parser)]
#[command(name = "cargo xtask costs", bin_name = "cargo xtask costs")]
struct Cli {
    /// Languages to measure [default: all whose tools are installed]; the table has only these
    #[arg(value_name = "LANGUAGE", requires = "output")]
    languages: Vec<String>,
    /// The page with the table [default: docs/LANGUAGES.md]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// What stands before and after the table.
const MARKS: (&str, &str) = (
    "<!-- costs: cargo xtask costs -->\n",
    "<!-- end of costs -->",
);

fn main() -> ExitCode {
    match write_table(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn write_table(cli: &Cli) -> Result<(), String> {
    let root = xtask::repository();
    let mut costs = Vec::new();
    if cli.languages.is_empty() {
        costs.push(measure::bundled()?);
    }
    for kit in Kit::ALL {
        let is_wanted =
            cli.languages.is_empty() || cli.languages.iter().any(|it| it == kit.language);
        if !is_wanted {
            continue;
        }
        if !kit.is_installed(&root) {
            eprintln!("skipped {}: its tools are not installed", kit.language);
            continue;
        }
        eprintln!("==> {}", kit.language);
        costs.push(measure::built(kit, &root)?);
    }
    let path = cli
        .output
        .clone()
        .unwrap_or_else(|| root.join("docs/LANGUAGES.md"));
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let page = with_table(&text, &table(&costs))
        .ok_or_else(|| format!("{} has no place for the table", path.display()))?;
    fs::write(&path, page).map_err(|error| error.to_string())
}

/// The page with another table between the marks.
fn with_table(page: &str, table: &str) -> Option<String> {
    let (before, rest) = page.split_once(MARKS.0)?;
    let (_, after) = rest.split_once(MARKS.1)?;
    Some(format!("{before}{}{table}{}{after}", MARKS.0, MARKS.1))
}

fn table(costs: &[Cost]) -> String {
    let mut table = "\
| language | robot | size (KB) | build (s) | memory (MB) | start (fuel) | step (fuel) | match (ms) |\n\
|---|---|--:|--:|--:|--:|--:|--:|\n"
        .to_owned();
    for cost in costs {
        table.push_str(&cost.row());
    }
    table
}
