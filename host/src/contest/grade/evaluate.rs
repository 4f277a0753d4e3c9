//! [`grade`]: the grade of one robot, from the matches of everybody.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{GuestText, guest_text};

use super::super::matrix::{MatrixRobot, Outcome, ScoreMatrix};
use super::super::mean::Mean;
use super::super::plan::NotAdmitted;
use super::baseline::Baseline;
use super::measure::Scope;
use super::outcome::{CriterionGrade, FaultLine, Grade, MatchCounts, Participation, Status};
use super::rubric::{Criterion, Expectation, Rubric, Threshold};
use super::significance::{self, Significance};
use super::unplayed::UnplayedMatches;

/// A contest that was played to grade robots.
pub struct Graded<'a> {
    /// What robots are graded by.
    pub rubric: &'a Rubric,
    /// The matches, those of reference robots included.
    pub matrix: &'a ScoreMatrix,
    /// Why matches were not played.
    pub unplayed: &'a UnplayedMatches,
    /// The names of all mazes that were to be played.
    pub mazes: &'a [GuestText],
    /// By criterion, the mazes that count for it, as indices of `mazes`.
    pub scopes: &'a [Vec<usize>],
    /// Reference robots by what the rubric calls them, as indices of the matrix.
    pub references: &'a BTreeMap<String, usize>,
    /// By criterion, the recorded scores that it compares with.
    pub baselines: &'a BTreeMap<usize, Baseline>,
    /// Why matches are missing for which nothing else is known: somebody stopped the contest, or
    /// it could not go on.
    pub stopped: &'a str,
}

/// A robot that is graded, or was meant to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Submission {
    /// It takes part: its index in the matrix.
    Robot(usize),
    /// There is nothing to grade.
    Missing {
        /// What it is called.
        name: GuestText,
        /// Why.
        reason: GuestText,
    },
}

/// Grades a robot.
pub fn grade(graded: &Graded<'_>, submission: &Submission) -> Grade {
    let rubric = graded.rubric;
    let grading = Grading::new(graded);
    let (robot, participation) = match submission {
        Submission::Robot(index) => (Some(*index), graded.participation(*index)),
        Submission::Missing { reason, .. } => (None, Participation::Missing(reason.clone())),
    };
    let criteria: Vec<CriterionGrade> = (0..rubric.criteria.len())
        .map(|criterion| grading.criterion(criterion, robot, &participation))
        .collect();
    let points_thousandths = criteria.iter().map(|it| it.points_thousandths).sum();
    let points_max = rubric.points_max();
    let entry = robot.map(|it| &graded.matrix.robots[it]);
    let name = match (submission, entry) {
        (Submission::Missing { name, .. }, _) => name.clone(),
        (_, entry) => entry.map(|it| it.name.clone()).unwrap_or_default(),
    };
    Grade {
        robot: name,
        digest: entry.map(|it| it.digest),
        variant: entry.map_or(0, |it| it.variant),
        is_passed: rubric.mark.is_reached(points_thousandths, points_max)
            && takes_part(&participation),
        participation,
        criteria,
        points_thousandths,
        points_max,
        matches: graded.counts(robot),
        faults: entry.map(|it| graded.faults(it)).unwrap_or_default(),
    }
}

/// Whether a robot can pass at all, even by a rubric that asks for no points.
const fn takes_part(participation: &Participation) -> bool {
    matches!(
        participation,
        Participation::Admitted | Participation::Withdrawn(_)
    )
}

