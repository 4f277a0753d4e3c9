//! [`Bench`]: plays cases through the `wasmouse` binary and judges what comes of them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};
use wasmouse::robot::bundled::find;

use super::case::{Case, Mode, fits};
use super::measure::{Measured, measure};
use crate::program::Program;

/// The good robot of every case, which comes with the host, and the same as a stranger's
/// file, which plays where the hostile robots did.
const GOOD: &str = "flood";
const GOOD_FILE: &str = "good";
/// Where they play.
const MAZE: &str = "test_maze_01";

/// The most that the process which the user starts may take where robots run in
/// others, in MiB.
const SUPERVISOR_MEGABYTES_MAX: u64 = 200;

/// How a robot's failure shows in the exit code.
const EXIT_ROBOT: i32 = 4;

/// A program to play with.
#[derive(Debug)]
pub struct Bench {
    program: Program,
    /// What the good robot does alone, by the further arguments.
    alone: RefCell<BTreeMap<String, Vec<Value>>>,
}

/// What came of a case in a mode.
#[derive(Debug)]
pub struct Judgement {
    /// In a few words.
    pub verdict: String,
    /// Why the first robot was refused or failed, in the host's words; empty if neither.
    pub reason: String,
    /// What was expected, in a few words.
    pub expected: String,
    /// How long it took.
    pub time: Duration,
    /// Peak memory of the process that the user starts, in bytes.
    pub first_bytes: u64,
    /// Peak memory of all processes, in bytes.
    pub all_bytes: u64,
    /// Fuel that the hostile robots used after they were loaded.
    pub fuel: u64,
    /// What is wrong; empty when all is well.
    pub problems: Vec<String>,
}

impl Bench {
    /// A bench for that program.
    ///
    /// # Errors
    ///
    /// When the folder or the good robot in it cannot be made.
    pub fn new(wasmouse: &Path) -> io::Result<Self> {
        let bench = Self {
            program: Program::new(wasmouse)?,
            alone: RefCell::default(),
        };
        let good = find(GOOD).ok_or(io::ErrorKind::NotFound)?;
        fs::write(bench.path(GOOD_FILE), good.component)?;
        Ok(bench)
    }

    /// Plays a case.
    ///
    /// # Errors
    ///
    /// When the program cannot be run, or files cannot be written.
    pub fn judge(&self, case: &Case, mode: Mode) -> io::Result<Judgement> {
        let robots = self.write(case)?;
        let time_max = Duration::from_secs(case.seconds_max);
        let mut arguments = self.arguments(case, mode);
        let json_at = arguments.len();
        arguments.push("--json".into());
        arguments.extend(robots.iter().map(|name| format!("--robot={name}.wasm")));
        // After the hostile ones: with one thread, it plays on what they leave.
        arguments.push(format!("--robot={GOOD_FILE}.wasm"));
        arguments.push(format!("--robot={GOOD}"));
        let measured = self.run(&arguments, time_max)?;

        let mut judgement = Judgement {
            verdict: String::new(),
            reason: String::new(),
            expected: in_few_words(&case.expected),
            time: measured.time,
            first_bytes: measured.first_bytes,
            all_bytes: measured.all_bytes,
            fuel: 0,
            problems: self.ceilings(case, mode, &measured),
        };
        judgement.results(case, &robots, &measured, &self.alone(case)?);
        if case.is_shown {
            arguments[json_at] = format!("--html={PAGE}");
            arguments.push("--log".into());
            let shown = self.run(&arguments, time_max)?;
            judgement.problems.extend(self.ceilings(case, mode, &shown));
            let page = fs::read_to_string(self.program.folder().join(PAGE)).unwrap_or_default();
            let _ = fs::remove_file(self.program.folder().join(PAGE));
            judgement.texts(&shown, &page);
        }
        for name in robots {
            fs::remove_file(self.path(&name))?;
        }
        Ok(judgement)
    }

