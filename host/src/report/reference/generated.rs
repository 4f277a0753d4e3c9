//! The study: every robot in hundreds of generated mazes, by family and size.

use std::cmp::Reverse;

use super::super::markdown::{Table, code, folded, grouped, mean, share, signed};
use super::Reference;
use crate::contest::{Benchmark, Group, Mean, Tally};
use crate::maze::generate::Kind;
use crate::robot::Verdict;

/// A list of unfinished mazes longer than this is only counted.
pub(super) const UNFINISHED_MAX: usize = 20;

/// What [`regret_cells`] are.
pub(super) const REGRET_COLUMNS: [&str; 6] = [
    "finished", "optimal", "score", "regret", "by run 1", "by run 2",
];

/// The section with all families.
pub(super) fn section(page: &Reference<'_>) -> String {
    let groups = page.study.groups;
    let count: usize = groups.iter().map(|it| it.mazes.len()).sum();
    let mut parts = vec![reading(page)];
    parts.push(format!(
        "### All {} mazes\n\n{}",
        grouped(count as u64),
        tables(page, groups, &[None])
    ));
    for group in groups {
        parts.push(family(page, group));
    }
    parts.push(unfinished(page));
    parts.push(fuel(page));
    parts.join("\n")
}

/// What is played and what the columns mean.
fn reading(page: &Reference<'_>) -> String {
    let mut benchmarks = Table::new(&["benchmark", "score to beat", "from"], 3);
    for benchmark in Benchmark::ALL {
        benchmarks.row([
            benchmark.name.to_owned(),
            benchmark.formula.to_owned(),
            benchmark.source.to_owned(),
        ]);
    }
    let dimensions = dimensions(page, page.study.groups);
    let sizes: Vec<String> = dimensions.iter().map(u8::to_string).collect();
    let each = page.study.groups.first().map_or(0, |it| it.mazes.len()) / dimensions.len().max(1);
    format!(
        "## Generated mazes\n\n\
         {each} mazes of each of the sizes {}, from each of {} generators. Robots are ordered by\n\
         the number of mazes that they finished, then by mean regret. All averages are over the\n\
         finished mazes alone.\n\n\
         - **finished**: mazes in which the robot reached the goal in run 2.\n\
         - **optimal**: the share of those with a run 2 as short as the maze allows.\n\
         - **score**: the mean score.\n\
         - **regret**: the mean of score minus floor, which is the sum of the two next columns.\n\
         - **by run 1**: the steps of run 1 beyond those of the floor (the shortest way and the\n\
         \x20 reset), over {}.\n\
         - **by run 2**: the steps of run 2 beyond the shortest way.\n\n\
         The second table of each family holds scores against the reports' benchmarks: the share\n\
         of finished mazes whose score is lower than the benchmark, and by how much it is on\n\
         average; a negative number means that the mean score is worse than the benchmark. In the\n\
         formulas, optimum is the steps of the shortest run 2 and n the cells along a side.\n\n{}\n\
         Rai calls a robot valid whose scores lie between his lower and his upper benchmark. His\n\
         formulas take n² as the steps of an exploration, times the share of cells that is\n\
         explored; here they are at 100 % and at 60 %, the share that he chose. His figures for the\n\
         official mazes take 23 as the optimum of both maze 02 and maze 03, which is 22 and 25.\n",
        sizes.join(", "),
        page.study.groups.len(),
        page.contest().rules.exploration_divisor,
        benchmarks.finish()
    )
}

fn family(page: &Reference<'_>, group: &Group) -> String {
    let about = match group.spec.kind() {
        Kind::Division => {
            "Minnett's generator as his report describes it: stretches of four edges, three of them\n\
             walls. Open places, free-standing walls, and dead ends all the same."
        }
        Kind::Tree { .. } => {
            "A random spanning tree, some of its walls opened. Winding, with many dead ends."
        }
        Kind::Braid => {
            "Straights and diagonal staircases with most dead ends joined: like mazes that people\n\
             draw for contests."
        }
        Kind::Stretches => {
            "Minnett's generator as his program has it: stretches of one to five edges with one\n\
             opening each. Short ways to the goal."
        }
    };
    let groups = std::slice::from_ref(group);
    let by_size: Vec<Option<u8>> = dimensions(page, groups).into_iter().map(Some).collect();
    format!(
        "### {}: {} mazes\n\n{about} `{}`\n\n{}\n{}",
        capitalized(group.spec.kind().name()),
        grouped(group.mazes.len() as u64),
        group.spec,
        tables(page, groups, &[None]),
        folded("By size", &tables(page, groups, &by_size))
    )
}

fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// The sizes of some groups, ascending.
fn dimensions(page: &Reference<'_>, groups: &[Group]) -> Vec<u8> {
    let mazes = groups
        .iter()
        .flat_map(|group| &page.contest().mazes[group.mazes.clone()]);
    let mut dimensions: Vec<u8> = mazes.map(|maze| maze.maze.dimension()).collect();
    dimensions.sort_unstable();
    dimensions.dedup();
    dimensions
}

