//! [`Verification`]: a contest's document against the same matches played again.
//!
//! First the document is held against itself, then its matches are played again by
//! whoever has robots and mazes, then every field is compared with what came of that,
//! and in the end the text with the one that would be written now. So a change
//! anywhere is found, whatever it is.

use std::collections::HashSet;

use serde_json::{Value, json};

use super::difference::{Difference, Differences, MatchName};
use super::finder::Finder;
use super::place::place;
use super::{ContestReport, WireFailed, WireMatch};
use crate::contest::{Contest, FailedMatch, MatchResult, Pairing, Played, standings};

/// Where values come from that a match had when it was played again.
const PLAYED: &str = "played";

/// Where values come from that this program computed from robots and mazes at hand.
const HERE: &str = "here";

/// A document that is being verified.
pub struct Verification<'a> {
    recorded: &'a ContestReport<'a>,
    differences: Differences,
}

/// The matches of a document as matches of a contest, in the document's order.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    /// Each with its index in the document.
    matches: Vec<(usize, Pairing)>,
    failed: Vec<(usize, Pairing)>,
}

/// What could not be compared.
#[derive(Debug, Default)]
pub struct Unplayed {
    /// Matches that were left out: there was an interrupt, or the robot is refused.
    pub missing: usize,
    /// Matches that the host failed to play: which, and why.
    pub failed: Vec<String>,
}

impl Schedule {
    /// All of them, to be played.
    pub fn pairings(&self) -> Vec<Pairing> {
        let all = self.matches.iter().chain(&self.failed);
        all.map(|&(_, pairing)| pairing).collect()
    }
}

impl<'a> Verification<'a> {
    /// Holds a document against itself.
    pub fn new(recorded: &'a ContestReport<'a>) -> Self {
        let mut new = Self {
            recorded,
            differences: Differences::default(),
        };
        new.check_count();
        new.check_settings(|setting, said| setting != 0 && said != Some(setting));
        if new.is_by_position() {
            new.check_names();
        }
        new.check_standings();
        new
    }

    /// What is wrong, as far as it is known.
    pub const fn differences(&self) -> &Differences {
        &self.differences
    }

    /// Adds something that is wrong.
    pub fn add(&mut self, difference: Difference) {
        self.differences.push(difference);
    }

