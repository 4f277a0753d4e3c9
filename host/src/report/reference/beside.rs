//! The reports' figures beside ours.

use super::super::markdown::{Table, code, grouped, mean, share, signed, thousandths};
use super::published::{
    CLAIMS, Claim, MINNETT_STUDY, PUBLISHED, Published, PublishedStudy, RANDOM_TRIES, Report, Tries,
};
use super::{Reference, label, score, score_with_steps};
use crate::contest::{Benchmark, Group, MatchResult, Mean, Tally};
use crate::maze::generate::Kind;
use crate::robot::bundled::find;

/// From which difference on a sentence says more about it, in percent.
const NOTABLE_PERCENT: u64 = 10;

/// The section that compares robots with their reports.
pub(super) fn section(page: &Reference<'_>) -> String {
    let mut text = format!(
        "## Beside the reports\n\n\
         The difference is ours minus the report's, in percent of the report's. The reports leave\n\
         details open, so a faithful port lands near their figures rather than on them. A\n\
         difference of more than {NOTABLE_PERCENT} % has a sentence below the table.\n\n"
    );
    text.push_str(&absent(page));
    let reports = [Report::Lobato, Report::Minnett, Report::Rai];
    let parts = reports.into_iter().filter_map(|it| of_report(page, it));
    text.push_str(&parts.collect::<Vec<_>>().join("\n"));
    text
}

/// Which figures are compared with nothing, and why.
fn absent(page: &Reference<'_>) -> String {
    let (mut later, mut elsewhere) = (Vec::new(), Vec::new());
    let figures = PUBLISHED.iter().map(|it| (it.robot, it.setting));
    let claims = CLAIMS.iter().map(|it| (it.robot, Some(it.setting)));
    for (robot, setting) in figures.chain(claims).chain([(RANDOM_TRIES.robot, None)]) {
        if page.find(robot, setting).is_none() {
            let list = if find(robot).is_some() {
                &mut elsewhere
            } else {
                &mut later
            };
            list.push(label(robot, setting));
        }
    }
    let mut text = String::new();
    for (list, why) in [
        (later, "not bundled yet"),
        (elsewhere, "not among the robots of this page"),
    ] {
        if !list.is_empty() {
            text.push_str(&format!(
                "There are figures also for robots that are {why}: {}.\n\n",
                list.join(", ")
            ));
        }
    }
    text
}

fn of_report(page: &Reference<'_>, report: Report) -> Option<String> {
    let figures = PUBLISHED.iter().filter(|it| it.report == report);
    let figures: Vec<Comparison<'_>> = figures.flat_map(|it| compare(page, it)).collect();
    let claims = CLAIMS.iter().filter(|it| it.report == report);
    let claims: Vec<String> = claims.filter_map(|it| claim(page, it)).collect();
    let mut parts = Vec::new();
    if !figures.is_empty() {
        parts.push(table(&figures));
        let sentences: Vec<String> = figures.iter().filter_map(Comparison::sentence).collect();
        if !sentences.is_empty() {
            parts.push(sentences.concat());
        }
    }
    if !claims.is_empty() {
        parts.push(format!(
            "What the report shows in figures that have no numbers, or says in words:\n\n{}",
            claims.concat()
        ));
    }
    if RANDOM_TRIES.report == report {
        parts.extend(tries(page, &RANDOM_TRIES));
    }
    if MINNETT_STUDY.report == report {
        parts.extend(study(page, &MINNETT_STUDY));
    }
    let is_empty = parts.is_empty();
    (!is_empty).then(|| format!("### {}\n\n{}", report.name(), parts.join("\n")))
}

/// One figure of a report and what ours did.
struct Comparison<'a> {
    published: &'a Published,
    maze: usize,
    theirs: u64,
    ours: Option<u64>,
    shown: String,
}

fn compare<'a>(page: &Reference<'_>, published: &'a Published) -> Vec<Comparison<'a>> {
    let Some(entrant) = page.find(published.robot, published.setting) else {
        return Vec::new();
    };
    let results = (0..3).filter_map(|maze| Some((maze, page.in_official(entrant, maze)?)));
    let compare = |(maze, result)| Comparison {
        published,
        maze,
        theirs: published.scores[maze],
        ours: score(result).map(|score| score.thousandths()),
        shown: score_with_steps(result),
    };
    results.map(compare).collect()
}

