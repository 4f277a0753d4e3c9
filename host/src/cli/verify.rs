//! `wasmouse verify`: recorded results against the same matches played again.

use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use serde_json::json;

use super::at_hand::{FoundRobot, Mazes, Namesake, Robots};
use super::exit::Exit;
use super::failure::Failure;
use super::robots::admit;
use super::setup::{EngineArgs, IsolationArgs};
use super::{interrupt, output, run};
use crate::contest::{Contest, ContestMaze, Entrant};
use wasmouse_core::maze::Maze;
use crate::report::result::{ContestReport, Difference, Unplayed, Verification};
use crate::report::verification::{FileReport, NotAtHand, to_json};
use crate::report::escape::for_terminal as visible;
use crate::robot::{Digest, Player, Referee, Refusal};
use crate::sim::Ruleset;

const EXAMPLES: &str = "\
Every match is played again and every byte compared: names and digests, rules,
verdicts, scores, steps, fuel, traces and standings. Robots and mazes are found by
their content, whatever their files are called: bundled ones always, `gen:` mazes by
their names, others in the files and folders that --robot and --maze name. Fuel and
faults are only comparable within one engine: results of another version of wasmouse
are verified by that version.

Examples:
  wasmouse verify results.json --robot submissions --maze mazes
  wasmouse run flood dfs --json | wasmouse verify -
  wasmouse verify day-1.json day-2.json --robot a.wasm --robot b.wasm --json

Exit codes, of several results the largest:
  0  everything is as recorded
  1  something is not; the differences are printed
  3  a result cannot be read, or a robot or maze is not at hand
  5  the host failed to play a match again
  130  interrupted";

/// Bytes that a result may have: more than a million matches.
const RESULT_BYTES_MAX: u64 = 1 << 30;

/// What stands for standard input.
const STDIN: &str = "-";

/// Things that a message lists.
const LISTED_MAX: usize = 20;

/// Play recorded results again and say what differs.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Files that `wasmouse run --json` wrote; - is standard input
    #[arg(value_name = "RESULT", required = true)]
    results: Vec<PathBuf>,
    /// A robot's file, or a folder: all its .wasm files
    #[arg(long = "robot", value_name = "FILE")]
    robots: Vec<PathBuf>,
    /// A maze's file, or a folder, as in `wasmouse run`
    #[arg(long = "maze", short, value_name = "MAZE")]
    mazes: Vec<String>,
    /// Print JSON: all differences of all results
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let results = args.results.iter().map(|path| path.as_os_str() == STDIN);
    let mazes = args.mazes.iter().map(|maze| maze == STDIN);
    if results.chain(mazes).filter(|is_stdin| *is_stdin).count() > 1 {
        return Err(Failure::usage("standard input is given twice"));
    }
    let bytes_max = Ruleset::default().limits.component_bytes_max;
    let at_hand = AtHand {
        robots: Robots::load(&args.robots, bytes_max)?,
        mazes: Mazes::load(&args.mazes)?,
    };
    let mut reports = Vec::new();
    let mut exit = Exit::Success;
    for path in &args.results {
        let file = path.display().to_string();
        let (report, own) = match args.verify(path, &file, &at_hand) {
            Ok(verified) => verified,
            Err(failure) => {
                message!("{failure}");
                let report = FileReport::unreadable(&file, failure.message());
                (report, failure.exit())
            }
        };
        if !args.json {
            output::print(&report.to_string())?;
        }
        reports.push(report);
        exit = if own as u8 > exit as u8 { own } else { exit };
        if own == Exit::Interrupted {
            break;
        }
    }
    if args.json {
        output::print(&to_json(&reports))?;
    }
    Ok(exit)
}

/// What results may be verified with.
struct AtHand {
    robots: Robots,
    mazes: Mazes,
}

/// The robots and mazes of one result, as far as they are at hand.
#[derive(Default)]
struct Needed<'a> {
    robots: Vec<FoundRobot<'a>>,
    mazes: Vec<Maze>,
    missing: Vec<NotAtHand>,
}