    /// Writes the files of a case and names the robots.
    fn write(&self, case: &Case) -> io::Result<Vec<String>> {
        let files = case.files();
        let many = files.len() > 1;
        let names = files.iter().enumerate().map(|(at, file)| {
            let name = match case.file_name {
                _ if many => format!("{}-{at:05}", case.name),
                Some(name) => name.to_owned(),
                None => case.name.clone(),
            };
            fs::write(self.path(&name), file)?;
            Ok(name)
        });
        names.collect()
    }

    fn path(&self, robot: &str) -> PathBuf {
        self.program.folder().join(format!("{robot}.wasm"))
    }

    fn arguments(&self, case: &Case, mode: Mode) -> Vec<String> {
        let mut arguments: Vec<String> = ["run", "--jobs=1", "--maze", MAZE]
            .into_iter()
            .chain(case.arguments.iter().copied())
            .map(str::to_owned)
            .collect();
        // One cache for the whole corpus and each mode: what a hostile robot leaves
        // there must not hurt those that come later.
        arguments.push(format!("--cache=cache-{}", mode.name()));
        if mode == Mode::Trusted {
            arguments.push("--trust".into());
        }
        arguments
    }

    /// What the good robot does when it is alone: its matches.
    fn alone(&self, case: &Case) -> io::Result<Vec<Value>> {
        let key = case.arguments.join(" ");
        if let Some(matches) = self.alone.borrow().get(&key) {
            return Ok(matches.clone());
        }
        let mut arguments = self.arguments(case, Mode::Trusted);
        arguments.extend(["--json".into(), format!("--robot={GOOD}")]);
        let measured = self.run(&arguments, Duration::from_secs(60))?;
        let document: Value = serde_json::from_str(&measured.stdout)?;
        let matches = matches_of(&document, GOOD);
        assert!(!matches.is_empty(), "{}", measured.stderr);
        self.alone.borrow_mut().insert(key, matches.clone());
        Ok(matches)
    }

    fn run(&self, arguments: &[String], time_max: Duration) -> io::Result<Measured> {
        measure(&self.program, arguments, time_max)
    }

    fn ceilings(&self, case: &Case, mode: Mode, measured: &Measured) -> Vec<String> {
        let mut problems = Vec::new();
        if measured.status.is_none() {
            let (seconds, megabytes) = (measured.time.as_secs(), measured.all_bytes >> 20);
            problems.push(format!("ended after {seconds} s at {megabytes} MiB"));
        }
        if measured.time > Duration::from_secs(case.seconds_max) {
            problems.push(format!("took more than {} s", case.seconds_max));
        }
        let mut ceiling = |what: &str, bytes: u64, max: u64| {
            if bytes > max << 20 {
                problems.push(format!("{what} took {} MiB, more than {max}", bytes >> 20));
            }
        };
        ceiling("all processes", measured.all_bytes, case.megabytes_max);
        if mode == Mode::Isolated {
            ceiling(
                "the supervisor",
                measured.first_bytes,
                SUPERVISOR_MEGABYTES_MAX,
            );
        }
        if measured.left_behind > 0 {
            problems.push(format!("left {} processes behind", measured.left_behind));
        }
        problems
    }
}

/// The web page of a case that is looked at.
const PAGE: &str = "page.html";

impl Judgement {
    /// Whether all is well.
    pub fn is_well(&self) -> bool {
        self.problems.is_empty()
    }