impl Comparison<'_> {
    fn robot(&self) -> String {
        label(self.published.robot, self.published.setting)
    }

    /// The difference with its sign: `+2.5 %`, or `-` without a score of ours.
    fn difference(&self) -> String {
        let Some(ours) = self.ours else {
            return "-".to_owned();
        };
        let sign = if ours < self.theirs { '-' } else { '+' };
        format!("{sign}{} %", self.tenths_of_percent(ours))
    }

    /// The size of the difference with one decimal, rounded half up.
    fn tenths_of_percent(&self, ours: u64) -> String {
        let tenths = (ours.abs_diff(self.theirs) * 2000 + self.theirs) / (self.theirs * 2);
        format!("{}.{}", tenths / 10, tenths % 10)
    }

    /// The sentence about a difference that is notable.
    fn sentence(&self) -> Option<String> {
        let what = match self.ours {
            None => format!("ours has no score ({})", self.shown),
            Some(ours) if ours.abs_diff(self.theirs) * 100 > self.theirs * NOTABLE_PERCENT => {
                let size = self.tenths_of_percent(ours);
                let word = if ours < self.theirs {
                    "lower"
                } else {
                    "higher"
                };
                format!("ours is {size} % {word}, {}", self.shown)
            }
            Some(_) => return None,
        };
        let remark = self.published.remark.unwrap_or("Not explained yet.");
        Some(format!(
            "- {} in maze 0{}: {what}, where the report has {}. {remark}\n",
            self.robot(),
            self.maze + 1,
            thousandths(self.theirs)
        ))
    }
}