impl AtHand {
    /// Finds what a result needs. What has a name of the result and another content
    /// is a difference; what is not there at all is missing.
    fn find(&self, report: &ContestReport<'_>, verification: &mut Verification<'_>) -> Needed<'_> {
        let mut needed = Needed::default();
        for (index, robot) in report.robots().enumerate() {
            let path = format!("robots[{index}]");
            match self.robots.find(robot) {
                Some(found) => needed.robots.push(found),
                None => match self.robots.namesake(robot) {
                    Some(other) => verification.add(changed(&path, robot.sha256, &other)),
                    None => needed
                        .missing
                        .push(not_at_hand(path, robot.name, robot.sha256)),
                },
            }
        }
        for (index, maze) in report.mazes().enumerate() {
            let path = format!("mazes[{index}]");
            match self.mazes.find(maze) {
                Some(found) => needed.mazes.push(found),
                None => match self.mazes.namesake(maze) {
                    Some(other) => verification.add(changed(&path, maze.sha256, &other)),
                    None => needed
                        .missing
                        .push(not_at_hand(path, maze.name, maze.sha256)),
                },
            }
        }
        needed
    }
}

fn changed(path: &str, sha256: &str, other: &Namesake) -> Difference {
    Difference {
        path: format!("{path}.sha256"),
        recorded: Some(json!(sha256)),
        source: format!("of `{}`", other.label),
        found: Some(json!(other.digest.hex())),
        of: None,
    }
}

fn not_at_hand(path: String, name: &str, sha256: &str) -> NotAtHand {
    NotAtHand {
        path,
        name: name.to_owned(),
        sha256: sha256.to_owned(),
    }
}

impl Args {
    fn verify(
        &self,
        path: &PathBuf,
        file: &str,
        at_hand: &AtHand,
    ) -> Result<(FileReport, Exit), Failure> {
        let shown = visible(file);
        let bytes = read(path, &shown)?;
        let report = ContestReport::read(&bytes).map_err(|error| {
            Failure::input(format!("failed to read result `{shown}`: {error}"))
                .hint("a result is what `wasmouse run --json` printed, to the byte")
        })?;
        let rules = Ruleset::by_name(report.ruleset()).ok_or_else(|| {
            let (name, known) = (visible(report.ruleset()), Ruleset::all().map(|it| it.name));
            Failure::input(format!(
                "failed to verify result `{shown}`: ruleset.name: this version has no \
                 ruleset `{name}`, but {}",
                known.join(", ")
            ))
        })?;
        let mut verification = Verification::new(&report);
        let needed = at_hand.find(&report, &mut verification);
        let lacks =
            needed.mazes.len() + needed.robots.len() < report.mazes().len() + report.robots().len();
        let (unplayed, problem) = if lacks {
            tell_missing(&shown, &needed.missing);
            let problem = "not all robots and mazes are at hand".to_owned();
            (Unplayed::default(), Some(problem))
        } else {
            let referee = self.engine.referee(rules, &self.isolation)?;
            let contest = contest(&report, &needed, &at_hand.robots, &referee)?;
            self.play_again(&contest, &referee, &mut verification, &bytes)?
        };
        let differences = verification.differences();
        let is_missing = !needed.missing.is_empty();
        let report = FileReport::new(file, &report, differences, needed.missing, problem);
        for failed in unplayed.failed.iter().take(LISTED_MAX) {
            message!("error: `{shown}` was not played again: {}", visible(failed));
        }
        let is_interrupted = unplayed.missing > 0 && interrupted()?;
        if is_interrupted {
            let missing = unplayed.missing;
            message!("interrupted: {missing} matches of `{shown}` were not played again");
        }
        let exit = if is_interrupted {
            Exit::Interrupted
        } else if !unplayed.failed.is_empty() {
            Exit::Internal
        } else if is_missing {
            Exit::Input
        } else if report.differs() {
            Exit::CheckFailed
        } else {
            Exit::Success
        };
        Ok((report, exit))
    }

