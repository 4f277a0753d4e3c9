//! [`classroom`]: the grade of a robot as `result.json` of Classroom 50, `classroom50/result/v1`.
//!
//! Its scores are integers, so points are rounded down, criterion by criterion.

use serde::Serialize;

use super::super::escape::for_terminal;
use super::super::json;
use super::sentence::{Report, sentence};
use crate::contest::grade::{Grade, Status};

/// What the runner of Classroom 50 says about a submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassroomContext {
    /// The short name of the classroom.
    pub classroom: String,
    /// The short name of the assignment.
    pub assignment: String,
    /// `individual` or `group`.
    pub assignment_type: String,
    /// The owner of the repository that was submitted.
    pub owner: String,
    /// The tag of the submission, which begins with `submit/`.
    pub submission: String,
    /// A link to the commit.
    pub commit: String,
    /// A link to the release.
    pub release: String,
    /// A link to the changes.
    pub review: String,
    /// When it was submitted, as `YYYY-MM-DDTHH:MM:SSZ`.
    pub datetime: String,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Document<'a> {
    schema: &'static str,
    classroom: &'a str,
    assignment: &'a str,
    #[serde(rename = "assignment_type")]
    assignment_type: &'a str,
    owner: &'a str,
    submission: &'a str,
    commit: &'a str,
    release: &'a str,
    review: &'a str,
    datetime: &'a str,
    score: u64,
    max_score: u64,
    tests: Vec<Test>,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Test {
    test_name: String,
    passed: bool,
    score: u64,
    max_score: u64,
    message: String,
}

/// The document of one robot.
pub fn classroom(report: &Report<'_>, grade: &Grade, context: &ClassroomContext) -> String {
    let tests = report.criteria(grade).map(|(criterion, result)| Test {
        test_name: for_terminal(&criterion.name),
        passed: result.status == Status::Passed,
        score: result.points_thousandths / 1000,
        max_score: criterion.points.into(),
        message: for_terminal(&sentence(criterion, result)),
    });
    let tests: Vec<Test> = tests.collect();
    json::document(&Document {
        schema: "classroom50/result/v1",
        classroom: &context.classroom,
        assignment: &context.assignment,
        assignment_type: &context.assignment_type,
        owner: &context.owner,
        submission: &context.submission,
        commit: &context.commit,
        release: &context.release,
        review: &context.review,
        datetime: &context.datetime,
        score: tests.iter().map(|it| it.score).sum(),
        max_score: tests.iter().map(|it| it.max_score).sum(),
        tests,
    })
}
