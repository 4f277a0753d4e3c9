//! [`Bench`]: plays cases through the `wasmouse` binary and compares the outcomes.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};
use wasmouse_engine::bundled::find;

use super::case::{Case, Mode};
use super::measure::{Measured, measure};
use crate::program::Program;

/// The good robot of every case: a bundled one as an untrusted file, which plays where the
/// hostile robots did.
const GOOD: &str = "good";
/// Where they play.
const MAZE: &str = "test_maze_01";

/// The memory that the supervisor may use at most, in MiB.
const SUPERVISOR_MEGABYTES_MAX: u64 = 200;

/// The exit code of a contest with a rejection or a fault.
const EXIT_ROBOT: i32 = 4;

/// A program to play with.
#[derive(Debug)]
pub struct Bench {
    program: Program,
    /// The matches of the good robot alone, by the case's arguments.
    alone: RefCell<BTreeMap<String, Vec<Value>>>,
}

/// The outcome of a case in a mode.
#[derive(Debug)]
pub struct Judgement {
    /// In a few words.
    pub verdict: String,
    /// The message of the first rejection or fault; empty if there is none.
    pub reason: String,
    /// What was expected, in a few words.
    pub expected: String,
    /// How long it took.
    pub time: Duration,
    /// Peak memory of the process that was started, in bytes.
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
        let good = find("flood").ok_or(io::ErrorKind::NotFound)?;
        fs::write(bench.path(GOOD), good.component)?;
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
        // After the hostile ones: with one thread, it plays in what they leave behind.
        arguments.push(format!("--robot={GOOD}.wasm"));
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

    /// The matches of the good robot when it is alone.
    fn alone(&self, case: &Case) -> io::Result<Vec<Value>> {
        let key = case.arguments.join(" ");
        if let Some(matches) = self.alone.borrow().get(&key) {
            return Ok(matches.clone());
        }
        let mut arguments = self.arguments(case, Mode::Trusted);
        arguments.extend(["--json".into(), format!("--robot={GOOD}.wasm")]);
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
        if mode == Mode::Sandboxed {
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

/// The web page of a case whose reports are checked.
const PAGE: &str = "page.html";

impl Judgement {
    /// Whether all is well.
    pub fn is_well(&self) -> bool {
        self.problems.is_empty()
    }

    /// Checks the results as JSON.
    fn results(&mut self, case: &Case, robots: &[String], measured: &Measured, alone: &[Value]) {
        let Ok(document) = serde_json::from_str::<Value>(&measured.stdout) else {
            self.verdict = "no result".into();
            let talk: String = measured.stderr.chars().take(500).collect();
            self.problems
                .push(format!("printed no JSON; stderr: {talk:?}"));
            return;
        };
        let summary = &document["summary"];
        if summary["complete"] != json!(true) || summary["failures"] != json!([]) {
            let failures = &summary["failures"];
            self.problems.push(format!("internal error: {failures}"));
        }
        let mut found = Vec::new();
        let mut has_failed = false;
        for name in robots {
            for entry in entries_of(&document, name) {
                has_failed |=
                    entry.get("rejection").is_some() || entry["verdict"]["kind"] == json!("fault");
                let fuel = |part: &str| entry["fuel"][part].as_u64().unwrap_or(0);
                self.fuel += fuel("start") + fuel("steps");
                if !case.allows(&entry) {
                    self.problems.push(format!("{name}: {entry}"));
                }
                found.push(entry);
            }
        }
        self.verdict = in_few_words(&found);
        self.reason = found.first().map(reason_of).unwrap_or_default();
        let exit = if has_failed { EXIT_ROBOT } else { 0 };
        let status = measured.status.and_then(|status| status.code());
        if status != Some(exit) {
            self.problems
                .push(format!("exit code {status:?} instead of {exit}"));
        }
        let matches = matches_of(&document, GOOD);
        if matches != alone {
            self.problems
                .push(format!("the good robot was affected: {matches:?}"));
        }
        self.harmless("the JSON", &measured.stdout);
        self.harmless("stderr", &measured.stderr);
    }

    /// Checks the reports for people.
    fn texts(&mut self, shown: &Measured, page: &str) {
        self.harmless("stdout", &shown.stdout);
        self.harmless("stderr", &shown.stderr);
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

    /// No character that controls a terminal or deceives the eye.
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
            self.problems.push(format!("{what} reports a panic"));
        }
    }
}

/// The rejection of a robot, or its matches.
fn entries_of(document: &Value, name: &str) -> Vec<Value> {
    match robot(document, name) {
        None => vec![json!({"missing": name})],
        Some(robot) => match robot.get("rejection") {
            Some(rejection) => vec![json!({"rejection": rejection})],
            None => match matches_of(document, name) {
                matches if matches.is_empty() => vec![json!({"no match": name})],
                matches => matches,
            },
        },
    }
}

fn robot<'a>(document: &'a Value, name: &str) -> Option<&'a Value> {
    let mut robots = document["contest"]["robots"].as_array()?.iter();
    robots.find(|robot| robot["name"] == json!(name))
}

fn matches_of(document: &Value, name: &str) -> Vec<Value> {
    let digest = robot(document, name).map(|robot| &robot["digest"]);
    let matches = document["matches"].as_array().into_iter().flatten();
    let of_robot = matches.filter(|it| Some(&it["key"]["robot"]) == digest);
    of_robot.cloned().collect()
}

fn reason_of(entry: &Value) -> String {
    let reason = entry["rejection"]["reason"].as_str();
    let detail = entry["verdict"]["fault"]["detail"].as_str();
    reason.or(detail).unwrap_or_default().to_owned()
}

/// The kinds of outcomes, each once.
fn in_few_words(entries: &[Value]) -> String {
    let kind = |value: &Value| value["kind"].as_str().unwrap_or("?").to_owned();
    let kinds = entries.iter().map(|entry| {
        let (rejection, fault) = (&entry["rejection"], &entry["verdict"]["fault"]);
        if rejection.is_object() {
            format!("rejected: {}", kind(rejection))
        } else if fault.is_object() {
            format!("fault: {}", kind(fault))
        } else {
            kind(&entry["verdict"])
        }
    });
    let kinds: BTreeSet<String> = kinds.collect();
    Vec::from_iter(kinds).join(" | ")
}
