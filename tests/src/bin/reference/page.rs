//! The page: `page.md` with tables of results. Two runs of one version give the same bytes.

use std::cmp::Reverse;
use std::iter::once;
use std::sync::Arc;

use wasmouse::contest::{ContestMaze, Entrant, Mean};
use wasmouse_core::game::{Ruleset, Score, Verdict};
use wasmouse_core::maze::generate::Kind;
use wasmouse_core::record::MatchRecord;
use wasmouse_engine::bundled::bundled;
use wasmouse_engine::engine_id;

use crate::played::{Counts, MazeSet};
use crate::published::{BENCHMARKS, BEST_OTHERS, FIGURES, MINNETT_BENCHMARKS, MINNETT_ROWS};
use crate::tables::{Table, code, count, grouped, mean, share, signed};

/// A longer list of unfinished mazes is only counted.
const UNFINISHED_MAX: usize = 5;

const NOT_PLAYED: &str = "Not played.\n";

/// An official maze with one match of each robot.
pub struct OfficialMaze {
    /// The maze.
    pub maze: ContestMaze,
    /// The matches, in the order of the robots.
    pub records: Vec<MatchRecord>,
}

/// Everything that the page shows.
pub struct Page {
    /// The robots.
    pub entrants: Vec<Entrant>,
    /// The rules of all matches.
    pub rules: Arc<Ruleset>,
    /// The official mazes 01, 02 and 03; `None` for a maze that was not found.
    pub official: [Option<OfficialMaze>; 3],
    /// The generated mazes by kind.
    pub generated: Vec<(Kind, MazeSet)>,
    /// The competition mazes with one entrance and with several, and how many were excluded.
    pub competition: Option<([MazeSet; 2], usize)>,
    /// The random robot in maze 01, if it played.
    pub random: Option<MazeSet>,
}

impl Page {
    /// The whole page.
    pub fn to_markdown(&self) -> String {
        let sets: Vec<&MazeSet> = self.generated.iter().map(|(_, set)| set).collect();
        let random = self.random.as_ref().map(random);
        let not_played = || NOT_PLAYED.to_owned();
        let mut parts = vec![
            ("robots", self.robots()),
            ("official", self.official()),
            ("reports", self.reports()),
            ("random", random.unwrap_or_else(not_played)),
            ("minnett", self.minnett().unwrap_or_else(not_played)),
            ("all", self.scores(&sets)),
            ("benchmarks", self.benchmarks(&sets)),
            ("fuel", self.fuel(&sets)),
            ("competition", self.competition().unwrap_or_else(not_played)),
            ("identity", self.identity()),
        ];
        let kinds = self.generated.iter();
        parts.extend(kinds.map(|(kind, set)| (kind.name(), self.scores(&[set]))));
        let text = include_str!("page.md").to_owned();
        parts.into_iter().fold(text, |text, (name, part)| {
            text.replace(&format!("{{{name}}}\n"), &format!("{part}\n"))
        })
    }

    fn robots(&self) -> String {
        let mut text = String::new();
        for robot in bundled() {
            text.push_str(&format!("- `{}`: {}\n", robot.name, robot.description));
            for variant in robot.variants {
                let name = format!("{}:{}", robot.name, variant.name);
                text.push_str(&format!("  - `{name}`: {}\n", variant.description));
            }
        }
        text
    }

    fn position(&self, robot: &str) -> Option<usize> {
        self.entrants.iter().position(|it| it.name == robot)
    }

    /// The matches of a robot in the official mazes.
    fn records(&self, robot: usize) -> [Option<&MatchRecord>; 3] {
        [0, 1, 2].map(|maze| Some(&self.official[maze].as_ref()?.records[robot]))
    }

    fn official(&self) -> String {
        let mut table = Table::new(["robot", "maze 01", "maze 02", "maze 03", "sum"], 1);
        let mut row = |name: String, cells: [String; 3], scores: [Option<Mean>; 3]| {
            let all: Option<Vec<Mean>> = scores.into_iter().collect();
            let average: Option<Mean> = all.and_then(|scores| scores.into_iter().collect());
            let sum = mean(average.map(|it| it.times(3)));
            table.row(once(name).chain(cells).chain(once(sum)));
        };
        let absent = || "-".to_owned();
        for (index, entrant) in self.entrants.iter().enumerate() {
            let records = self.records(index);
            let scores = records.map(|it| it?.verdict.score().map(Mean::from));
            let cells = records.map(|it| it.map_or_else(absent, verdict));
            row(code(entrant.name.escaped()), cells, scores);
        }
        for scores in BEST_OTHERS {
            let scores = scores.map(|it| Some(Mean::fraction(it.into(), 1000)));
            row("best by others".to_owned(), scores.map(mean), scores);
        }
        let oracles = [0, 1, 2].map(|maze| self.official[maze].as_ref()?.maze.oracle);
        let cells = oracles.map(|it| it.map_or_else(absent, score));
        let scores = oracles.map(|it| it.map(Mean::from));
        row("**oracle score**".to_owned(), cells, scores);
        table.finish()
    }

