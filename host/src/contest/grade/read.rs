//! Reading a [`Rubric`] from TOML, with every check that needs nothing but the text.

use wasmouse_core::Digest;

use super::super::config::{ConfigError, Document, Integer, Name};
use super::super::file::check;
use super::entry::{Decimal, Entry, File, MazesEntry, OneOrMany, RUBRIC_VERSION};
use super::rubric::{Criterion, Expectation, Mark, Rubric, RubricSet, Target, Threshold};

/// The most sets, criteria, and specifications of mazes in a set.
const ENTRIES_MAX: usize = 1000;

/// The keys of which a criterion has one.
const EXPECTATIONS: [&str; 10] = [
    "finished_percent",
    "mean_score",
    "mean_regret",
    "faults",
    "step_fuel_mean",
    "step_fuel_max",
    "memory_bytes_max",
    "beats",
    "baseline",
    "no_worse_than",
];

impl Rubric {
    /// Reads a rubric.
    ///
    /// Whether its mazes, robots and files exist is not known here.
    ///
    /// # Errors
    ///
    /// With the first thing that is wrong.
    pub fn read(text: &str) -> Result<Self, ConfigError> {
        let document = Document::parse(text)?;
        check::version(&document, RUBRIC_VERSION)?;
        let file: File = document.read()?;
        check::rules(&file.rules, &document)?;
        check::seeds(&file.seeds, &document)?;
        let sets = sets(&document, file.mazes)?;
        if file.criteria.is_empty() || file.criteria.len() > ENTRIES_MAX {
            let message = format!("a rubric has 1 to {ENTRIES_MAX} criteria");
            return Err(document.error("criteria", message));
        }
        let mut criteria: Vec<Criterion> = Vec::new();
        for (index, entry) in file.criteria.into_iter().enumerate() {
            let criterion = criterion(&document, &format!("criteria[{index}]"), entry)?;
            if criteria.iter().any(|it| it.name == criterion.name) {
                let message = format!("there are two criteria `{}`", criterion.name);
                return Err(document.error(&format!("criteria[{index}].name"), message));
            }
            criteria.push(criterion);
        }
        let mut rubric = Self {
            name: file
                .name
                .map_or_else(|| "Grade".to_owned(), Name::into_string),
            digest: Digest::of(text.as_bytes()),
            rules: file.rules.ruleset().unwrap_or_default(),
            seeds: file.seeds.into(),
            sets,
            criteria,
            mark: Mark::Percent(100_000),
        };
        let points_max = rubric.points_max();
        if points_max == 0 {
            return Err(document.error("criteria", "the criteria are worth no points"));
        }
        rubric.mark = match (file.pass_percent, file.pass_points) {
            (Some(_), Some(_)) => {
                let message = "`pass_percent` and `pass_points` exclude each other";
                return Err(document.error("pass_points", message));
            }
            (Some(Decimal(percent)), None) => {
                if !(0..=100_000).contains(&percent) {
                    let message = "`pass_percent`: expected a percentage from 0 to 100";
                    return Err(document.error("pass_percent", message));
                }
                Mark::Percent(percent)
            }
            (None, Some(points)) => {
                if points.get() > u64::from(points_max) {
                    let message = format!(
                        "`pass_points`: expected at most {points_max}, the points of all criteria"
                    );
                    return Err(document.error("pass_points", message));
                }
                Mark::Points(points.get_u32())
            }
            (None, None) => rubric.mark,
        };
        Ok(rubric)
    }
}

fn sets(document: &Document<'_>, mazes: Vec<MazesEntry>) -> Result<Vec<RubricSet>, ConfigError> {
    if mazes.is_empty() || mazes.len() > ENTRIES_MAX {
        let message = format!("a rubric has 1 to {ENTRIES_MAX} sets of mazes");
        return Err(document.error("mazes", message));
    }
    let mut sets: Vec<RubricSet> = Vec::new();
    for (index, entry) in mazes.into_iter().enumerate() {
        let MazesEntry {
            set,
            paths: OneOrMany(mazes),
            lenient: is_lenient,
        } = entry;
        let name = set.into_string();
        if sets.iter().any(|it| it.name == name) {
            let message = format!("there are two sets `{name}`");
            return Err(document.error(&format!("mazes[{index}].set"), message));
        }
        let key = format!("mazes[{index}].paths");
        if mazes.is_empty() || mazes.len() > ENTRIES_MAX {
            let message = format!("`{key}`: a set has 1 to {ENTRIES_MAX} paths");
            return Err(document.error(&key, message));
        }
        if mazes.iter().any(|it| it.is_empty() || it == "-") {
            let message = format!("`{key}`: expected names of mazes, files, folders or `gen:`");
            return Err(document.error(&key, message));
        }
        sets.push(RubricSet {
            name,
            mazes,
            is_lenient,
        });
    }
    Ok(sets)
}

fn criterion(document: &Document<'_>, key: &str, entry: Entry) -> Result<Criterion, ConfigError> {
    let at = |field: &str, message: String| document.error(&format!("{key}.{field}"), message);
    let expectation = expectation(&at, &entry)?;
    let mazes = entry.mazes.map_or_else(Vec::new, |it| it.0);
    if mazes.len() > ENTRIES_MAX || mazes.iter().any(String::is_empty) {
        return Err(at(
            "mazes",
            "`mazes`: expected names of sets or mazes".to_owned(),
        ));
    }
    Ok(Criterion {
        name: entry.name.into_string(),
        points: entry.points.map_or(1, Integer::get_u32),
        mazes,
        expectation,
    })
}

