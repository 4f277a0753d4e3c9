//! `wasmouse study`: the reference page, `docs/REFERENCE.md`.
//!
//! Plays the bundled robots in the official mazes, in hundreds of generated ones and
//! in those of competitions. What is compared with what is decided in
//! [`crate::report::reference`].

mod mazes;

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::exit::Exit;
use super::failure::Failure;
use super::output::{self, Existing};
use super::robots::{self, Specification};
use super::run;
use super::setup::{IsolationArgs, SetupArgs};
use crate::contest::{Contest, MatchResult, Study};
use crate::report::reference::published::{OFFICIAL, RANDOM_TRIES};
use crate::report::reference::{Competitor, MARK, Reference};
use crate::robot::Referee;
use mazes::{MazeArgs, Mazes};

/// Tries of the random robot in maze 01.
const TRIES: u64 = 600;
const TRIES_QUICK: u64 = 60;

const LONG_HELP: &str = "\
Mazes: the official ones, of which wasmouse comes with maze 01 alone; 100 of
each size from 12 to 20 from each of the four generators, with the seeds
500001 to 500100; and those of competitions, by the number of entrances to
their goal. The page says where mazes were absent. The same version writes the
same bytes on any number of threads. A page that is there already is replaced
if an earlier study wrote it.

Examples:
  wasmouse study --official udacity --competition contests
                                             all bundled robots: docs/REFERENCE.md
  wasmouse study --quick -o quick.md         4 mazes of each size instead of 100
  wasmouse study my-robot.wasm flood -o my.md

Exit codes:
  0  the page was written; a robot that did not finish a maze is on it
  4  the page was written; a robot was refused or ended a match with a fault
  130  interrupted; no page was written";

/// Write the reference page: robots in official, generated and competition mazes.
///
/// Puts each robot's scores beside those of the report that it comes from, and
/// plays hundreds of generated mazes and those of competitions: finished matches,
/// benchmarks, regret and fuel, by size and generator. The page is Markdown.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!("{}\n\n{LONG_HELP}", robots::SPECIFICATION_HELP))]
pub struct Args {
    /// Robots to study; by default every bundled one in every setting
    #[arg(value_name = "ROBOT")]
    robots: Vec<String>,
    /// The page
    #[arg(long, short, value_name = "FILE", default_value = "docs/REFERENCE.md")]
    output: PathBuf,
    #[command(flatten)]
    mazes: MazeArgs,
    /// Replace FILE even if it was not written by a study
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let existing = args.existing()?;
    let specifications = args.specifications()?;
    let rules = args.setup.rules;
    let Mazes {
        all,
        official,
        groups,
        competition,
    } = args.mazes.load(&rules)?;
    let referee = args.setup.referee_for_all(&args.isolation)?;
    let contest = Contest {
        entrants: robots::load(&specifications, &referee)?,
        mazes: all,
        seeds: vec![0],
        rules,
    };
    let threads = args.setup.threads();
    let competitors: Vec<Competitor> = specifications.iter().map(competitor).collect();
    let played = run::play(&contest, &referee, threads)?;
    let mut exit = run::exit(&contest, &played);
    let mut tries = None;
    if is_whole(exit)
        && let Some(contest) = args.tries(&specifications, &contest, &referee)?
    {
        let played = run::play(&contest, &referee, threads)?;
        let tries_exit = run::exit(&contest, &played);
        if !is_whole(tries_exit) {
            exit = tries_exit;
        }
        tries = Some((contest, played.results));
    }
    if !is_whole(exit) {
        tell!("`{}` was not written", args.output.display());
        return Ok(exit);
    }
    let results = played.results;
    run::tell_failures(&contest, &results);
    let page = Reference {
        study: Study {
            contest: &contest,
            results: &results,
            groups: &groups,
        },
        competitors: &competitors,
        command: args.command(&official, competition.is_some()),
        competition,
        official,
        tries: as_pair(&tries),
    };
    output::save(&args.output, page.to_markdown().as_bytes(), existing)?;
    tell!("wrote {}", args.output.display());
    Ok(exit)
}

