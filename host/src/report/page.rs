//! The results of a contest as one self-contained web page: standings, pictures, matches.
//!
//! No scripts, and nothing is loaded from elsewhere; readable in light and dark, and without
//! colours. Untrusted text is escaped for HTML by maud, and
//! [`for_terminal`] makes invisible characters visible.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use wasmouse_core::game::Score;
use wasmouse_core::record::{MatchRecord, ReplayError, trace};

use super::escape::for_terminal;
use super::paths::paths;
use super::standings::{self as standings_text, NONE};
use crate::contest::{BestMatch, ContestInfo, Names, Results, Summary, WithdrawalEntry};

/// Matches that a page lists, at most; browsers are slow to lay out longer tables.
pub const LISTED_MAX: usize = 1000;

/// Matches that the host could not play that a page lists, at most.
const FAILURES_MAX: usize = 20;

/// The best match of a robot, with its picture.
#[derive(Clone, Debug)]
pub struct BestRun {
    /// The name of the robot.
    pub robot: String,
    /// The name of the maze.
    pub maze: String,
    /// What came of the match.
    pub record: MatchRecord,
    /// The picture as an SVG element.
    pub svg: String,
}

impl BestRun {
    /// Draws a match from its maze, the rules of the contest and its transcript; no robot runs.
    ///
    /// # Errors
    ///
    /// When the transcript is not of a match in that maze by those rules.
    pub fn new(contest: &ContestInfo, best: &BestMatch) -> Result<Self, ReplayError> {
        let BestMatch { played, maze } = best;
        let (_, trace) = trace(&maze.maze, &contest.rules.game, &played.transcript)?;
        let robot = Names::new(&contest.robots, &[])
            .robot(&played.record.key)
            .to_owned();
        let mut picture = paths(&maze.maze, &trace);
        picture.set_title(&format!("{robot} in {}", maze.name));
        Ok(Self {
            robot,
            maze: maze.name.clone(),
            record: played.record.clone(),
            svg: picture.to_svg(),
        })
    }
}

/// What a page shows.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The contest.
    pub contest: &'a ContestInfo,
    /// The matches; `None` when they were too many to keep. More than [`LISTED_MAX`] are not
    /// listed.
    pub matches: Option<&'a [MatchRecord]>,
    /// How many matches were played.
    pub matches_played: u64,
    /// The summary.
    pub summary: &'a Summary,
    /// The best matches, one for each robot that is to be shown.
    pub best: &'a [BestRun],
}

const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin-bottom: 0; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { padding: .25rem .75rem; text-align: right; border-bottom: 1px solid color-mix(in srgb, currentColor 20%, transparent); }
th.name, td.name { text-align: left; }
.scroll { overflow-x: auto; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem; }
figure { margin: 0; }
figure svg { width: 100%; height: auto; }
.quiet { opacity: .75; }
code { font-size: .85em; overflow-wrap: anywhere; }
";

impl<'a> Page<'a> {
    /// The page of a whole results document.
    pub fn of(results: &'a Results, best: &'a [BestRun]) -> Self {
        Self {
            contest: &results.contest,
            matches: Some(&results.matches),
            matches_played: results.matches.len() as u64,
            summary: &results.summary,
            best,
        }
    }

