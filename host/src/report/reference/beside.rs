//! The reports' figures beside ours.

use super::super::markdown::{Table, code, grouped, mean, share, signed, thousandths};
use super::published::{
    CLAIMS, Claim, MINNETT_STUDY, PUBLISHED, Published, PublishedStudy, RANDOM_TRIES, Report, Tries,
};
use super::{Reference, label, score, score_with_steps};
use crate::contest::{Benchmark, Mean, Tally};
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

/// A study of another generator's mazes against ours in the same sizes.
fn study(page: &Reference<'_>, published: &PublishedStudy) -> Option<String> {
    let entrant = page.find(published.robot, Some(published.setting))?;
    // The first family is that of the report's generator.
    let group = page.study.groups.first()?;
    let tally = page.study.tally(entrant, std::slice::from_ref(group), None);
    let lower = tally.benchmarks[Benchmark::MINNETT_LOWER];
    let upper = tally.benchmarks[Benchmark::MINNETT_UPPER];
    let counts = |part: u32, all: u32| format!("{part} of {all} ({})", share(part, all));
    let margin = |thousandths: i64| signed(Some(Mean::fraction(thousandths.into(), 1000)));
    let mut table = Table::new(&["", "report", "ours"], 1);
    table.row([
        "finished".to_owned(),
        counts(published.finished, published.matches),
        counts(tally.finished, tally.matches),
    ]);
    table.row([
        "of those, beats the lower benchmark".to_owned(),
        counts(published.lower_beaten, published.finished),
        counts(lower.beaten, tally.finished),
    ]);
    table.row([
        "by, on average".to_owned(),
        margin(published.lower_margin),
        signed(lower.margin),
    ]);
    table.row([
        "beats the upper benchmark by, on average".to_owned(),
        margin(published.upper_margin),
        signed(upper.margin),
    ]);
    Some(format!(
        "#### Minnett's generated mazes\n\n\
         {} in 100 mazes of each size from 12 to 20 ({}). The report's mazes are not published;\n\
         ours are {}, made as the report describes.\n\n{}",
        label(published.robot, Some(published.setting)),
        published.place,
        code(&group.spec.to_string()),
        table.finish()
    ))
}