fn expectation(
    at: &dyn Fn(&str, String) -> ConfigError,
    entry: &Entry,
) -> Result<Expectation, ConfigError> {
    let measures = [
        (Target::FinishedPercent, entry.finished_percent),
        (Target::MeanScore, entry.mean_score),
        (Target::MeanRegret, entry.mean_regret),
        (Target::Faults, entry.faults),
        (Target::StepFuelMean, entry.step_fuel_mean),
        (Target::StepFuelMax, entry.step_fuel_max),
        (Target::MemoryBytesMax, entry.memory_bytes_max),
    ];
    let mut given: Vec<&'static str> = measures
        .iter()
        .filter_map(|(target, value)| value.is_some().then_some(target.name()))
        .collect();
    let others = [
        ("beats", entry.beats.is_some()),
        ("baseline", entry.baseline.is_some()),
        ("no_worse_than", entry.no_worse_than.is_some()),
    ];
    given.extend(
        others
            .iter()
            .filter_map(|(name, is_given)| is_given.then_some(*name)),
    );
    let kind = match given.as_slice() {
        [kind] => *kind,
        [] => {
            let message = format!("criterion `{}` expects nothing", entry.name.as_str());
            let hint = format!("add one of the keys {}", EXPECTATIONS.join(", "));
            return Err(at("name", message).hint(hint));
        }
        [first, second, ..] => {
            let message = format!("`{first}` and `{second}` exclude each other");
            let hint = "make two criteria of them";
            return Err(at(second, message).hint(hint));
        }
    };
    let helpers = [
        ("beats_percent", "beats", entry.beats_percent.is_some()),
        ("baseline_robot", "baseline", entry.baseline_robot.is_some()),
        ("baseline_steps", "baseline", entry.baseline_steps.is_some()),
    ];
    for (helper, owner, is_given) in helpers {
        if is_given && owner != kind {
            return Err(at(helper, format!("`{helper}` belongs to `{owner}`")));
        }
    }
    let named = |field: &str, text: &str| {
        if text.is_empty() {
            return Err(at(field, format!("`{field}`: the name is empty")));
        }
        Ok(text.to_owned())
    };
    let of = |field: &str, full: i64, is_more_better: bool| {
        threshold(at, (field, full), entry.none.map(|it| it.0), is_more_better)
    };
    let percent = |field: &str, Decimal(value): Decimal| {
        let is_percent = (0..=100_000).contains(&value);
        let message = || format!("`{field}`: expected a percentage from 0 to 100");
        is_percent
            .then_some(value)
            .ok_or_else(|| at(field, message()))
    };
    if let Some(robot) = &entry.beats {
        let robot = named("beats", robot)?;
        let full = entry.beats_percent.unwrap_or(Decimal(50_000));
        let full = percent("beats_percent", full)?;
        let field = if entry.beats_percent.is_some() {
            "beats_percent"
        } else {
            "beats"
        };
        let percent = of(field, full, true)?;
        return Ok(Expectation::Beats { robot, percent });
    }
    if let Some(file) = &entry.baseline {
        let file = file.as_str().to_owned();
        let full = entry.baseline_steps.map_or(0, |it| it.0);
        let steps = of("baseline", full, false)?;
        let robot = entry.baseline_robot.clone();
        return Ok(Expectation::Baseline { file, robot, steps });
    }
    if let Some(robot) = &entry.no_worse_than {
        if entry.none.is_some() {
            let message = "`none`: `no_worse_than` has no partial credit";
            return Err(at("none", message.to_owned()));
        }
        let robot = named("no_worse_than", robot)?;
        return Ok(Expectation::NoWorseThan { robot });
    }
    let mut measures = measures.into_iter();
    let measure = measures.find_map(|(target, value)| Some((target, value?)));
    let (target, value) = measure.expect("one of them was given");
    if target == Target::FinishedPercent {
        percent(target.name(), value)?;
    } else if value.0 < 0 {
        let message = format!("`{}`: expected a number of at least 0", target.name());
        return Err(at(target.name(), message));
    }
    let is_counted = matches!(
        target,
        Target::Faults | Target::StepFuelMax | Target::MemoryBytesMax
    );
    if is_counted && value.0 % 1000 != 0 {
        let message = format!("`{}`: expected a whole number", target.name());
        return Err(at(target.name(), message));
    }
    let threshold = of(target.name(), value.0, target.is_more_better())?;
    Ok(Expectation::Measure(target, threshold))
}

fn threshold(
    at: &dyn Fn(&str, String) -> ConfigError,
    (field, full): (&str, i64),
    none: Option<i64>,
    is_more_better: bool,
) -> Result<Threshold, ConfigError> {
    let is_worse = |none: i64| {
        if is_more_better {
            none < full
        } else {
            none > full
        }
    };
    if none.is_some_and(|none| !is_worse(none)) {
        let side = if is_more_better { "less" } else { "more" };
        let message =
            format!("`none`: expected {side} than `{field}`, where all points are earned");
        return Err(at("none", message));
    }
    Ok(Threshold { full, none })
}
