//! The reference page: the bundled robots in the official mazes, beside what the
//! reports measured, in a study of generated mazes, and in competition mazes. Markdown.
//!
//! The page is a pure function of results and holds neither times nor dates, so
//! the same study gives the same bytes. One file for each part of it; the reports'
//! own figures are in [`published`].

pub mod published;

mod beside;
mod competition;
mod generated;
mod official;

#[cfg(test)]
mod tests;

use super::markdown::{Table, code, grouped, mean};
use crate::contest::{CompetitionMazes, Contest, MatchResult, Mean, Study};
use crate::robot::bundled::find;
use crate::robot::{Digest, Verdict, engine_id};
use crate::sim::Score;

/// How every page begins: a file that begins like this may be replaced by a new
/// page.
pub const MARK: &str =
    "<!-- Written by `wasmouse study`: make it again instead of editing it. -->\n";

/// An entrant by the names that reports and readers know it by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Competitor {
    /// The name of the robot, without its setting.
    pub robot: String,
    /// The name of its setting, or the number of one without a name; `None` of
    /// a robot without settings.
    pub setting: Option<String>,
    /// Whether it comes with wasmouse; a file that has the name of a bundled
    /// robot is not that robot.
    pub is_bundled: bool,
}

impl Competitor {
    /// Whether it is that bundled robot in that setting.
    pub fn is(&self, robot: &str, setting: Option<&str>) -> bool {
        self.is_bundled && self.robot == robot && self.setting.as_deref() == setting
    }

    /// What a bundled robot does, and what its setting changes.
    fn description(&self) -> String {
        let robot = find(&self.robot).filter(|_| self.is_bundled);
        let Some(robot) = robot else {
            return "Not bundled.".to_owned();
        };
        let name = self.setting.as_deref();
        let setting = robot.variants.iter().find(|it| Some(it.name) == name);
        let parts = [Some(robot.description), setting.map(|it| it.description)];
        let parts: Vec<&str> = parts.into_iter().flatten().collect();
        parts.join(" ")
    }

    /// `robot:setting`, as on the command line, in the typewriter font.
    fn label(&self) -> String {
        label(&self.robot, self.setting.as_deref())
    }
}

fn label(robot: &str, setting: Option<&str>) -> String {
    match setting {
        Some(setting) => code(&format!("{robot}:{setting}")),
        None => code(robot),
    }
}

/// Everything that the page tells.
pub struct Reference<'a> {
    /// What was played with seed 0: official mazes and families of generated ones.
    pub study: Study<'a>,
    /// The names of the contest's entrants, in their order.
    pub competitors: &'a [Competitor],
    /// Where the mazes of competitions are in the contest, if they are.
    pub competition: Option<CompetitionMazes>,
    /// Where the official mazes 01, 02 and 03 are in the contest, those that are.
    pub official: [Option<usize>; 3],
    /// The random robot alone in maze 01 with many seeds, if it took part.
    pub tries: Option<(&'a Contest, &'a [MatchResult])>,
    /// The command that makes the page.
    pub command: String,
}