impl Graded<'_> {
    fn participation(&self, robot: usize) -> Participation {
        let entry = &self.matrix.robots[robot];
        match &entry.not_admitted {
            Some(NotAdmitted::Rejected(rejection)) => Participation::Rejected {
                kind: rejection.name().into(),
                reason: rejection.reason(),
                hint: rejection.hint().into(),
            },
            Some(NotAdmitted::Failed(reason)) => Participation::HostFailed(reason.clone()),
            None => match self.unplayed.of(entry.digest, entry.variant).withdrawn {
                Some(reason) => Participation::Withdrawn(reason),
                None => Participation::Admitted,
            },
        }
    }

    fn counts(&self, robot: Option<usize>) -> MatchCounts {
        let seeds = u64::from(self.matrix.seeds.count);
        let mut counts = MatchCounts {
            planned: self.mazes.len() as u64 * seeds,
            ..MatchCounts::default()
        };
        let all: Vec<usize> = (0..self.matrix.mazes.len()).collect();
        let scope = Scope {
            matrix: self.matrix,
            mazes: &all,
        };
        for (_, played) in robot.into_iter().flat_map(|it| scope.played(it)) {
            counts.played += 1;
            counts.finished += u64::from(played.outcome == Outcome::Finished);
            counts.faults += u64::from(matches!(played.outcome, Outcome::Fault(_)));
        }
        counts
    }

    fn faults(&self, robot: &MatrixRobot) -> Vec<FaultLine> {
        let name_of = |digest| {
            let mut mazes = self.matrix.mazes.iter();
            let maze = mazes.find(|it| it.digest == digest);
            maze.map_or_else(|| "?".into(), |it| it.name.clone())
        };
        let faults = robot.faults.iter().filter_map(|(kind, fault)| {
            let message = fault.first.verdict.fault()?.describe();
            Some(FaultLine {
                kind,
                count: fault.count,
                maze: name_of(fault.first.key.maze),
                seed: fault.first.key.seed,
                message,
            })
        });
        faults.collect()
    }
}

/// A contest with what is found in it by name.
struct Grading<'a> {
    graded: &'a Graded<'a>,
    /// The mazes of the matrix by name. They are those of which some match was played.
    places: HashMap<GuestStr<'a>, usize>,
}

impl<'a> Grading<'a> {
    fn new(graded: &'a Graded<'a>) -> Self {
        let mut places = HashMap::new();
        for (index, maze) in graded.matrix.mazes.iter().enumerate() {
            places.entry(maze.name.as_guest()).or_insert(index);
        }
        Self { graded, places }
    }

    fn criterion(
        &self,
        index: usize,
        robot: Option<usize>,
        participation: &Participation,
    ) -> CriterionGrade {
        let criterion = &self.graded.rubric.criteria[index];
        let seeds = u64::from(self.graded.matrix.seeds.count);
        let matches = self.graded.scopes[index].len() as u64 * seeds;
        let without = |status, reason: GuestText| CriterionGrade {
            status,
            points_thousandths: 0,
            value_thousandths: None,
            matches,
            reason: Some(reason),
        };
        let robot = match (participation, robot) {
            (Participation::Missing(reason), _) => {
                return without(
                    Status::Failed,
                    guest_text!("there is no robot to grade: {}", reason),
                );
            }
            (Participation::Rejected { reason, .. }, _) => {
                let reason = guest_text!("the robot is rejected: {}", reason);
                return without(Status::Failed, reason);
            }
            (Participation::HostFailed(reason), _) => {
                let reason = guest_text!("the robot could not be admitted: {}", reason);
                return without(Status::Skipped, reason);
            }
            (Participation::Admitted | Participation::Withdrawn(_), None) => {
                return without(Status::Skipped, "the robot is unknown".into());
            }
            (Participation::Admitted | Participation::Withdrawn(_), Some(robot)) => robot,
        };
        let Some(mazes) = self.complete(index, robot) else {
            let (status, reason) = self.missing_matches(robot);
            return without(status, reason);
        };
        let scope = Scope {
            matrix: self.graded.matrix,
            mazes: &mazes,
        };
        let measured = self.measured(index, scope, robot);
        match measured {
            Ok(Measured::Value(value)) => {
                let threshold = criterion.expectation.threshold();
                let threshold = threshold.unwrap_or(Threshold {
                    full: 0,
                    none: None,
                });
                let (status, points_thousandths) = credit(criterion, threshold, value);
                CriterionGrade {
                    status,
                    points_thousandths,
                    value_thousandths: Some(value.thousandths()),
                    matches,
                    reason: None,
                }
            }
            Ok(Measured::Significance(found)) => CriterionGrade {
                status: if found.is_worse {
                    Status::Failed
                } else {
                    Status::Passed
                },
                points_thousandths: if found.is_worse {
                    0
                } else {
                    u64::from(criterion.points) * 1000
                },
                value_thousandths: Some(found.difference.thousandths()),
                matches,
                reason: Some(found.reason.into()),
            },
            Err(reason) => without(Status::Skipped, reason),
        }
    }