    /// Looks at the results as JSON.
    fn results(&mut self, case: &Case, robots: &[String], measured: &Measured, alone: &[Value]) {
        let Ok(document) = serde_json::from_str::<Value>(&measured.stdout) else {
            self.verdict = "no result".into();
            let talk: String = measured.stderr.chars().take(500).collect();
            self.problems
                .push(format!("printed no JSON, and said: {talk:?}"));
            return;
        };
        if document["complete"] != json!(true) || document["failed"] != json!([]) {
            self.problems
                .push(format!("the host failed: {}", document["failed"]));
        }
        let mut found = Vec::new();
        let mut is_robots_fault = false;
        for name in robots {
            for entry in entries_of(&document, name) {
                is_robots_fault |= entry.get("refusal").is_some() || entry.get("fault").is_some();
                self.fuel += fuel_of(&entry);
                if !case.expected.iter().any(|expected| fits(expected, &entry)) {
                    self.problems.push(format!("{name}: {entry}"));
                }
                found.push(entry);
            }
        }
        self.verdict = in_few_words(&found);
        self.reason = found.first().map(reason_of).unwrap_or_default();
        let exit = if is_robots_fault { EXIT_ROBOT } else { 0 };
        let status = measured.status.and_then(|status| status.code());
        if status != Some(exit) {
            self.problems
                .push(format!("exit code {status:?} instead of {exit}"));
        }
        for good in [GOOD_FILE, GOOD] {
            let matches = matches_of(&document, good);
            if matches != alone {
                self.problems
                    .push(format!("{good} does not play as ever: {matches:?}"));
            }
        }
        self.harmless("the JSON", &measured.stdout);
        self.harmless("standard error", &measured.stderr);
    }

    /// Looks at the reports for people.
    fn texts(&mut self, shown: &Measured, page: &str) {
        self.harmless("standard output", &shown.stdout);
        self.harmless("standard error", &shown.stderr);
        self.harmless("the page", page);
        if shown.stdout.is_empty() {
            self.problems.push(format!("no table: {}", shown.stderr));
        }
        for markup in ["<script>alert", "<img src=x", "onerror=\"alert"] {
            if page.contains(markup) {
                self.problems
                    .push(format!("the page has a robot's markup: {markup}"));
            }
        }
    }

    /// Nothing that plays with a terminal or with the eye.
    fn harmless(&mut self, what: &str, text: &str) {
        let harmful = text.chars().find(|&character| {
            (character.is_control() && character != '\n')
                || matches!(character, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
        });
        if let Some(character) = harmful {
            self.problems
                .push(format!("{what} has the character {character:?}"));
        }
        if text.contains("panicked at") {
            self.problems.push(format!("{what} tells of a panic"));
        }
    }
}

/// What became of a robot: its refusal, or its matches.
fn entries_of(document: &Value, name: &str) -> Vec<Value> {
    let robots = document["robots"].as_array();
    let robot = robots
        .into_iter()
        .flatten()
        .find(|robot| robot["name"] == json!(name));
    match robot {
        None => vec![json!({"missing": name})],
        Some(robot) => match robot.get("refusal") {
            Some(refusal) => vec![json!({"refusal": refusal})],
            None => match matches_of(document, name) {
                matches if matches.is_empty() => vec![json!({"no match": name})],
                matches => matches,
            },
        },
    }
}

/// The matches of a robot, without its name.
fn matches_of(document: &Value, name: &str) -> Vec<Value> {
    let matches = document["matches"].as_array();
    let of_robot = matches
        .into_iter()
        .flatten()
        .filter(|it| it["robot"] == json!(name));
    let nameless = of_robot.cloned().map(|mut result| {
        result["robot"].take();
        result
    });
    nameless.collect()
}

fn fuel_of(entry: &Value) -> u64 {
    let fuel = |name: &str| entry[name].as_u64().unwrap_or(0);
    fuel("start_fuel") + fuel("steps_fuel")
}

fn reason_of(entry: &Value) -> String {
    let reason = entry["refusal"]["reason"].as_str();
    let detail = entry["fault"]["detail"].as_str();
    reason.or(detail).unwrap_or_default().to_owned()
}

/// The kinds of what became of robots, each once.
fn in_few_words(entries: &[Value]) -> String {
    let mut kinds: Vec<String> = entries
        .iter()
        .map(|entry| {
            let text = |value: &Value| value.as_str().unwrap_or("?").to_owned();
            if let Some(refusal) = entry.get("refusal") {
                format!("refused: {}", text(&refusal["kind"]))
            } else if let Some(fault) = entry.get("fault") {
                format!("fault: {}", text(&fault["kind"]))
            } else {
                text(&entry["verdict"])
            }
        })
        .collect();
    kinds.sort();
    kinds.dedup();
    kinds.join(" | ")
}