/// Whether every match was played; a page of less would mislead.
const fn is_whole(exit: Exit) -> bool {
    !matches!(exit, Exit::Interrupted | Exit::Host)
}

fn as_pair(tries: &Option<(Contest, Vec<MatchResult>)>) -> Option<(&Contest, &[MatchResult])> {
    tries
        .as_ref()
        .map(|(contest, results)| (contest, &results[..]))
}

fn competitor(specification: &Specification) -> Competitor {
    Competitor {
        robot: specification.robot_name(),
        setting: specification.setting_name(),
        is_bundled: specification.is_bundled(),
    }
}

impl Args {
    /// What to do with the page that is there, found out before anything is
    /// played, so that no work is lost; makes its folder.
    ///
    /// The page is generated and made again often, so one that a study wrote
    /// needs no `--force`; anything else may be somebody's work.
    fn existing(&self) -> Result<Existing, Failure> {
        let path = &self.output;
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|error| {
                Failure::input(format!("failed to create `{}`: {error}", folder.display()))
            })?;
        }
        if path.exists() && !path.is_file() {
            return Err(Failure::input(format!(
                "failed to write `{}`: not a regular file",
                path.display()
            )));
        }
        if self.force || is_page(path) {
            return Ok(Existing::Replace);
        }
        if path.exists() {
            return Err(Failure::input(format!(
                "failed to write `{}`: the file is there and was not written by a study",
                path.display()
            ))
            .hint("replace it with --force"));
        }
        Ok(Existing::Keep)
    }

    fn specifications(&self) -> Result<Vec<Specification>, Failure> {
        if self.robots.is_empty() {
            return Ok(Specification::bundled_in_every_setting());
        }
        let robots = self.robots.iter();
        robots.map(|text| Specification::parse(text)).collect()
    }

    /// The random robot alone in maze 01 with many seeds, if it takes part.
    fn tries(
        &self,
        specifications: &[Specification],
        contest: &Contest,
        referee: &Referee,
    ) -> Result<Option<Contest>, Failure> {
        let random = specifications
            .iter()
            .find(|it| it.robot_name() == RANDOM_TRIES.robot && it.is_bundled());
        let Some(random) = random else {
            return Ok(None);
        };
        let count = if self.mazes.quick { TRIES_QUICK } else { TRIES };
        let maze_01 = contest
            .mazes
            .iter()
            .filter(|maze| maze.name == OFFICIAL[0].name);
        Ok(Some(Contest {
            entrants: robots::load(std::slice::from_ref(random), referee)?,
            mazes: maze_01.cloned().collect(),
            seeds: (0..count).collect(),
            rules: contest.rules,
        }))
    }

    /// The command line that makes the page again, without paths of this machine.
    fn command(&self, official: &[Option<usize>; 3], has_competition: bool) -> String {
        let mut words = vec!["wasmouse study".to_owned()];
        words.extend(self.robots.iter().map(|robot| {
            let path = Path::new(robot);
            let name = path.file_name().unwrap_or(path.as_os_str());
            name.to_string_lossy().into_owned()
        }));
        if official.iter().all(Option::is_some) {
            words.push("--official FOLDER".to_owned());
        }
        if has_competition {
            words.push("--competition FOLDER".to_owned());
        }
        if self.mazes.quick {
            words.push("--quick".to_owned());
        }
        let rules = &self.setup.rules;
        if rules != &crate::sim::Ruleset::default() {
            words.push(format!("--rules {}", rules.name));
        }
        words.join(" ")
    }
}

/// Whether a file begins as the pages of studies do.
fn is_page(path: &Path) -> bool {
    let mut begin = Vec::new();
    let read = File::open(path).and_then(|file| {
        let mut file = file.take(MARK.len() as u64);
        file.read_to_end(&mut begin)
    });
    read.is_ok() && begin == MARK.as_bytes()
}