    /// Plays the matches of a result and compares; also says why that is not all.
    fn play_again(
        &self,
        contest: &Contest,
        referee: &Referee,
        verification: &mut Verification<'_>,
        bytes: &[u8],
    ) -> Result<(Unplayed, Option<String>), Failure> {
        let schedule = verification.schedule(contest);
        let threads = self.engine.threads();
        let played = run::play_only(contest, &schedule.pairings(), referee, threads)?;
        let unplayed = verification.compare(contest, &schedule, played, bytes);
        let problem = match &unplayed.failed[..] {
            [failed, ..] => Some(format!("the host failed to play {failed}")),
            [] if unplayed.missing > 0 => Some(format!(
                "{} matches were not played again",
                unplayed.missing
            )),
            [] => None,
        };
        Ok((unplayed, problem))
    }
}

fn interrupted() -> Result<bool, Failure> {
    Ok(interrupt::listen()?.load(Ordering::Relaxed))
}

fn read(path: &PathBuf, shown: &str) -> Result<Vec<u8>, Failure> {
    let failed = |reason: &dyn std::fmt::Display| {
        Failure::input(format!("failed to read result `{shown}`: {reason}"))
    };
    let limited = |reader: &mut dyn Read| {
        let mut bytes = Vec::new();
        let reader = reader.take(RESULT_BYTES_MAX + 1);
        { reader }.read_to_end(&mut bytes).map(|_| bytes)
    };
    let read = if path.as_os_str() == STDIN {
        limited(&mut io::stdin().lock())
    } else {
        File::open(path).and_then(|mut file| limited(&mut file))
    };
    let bytes = read.map_err(|error| failed(&error))?;
    if bytes.len() as u64 > RESULT_BYTES_MAX {
        return Err(failed(&format!("more than {RESULT_BYTES_MAX} bytes")));
    }
    Ok(bytes)
}

/// The contest of a result, with what the referee says of each robot now.
fn contest(
    report: &ContestReport<'_>,
    needed: &Needed<'_>,
    robots: &Robots,
    referee: &Referee,
) -> Result<Contest, Failure> {
    type Admission = Result<Arc<Player>, Arc<Refusal>>;
    // A robot takes part once for each setting, and is admitted once.
    let mut admitted: Vec<(&str, Digest, Admission)> = Vec::new();
    let mut entrants = Vec::new();
    for (recorded, found) in report.robots().zip(&needed.robots) {
        let known = admitted.iter().find(|it| it.0 == recorded.sha256);
        let (digest, admission) = match known {
            Some((_, digest, admission)) => (*digest, admission.clone()),
            None => {
                let (bytes, trust) = robots.read(found, recorded.sha256)?;
                let digest = Digest::of(&bytes);
                let admission = admit(referee, &bytes, trust)?;
                admitted.push((recorded.sha256, digest, admission.clone()));
                (digest, admission)
            }
        };
        entrants.push(Entrant {
            name: recorded.name.to_owned(),
            digest,
            setting: recorded.setting,
            admission,
        });
    }
    let rules = *referee.rules();
    let mazes = report
        .mazes()
        .zip(&needed.mazes)
        .map(|(recorded, maze)| ContestMaze::new(recorded.name.to_owned(), maze.clone(), &rules));
    Ok(Contest {
        entrants,
        mazes: mazes.collect(),
        seeds: report.seeds().to_vec(),
        rules,
    })
}

fn tell_missing(file: &str, missing: &[NotAtHand]) {
    if missing.is_empty() {
        return;
    }
    message!("error: robots or mazes of result `{file}` are not at hand:");
    for it in missing.iter().take(LISTED_MAX) {
        let (name, sha256) = (visible(&it.name), visible(&it.sha256));
        message!("  {} `{name}`, sha256 {sha256}", it.path);
    }
    if missing.len() > LISTED_MAX {
        let rest = missing.len() - LISTED_MAX;
        message!("  and {rest} more");
    }
    message!("\nhint: name their files or folders with --robot and --maze");
}
