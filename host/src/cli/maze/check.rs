//! `wasmouse maze check`: which mazes are fit for a contest, and why not.

use std::fmt::Write as _;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, Source};
use super::super::output;
use crate::maze::format::Parsed;
use crate::maze::{Survey, Violation, violations};
use crate::report::maze_check::{CheckedMaze, MazeCheck};

const EXAMPLES: &str = "\
Examples:
  wasmouse maze check test_maze_01
  wasmouse maze check my-mazes --summary
  wasmouse maze check a.txt b.txt --json

Exit codes:
  0  every maze keeps all contest rules, or --lenient was given
  1  a maze breaks contest rules
  3  a maze cannot be read; the others were checked nevertheless";

/// Check mazes against the contest rules.
///
/// Every rule that a maze breaks is named with the cells that break it. Real
/// competition mazes often break some; with --lenient that is no failure here,
/// and other commands then use them as they are.
#[derive(clap::Args)]
#[command(after_long_help = format!("{}\n\n{EXAMPLES}", mazes::SPECIFICATION_HELP))]
pub struct Args {
    /// Bundled mazes, files, folders, or - for standard input
    #[arg(required = true, value_name = "MAZE")]
    mazes: Vec<String>,
    /// Accept mazes that break contest rules, but still name the rules
    #[arg(long)]
    lenient: bool,
    /// Print only how many mazes are solvable, have unreachable cells or
    /// several entrances to the goal
    #[arg(long)]
    summary: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A source and what came out of it.
struct Checked {
    label: String,
    outcome: Result<(Parsed, Vec<Violation>), Failure>,
}

/// Runs the command: every maze is checked, also after one that cannot be read.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let checked: Vec<Checked> = args.mazes.iter().flat_map(|spec| check(spec)).collect();
    for checked in &checked {
        if let Err(failure) = &checked.outcome {
            anstream::eprintln!("{failure}");
        }
    }
    let survey = survey(&checked);
    output::print(&match (args.json, args.summary) {
        (true, summary) => json(&checked, summary, &survey),
        (false, true) => summary(&survey),
        (false, false) => listing(&checked, args.lenient),
    })?;
    Ok(exit(&checked, args.lenient))
}

fn check(spec: &str) -> Vec<Checked> {
    match mazes::resolve(spec) {
        Ok(sources) => sources.iter().map(check_source).collect(),
        Err(failure) => vec![Checked {
            label: spec.to_owned(),
            outcome: Err(failure),
        }],
    }
}

fn check_source(source: &Source) -> Checked {
    Checked {
        label: source.label(),
        outcome: source.read().map(|parsed| {
            let broken = violations(&parsed.maze);
            (parsed, broken)
        }),
    }
}

fn survey(checked: &[Checked]) -> Survey {
    let mut survey = Survey::default();
    for checked in checked {
        match &checked.outcome {
            Ok((parsed, _)) => survey.add(&parsed.maze),
            Err(_) => survey.add_refused(),
        }
    }
    survey
}

fn exit(checked: &[Checked], lenient: bool) -> Exit {
    let outcomes = || checked.iter().map(|checked| &checked.outcome);
    let is_illegal = |(_, broken): &(Parsed, Vec<Violation>)| !broken.is_empty();
    if outcomes().any(Result::is_err) {
        Exit::Input
    } else if !lenient && outcomes().flatten().any(is_illegal) {
        Exit::No
    } else {
        Exit::Success
    }
}

fn listing(checked: &[Checked], lenient: bool) -> String {
    let mut text = String::new();
    for checked in checked {
        let Ok((_, broken)) = &checked.outcome else {
            continue;
        };
        let verdict = match (broken.len(), lenient) {
            (0, _) => "ok".to_owned(),
            (1, false) => "breaks 1 contest rule".to_owned(),
            (count, false) => format!("breaks {count} contest rules"),
            (1, true) => "ok, but breaks 1 contest rule".to_owned(),
            (count, true) => format!("ok, but breaks {count} contest rules"),
        };
        writeln!(text, "{}: {verdict}", checked.label).expect("writing to a string never fails");
        for violation in broken {
            writeln!(text, "  {violation}").expect("writing to a string never fails");
        }
    }
    text
}

fn summary(survey: &Survey) -> String {
    let mut counts = vec![
        (survey.files, "files"),
        (survey.parsed, "mazes"),
        (survey.contest_legal, "keep all contest rules"),
        (survey.solvable, "solvable"),
        (survey.with_unreachable, "with unreachable cells"),
        (survey.several_entrances(), "with several goal entrances"),
    ];
    let entrances: Vec<(usize, String)> = survey
        .by_entrances
        .iter()
        .map(|(&entrances, &mazes)| match entrances {
            1 => (mazes, "  with 1 entrance".to_owned()),
            _ => (mazes, format!("  with {entrances} entrances")),
        })
        .collect();
    counts.extend(entrances.iter().map(|(mazes, what)| (*mazes, &what[..])));
    let mut text = String::new();
    for (count, what) in counts {
        writeln!(text, "{count:>6} {what}").expect("writing to a string never fails");
    }
    text
}

fn json(checked: &[Checked], summary: bool, survey: &Survey) -> String {
    let mazes = checked.iter().map(|checked| {
        let source = checked.label.clone();
        match &checked.outcome {
            Ok((parsed, broken)) => CheckedMaze::read(source, parsed, broken),
            Err(failure) => CheckedMaze::refused(source, failure.message().to_owned()),
        }
    });
    MazeCheck::new((!summary).then(|| mazes.collect()), survey).to_json()
}
