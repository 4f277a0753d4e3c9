//! [`View`]: what a report may show of a contest, and what it calls robots and mazes.
//!
//! Every format takes its lists from here, so that none shows what the options hide.

use std::collections::{HashMap, HashSet};

use wasmouse_core::game::Verdict;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{Digest, GuestText};

use super::super::faults::explained;
use super::document::{Compared, ContestReport, PartRanking};
use crate::contest::{
    Complaint, MatrixMaze, MatrixRobot, NotAdmitted, Ranking, RankingLine, RobotState, ScoreMatrix,
};

/// What a report shows. Formats escape the texts.
#[derive(Debug)]
pub(super) struct View<'a> {
    pub(super) report: &'a ContestReport<'a>,
    /// The robots that are shown, in the order of the overall ranking, as indices in the matrix.
    pub(super) robots: Vec<usize>,
    /// The mazes that are shown, in the order of the matrix.
    pub(super) mazes: Vec<usize>,
    /// By robot of the matrix, what it is called.
    names: Vec<GuestText>,
    /// By maze of the matrix.
    is_maze_hidden: Vec<bool>,
    mazes_by_digest: HashMap<Digest, usize>,
}

/// A table of ranks.
pub(super) struct Part<'a> {
    /// The name of its set.
    pub(super) set: Option<GuestStr<'a>>,
    /// The name of its class.
    pub(super) class: Option<GuestStr<'a>>,
    pub(super) ranking: &'a Ranking,
    /// The lines that are shown.
    pub(super) lines: Vec<&'a RankingLine>,
}

/// Why a robot has no rank.
pub(super) struct Unranked<'a> {
    pub(super) robot: usize,
    /// One word or two: `rejected`, `withdrawn`.
    pub(super) state: &'static str,
    /// Why, if that may be shown, and for how many matches.
    pub(super) reasons: Vec<(&'a GuestText, Option<u64>)>,
    /// The same of a rejection, which makes its texts itself.
    pub(super) rejection: Option<(GuestText, GuestStr<'a>)>,
}

/// A kind of fault of a robot.
pub(super) struct FaultLine<'a> {
    pub(super) robot: usize,
    /// The name of the kind.
    pub(super) kind: &'static str,
    pub(super) count: u64,
    /// How many matches the robot has played.
    pub(super) matches: u64,
    /// The first match that ended so; `None` in a hidden maze.
    pub(super) first: Option<FirstFault<'a>>,
    /// What the robot wrote then, if that may be shown.
    pub(super) complaint: Option<&'a Complaint>,
}

/// Where a fault happened first.
pub(super) struct FirstFault<'a> {
    pub(super) maze: GuestStr<'a>,
    pub(super) seed: u64,
    /// The message with its place, if that may be shown.
    pub(super) detail: Option<GuestText>,
}

impl<'a> View<'a> {
    pub(super) fn new(report: &'a ContestReport<'a>) -> Self {
        let matrix = report.matrix;
        let is_maze_hidden = matrix
            .mazes
            .iter()
            .map(|maze| report.options.hide_hidden_mazes && matrix.sets[maze.set].is_hidden);
        let is_maze_hidden: Vec<bool> = is_maze_hidden.collect();
        let shown = shown(report);
        let lines = report.overall.lines.iter().map(|line| line.robot);
        let mazes = 0..matrix.mazes.len();
        let digests = matrix.mazes.iter().enumerate();
        Self {
            report,
            robots: lines.filter(|&robot| shown[robot]).collect(),
            mazes: mazes.filter(|&maze| !is_maze_hidden[maze]).collect(),
            names: names(matrix, report.options.hide_names),
            is_maze_hidden,
            mazes_by_digest: digests.map(|(index, maze)| (maze.digest, index)).collect(),
        }
    }