/// Both tables of some groups, with a line for each robot and size; a size of
/// `None` is all of them, and the column is left out when it is the only one.
fn tables(page: &Reference<'_>, groups: &[Group], sizes: &[Option<u8>]) -> String {
    let with_size = sizes != [None];
    let header = |columns: &[&'static str]| {
        let mut header = vec!["robot"];
        header.extend(with_size.then_some("size"));
        header.extend(columns);
        header
    };
    let mut regrets = Table::new(&header(&REGRET_COLUMNS), 1);
    let names = Benchmark::ALL.map(|benchmark| benchmark.name);
    let mut benchmarks = Table::new(&header(&names), 1);
    for entrant in ranking(page, |entrant| page.study.tally(entrant, groups, None)) {
        for &size in sizes {
            let tally = page.study.tally(entrant, groups, size);
            let mut start = vec![page.competitors[entrant].label()];
            start.extend(size.map(|size| size.to_string()));
            regrets.row(start.clone().into_iter().chain(regret_cells(&tally)));
            benchmarks.row(start.into_iter().chain(benchmark_cells(&tally)));
        }
    }
    format!("{}\n{}", regrets.finish(), benchmarks.finish())
}

/// What a robot did in some mazes, for a row of a table.
pub(super) fn regret_cells(tally: &Tally) -> [String; 6] {
    let regret = |part: fn(crate::contest::Regret) -> Mean| mean(tally.regret.map(part));
    [
        format!("{} of {}", tally.finished, tally.matches),
        share(tally.optimal, tally.finished),
        mean(tally.score),
        regret(|regret| regret.total),
        regret(|regret| regret.exploration),
        regret(|regret| regret.speed),
    ]
}

fn benchmark_cells(tally: &Tally) -> impl Iterator<Item = String> {
    tally
        .benchmarks
        .map(|against| match against.margin {
            Some(margin) => format!(
                "{}, {}",
                share(against.beaten, tally.finished),
                signed(Some(margin))
            ),
            None => "-".to_owned(),
        })
        .into_iter()
}

/// The entrants that played, the best first, by their tallies.
pub(super) fn ranking(page: &Reference<'_>, tally: impl Fn(usize) -> Tally) -> Vec<usize> {
    let entrants = 0..page.competitors.len();
    let mut ranked: Vec<_> = entrants
        .map(|entrant| (tally(entrant), entrant))
        .filter(|(tally, _)| tally.matches > 0)
        .map(|(tally, entrant)| {
            let regret = tally.regret.map(|regret| regret.total);
            (Reverse(tally.finished), regret, entrant)
        })
        .collect();
    ranked.sort();
    ranked.into_iter().map(|(_, _, entrant)| entrant).collect()
}

/// Which mazes were not finished, and how that came.
fn unfinished(page: &Reference<'_>) -> String {
    let mut table = Table::new(
        &[
            "robot",
            "goal not reached",
            "goal reached",
            "faults",
            "mazes",
        ],
        1,
    );
    let mut all_finished = true;
    for (entrant, competitor) in page.competitors.iter().enumerate() {
        let tally = page.study.tally(entrant, page.study.groups, None);
        if tally.finished == tally.matches {
            continue;
        }
        all_finished = false;
        let lost = tally.matches - tally.finished - tally.goal_reached - tally.faults;
        table.row([
            competitor.label(),
            lost.to_string(),
            tally.goal_reached.to_string(),
            tally.faults.to_string(),
            unfinished_mazes(page, entrant),
        ]);
    }
    let text = if all_finished {
        "Every robot finished every maze.\n".to_owned()
    } else {
        format!(
            "Robots that are not listed finished every maze. The budget ran out before run 1 had\n\
             reached the goal, or after it, or the robot failed.\n\n{}",
            table.finish()
        )
    };
    format!("### Not finished\n\n{text}")
}

fn unfinished_mazes(page: &Reference<'_>, entrant: usize) -> String {
    let unfinished: Vec<&str> = page
        .study
        .of_entrant(entrant)
        .filter(|result| !matches!(result.outcome.verdict, Verdict::Finished(_)))
        .map(|result| &page.contest().mazes[result.maze].name[..])
        .collect();
    if unfinished.len() > UNFINISHED_MAX {
        return format!("{} mazes", grouped(unfinished.len() as u64));
    }
    let names: Vec<String> = unfinished.into_iter().map(code).collect();
    names.join(", ")
}

/// Fuel per decision by size, over all families.
fn fuel(page: &Reference<'_>) -> String {
    let groups = page.study.groups;
    let sizes: Vec<Option<u8>> = dimensions(page, groups).into_iter().map(Some).collect();
    let names: Vec<String> = sizes
        .iter()
        .flatten()
        .map(|size| format!("{size} × {size}"))
        .collect();
    let mut header = vec!["robot"];
    header.extend(names.iter().map(String::as_str));
    header.push("all");
    let (mut means, mut largest) = (Table::new(&header, 1), Table::new(&header, 1));
    for (entrant, competitor) in page.competitors.iter().enumerate() {
        let tallies: Vec<Tally> = sizes
            .iter()
            .chain(&[None])
            .map(|&size| page.study.tally(entrant, groups, size))
            .collect();
        if tallies.iter().all(|tally| tally.decisions == 0) {
            continue;
        }
        let row = |number: fn(&Tally) -> u64| {
            let numbers = tallies.iter().map(move |tally| grouped(number(tally)));
            std::iter::once(competitor.label()).chain(numbers)
        };
        means.row(row(Tally::decision_fuel_mean));
        largest.row(row(|tally| tally.decision_fuel_max));
    }
    let limits = page.contest().rules.limits;
    format!(
        "### Fuel for a decision\n\n\
         What one answer costs, over all mazes and whether finished or not; the call that briefs a\n\
         robot is not counted. The ruleset allows {} for an answer and {} for a match.\n\n\
         On average:\n\n{}\nAt most:\n\n{}",
        grouped(limits.step_fuel_max),
        grouped(limits.match_fuel_max),
        means.finish(),
        largest.finish()
    )
}