    /// The mazes of a criterion in the matrix, if a robot has played all of its matches in them.
    fn complete(&self, criterion: usize, robot: usize) -> Option<Vec<usize>> {
        let names = self.graded.scopes[criterion]
            .iter()
            .map(|&it| &self.graded.mazes[it]);
        let mazes: Option<Vec<usize>> = names
            .map(|name| self.places.get(&GuestStr::from(name)).copied())
            .collect();
        let mazes = mazes?;
        let scope = Scope {
            matrix: self.graded.matrix,
            mazes: &mazes,
        };
        scope.is_complete(robot).then_some(mazes)
    }

    /// What it means that matches of a robot are missing.
    fn missing_matches(&self, robot: usize) -> (Status, GuestText) {
        let entry = &self.graded.matrix.robots[robot];
        let unplayed = self.graded.unplayed.of(entry.digest, entry.variant);
        match (unplayed.withdrawn, unplayed.failed) {
            (Some(reason), _) => (
                Status::Failed,
                guest_text!("the robot was withdrawn: {}", reason),
            ),
            (None, Some(reason)) => (
                Status::Skipped,
                guest_text!("not all of its matches could be played: {}", reason),
            ),
            (None, None) => (
                Status::Skipped,
                guest_text!(
                    "stopped before all of its matches were played: {}",
                    self.graded.stopped
                ),
            ),
        }
    }

    fn measured(
        &self,
        index: usize,
        scope: Scope<'_>,
        robot: usize,
    ) -> Result<Measured, GuestText> {
        match &self.graded.rubric.criteria[index].expectation {
            Expectation::Measure(target, _) => scope
                .measure(*target, robot)
                .map(Measured::Value)
                .ok_or_else(|| "the goal cannot be reached in any of the mazes".into()),
            Expectation::Beats { robot: other, .. } => {
                let reference = self.reference(other, index)?;
                let percent = scope.beats_percent(robot, reference);
                let percent = percent.ok_or("there are no matches")?;
                Ok(Measured::Value(percent))
            }
            Expectation::Baseline { .. } => {
                let places = scope.places().map(|(maze, seed)| {
                    (
                        self.graded.matrix.mazes[maze].digest,
                        self.graded.matrix.seeds.get(seed),
                    )
                });
                let baseline = self.graded.baselines.get(&index);
                let recorded = baseline.and_then(|it| it.mean_score(places));
                let recorded = recorded.ok_or("the baseline lacks some of the matches")?;
                let ours = scope.mean_score(robot);
                let ours = ours.ok_or("there are no matches")?;
                Ok(Measured::Value(ours.minus(recorded)))
            }
            Expectation::NoWorseThan { robot: other } => {
                let reference = self.reference(other, index)?;
                let found = significance::compare(scope, (robot, reference));
                Ok(Measured::Significance(found?))
            }
        }
    }

    /// A reference robot that has played all matches of a criterion.
    fn reference(&self, name: &str, criterion: usize) -> Result<usize, GuestText> {
        let index = self.graded.references.get(name).copied();
        let index = index.ok_or_else(|| guest_text!("there is no reference robot `{}`", name))?;
        if let Some(why) = self.graded.participation(index).reason() {
            return Err(guest_text!(
                "the reference robot `{}` did not play: {}",
                name,
                why
            ));
        }
        if self.complete(criterion, index).is_none() {
            let (_, reason) = self.missing_matches(index);
            return Err(guest_text!("the reference robot `{}`: {}", name, reason));
        }
        Ok(index)
    }
}

/// What was found for a criterion.
enum Measured {
    Value(Mean),
    Significance(Significance),
}

/// Whether a value is good enough, and the points that it earns, in thousandths.
fn credit(criterion: &Criterion, threshold: Threshold, value: Mean) -> (Status, u64) {
    let all = u64::from(criterion.points) * 1000;
    let is_more_better = criterion.expectation.is_more_better();
    let better_than = |limit: i64| {
        let order = value.cmp(&Mean::fraction(limit.into(), 1000));
        if is_more_better {
            order
        } else {
            order.reverse()
        }
    };
    if better_than(threshold.full) != Ordering::Less {
        return (Status::Passed, all);
    }
    match threshold.none {
        Some(none) if better_than(none) == Ordering::Greater => {
            // Rounded as it is reported, so that it can be computed again from the report.
            let gained = i128::from((value.thousandths() - none).abs());
            let range = i128::from((threshold.full - none).abs()).max(1);
            let earned = i128::from(all) * gained.min(range) / range;
            (Status::Partial, u64::try_from(earned).unwrap_or(0))
        }
        _ => (Status::Failed, 0),
    }
}
