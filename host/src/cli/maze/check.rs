//! `wasmouse maze check`: which mazes are fit for a contest, and why not.

use std::fmt::Write as _;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::maze_source::{self, Source};
use super::super::mazes;
use super::super::output::{self, message};
use crate::report::maze_check::{CheckedMaze, MazeCheck};
use crate::report::text::Text;
use wasmouse_core::GuestText;
use wasmouse_core::maze::format::Format;
use wasmouse_core::maze::{Maze, Survey, Violation, violations};

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
    label: GuestText,
    outcome: Result<Judged, Failure>,
}

/// A maze that could be read, and the rules that it breaks.
struct Judged {
    maze: Maze,
    format: Option<Format>,
    broken: Vec<Violation>,
}

/// Runs the command: every maze is checked, also after one that cannot be read.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let checked: Vec<Checked> = args.mazes.iter().flat_map(|spec| check(spec)).collect();
    for checked in &checked {
        if let Err(failure) = &checked.outcome {
            message!("{}", failure.report());
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
    match maze_source::resolve(spec) {
        Ok(sources) => sources.iter().map(check_source).collect(),
        Err(failure) => vec![Checked {
            label: Text::of_path(spec).as_str().into(),
            outcome: Err(failure),
        }],
    }
}

fn check_source(source: &Source) -> Checked {
    Checked {
        label: source.label(),
        outcome: source.read().map(|(maze, format)| Judged {
            broken: violations(&maze),
            maze,
            format,
        }),
    }
}

fn survey(checked: &[Checked]) -> Survey {
    let mut survey = Survey::default();
    for checked in checked {
        match &checked.outcome {
            Ok(judged) => survey.add(&judged.maze),
            Err(_) => survey.add_rejected(),
        }
    }
    survey
}

fn exit(checked: &[Checked], lenient: bool) -> Exit {
    let outcomes = || checked.iter().map(|checked| &checked.outcome);
    let is_illegal = |judged: &Judged| !judged.broken.is_empty();
    if outcomes().any(Result::is_err) {
        Exit::Input
    } else if !lenient && outcomes().flatten().any(is_illegal) {
        Exit::CheckFailed
    } else {
        Exit::Success
    }
}

fn listing(checked: &[Checked], lenient: bool) -> String {
    let mut text = String::new();
    for checked in checked {
        let Ok(Judged { broken, .. }) = &checked.outcome else {
            continue;
        };
        let verdict = match (broken.len(), lenient) {
            (0, _) => "ok".to_owned(),
            (1, false) => "breaks 1 contest rule".to_owned(),
            (count, false) => format!("breaks {count} contest rules"),
            (1, true) => "ok, but breaks 1 contest rule".to_owned(),
            (count, true) => format!("ok, but breaks {count} contest rules"),
        };
        writeln!(text, "{}: {verdict}", checked.label.escaped())
            .expect("writing to a string never fails");
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
            Ok(judged) => CheckedMaze::read(source, &judged.maze, judged.format, &judged.broken),
            Err(failure) => CheckedMaze::unreadable(source, failure.message().as_str().to_owned()),
        }
    });
    MazeCheck::new((!summary).then(|| mazes.collect()), survey).to_json()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use wasmouse_core::maze::bundled;

    /// A legal maze, one with a wall less, and no maze.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let legal = bundled()[0].text;
        let opened = legal
            .replacen("\n1,", "\n3,", 1)
            .replacen("\n3,5,14", "\n11,5,14", 1);
        let files = [("a.txt", legal), ("b.txt", &opened), ("c.txt", "no maze")];
        for (name, text) in files {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        folder
    }

    fn check_files(names: &[&str], lenient: bool) -> (String, Exit, Survey) {
        let folder = folder();
        let path = |name: &&str| folder.path().join(name).display().to_string();
        let checked: Vec<Checked> = names.iter().flat_map(|name| check(&path(name))).collect();
        let place = format!("{}/", folder.path().display());
        let text = listing(&checked, lenient).replace(&place, "");
        (text, exit(&checked, lenient), survey(&checked))
    }

    const RULE: &str = "  the start must be open at the top only: (0, 0) is open up, right\n";

    #[test]
    fn the_worst_maze_decides_the_exit_code() {
        let (text, exit, _) = check_files(&["a.txt"], false);
        assert_eq!((&text[..], exit), ("a.txt: ok\n", Exit::Success));

        let (text, exit, _) = check_files(&["b.txt", "a.txt"], false);
        let expected = format!("b.txt: breaks 1 contest rule\n{RULE}a.txt: ok\n");
        assert_eq!((text, exit), (expected, Exit::CheckFailed));

        let (text, exit, _) = check_files(&["b.txt"], true);
        let expected = format!("b.txt: ok, but breaks 1 contest rule\n{RULE}");
        assert_eq!((text, exit), (expected, Exit::Success));

        // Unreadable mazes do not keep the others from being checked.
        for lenient in [false, true] {
            let (text, exit, survey) = check_files(&["c.txt", "none.txt", "", "a.txt"], lenient);
            let sources: Vec<&str> = text.lines().filter(|line| !line.starts_with(' ')).collect();
            assert_eq!(sources.len(), 3);
            assert_eq!(exit, Exit::Input);
            assert_eq!((survey.files, survey.parsed), (6, 3));
        }
    }

    #[test]
    fn the_summary_counts() {
        let (_, _, survey) = check_files(&[""], false);
        assert_eq!(
            summary(&survey),
            "     3 files\n     2 mazes\n     1 keep all contest rules\n     2 solvable\n     \
             0 with unreachable cells\n     0 with several goal entrances\n     \
             2   with 1 entrance\n"
        );
    }

    #[test]
    fn json_is_complete() {
        let folder = folder();
        let specs = [
            folder.path().display().to_string(),
            "gen:braid:12:1".to_owned(),
        ];
        let checked: Vec<Checked> = specs.iter().flat_map(|spec| check(spec)).collect();
        let survey = survey(&checked);
        let full: serde_json::Value =
            serde_json::from_str(&json(&checked, false, &survey)).expect("JSON");
        assert_eq!(full["version"], 2);
        assert_eq!(full["mazes"][0]["legal"], true);
        assert_eq!(full["mazes"][0]["format"], "udacity");
        let broken = &full["mazes"][1]["violations"][0];
        assert_eq!(broken["rule"], "start-walls");
        assert_eq!(broken["cells"], serde_json::json!([{"x": 0, "y": 0}]));
        assert!(full["mazes"][2]["error"].is_string());
        assert_eq!(full["mazes"][3]["format"], serde_json::Value::Null);
        let short: serde_json::Value =
            serde_json::from_str(&json(&checked, true, &survey)).expect("JSON");
        assert_eq!(short.get("mazes"), None);
        assert_eq!(short["summary"], full["summary"]);
        assert_eq!(short["summary"]["by_entrances"]["1"], 3);
    }
}