    /// The page as HTML.
    pub fn to_html(&self) -> String {
        let Self {
            contest, summary, ..
        } = self;
        html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { "wasmouse contest" }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { "Contest" }
                    p.quiet {
                        (contest.robots.len()) " robots, " (summary.mazes.len()) " mazes, "
                        (self.matches_played) " matches; ruleset " (for_terminal(&contest.rules.name))
                        " version " (contest.rules.version)
                    }
                    (self.missing())
                    h2 { "Standings" }
                    p { "Ranked by matches finished, then by mean score (lower is better). "
                        "Regret: score minus the oracle score (a robot that knows the maze)." }
                    (self.standings())
                    @if !self.best.is_empty() {
                        h2 { "Best runs" }
                        p { "Blue line: speed run. Shading: how often the exploration run stopped in a cell." }
                        div.pictures { @for run in self.best { (figure(run)) } }
                    }
                    h2 { "Matches" }
                    (self.matches())
                    h2 { "Reproduce" }
                    p { "wasmouse " (for_terminal(&contest.wasmouse)) ", engine "
                        code { (for_terminal(contest.engine.as_str())) } ", results digest "
                        code { (summary.digest) } }
                    (self.digests())
                }
            }
        }
        .into_string()
    }

    fn missing(&self) -> Markup {
        let missing = self
            .contest
            .matches_planned
            .saturating_sub(self.matches_played);
        html! {
            @if !self.summary.complete {
                p { strong {
                    "Incomplete: " (missing) " of " (self.contest.matches_planned)
                    " matches were not played."
                } }
            }
            @let names = self.names();
            @for failure in self.summary.failures.iter().take(FAILURES_MAX) {
                p { "Internal error: " strong { (for_terminal(names.robot(&failure.key))) } " in "
                    (for_terminal(names.maze_name(&failure.key))) ", seed " (failure.key.seed) ": "
                    (for_terminal(&failure.reason)) }
            }
            (more(self.summary.failures.len(), FAILURES_MAX))
            @for robot in self.contest.robots.iter().filter(|it| it.failure.is_some()) {
                p { "Internal error: " strong { (for_terminal(&robot.name)) }
                    " could not be admitted: "
                    (for_terminal(robot.failure.as_deref().unwrap_or_default())) }
            }
            @for entry in &self.summary.withdrawn {
                p { "Withdrawn: " strong { (for_terminal(self.withdrawn_name(entry))) } ": "
                    (for_terminal(&entry.reason)) "; " (entry.matches)
                    " of its matches were not played." }
            }
        }
    }

    fn withdrawn_name(&self, entry: &WithdrawalEntry) -> &str {
        let mut robots = self.contest.robots.iter();
        let robot = robots.find(|it| it.digest == entry.robot && it.variant == entry.variant);
        robot.map_or("?", |it| &it.name)
    }

    fn standings(&self) -> Markup {
        let (contest, standings) = (self.contest, &self.summary.standings);
        html! {
            @if standings.partial {
                p { strong { "The standings are " (standings_text::scope(contest, standings)) "." } }
            }
            div.scroll { table {
                thead { tr {
                    th { "Rank" } th.name { "Robot" } th { "Matches" } th { "Finished" }
                    th { "Faults" } th { "Mean score" } th { "Mean regret" }
                } }
                tbody { @for line in &standings.lines { tr {
                    td { (standings_text::rank(line)) }
                    td.name { (standings_text::robot(contest, line)) }
                    td { (line.matches) }
                    td { (line.finished) }
                    td { (line.faults) }
                    td { (standings_text::mean(line.mean_score_thousandths)) }
                    td { (standings_text::mean(line.mean_regret_thousandths)) }
                } } }
            } }
            @for robot in &contest.robots {
                @if let Some(rejection) = &robot.rejection {
                    p { "Rejected " strong { (for_terminal(&robot.name)) } ": "
                        (for_terminal(&rejection.reason)) ". Hint: " (for_terminal(&rejection.hint)) "." }
                }
            }
        }
    }

    fn matches(&self) -> Markup {
        match self.matches {
            Some(matches) if matches.len() <= LISTED_MAX => self.listed(matches),
            _ => html! {
                p { "The " (self.matches_played) " matches are not listed here, because there are more than "
                    (LISTED_MAX) ". They are in the JSON of the results." }
            },
        }
    }

    fn listed(&self, matches: &[MatchRecord]) -> Markup {
        let names = self.names();
        html! {
            div.scroll { table {
                thead { tr {
                    th.name { "Robot" } th.name { "Maze" } th { "Seed" } th.name { "Verdict" }
                    th { "Score" } th { "Oracle" } th { "Exploration" } th { "Speed" } th { "Bumps" }
                    th { "Fuel" }
                } }
                tbody { @for record in matches { tr {
                    td.name { (for_terminal(names.robot(&record.key))) }
                    td.name { (for_terminal(names.maze_name(&record.key))) }
                    td { (record.key.seed) }
                    td.name {
                        (record.verdict.title())
                        @if let Some(fault) = record.verdict.fault() {
                            br; span.quiet { (for_terminal(&fault.to_string())) }
                        }
                    }
                    td { (score(record.verdict.score())) }
                    td { (score(names.maze(&record.key).and_then(|maze| maze.oracle))) }
                    td { (record.steps.exploration) }
                    td { (record.steps.speed) }
                    td { (record.counts.bumps) }
                    td { (record.fuel.start + record.fuel.steps) }
                } } }
            } }
        }
    }

    fn digests(&self) -> Markup {
        let robots = self.contest.robots.iter();
        let robots = robots.map(|robot| (&robot.name, robot.digest));
        let mazes = self.summary.mazes.iter().take(LISTED_MAX);
        let all = robots.chain(mazes.map(|maze| (&maze.name, maze.digest)));
        html! {
            div.scroll { table {
                thead { tr { th.name { "Robot or maze" } th.name { "SHA-256" } } }
                tbody { @for (name, digest) in all {
                    tr { td.name { (for_terminal(name)) } td.name { code { (digest) } } }
                } }
            } }
            (more(self.summary.mazes.len(), LISTED_MAX))
        }
    }

    fn names(&self) -> Names<'a> {
        Names::new(&self.contest.robots, &self.summary.mazes)
    }
}