    fn reports(&self) -> String {
        let header = ["robot", "report", "maze 01", "maze 02", "maze 03"];
        let mut table = Table::new(header, 2);
        for (name, place, published) in FIGURES {
            if let Some(robot) = self.position(name) {
                let figures = self.records(robot).into_iter().zip(published);
                let cells = figures.map(|(record, published)| {
                    let ours = record.and_then(|it| it.verdict.score());
                    ours.map_or_else(|| "-".to_owned(), |ours| comparison(published, ours))
                });
                table.row([code(name), place.to_owned()].into_iter().chain(cells));
            }
        }
        table.finish()
    }

    /// Minnett's results in generated mazes, and those of the bundled robot.
    fn minnett(&self) -> Option<String> {
        let robot = self.position("minnett:final")?;
        let sets = [Kind::Stretches, Kind::Division].map(|kind| {
            let mut sets = self.generated.iter();
            let (_, set) = sets.find(|it| it.0 == kind).expect("all kinds are played");
            (set.robots[robot].all(), set.robots[robot].silent)
        });
        let [lower, upper] = MINNETT_BENCHMARKS;
        let [stretches, division] = sets.map(|(all, silent): (Counts, Counts)| {
            let beaten = |it: Counts| count(it.beaten[lower], it.tally.finished);
            let margin = |it: Counts, benchmark| signed(it.margin(benchmark));
            [
                count(all.tally.finished, all.tally.matches),
                beaten(all),
                margin(all, lower),
                count(silent.tally.finished, all.tally.matches),
                beaten(silent),
                margin(silent, lower),
                count(all.beaten[lower], all.tally.matches),
                margin(all, upper),
            ]
        });
        let mut table = Table::new(["", "report", "`stretches`", "`division`"], 1);
        let ours = stretches.iter().zip(&division);
        for ((title, report), (stretches, division)) in MINNETT_ROWS.into_iter().zip(ours) {
            table.row([title, report, stretches, division]);
        }
        Some(table.finish())
    }

    /// The robots from the best to the worst: indices, names, all their matches.
    fn ranking(&self, sets: &[&MazeSet]) -> Vec<(usize, String, Counts)> {
        let counts = |robot: usize| {
            let sizes = sets
                .iter()
                .flat_map(|set| set.robots[robot].by_size.values());
            Counts::sum(sizes)
        };
        let robots = self.entrants.iter().enumerate();
        let robots = robots.map(|(robot, it)| (robot, code(it.name.escaped()), counts(robot)));
        let mut ranked: Vec<_> = robots.collect();
        ranked.sort_by_key(|(_, _, Counts { tally, .. })| {
            (
                Reverse(tally.finished),
                tally.mean_regret().map(|it| it.total),
            )
        });
        ranked
    }

    fn scores(&self, sets: &[&MazeSet]) -> String {
        let header = ["robot", "finished", "optimal", "score", "regret"];
        let sizes = sizes(sets);
        let mut table = Table::new(
            header.map(String::from).into_iter().chain(titles(&sizes)),
            1,
        );
        for (robot, name, Counts { tally, .. }) in self.ranking(sets) {
            let regret = tally.mean_regret().map_or_else(
                || "-".to_owned(),
                |it| format!("{} ({} + {})", it.total, it.exploration, it.speed),
            );
            let all = [
                name,
                format!("{} of {}", tally.finished, tally.matches),
                share(tally.optimal, tally.finished),
                mean(tally.mean_score()),
                regret,
            ];
            let by_size = sizes.iter().map(|&size| {
                let regret = of_size(sets, robot, size).tally.mean_regret();
                mean(regret.map(|it| it.total))
            });
            table.row(all.into_iter().chain(by_size));
        }
        table.finish()
    }

    fn benchmarks(&self, sets: &[&MazeSet]) -> String {
        let names = BENCHMARKS.iter().map(|(name, _)| *name);
        let mut table = Table::new(once("robot").chain(names), 1);
        for (_, name, counts) in self.ranking(sets) {
            let cells = (0..BENCHMARKS.len()).map(|it| {
                let share = share(counts.beaten[it], counts.tally.finished);
                format!("{share}, {}", signed(counts.margin(it)))
            });
            table.row(once(name).chain(cells));
        }
        table.finish()
    }

    fn fuel(&self, sets: &[&MazeSet]) -> String {
        let sizes = sizes(sets);
        let (first, last) = (["robot".to_owned()], ["all".to_owned(), "most".to_owned()]);
        let header = first.into_iter().chain(titles(&sizes)).chain(last);
        let mut table = Table::new(header, 1);
        for (robot, entrant) in self.entrants.iter().enumerate() {
            let counts: Vec<Counts> = sizes.iter().map(|&it| of_size(sets, robot, it)).collect();
            let all = Counts::sum(&counts);
            let means = counts
                .iter()
                .chain([&all])
                .map(|it| it.tally.step_fuel_mean());
            let cells = means.chain([all.tally.step_fuel_max]).map(grouped);
            table.row(once(code(entrant.name.escaped())).chain(cells));
        }
        table.finish()
    }