fn table(figures: &[Comparison<'_>]) -> String {
    let header = [
        "robot",
        "in the report",
        "maze",
        "report",
        "ours",
        "difference",
    ];
    let mut table = Table::new(&header, 3);
    for figure in figures {
        table.row([
            figure.robot(),
            figure.published.place.to_owned(),
            format!("0{}", figure.maze + 1),
            thousandths(figure.theirs),
            figure.shown.clone(),
            figure.difference(),
        ]);
    }
    table.finish()
}

/// What the report says in words, and what ours did.
fn claim(page: &Reference<'_>, claim: &Claim) -> Option<String> {
    let entrant = page.find(claim.robot, Some(claim.setting))?;
    let ours = (0..3).filter_map(|maze| page.in_official(entrant, maze));
    let ours: Vec<String> = ours.map(score_with_steps).collect();
    Some(format!(
        "- {}: {} ({}). Ours: {}.\n",
        label(claim.robot, Some(claim.setting)),
        claim.says,
        claim.place,
        ours.join(", ")
    ))
}

/// Chance against chance.
fn tries(page: &Reference<'_>, published: &Tries) -> Option<String> {
    let (contest, results) = page.tries?;
    let tally = Tally::of(contest, results);
    let (first, last) = (contest.seeds.first()?, contest.seeds.last()?);
    let goal_reached = tally.goal_reached + tally.finished;
    let mut table = Table::new(&["", "report", "ours"], 1);
    let counts =
        |count: u32, all: u32| format!("{} of {}", grouped(count.into()), grouped(all.into()));
    table.row([
        "run 1 reached the goal".to_owned(),
        counts(published.goal_reached, published.tries),
        format!(
            "{} ({})",
            counts(goal_reached, tally.matches),
            share(goal_reached, tally.matches)
        ),
    ]);
    table.row([
        "finished".to_owned(),
        counts(published.finished, published.tries),
        format!(
            "{} ({})",
            counts(tally.finished, tally.matches),
            share(tally.finished, tally.matches)
        ),
    ]);
    table.row([
        "mean score of those".to_owned(),
        thousandths(published.score),
        mean(tally.score),
    ]);
    Some(format!(
        "#### Random tries\n\n\
         {} in maze 01 ({} of the report); ours with the seeds {first} to {last}. The report\n\
         has one score, so a difference of scores says nothing.\n\n{}",
        code(published.robot),
        published.place,
        table.finish()
    ))
}

/// A study of mazes that are not published, against ours of both kinds that are
/// made as the report's were.
fn study(page: &Reference<'_>, published: &PublishedStudy) -> Option<String> {
    let entrant = page.find(published.robot, Some(published.setting))?;
    let kinds = [
        (Kind::Stretches, "made as the author's program makes them"),
        (Kind::Division, "made as the report describes it"),
    ];
    let mut columns = Vec::new();
    let mut mazes = String::new();
    for (kind, how) in kinds {
        let mut groups = page.study.groups.iter();
        if let Some(group) = groups.find(|group| group.spec.kind() == kind) {
            columns.push(StudyColumn::new(page, entrant, group));
            mazes.push_str(&format!("- {}, {how}\n", code(&group.spec.to_string())));
        }
    }
    if columns.is_empty() {
        return None;
    }
    Some(format!(
        "#### Minnett's generated mazes\n\n\
         {} in 100 mazes of each size from 12 to 20 ({}). The report's figures are for mazes of\n\
         the author's program, which does not make them as the report describes it. Ours are:\n\n\
         {mazes}\n\
         {}\n\n{}",
        label(published.robot, Some(published.setting)),
        published.place,
        published.remark,
        study_table(published, &columns)
    ))
}

/// Our results in one kind of mazes.
struct StudyColumn {
    kind: Kind,
    all: Tally,
    /// Those in which the robot had nothing to say: its guard did not take over.
    silent: Tally,
}

impl StudyColumn {
    fn new(page: &Reference<'_>, entrant: usize, group: &Group) -> Self {
        let results = page.study.in_mazes(entrant, &group.mazes);
        let is_silent = |result: &&MatchResult| result.journal == (0, 0);
        Self {
            kind: group.spec.kind(),
            all: Tally::of(page.contest(), results.clone()),
            silent: Tally::of(page.contest(), results.filter(is_silent)),
        }
    }
}

fn study_table(published: &PublishedStudy, columns: &[StudyColumn]) -> String {
    let names: Vec<String> = columns
        .iter()
        .map(|column| format!("ours, {}", column.kind.name()))
        .collect();
    let mut header = vec!["", "report"];
    header.extend(names.iter().map(String::as_str));
    let mut table = Table::new(&header, 1);
    let mut row = |title: &str, theirs: String, ours: &dyn Fn(&StudyColumn) -> String| {
        let start = [title.to_owned(), theirs];
        table.row(start.into_iter().chain(columns.iter().map(ours)));
    };
    let counts = |part: u32, all: u32| format!("{part} of {all} ({})", share(part, all));
    let margin = |thousandths: i64| signed(Some(Mean::fraction(thousandths.into(), 1000)));
    let lower = |tally: &Tally| tally.benchmarks[Benchmark::MINNETT_LOWER];
    let of_finished = |tally: &Tally| counts(lower(tally).beaten, tally.finished);

    let finished = counts(published.finished, published.matches);
    let beaten = counts(published.lower_beaten, published.finished);
    row("finished", finished.clone(), &|ours| {
        counts(ours.all.finished, ours.all.matches)
    });
    row(
        "of those, beats the lower benchmark",
        beaten.clone(),
        &|ours| of_finished(&ours.all),
    );
    row("by, on average", margin(published.lower_margin), &|ours| {
        signed(lower(&ours.all).margin)
    });
    row("finished without the guard", finished, &|ours| {
        counts(ours.silent.finished, ours.all.matches)
    });
    row("of those, beats the lower benchmark", beaten, &|ours| {
        of_finished(&ours.silent)
    });
    row("by, on average", margin(published.lower_margin), &|ours| {
        signed(lower(&ours.silent).margin)
    });
    row(
        "of all mazes, beats the lower benchmark",
        counts(published.lower_beaten, published.matches),
        &|ours| counts(lower(&ours.all).beaten, ours.all.matches),
    );
    row(
        "beats the upper benchmark by, on average",
        margin(published.upper_margin),
        &|ours| signed(ours.all.benchmarks[Benchmark::MINNETT_UPPER].margin),
    );
    table.finish()
}