impl Reference<'_> {
    /// The page.
    pub fn to_markdown(&self) -> String {
        let sections = [
            MARK.to_owned(),
            self.introduction(),
            self.robots(),
            official::section(self),
            beside::section(self),
            generated::section(self),
            competition::section(self),
            self.identity(),
        ];
        let mut page = sections
            .map(|section| section.trim_end().to_owned())
            .join("\n\n");
        page.push('\n');
        page
    }

    fn introduction(&self) -> String {
        let mazes: usize = self.study.groups.iter().map(|it| it.mazes.len()).sum();
        format!(
            "# The reference robots\n\n\
             What the robots that come with wasmouse do [in the official mazes](#official-mazes),\n\
             [beside what the reports say](#beside-the-reports) that their robots did,\n\
             [in {} generated mazes](#generated-mazes), and\n\
             [in mazes of competitions](#competition-mazes).\n\n\
             A score is the steps of run 2 plus a share of the steps of run 1, lower is better. A\n\
             robot that knows the maze drives the shortest way, resets, and drives it again: its\n\
             score is the *floor*, and what a score has beyond the floor is its *regret*.\n\n\
             This page is written by\n\n\
             ```sh\n{}\n```\n\n\
             where the folders, if there are any, hold `test_maze_02.txt` and `test_maze_03.txt`, and\n\
             the mazes of competitions, which do not come with wasmouse. The same version writes the\n\
             same bytes again, on any number of threads; [what was played](#what-was-played) has the\n\
             engine, the seeds and the hashes.\n",
            grouped(mazes as u64),
            self.command,
        )
    }

    fn robots(&self) -> String {
        let mut table = Table::new(&["robot", "what it does"], 2);
        for competitor in self.competitors {
            table.row([competitor.label(), competitor.description()]);
        }
        format!(
            "## The robots\n\n\
             Robots with settings are named `robot:setting`, as on the command line. How each works\n\
             and what its report leaves open is in its documentation under `example-robots`.\n\n{}",
            table.finish()
        )
    }

    fn contest(&self) -> &Contest {
        self.study.contest
    }

    /// The entrant that stands for a robot of a report.
    fn find(&self, robot: &str, setting: Option<&str>) -> Option<usize> {
        let mut competitors = self.competitors.iter();
        competitors.position(|competitor| competitor.is(robot, setting))
    }

    /// The result of an entrant in an official maze, counted from 0; `None` when
    /// the maze is absent or the robot was refused.
    fn in_official(&self, entrant: usize, number: usize) -> Option<&MatchResult> {
        let maze = self.official[number]?;
        let is_it = |result: &&MatchResult| result.entrant == entrant && result.maze == maze;
        self.study.results.iter().find(is_it)
    }

    /// Engine, rules, seeds and hashes.
    fn identity(&self) -> String {
        let contest = self.contest();
        let rules = &contest.rules;
        let mut text = format!(
            "## What was played\n\n\
             - wasmouse {}, engine `{}`. Fuel is comparable within one engine only.\n\
             - Ruleset `{}` version {}, SHA-256 `{}`.\n\
             - Every match has the seed 0{}.\n\n",
            env!("CARGO_PKG_VERSION"),
            engine_id(),
            rules.name,
            rules.version,
            Digest::of(&rules.identity_bytes()).hex(),
            match self.tries {
                Some(_) => ", except for [the random tries](#random-tries)",
                None => "",
            },
        );
        let mut mazes = Table::new(&["mazes", "SHA-256", "count"], 2);
        for maze in self.official.iter().flatten().map(|&it| &contest.mazes[it]) {
            mazes.row([code(&maze.name), code(&maze.digest.hex()), "1".into()]);
        }
        for group in self.study.groups {
            mazes.row([
                code(&group.spec.to_string()),
                code(&self.study.digest(&group.mazes).hex()),
                grouped(group.mazes.len() as u64),
            ]);
        }
        for (name, set) in self.competition.iter().flat_map(competition::sets) {
            mazes.row([
                format!("of competitions, {name}"),
                code(&self.study.digest(set).hex()),
                grouped(set.len() as u64),
            ]);
        }
        text.push_str(&mazes.finish());
        text.push_str(
            "\nThe hash of several mazes is that of their hashes, one behind the other. No parameter\n\
             of a bundled robot was fixed on mazes of these seeds.\n\n",
        );
        let mut robots = Table::new(&["robot", "SHA-256 of its component"], 2);
        let mut told: Vec<&Digest> = Vec::new();
        for (competitor, entrant) in self.competitors.iter().zip(&contest.entrants) {
            if !told.contains(&&entrant.digest) {
                robots.row([code(&competitor.robot), code(&entrant.digest.hex())]);
                told.push(&entrant.digest);
            }
        }
        text.push_str(&robots.finish());
        text
    }
}

/// The score of a result, if it has one.
fn score(result: &MatchResult) -> Option<Score> {
    match result.outcome.verdict {
        Verdict::Finished(score) => Some(score),
        Verdict::BudgetUsedUp { .. } | Verdict::Fault(_) => None,
    }
}

/// `21.867 (146 + 17)`: a score with the steps of run 1 and run 2, or how the
/// match ended without one.
fn score_with_steps(result: &MatchResult) -> String {
    let [exploration, speed] = result.outcome.steps;
    match score(result) {
        Some(score) => format!("{score} ({exploration} + {speed})"),
        None => result.outcome.verdict.title().into_owned(),
    }
}

/// The sum of three scores, exactly.
fn sum(scores: [Score; 3]) -> String {
    let average: Option<Mean> = scores.into_iter().collect();
    mean(average.map(|average| average.times(3)))
}