/// What stands below a list of `count` things of which `max` are shown.
fn more(count: usize, max: usize) -> Markup {
    html! {
        @if count > max { p { "And " (count - max) " more; they are in the JSON of the results." } }
    }
}

fn figure(run: &BestRun) -> Markup {
    let BestRun {
        robot,
        maze,
        record,
        svg,
    } = run;
    html! {
        figure {
            (PreEscaped(svg))
            figcaption {
                strong { (for_terminal(robot)) } " in " (for_terminal(maze)) ": "
                @match record.verdict.score() {
                    Some(score) => { "score " (score) },
                    None => { (record.verdict.title()) },
                }
                " (" (record.steps.exploration) " + " (record.steps.speed) " steps)"
            }
        }
    }
}

fn score(score: Option<Score>) -> String {
    score.map_or_else(|| NONE.to_owned(), |score| score.to_string())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use wasmouse_core::game::Action;
    use wasmouse_core::maze::{Maze, Turn, Walls};
    use wasmouse_core::record::Transcript;

    use super::super::sample::{HOSTILE, results};
    use super::*;
    use crate::contest::{ContestMatch, ContestMaze};

    /// A match of two steps in an open maze.
    fn best(results: &Results) -> BestMatch {
        let mut transcript = Transcript::default();
        for advance in [3, 1] {
            transcript.push(Action::Move {
                turn: Turn::Right,
                advance,
            });
        }
        let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
        BestMatch {
            played: ContestMatch {
                player: 1,
                record: results.matches[1].clone(),
                transcript,
            },
            maze: ContestMaze {
                name: HOSTILE.to_owned(),
                digest: maze.digest(),
                oracle: None,
                is_generated: false,
                maze: Arc::new(maze),
            },
        }
    }

    #[test]
    fn a_page_shows_everything_and_runs_nothing() {
        let mut results = results();
        results.contest.rules.game.budget = 2;
        let best = BestRun::new(&results.contest, &best(&results)).expect("two steps");
        assert_eq!(best.robot, HOSTILE);
        let html = Page::of(&results, &[best]).to_html();
        for expected in [
            "Incomplete: 796 of 800 matches were not played.",
            "The standings are partial: ranked over 1 of 200 mazes that every robot has played.",
            "Rejected <strong>rejected</strong>: it imports &lt;b&gt;\\u{1b}",
            "Internal error: <strong>a</strong>",
            "<svg xmlns",
            "fault: panic (110 + 17 steps)",
            "<td>19.999</td><td>-0.001</td>",
            "<td>20.667</td><td>17.600</td>",
            &results.summary.digest.to_string(),
        ] {
            assert!(html.contains(expected), "{expected} is missing:\n{html}");
        }
        let harmful = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
        assert!(!html.contains(harmful) && !html.contains("<b>") && !html.contains("<script"));
    }

    #[test]
    fn a_picture_needs_a_transcript_of_the_match() {
        let results = results();
        BestRun::new(&results.contest, &best(&results)).expect_err("the budget is not used up");
    }

    #[test]
    fn long_lists_of_matches_are_left_out() {
        let mut results = results();
        let sentence = "matches are not listed here, because there are more than 1000.";
        let one = results.matches[0].clone();
        results.matches = vec![one; LISTED_MAX];
        assert!(!Page::of(&results, &[]).to_html().contains(sentence));
        results.matches.push(results.matches[0].clone());
        let html = Page::of(&results, &[]).to_html();
        assert!(html.contains(&format!("The 1001 {sentence}")) && html.len() < 20_000);
        let failure = results.summary.failures[0].clone();
        results.summary.failures = vec![failure; FAILURES_MAX + 3];
        results.summary.mazes = vec![results.summary.mazes[0].clone(); LISTED_MAX + 2];
        let html = Page::of(&results, &[]).to_html();
        assert!(html.contains("<p>And 3 more;") && html.contains("<p>And 2 more;"));
    }
}