    /// Finds the matches in a contest of the document's robots, mazes and seeds. One
    /// that cannot be there is a difference.
    pub fn schedule(&mut self, contest: &Contest) -> Schedule {
        let recorded = self.recorded;
        if self.is_by_position() {
            let positions = self.positions().into_iter();
            let matches = positions.zip(&recorded.matches).enumerate();
            let matches = matches.map(|(index, ([entrant, maze, _], it))| {
                let seed = it.seed;
                (
                    index,
                    Pairing {
                        entrant,
                        maze,
                        seed,
                    },
                )
            });
            return Schedule {
                matches: matches.collect(),
                failed: Vec::new(),
            };
        }
        let named = |it: &WireMatch<'_>| MatchName {
            robot: it.robot.to_string(),
            maze: it.maze.to_string(),
            seed: it.seed,
        };
        let matches = recorded.matches.iter().map(named);
        let matches = self.find("matches", contest, matches);
        let failed = recorded.failed.iter().map(|it| MatchName {
            robot: it.robot.to_string(),
            maze: it.maze.to_string(),
            seed: it.seed,
        });
        let failed = self.find("failed", contest, failed);
        Schedule { matches, failed }
    }

    /// Compares the document, whose text these bytes are, with what came of a
    /// [`Schedule`].
    pub fn compare(
        &mut self,
        contest: &Contest,
        schedule: &Schedule,
        played: Played,
        bytes: &[u8],
    ) -> Unplayed {
        let mut unplayed = Unplayed::default();
        let mut again = Played::default();
        let mut next = Arrivals::new(played);
        self.compare_head(contest);
        for &(index, pairing) in &schedule.matches {
            match next.of(pairing) {
                Some(Ok(result)) => {
                    self.compare_match(contest, index, &result);
                    again.results.push(result);
                }
                Some(Err(failed)) => unplayed
                    .failed
                    .push(format!("matches[{index}]: {}", failed.error)),
                None => unplayed.missing += 1,
            }
        }
        for &(index, pairing) in &schedule.failed {
            match next.of(pairing) {
                Some(came) => again
                    .failed
                    .extend(self.compare_failed(contest, index, came)),
                None => unplayed.missing += 1,
            }
        }
        if unplayed.missing == 0 && unplayed.failed.is_empty() {
            self.compare_rest(contest, &again, bytes);
        }
        if self.differences.count() > 0 {
            // A file may be called `bot:1.wasm`, so this alone is nothing wrong.
            self.check_settings(|setting, said| setting == 0 && said.is_some());
        }
        unplayed
    }

    fn compare_match(&mut self, contest: &Contest, index: usize, result: &MatchResult) {
        let recorded = &self.recorded.matches[index];
        let mut found = WireMatch::new(contest, result);
        // Names were held against the lists of robots and mazes before.
        found.robot.clone_from(&recorded.robot);
        found.maze.clone_from(&recorded.maze);
        if *recorded != found {
            let path = format!("matches[{index}]");
            let name = MatchName {
                robot: recorded.robot.to_string(),
                maze: recorded.maze.to_string(),
                seed: recorded.seed,
            };
            self.differences
                .compare(&path, PLAYED, (recorded, &found), Some(&name));
        }
    }

    /// A failure of the host says nothing of the robot, so that it does not come
    /// again is a difference like any other.
    fn compare_failed(
        &mut self,
        contest: &Contest,
        index: usize,
        came: Result<MatchResult, FailedMatch>,
    ) -> Option<FailedMatch> {
        let recorded = &self.recorded.failed[index];
        let path = format!("failed[{index}]");
        match came {
            Ok(result) => {
                self.add(Difference {
                    path,
                    recorded: Some(json!(recorded.reason)),
                    source: PLAYED.to_owned(),
                    found: Some(json!(result.outcome.verdict.name())),
                    of: Some(MatchName {
                        robot: recorded.robot.to_string(),
                        maze: recorded.maze.to_string(),
                        seed: recorded.seed,
                    }),
                });
                None
            }
            Err(failed) => {
                let found = WireFailed::new(contest, &failed);
                self.differences
                    .compare(&path, PLAYED, (recorded, &found), None);
                Some(failed)
            }
        }
    }

    /// Everything before the matches.
    fn compare_head(&mut self, contest: &Contest) {
        let nothing = Played::default();
        let found = ContestReport::new(contest, &nothing, &[]);
        let recorded = self.recorded;
        let differences = &mut self.differences;
        let texts = (&recorded.wasmouse, &found.wasmouse);
        differences.compare("wasmouse", HERE, texts, None);
        let texts = (&recorded.engine, &found.engine);
        differences.compare("engine", HERE, texts, None);
        let rules = (&recorded.ruleset, &found.ruleset);
        differences.compare("ruleset", HERE, rules, None);
        differences.compare("robots", HERE, (&recorded.robots, &found.robots), None);
        differences.compare("mazes", HERE, (&recorded.mazes, &found.mazes), None);
    }

    /// Everything behind the matches, when they are all there, and the text.
    fn compare_rest(&mut self, contest: &Contest, again: &Played, bytes: &[u8]) {
        let standings = standings(contest, &again.results);
        let found = ContestReport::new(contest, again, &standings);
        let lines = (&self.recorded.standings, &found.standings);
        self.differences
            .compare("standings", "counted", lines, None);
        if self.differences.count() == 0 {
            self.compare_text(bytes, &found);
        }
    }

    /// All values are right. Is the text?
    fn compare_text(&mut self, bytes: &[u8], found: &ContestReport<'_>) {
        let text = found.to_json();
        if bytes == text.as_bytes() {
            return;
        }
        let mut pairs = bytes.iter().zip(text.as_bytes());
        let shorter = bytes.len().min(text.len());
        let at = pairs.position(|(one, other)| one != other);
        let place = place(text.as_bytes(), at.unwrap_or(shorter));
        let line = |text: &str| {
            let line = text.lines().nth(place.line - 1);
            line.map(|line| Value::String(line.to_owned()))
        };
        let path = match &place.path[..] {
            "" => "text",
            path => path,
        };
        self.add(Difference {
            path: path.to_owned(),
            recorded: line(&String::from_utf8_lossy(bytes)),
            source: format!("line {} has to be", place.line),
            found: line(&text),
            of: None,
        });
    }

    /// Whether each match has its place, because none is missing.
    fn is_by_position(&self) -> bool {
        let count = self.recorded.matches.len() as u128;
        count == self.recorded.matches_expected() && self.recorded.failed.is_empty()
    }

    /// Robot, maze and seed, as indices, of all matches when none is missing.
    fn positions(&self) -> Vec<[usize; 3]> {
        let robots = self.recorded.robots.iter().enumerate();
        let admitted = robots.filter(|(_, robot)| robot.refusal.is_none());
        let (mazes, seeds) = (self.recorded.mazes.len(), self.recorded.seeds.len());
        admitted
            .flat_map(|(robot, _)| (0..mazes).map(move |maze| (robot, maze)))
            .flat_map(|(robot, maze)| (0..seeds).map(move |seed| [robot, maze, seed]))
            .collect()
    }

    fn check_count(&mut self) {
        let (count, expected) = (
            self.recorded.matches.len(),
            self.recorded.matches_expected(),
        );
        let is_complete = count as u128 == expected;
        if self.recorded.complete != is_complete {
            self.add(Difference {
                path: "complete".to_owned(),
                recorded: Some(json!(self.recorded.complete)),
                source: format!("with {count} of {expected} matches"),
                found: Some(json!(is_complete)),
                of: None,
            });
        }
    }

    /// The end of a name tells the setting when there is one: `flood:1`.
    fn check_settings(&mut self, is_wrong: impl Fn(u32, Option<u32>) -> bool) {
        for (index, robot) in self.recorded.robots.iter().enumerate() {
            let said = robot
                .name
                .rsplit_once(':')
                .and_then(|(_, end)| end.parse().ok());
            if is_wrong(robot.setting, said) {
                self.differences.push_first(Difference {
                    path: format!("robots[{index}].setting"),
                    recorded: Some(json!(robot.setting)),
                    source: format!("by the end of robots[{index}].name"),
                    found: Some(json!(said.unwrap_or(0))),
                    of: None,
                });
            }
        }
    }

    /// Matches name robot, maze and seed, which their places say too.
    fn check_names(&mut self) {
        let recorded = self.recorded;
        let positions = self.positions();
        let all = recorded.matches.iter().zip(&positions);
        let said = all.clone().map(|(it, place)| (place[0], json!(it.robot)));
        let listed = recorded.robots.iter().map(|it| json!(it.name));
        let fields = ("robots", ".name", "robot");
        self.check_list(
            fields,
            &listed.collect::<Vec<_>>(),
            &said.collect::<Vec<_>>(),
        );
        let said = all.clone().map(|(it, place)| (place[1], json!(it.maze)));
        let listed = recorded.mazes.iter().map(|it| json!(it.name));
        let fields = ("mazes", ".name", "maze");
        self.check_list(
            fields,
            &listed.collect::<Vec<_>>(),
            &said.collect::<Vec<_>>(),
        );
        let said = all.map(|(it, place)| (place[2], json!(it.seed)));
        let listed = recorded.seeds.iter().map(|seed| json!(seed));
        let fields = ("seeds", "", "seed");
        self.check_list(
            fields,
            &listed.collect::<Vec<_>>(),
            &said.collect::<Vec<_>>(),
        );
    }

    /// Compares what is `listed` with what matches say, each with the index of what it
    /// should be. When all matches contradict the list alike, the list is wrong.
    fn check_list(
        &mut self,
        (list, name, field): (&str, &str, &str),
        listed: &[Value],
        said: &[(usize, Value)],
    ) {
        // For each of the list: the first match that speaks of it, and whether all
        // that do say the same.
        let mut voices: Vec<Option<(usize, bool)>> = vec![None; listed.len()];
        for (place, (index, value)) in said.iter().enumerate() {
            voices[*index] = match voices[*index] {
                None => Some((place, true)),
                Some((first, all)) => Some((first, all && said[first].1 == *value)),
            };
        }
        let contradicted = |index: usize| match voices[index] {
            Some((first, true)) if said[first].1 != listed[index] => Some(first),
            _ => None,
        };
        for (index, recorded) in listed.iter().enumerate() {
            if let Some(first) = contradicted(index) {
                self.add(Difference {
                    path: format!("{list}[{index}]{name}"),
                    recorded: Some(recorded.clone()),
                    source: format!("in matches[{first}].{field}"),
                    found: Some(said[first].1.clone()),
                    of: None,
                });
            }
        }
        for (place, (index, value)) in said.iter().enumerate() {
            if *value != listed[*index] && contradicted(*index).is_none() {
                self.add(Difference {
                    path: format!("matches[{place}].{field}"),
                    recorded: Some(value.clone()),
                    source: format!("in {list}[{index}]{name}"),
                    found: Some(listed[*index].clone()),
                    of: None,
                });
            }
        }
    }

    /// Every robot is in the standings, by its name.
    fn check_standings(&mut self) {
        let recorded = self.recorded;
        let ranked: HashSet<&str> = recorded.standings.iter().map(|it| &*it.robot).collect();
        let robots = recorded.robots.iter().enumerate();
        for (index, robot) in robots.filter(|(_, it)| !ranked.contains(&*it.name)) {
            self.add(Difference {
                path: format!("robots[{index}].name"),
                recorded: Some(json!(robot.name)),
                source: "in standings".to_owned(),
                found: None,
                of: None,
            });
        }
    }

    /// Finds matches by name, each behind the one before it.
    fn find(
        &mut self,
        list: &str,
        contest: &Contest,
        names: impl Iterator<Item = MatchName>,
    ) -> Vec<(usize, Pairing)> {
        let mut finder = Finder::new(contest);
        let mut found = Vec::new();
        for (index, name) in names.enumerate() {
            match finder.next(&name) {
                Some(pairing) => found.push((index, pairing)),
                None => self.add(Difference {
                    path: format!("{list}[{index}]"),
                    recorded: Some(json!(name)),
                    source: "among the matches of this contest behind the one before".to_owned(),
                    found: None,
                    of: None,
                }),
            }
        }
        found
    }
}

/// What came of a schedule, in its order.
struct Arrivals {
    results: std::iter::Peekable<std::vec::IntoIter<MatchResult>>,
    failed: std::iter::Peekable<std::vec::IntoIter<FailedMatch>>,
}

impl Arrivals {
    fn new(played: Played) -> Self {
        Self {
            results: played.results.into_iter().peekable(),
            failed: played.failed.into_iter().peekable(),
        }
    }

    /// What came of the next match of the schedule; `None` when it was not played.
    fn of(&mut self, pairing: Pairing) -> Option<Result<MatchResult, FailedMatch>> {
        let result = self.results.next_if(|it| it.pairing() == pairing);
        result.map(Ok).or_else(|| {
            let failed = self.failed.next_if(|it| it.pairing() == pairing);
            failed.map(Err)
        })
    }
}
