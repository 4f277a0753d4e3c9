//! `wasmouse verify`: recorded results against the same matches played again.

use std::collections::HashSet;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use wasmouse_core::game::Ruleset;
use wasmouse_core::record::MatchKey;
use wasmouse_core::{GuestText, guest_text};
use wasmouse_engine::{AdmissionLimits, LocalExecutor, engine_id};

use super::entrants::admit;
use super::exit::Exit;
use super::failure::Failure;
use super::input;
use super::output::{self, message};
use super::play::{Pace, is_interrupted, play};
use super::resolve::{Found, Mazes, RobotSource, Robots};
use super::setup::{EngineArgs, IsolationArgs, TimeArgs};
use crate::contest::{
    ContestInfo, Entrant, FieldDifference, MazeSource, NotAdmitted, Plan, RESULTS_VERSION,
    RecordList, Results, StandingsBuilder, SummaryBuilder, Tee, compare, compare_played,
};
use crate::report::escape::for_terminal;
use crate::report::number::counted;
use crate::report::results_json::{read_results, write_results};
use crate::report::verification::{
    Differences, FileReport, MatchName, NeededKind, NotFound, Status, to_json,
};

const EXAMPLES: &str = "\
Every match is played again and every value compared: digests, rules, verdicts, scores,
steps, fuel, transcripts and standings. Robots and mazes are found by content, whatever
their file names: bundled ones always, `gen:` mazes by name, others in the files and
folders given with --robot and --maze. Their names are labels: a robot whose file has
another name gets a warning that says which file it is. Fuel and faults can
only be compared within one engine: results of another version of wasmouse are
verified by that version.

Examples:
  wasmouse verify results.json --robot submissions --maze mazes
  wasmouse run flood dfs --json | wasmouse verify -
  wasmouse verify day-1.json day-2.json --robot a.wasm --robot b.wasm --json

Exit codes (the largest, for several results):
  0  everything is as recorded, to the byte
  1  something has changed; the differences are printed
  3  a result cannot be read, or a required robot or maze was not found
  5  internal error
  7  the result was recorded by another version of the engine
  8  everything is as recorded, but the file was reformatted
  129, 130, 143  ended by SIGHUP, Ctrl-C or SIGTERM";

/// Largest result file, in bytes: more than a million matches.
const RESULT_BYTES_MAX: u64 = 4 << 30;

/// The argument that means standard input.
const STDIN: &str = "-";

