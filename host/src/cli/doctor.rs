//! `wasmouse doctor`: which languages this machine can build robots in.

use std::path::Path;

use clap::builder::PossibleValuesParser;

use super::exit::Exit;
use super::failure::Failure;
use super::output;
use super::project::{self, LANGUAGES, Language, Status};
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse doctor              all languages, and the project in this folder
  wasmouse doctor go python    only these; exit code 3 if a tool is missing";

/// Check the tools that robots are built with
///
/// For every language, prints which tools are there, in which version, and how to install those
/// that are missing. Tools that are installed into a project are looked for in this folder.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Languages to check [default: all of them]
    #[arg(value_name = "LANGUAGE",
          value_parser = PossibleValuesParser::new(LANGUAGES.iter().map(|it| it.name)))]
    languages: Vec<String>,
}

/// Prints the state of each language. A tool that is missing is a failure only for a language
/// that was asked for by name.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let is_asked = |it: &&&Language| args.languages.iter().any(|name| name == it.name);
    let asked: Vec<&Language> = LANGUAGES.iter().filter(is_asked).copied().collect();
    let languages = if asked.is_empty() { LANGUAGES } else { &asked };
    let mut text = Text::default();
    let mut is_ready = true;
    for language in languages {
        let checks = project::check(language, Path::new("."));
        is_ready &= checks.iter().all(|(_, status)| status.is_ready());
        text = text!("{}{}\n{}", text, language.title, lines(&checks));
    }
    output::print(text.as_str())?;
    Ok(if is_ready || asked.is_empty() {
        Exit::Success
    } else {
        Exit::Input
    })
}

fn lines(checks: &[(&'static str, Status)]) -> Text {
    let mut text = Text::default();
    for (tool, status) in checks {
        text = match status {
            Status::Found(Some(version)) => text!("{}  ok       {} {}\n", text, tool, version),
            Status::Found(None) => text!("{}  ok       {}\n", text, tool),
            Status::PerProject(command) => {
                text!("{}  project  {}: {}\n", text, tool, command)
            }
            Status::Missing { problem, install } => {
                let install = install.as_str().replace('\n', "\n           ");
                text!(
                    "{}  missing  {}\n           {}\n",
                    text,
                    problem,
                    Text::of_lines(&install)
                )
            }
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::project::Version;

    #[test]
    fn a_line_says_what_is_there_and_what_to_do() {
        let checks = [
            ("cargo", Status::Found(Some(Version(1, 95, 0)))),
            ("make", Status::Found(None)),
            ("asc", Status::PerProject("npm ci")),
            (
                "zig",
                Status::Missing {
                    problem: text!("zig is not installed"),
                    install: text!("pip install ziglang\nor: brew install zig"),
                },
            ),
        ];
        assert_eq!(
            lines(&checks).as_str(),
            "  ok       cargo 1.95.0\n  ok       make\n  project  asc: npm ci\n  \
             missing  zig is not installed\n           pip install ziglang\n           \
             or: brew install zig\n"
        );
        assert!(!checks.iter().all(|(_, status)| status.is_ready()));
        assert!(checks[..3].iter().all(|(_, status)| status.is_ready()));
    }
}