    pub(super) fn matrix(&self) -> &'a ScoreMatrix {
        self.report.matrix
    }

    pub(super) fn robot(&self, robot: usize) -> &'a MatrixRobot {
        &self.matrix().robots[robot]
    }

    pub(super) fn maze(&self, maze: usize) -> &'a MatrixMaze {
        &self.matrix().mazes[maze]
    }

    /// What a robot is called.
    pub(super) fn name(&self, robot: usize) -> GuestStr<'_> {
        self.names[robot].as_guest()
    }

    /// Who submitted a robot.
    pub(super) fn author(&self, robot: usize) -> Option<GuestStr<'a>> {
        let author = self.robot(robot).author.as_ref();
        let author = author.filter(|_| !self.report.options.hide_names);
        author.map(GuestStr::from)
    }

    /// The digest of a robot's file.
    pub(super) fn digest(&self, robot: usize) -> Option<Digest> {
        (!self.report.options.hide_names).then(|| self.robot(robot).digest)
    }

    /// The maze with that digest, unless it must not be shown.
    pub(super) fn maze_by_digest(&self, digest: &Digest) -> Option<usize> {
        let maze = self.mazes_by_digest.get(digest).copied();
        maze.filter(|&maze| !self.is_maze_hidden[maze])
    }

    /// How many robots are left out.
    pub(super) fn robots_hidden(&self) -> usize {
        self.matrix().robots.len() - self.robots.len()
    }

    /// How many mazes are left out.
    pub(super) fn mazes_hidden(&self) -> usize {
        self.matrix().mazes.len() - self.mazes.len()
    }

    /// The rankings, the overall one first.
    pub(super) fn parts(&self) -> Vec<Part<'a>> {
        let report = self.report;
        let overall = self.part(None, None, &report.overall);
        let set = |it: &'a PartRanking| self.part(Some(it.name.as_guest()), None, &it.ranking);
        let class = |it: &'a PartRanking| self.part(None, Some(it.name.as_guest()), &it.ranking);
        let sets = report.sets.iter().map(set);
        let classes = report.classes.iter().map(class);
        std::iter::once(overall)
            .chain(sets)
            .chain(classes)
            .collect()
    }

    fn part(
        &self,
        set: Option<GuestStr<'a>>,
        class: Option<GuestStr<'a>>,
        ranking: &'a Ranking,
    ) -> Part<'a> {
        let lines = ranking.lines.iter();
        Part {
            set,
            class,
            ranking,
            lines: lines
                .filter(|line| self.robots.contains(&line.robot))
                .collect(),
        }
    }

    /// The overall line of a robot.
    pub(super) fn line(&self, robot: usize) -> &'a RankingLine {
        let mut lines = self.report.overall.lines.iter();
        let line = lines.find(|line| line.robot == robot);
        line.expect("a ranking has a line for every robot")
    }

    /// The comparisons of robots that are shown.
    pub(super) fn comparisons(&self) -> Vec<&'a Compared> {
        let comparisons = self.report.comparisons.iter();
        let is_shown = |robot: &usize| self.robots.contains(robot);
        comparisons
            .filter(|it| is_shown(&it.first) && is_shown(&it.second))
            .collect()
    }

    /// The robots without a rank, and why, unless the contest has just not come to them.
    pub(super) fn unranked(&self) -> Vec<Unranked<'a>> {
        let robots = self.robots.iter().copied();
        let mut unranked = Vec::new();
        for robot in robots {
            let MatrixRobot {
                not_admitted,
                unplayed,
                ..
            } = self.robot(robot);
            let (mut reasons, mut rejection) = (Vec::new(), None);
            match not_admitted {
                Some(NotAdmitted::Rejected(it)) => rejection = Some((it.reason(), it.hint())),
                Some(NotAdmitted::Failed(reason)) => reasons.push((reason, None)),
                None if unplayed.is_empty() => continue,
                None => {
                    let each = unplayed.iter();
                    reasons.extend(each.map(|(reason, &count)| (reason, Some(count))));
                }
            }
            if self.report.options.hide_names {
                // They can quote the robot.
                rejection = None;
                reasons.clear();
            }
            unranked.push(Unranked {
                robot,
                state: state(self.robot(robot), self.line(robot).state)
                    .unwrap_or("not played completely"),
                reasons,
                rejection,
            });
        }
        unranked
    }

    /// The faults of the robots that are shown, by robot.
    pub(super) fn faults(&self) -> Vec<FaultLine<'a>> {
        let mut lines = Vec::new();
        for &robot in &self.robots {
            for (kind, fault) in &self.robot(robot).faults {
                let key = &fault.first.key;
                let maze = self.maze_by_digest(&key.maze);
                let may_show = !self.report.options.hide_names;
                let complaint = self.report.complaints.get(&(robot, *kind));
                let complaint = complaint.filter(|_| may_show && maze.is_some());
                let detail = match &fault.first.verdict {
                    Verdict::Fault { fault } if may_show => Some(explained(fault, complaint)),
                    _ => None,
                };
                lines.push(FaultLine {
                    robot,
                    kind,
                    count: fault.count,
                    matches: self.played(robot),
                    first: maze.map(|maze| FirstFault {
                        maze: GuestStr::from(&self.maze(maze).name),
                        seed: key.seed,
                        detail,
                    }),
                    complaint,
                });
            }
        }
        lines
    }

    /// How many matches were played. Robots with the same file and variant play once.
    pub(super) fn matches_played(&self) -> u64 {
        let mut players = HashSet::new();
        let robots = self.matrix().robots.iter().enumerate();
        let mut is_first = |robot: &MatrixRobot| players.insert((robot.digest, robot.variant));
        let robots = robots.filter(|(_, robot)| is_first(robot));
        robots.map(|(index, _)| self.played(index)).sum()
    }

    /// How many matches a robot has played, in all mazes.
    fn played(&self, robot: usize) -> u64 {
        let matrix = self.matrix();
        let mazes = 0..matrix.mazes.len();
        let played = |maze| {
            let seeds = 0..matrix.seeds.count;
            seeds
                .filter(|&seed| matrix.get(robot, maze, seed).is_some())
                .count() as u64
        };
        mazes.map(played).sum()
    }
}