/// Replay recorded results and report differences
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Files written by `wasmouse run --json` or `-o`; - is standard input
    #[arg(value_name = "RESULT", required = true)]
    results: Vec<PathBuf>,
    /// A robot file, or a folder with .wasm and .wat files
    #[arg(long = "robot", value_name = "FILE")]
    robots: Vec<PathBuf>,
    /// A maze file, or a folder, as in `wasmouse run`
    #[arg(long = "maze", short, value_name = "MAZE")]
    mazes: Vec<String>,
    /// Print JSON: all differences of all results
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
    #[command(flatten)]
    time: TimeArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let results = args.results.iter().map(|path| path.as_os_str() == STDIN);
    let mazes = args.mazes.iter().map(|maze| maze == STDIN);
    if results.chain(mazes).filter(|is_stdin| *is_stdin).count() > 1 {
        return Err(Failure::usage("standard input is given twice"));
    }
    let available = Available {
        robots: Robots::load(&args.robots, AdmissionLimits::DEFAULT.component_bytes_max)?,
        mazes: Mazes::load(&args.mazes)?,
    };
    let mut reports = Vec::new();
    let mut exit = Exit::Success;
    for path in &args.results {
        let (report, own) = match args.verify(path, &available) {
            Ok(verified) => verified,
            Err(failure) => {
                message!("{}", failure.report());
                let file = path.display().to_string();
                let report = FileReport::unreadable(&file, failure.message().as_str());
                (report, failure.exit())
            }
        };
        if !args.json {
            output::print(&report.to_string())?;
        }
        reports.push(report);
        exit = exit.max(own);
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
struct Available {
    robots: Robots,
    mazes: Mazes,
}

/// The robots and mazes of one result.
#[derive(Default)]
struct Required {
    robots: Vec<RobotSource>,
    mazes: Vec<MazeSource>,
    not_found: Vec<NotFound>,
    /// Those that have the recorded names and other contents.
    changed: Vec<FieldDifference>,
}

impl Available {
    fn find(&self, recorded: &Results) -> Required {
        let mut required = Required::default();
        for (index, entry) in recorded.contest.robots.iter().enumerate() {
            match self.robots.find(entry) {
                Found::Same(robot) => required.robots.push(robot),
                other => required.lacks(
                    (NeededKind::Robot, &entry.name, entry.digest),
                    &format!("contest.robots[{index}].digest"),
                    &other,
                ),
            }
        }
        for (index, entry) in recorded.summary.mazes.iter().enumerate() {
            match self.mazes.find(entry) {
                Found::Same(maze) => required.mazes.push(maze),
                other => required.lacks(
                    (NeededKind::Maze, &entry.name, entry.digest),
                    &format!("summary.mazes[{index}].digest"),
                    &other,
                ),
            }
        }
        required
    }
}

impl Required {
    fn lacks<T>(
        &mut self,
        (kind, name, digest): (NeededKind, &GuestText, wasmouse_core::Digest),
        field: &str,
        found: &Found<T>,
    ) {
        match found {
            Found::Changed(other) => self.changed.push(FieldDifference {
                field: field.to_owned(),
                recorded: Some(digest.to_string().into()),
                found: Some(other.to_string().into()),
            }),
            Found::Same(_) | Found::Nothing => self.not_found.push(NotFound {
                kind,
                name: name.clone(),
                digest,
            }),
        }
    }
}

impl Args {
    fn verify(&self, path: &Path, available: &Available) -> Result<(FileReport, Exit), Failure> {
        let file = path.display().to_string();
        let shown = for_terminal(&file);
        let bytes = read(path, &shown)?;
        let recorded = read_results(&bytes).map_err(|error| {
            Failure::input(format!("failed to read result `{shown}`: {error}")).hint(error.hint())
        })?;
        let mut report = FileReport {
            file,
            matches: recorded.matches.len() as u64,
            matches_planned: recorded.contest.matches_planned,
            status: Status::Incomplete,
            differences: Differences::default(),
            not_found: Vec::new(),
            reason: None,
        };
        if recorded.contest.engine != engine_id() {
            report.status = Status::DifferentEngine {
                recorded_engine: recorded.contest.engine,
                found_engine: engine_id(),
            };
            return Ok((report, Exit::OtherEngine));
        }
        let required = available.find(&recorded);
        report.not_found = required.not_found;
        if !required.changed.is_empty() {
            report.differences.add(None, required.changed);
            report.status = Status::Changed;
            return Ok((report, Exit::CheckFailed));
        }
        if !report.not_found.is_empty() {
            message!("hint: give their files or folders with --robot and --maze");
            return Ok((report, Exit::Input));
        }
        warn_about_names(&recorded, &required.robots);
        let rules = Arc::new(recorded.contest.rules.clone());
        check_rules(&rules, &shown)?;
        let executor = self
            .engine
            .executor(Arc::clone(&rules), &self.isolation, &self.time)?;
        let plan = Plan {
            entrants: entrants(&recorded, &required.robots, &available.robots, &executor)?,
            mazes: required.mazes,
            seeds: recorded.contest.seeds,
            rules,
        };
        let found = self.play(&plan, &recorded, &executor)?;
        if is_interrupted()? {
            let played = found.matches.len();
            let all = counted(recorded.matches.len(), "match");
            let reason = format!("interrupted after {played} of {all}");
            report.reason = Some(reason.into());
            return Ok((report, Exit::Interrupted));
        }
        if let Some(reason) = not_played(&recorded, &found) {
            report.reason = Some(reason);
            let names = recorded.names();
            for (key, field) in compare_played(&recorded, &found) {
                let of = key.map(|key| MatchName::new(&names, &key));
                report.differences.add(of.as_ref(), [field]);
            }
            if report.differences.count() > 0 {
                report.status = Status::Changed;
            }
            return Ok((report, Exit::Internal));
        }
        Ok(judge(report, &recorded, &found, &bytes))
    }

    /// Plays the recorded matches again.
    fn play(
        &self,
        plan: &Plan,
        recorded: &Results,
        executor: &LocalExecutor,
    ) -> Result<Results, Failure> {
        let keys: HashSet<MatchKey> = recorded.matches.iter().map(|it| it.key).collect();
        let players = plan.players();
        let mut standings = StandingsBuilder::new(plan, &players);
        let mut summary = SummaryBuilder::new();
        let mut list = RecordList::new(u64::MAX);
        let mut sink = Tee(vec![&mut standings, &mut summary, &mut list]);
        let wanted = |key: &MatchKey| keys.contains(key);
        let total = keys.len() as u64;
        play(
            plan,
            executor,
            Pace {
                jobs: self.engine.jobs(),
                robot_time: self.time.robot_time(),
            },
            (&wanted, total),
            &mut sink,
        )?;
        let mut contest = ContestInfo::new(plan);
        // A contest that was interrupted lists only the mazes that it had come to.
        if !recorded.summary.complete {
            contest.matches_planned = recorded.contest.matches_planned;
        }
        for key in recorded.summary.failures.iter().map(|it| &it.key) {
            standings.set_incomplete(key.robot, key.variant);
        }
        for robot in &recorded.summary.withdrawn {
            standings.set_incomplete(robot.robot, robot.variant);
        }
        let mut standings = standings.finish(plan, &players);
        let matches_per_maze = players.len() as u64 * u64::from(plan.seeds.count);
        let mazes_planned = contest.matches_planned.checked_div(matches_per_maze);
        standings.partial = standings.mazes < mazes_planned.unwrap_or(0);
        let mut summary = summary.finish(plan, standings);
        summary.complete = summary.matches == contest.matches_planned;
        Ok(Results {
            version: RESULTS_VERSION,
            contest,
            matches: list.into_records().unwrap_or_default(),
            summary,
        })
    }
}

/// Why not all recorded matches were played again.
fn not_played(recorded: &Results, found: &Results) -> Option<GuestText> {
    let robots = recorded.contest.robots.iter().zip(&found.contest.robots);
    let mut failed = robots.filter(|(then, now)| then.failure.is_none() && now.failure.is_some());
    if let Some((robot, now)) = failed.next() {
        let reason = now.failure.clone().unwrap_or_default();
        return Some(guest_text!(
            "`{}` could not be admitted: {}",
            robot.name,
            reason
        ));
    }
    if let Some(failure) = found.summary.failures.first() {
        return Some(failure.reason.clone());
    }
    let withdrawn = found.summary.withdrawn.first()?;
    let mut robots = found.contest.robots.iter();
    let robot = robots.find(|it| it.digest == withdrawn.robot && it.variant == withdrawn.variant);
    let name = robot.map_or("?".into(), |it| it.name.as_guest());
    Some(guest_text!(
        "`{}` was withdrawn: {}",
        name,
        withdrawn.reason
    ))
}

/// The report on a result whose matches were all played again.
fn judge(
    mut report: FileReport,
    recorded: &Results,
    found: &Results,
    bytes: &[u8],
) -> (FileReport, Exit) {
    let names = recorded.names();
    for (key, field) in compare(recorded, found) {
        let of = key.map(|key| MatchName::new(&names, &key));
        report.differences.add(of.as_ref(), [field]);
    }
    if report.differences.count() > 0 {
        report.status = Status::Changed;
        return (report, Exit::CheckFailed);
    }
    let written = write_results(recorded, Vec::new()).expect("writing to memory cannot fail");
    if written == bytes {
        report.status = Status::Verified;
        return (report, Exit::Success);
    }
    let lines = |bytes: &[u8]| {
        bytes
            .split(|byte| *byte == b'\n')
            .map(<[u8]>::to_vec)
            .collect()
    };
    let (written, recorded): (Vec<Vec<u8>>, Vec<Vec<u8>>) = (lines(&written), lines(bytes));
    let same = written.iter().zip(&recorded).take_while(|(a, b)| a == b);
    report.status = Status::Reformatted {
        line: same.count() + 1,
    };
    (report, Exit::Reformatted)
}

/// Warns about robots that are recorded under other names than they have here. What a match is
/// about is the digest; a name is a label that anybody can change without a difference.
fn warn_about_names(recorded: &Results, sources: &[RobotSource]) {
    for (entry, source) in recorded.contest.robots.iter().zip(sources) {
        if !source.is_called(&entry.name) {
            message!(
                "warning: the result calls {} `{}` (SHA-256 {}); names are labels and are not \
                 verified",
                source.label(),
                entry.name.escaped(),
                entry.digest
            );
        }
    }
}

/// Recorded rules decide what the host allows a robot, so only those that come with wasmouse are
/// accepted.
fn check_rules(rules: &Ruleset, shown: &str) -> Result<(), Failure> {
    if Ruleset::all().contains(rules) {
        return Ok(());
    }
    let names = Ruleset::all().map(|it| it.name);
    Err(Failure::input(format!(
        "failed to verify result `{shown}`: contest.rules: this version has no such ruleset; its \
         rulesets are {}",
        names.join(", ")
    )))
}

/// The robots of a result, as they are admitted now.
fn entrants(
    recorded: &Results,
    sources: &[RobotSource],
    robots: &Robots,
    executor: &LocalExecutor,
) -> Result<Vec<Entrant>, Failure> {
    let mut entrants: Vec<Entrant> = Vec::new();
    for (entry, source) in recorded.contest.robots.iter().zip(sources) {
        // A robot takes part once for each variant, and is admitted once.
        let known = entrants.iter().find(|it| it.digest == entry.digest);
        let admission = match (known, &entry.failure) {
            (Some(known), _) => known.admission.clone(),
            // What could not be admitted then has no matches to play now.
            (None, Some(reason)) => Err(NotAdmitted::Failed(reason.clone())),
            (None, None) => {
                let (bytes, trust) = robots.read(source)?;
                admit(executor, &bytes, trust)?
            }
        };
        entrants.push(Entrant {
            name: entry.name.clone(),
            digest: entry.digest,
            variant: entry.variant,
            admission,
        });
    }
    Ok(entrants)
}

fn read(path: &Path, shown: &str) -> Result<Vec<u8>, Failure> {
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
        input::open(path).and_then(|mut file| limited(&mut file))
    };
    let bytes = read.map_err(|error| failed(&error))?;
    if bytes.len() as u64 > RESULT_BYTES_MAX {
        return Err(failed(&format!("more than {RESULT_BYTES_MAX} bytes")));
    }
    Ok(bytes)
}