    fn competition(&self) -> Option<String> {
        let (sets, excluded) = self.competition.as_ref()?;
        let mut text = format!("Excluded because their goal is unreachable: {excluded}.\n\n");
        for set in sets {
            let scores = self.scores(&[set]);
            text.push_str(&format!("### {} ({})\n\n{scores}\n", set.name, set.mazes));
        }
        let mut table = Table::new(["robot", "unfinished mazes"], 2);
        for (robot, entrant) in self.entrants.iter().enumerate() {
            let names = sets.iter().flat_map(|set| &set.robots[robot].unfinished);
            let names: Vec<String> = names.map(|it| code(it.escaped())).collect();
            let cell = match names.len() {
                0 => continue,
                1..=UNFINISHED_MAX => names.join(", "),
                many => many.to_string(),
            };
            table.row([code(entrant.name.escaped()), cell]);
        }
        Some(text + &table.finish())
    }

    /// Engine, rules and digests.
    fn identity(&self) -> String {
        let mut mazes = Table::new(["mazes", "digest", "count"], 2);
        for OfficialMaze { maze, .. } in self.official.iter().flatten() {
            mazes.row([code(maze.name.escaped()), code(maze.digest), "1".to_owned()]);
        }
        let generated = self.generated.iter().map(|(_, set)| (code(&set.name), set));
        let competition = self.competition.iter().flat_map(|(sets, _)| sets);
        let competition = competition.map(|set| (set.name.clone(), set));
        for (name, set) in generated.chain(competition) {
            mazes.row([name, code(set.digest()), set.mazes.to_string()]);
        }
        let mut robots = Table::new(["robot", "SHA-256"], 2);
        for robot in bundled() {
            robots.row([code(robot.name), code(robot.sha256)]);
        }
        format!(
            "- wasmouse {}, engine `{}`; fuel is comparable only within one engine\n\
             - ruleset `{}` version {}, `{}`\n\
             - seed 0, except for the random robot in maze 01\n\n{}\n\
             The digest of several mazes is that of their digests in order. No parameter of a \
             bundled robot was\ntuned on mazes with these seeds.\n\n{}",
            env!("CARGO_PKG_VERSION"),
            engine_id(),
            self.rules.name,
            self.rules.version,
            self.rules.digest(),
            mazes.finish(),
            robots.finish()
        )
    }
}

/// The sizes of generated mazes; empty for competition mazes, which are of one size but for a few.
fn sizes(sets: &[&MazeSet]) -> Vec<u8> {
    let is_generated = sets[0].name.starts_with("gen:");
    let sizes = sets[0].robots[0].by_size.keys();
    sizes.copied().filter(|_| is_generated).collect()
}

fn titles(sizes: &[u8]) -> impl Iterator<Item = String> {
    sizes.iter().map(|size| format!("{size} × {size}"))
}

/// The matches of a robot in the mazes of one size.
fn of_size(sets: &[&MazeSet], robot: usize, size: u8) -> Counts {
    let counts = sets.iter().map(|set| &set.robots[robot]);
    Counts::sum(counts.filter_map(|it| it.by_size.get(&size)))
}

/// The random robot in maze 01, beside the report.
fn random(set: &MazeSet) -> String {
    let Counts { tally, .. } = set.robots[0].all();
    let mut table = Table::new(["", "report", "bundled robot"], 1);
    let reached = count(tally.goal_reached + tally.finished, tally.matches);
    table.row(["exploration run reached the goal", "3 of 6", &reached]);
    table.row(["finished", "1 of 6", &count(tally.finished, tally.matches)]);
    table.row(["mean score", "584.067", &mean(tally.mean_score())]);
    table.finish()
}

/// `44.100 / 45.200 (+2.5 %)`, bold from 10 % on.
fn comparison(published: u64, ours: Score) -> String {
    let difference = ours.thousandths().abs_diff(published);
    // In tenths of a percent, rounded half up.
    let tenths = (difference * 2000 + published) / (published * 2);
    let sign = if ours.thousandths() < published {
        '-'
    } else {
        '+'
    };
    let percent = format!("{sign}{}.{} %", tenths / 10, tenths % 10);
    let bold = if difference * 10 > published {
        "**"
    } else {
        ""
    };
    format!(
        "{} / {ours} ({bold}{percent}{bold})",
        Mean::fraction(published.into(), 1000)
    )
}

/// `21.867 (146 + 17)`.
fn score(score: Score) -> String {
    format!(
        "{score} ({} + {})",
        score.exploration_steps(),
        score.speed_steps()
    )
}

fn verdict(record: &MatchRecord) -> String {
    match &record.verdict {
        Verdict::Finished { score: finished } => score(*finished),
        other => other.title().into_owned(),
    }
}