/// In a word or two, why a robot has no rank; `None` if it has one or will have one.
pub(super) fn state(robot: &MatrixRobot, state: RobotState) -> Option<&'static str> {
    match (state, &robot.not_admitted) {
        (RobotState::NotAdmitted, Some(NotAdmitted::Rejected(_))) => Some("rejected"),
        (RobotState::NotAdmitted, _) => Some("not admitted"),
        (RobotState::Incomplete, _) => Some("incomplete"),
        (RobotState::NotStarted, _) => Some("not started"),
        (RobotState::Ranked, _) => None,
    }
}

/// By robot, whether it is shown: all are, or the first overall and of each class.
fn shown(report: &ContestReport<'_>) -> Vec<bool> {
    let robots = report.matrix.robots.len();
    let Some(top) = report.options.show_top else {
        return vec![true; robots];
    };
    let mut shown = vec![false; robots];
    let classes = report.classes.iter().map(|it| &it.ranking);
    for ranking in std::iter::once(&report.overall).chain(classes) {
        let lines = ranking.lines.iter();
        for line in lines.filter(|line| line.rank.is_some_and(|rank| rank <= top)) {
            shown[line.robot] = true;
        }
    }
    shown
}

/// By robot, what it is called. The beginning of a digest tells contestants which line is theirs
/// and nobody else.
fn names(matrix: &ScoreMatrix, are_hidden: bool) -> Vec<GuestText> {
    let robots = matrix.robots.iter();
    if !are_hidden {
        return robots.map(|robot| robot.name.clone()).collect();
    }
    let mut seen: HashMap<String, u32> = HashMap::new();
    let alias = |robot: &MatrixRobot| {
        let mut alias: String = robot.digest.to_string().chars().take(8).collect();
        if robot.variant > 0 {
            alias.push_str(&format!(" variant {}", robot.variant));
        }
        let count = seen.entry(alias.clone()).or_default();
        *count += 1;
        if *count > 1 {
            format!("{alias} ({count})").into()
        } else {
            alias.into()
        }
    };
    robots.map(alias).collect()
}
