//! What has to hold between the values of a contest file.

use std::collections::{BTreeMap, HashMap};
use std::ops::RangeInclusive;
use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use toml::Value;
use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_engine::bundled::bundled;

use super::super::config::{ConfigError, Document, FilePath, Name, suggestion};
use super::contest_file::ContestFile;
use super::options::SeedsEntry;
use super::robots::{RobotSource, RobotsEntry, VariantRef};
use super::rules::{GameEntry, RulesEntry, SandboxEntry};

type Checked = Result<(), ConfigError>;

/// Checks the version before anything else: the keys of another one may be others.
pub(in crate::contest) fn version(document: &Document<'_>, supported: u64) -> Checked {
    #[derive(Deserialize)]
    struct OnlyVersion {
        version: Option<Value>,
    }
    let found = match document.read::<OnlyVersion>()?.version {
        None => {
            let error = document.error("", "missing key `version`");
            return Err(error.hint("begin the file with `version = 1`"));
        }
        Some(Value::Integer(number)) if u64::try_from(number) == Ok(supported) => {
            return Ok(());
        }
        Some(Value::Integer(number)) => number,
        // The value's type says more.
        Some(_) => return Ok(()),
    };
    let message = format!("version {found}; only version {supported} is supported");
    let error = document.error("version", message);
    Err(error.hint("use the wasmouse that the file was written for"))
}

/// Checks a file.
pub(super) fn check(file: &ContestFile, document: &Document<'_>) -> Checked {
    classes(file, document)?;
    robots(file, document)?;
    mazes(file, document)?;
    seeds(&file.seeds, document)?;
    rules(&file.rules, document)?;
    scoring(file, document)?;
    outputs(file, document)
}

/// Where values were given before.
#[derive(Default)]
struct Seen(HashMap<String, String>);

impl Seen {
    /// Notes that a key has a value; an error if another one has it.
    fn note(&mut self, what: &str, value: &str, key: &str, document: &Document<'_>) -> Checked {
        match self.0.insert(value.to_owned(), key.to_owned()) {
            None => Ok(()),
            Some(before) => {
                let line = document.line(&before);
                let message = format!("`{key}`: {what} `{value}` is given twice");
                Err(document
                    .error(key, message)
                    .hint(format!("line {line} has it")))
            }
        }
    }
}

fn classes(file: &ContestFile, document: &Document<'_>) -> Checked {
    let mut names = Seen::default();
    for (index, class) in file.classes.iter().enumerate() {
        let key = format!("classes[{index}].name");
        names.note("class", class.name.as_str(), &key, document)?;
    }
    Ok(())
}

fn robots(file: &ContestFile, document: &Document<'_>) -> Checked {
    if file.robots.is_empty() {
        let error = document.error("robots", "the contest has no robots");
        return Err(error.hint("add `[[robots]]` with a `path` or a `bundled` robot"));
    }
    let mut names = Seen::default();
    // A folder may have the name of a bundled robot.
    let (mut in_files, mut by_name) = (Seen::default(), Seen::default());
    for (index, entry) in file.robots.iter().enumerate() {
        let key = format!("robots[{index}]");
        let source = robot_source(entry, &key, document)?;
        variants(entry, source, &key, document)?;
        if let Some(name) = &entry.name {
            names.note("name", name.as_str(), &format!("{key}.name"), document)?;
        }
        class(entry, &key, file, document)?;
        let (field, given, players) = match source {
            RobotSource::Path(path) => ("path", path.as_str(), &mut in_files),
            RobotSource::Bundled(robot) => ("bundled", robot.name, &mut by_name),
        };
        for variant in entry.variant_numbers() {
            let player = match variant {
                0 => given.to_owned(),
                variant => format!("{given}:{variant}"),
            };
            // Under two names, a robot is two entrants that share their results.
            let player = match &entry.name {
                None => player,
                Some(name) => format!("{}={player}", name.as_str()),
            };
            players.note("robot", &player, &format!("{key}.{field}"), document)?;
        }
    }
    Ok(())
}

/// Checks that the class of an entry exists.
fn class(entry: &RobotsEntry, key: &str, file: &ContestFile, document: &Document<'_>) -> Checked {
    let Some(class) = entry.class.as_ref().map(Name::as_str) else {
        return Ok(());
    };
    let mut classes = file.classes.iter().map(|it| it.name.as_str());
    if classes.clone().any(|it| it == class) {
        return Ok(());
    }
    let hint = suggestion(class, classes.by_ref())
        .unwrap_or_else(|| "add `[[classes]]` with this `name`".to_owned());
    let key = format!("{key}.class");
    let error = document.error(&key, format!("`{key}`: there is no class `{class}`"));
    Err(error.hint(hint))
}

/// Where the robots of an entry are, if it says so once and has no keys that contradict it.
fn robot_source<'a>(
    entry: &'a RobotsEntry,
    key: &str,
    document: &Document<'_>,
) -> Result<RobotSource<'a>, ConfigError> {
    let contradiction = |field: &str, message: String| {
        let field = format!("{key}.{field}");
        document.error(&field, format!("`{field}`: {message}"))
    };
    match (entry.path(), entry.bundled()) {
        (None, None) => {
            let message = format!("missing key `path` in `{key}`");
            let hint = "say where the robots are with `path`, or name one with `bundled`";
            Err(document.error(key, message).hint(hint))
        }
        (Some(_), Some(_)) => {
            let error = contradiction("bundled", "`path` is given, too".to_owned());
            Err(error.hint("write two `[[robots]]`"))
        }
        (Some(path), None) if path.is_pattern() && entry.name.is_some() => {
            let error = contradiction("name", "`path` is a pattern".to_owned());
            Err(error.hint("robots of a pattern are named by file or folder: `names_from`"))
        }
        (Some(path), None) => Ok(RobotSource::Path(path)),
        (None, Some(_)) if entry.names_from.is_some() => {
            let error = contradiction("names_from", "a bundled robot has no file".to_owned());
            Err(error.hint("leave it out"))
        }
        (None, Some(name)) => entry.source().ok_or_else(|| {
            let name = name.as_str();
            let names = bundled().iter().map(|it| it.name);
            let error = contradiction("bundled", format!("there is no bundled robot `{name}`"));
            let hint = suggestion(name, names);
            error.hint(hint.unwrap_or_else(|| "`wasmouse robots` lists them".to_owned()))
        }),
    }
}

fn variants(
    entry: &RobotsEntry,
    source: RobotSource<'_>,
    key: &str,
    document: &Document<'_>,
) -> Checked {
    let Some(variants) = &entry.variants else {
        return Ok(());
    };
    if variants.is_empty() {
        let key = format!("{key}.variants");
        let error = document.error(&key, format!("`{key}`: the list is empty"));
        return Err(error.hint("leave the key out for variant 0"));
    }
    let mut numbers = Seen::default();
    for (index, variant) in variants.iter().enumerate() {
        let key = format!("{key}.variants[{index}]");
        let Some(number) = variant.number(Some(source)) else {
            let (message, hint) = unknown_variant(variant, source);
            return Err(document
                .error(&key, format!("`{key}`: {message}"))
                .hint(hint));
        };
        numbers.note("variant", &number.to_string(), &key, document)?;
    }
    Ok(())
}

fn unknown_variant(variant: &VariantRef, source: RobotSource<'_>) -> (String, String) {
    match source {
        RobotSource::Path(_) => (
            format!("expected the number of a variant, found `{variant}`"),
            "only bundled robots have variants with names".to_owned(),
        ),
        RobotSource::Bundled(robot) => {
            let message = format!("robot `{}` has no variant `{variant}`", robot.name);
            let names: Vec<&str> = robot.variants.iter().map(|it| it.name).collect();
            let hint = match names.as_slice() {
                [] => "it has no variants; leave the key out".to_owned(),
                names => format!("its variants are {}", names.join(", ")),
            };
            (message, hint)
        }
    }
}

fn mazes(file: &ContestFile, document: &Document<'_>) -> Checked {
    if file.mazes.is_empty() {
        let error = document.error("mazes", "the contest has no mazes");
        return Err(error.hint("add `[[mazes]]` with a `set` and `paths`"));
    }
    let (mut sets, mut paths) = (Seen::default(), Seen::default());
    let mut generated = Generated::default();
    for (index, entry) in file.mazes.iter().enumerate() {
        let key = format!("mazes[{index}]");
        sets.note("set", entry.set.as_str(), &format!("{key}.set"), document)?;
        if entry.paths.is_empty() {
            let key = format!("{key}.paths");
            return Err(document.error(&key, format!("`{key}`: the list is empty")));
        }
        for (index, path) in entry.paths.iter().enumerate() {
            let key = format!("{key}.paths[{index}]");
            let text = path.as_str();
            paths.note("maze", text, &key, document)?;
            if text == "-" {
                let message = format!("`{key}`: a contest cannot read standard input");
                let error = document.error(&key, message);
                return Err(error.hint("name a file"));
            }
            if GenSpec::is_meant_by(text) {
                let spec = text.parse::<GenSpec>();
                let spec =
                    spec.map_err(|error| document.error(&key, format!("`{key}`: {error}")))?;
                generated.add(&spec, key);
            }
        }
    }
    generated.check(document)
}

/// The generated mazes of a contest by kind and size, as ranges of seeds with their keys.
#[derive(Default)]
struct Generated(BTreeMap<(String, u8), Vec<KeyedSeeds>>);

type KeyedSeeds = (RangeInclusive<u64>, String);

impl Generated {
    /// Notes what a specification at a key generates.
    fn add(&mut self, spec: &GenSpec, key: String) {
        for dimension in spec.dimensions() {
            let ranges = self.0.entry((spec.kind().to_string(), dimension));
            let ranges = ranges.or_default();
            ranges.push((spec.seeds().clone(), key.clone()));
        }
    }

    /// Checks that no maze is generated twice.
    fn check(mut self, document: &Document<'_>) -> Checked {
        for ((kind, dimension), ranges) in &mut self.0 {
            ranges.sort_by_key(|(seeds, _)| *seeds.start());
            for pair in ranges.windows(2) {
                let [(first, before), (second, key)] = pair else {
                    continue;
                };
                if second.start() > first.end() {
                    continue;
                }
                let seed = second.start();
                let message =
                    format!("`{key}`: maze `gen:{kind}:{dimension}:{seed}` is given twice");
                let line = document.line(before);
                let error = document.error(key, message);
                return Err(error.hint(format!("`{before}` in line {line} has it")));
            }
        }
        Ok(())
    }
}

/// Checks the seeds of any configuration file.
pub(in crate::contest) fn seeds(seeds: &SeedsEntry, document: &Document<'_>) -> Checked {
    let (first, count) = (seeds.first.get(), seeds.count.get());
    match first.checked_add(count - 1) {
        Some(_) => Ok(()),
        None => {
            let message = format!("`seeds.first`: {count} seeds from {first} on exceed 2^64 - 1");
            Err(document
                .error("seeds.first", message)
                .hint("begin with a smaller one"))
        }
    }
}

/// Checks the rules of any configuration file.
pub(in crate::contest) fn rules(rules: &RulesEntry, document: &Document<'_>) -> Checked {
    let bundled = Ruleset::all().map(|it| it.name);
    let names = bundled.iter().map(String::as_str);
    if let Some(base) = &rules.base
        && rules.ruleset().is_none()
    {
        let message = format!("`rules.base`: there is no ruleset `{}`", base.as_str());
        let hint = suggestion(base.as_str(), names.clone())
            .unwrap_or_else(|| format!("the rulesets are {}", bundled.join(", ")));
        return Err(document.error("rules.base", message).hint(hint));
    }
    let is_changed = rules.game != GameEntry::default() || rules.sandbox != SandboxEntry::default();
    match &rules.name {
        None if is_changed || rules.version.is_some() => {
            let message = "missing key `name` in `rules`, for rules that are not those of `base`";
            let hint = "for example: name = \"my rules\"";
            Err(document.error("rules", message).hint(hint))
        }
        Some(name) if names.clone().any(|it| it == name.as_str()) => {
            let message = format!(
                "`rules.name`: `{}` is the name of a bundled ruleset",
                name.as_str()
            );
            let hint = "use another name, or `base` alone for the bundled rules";
            Err(document.error("rules.name", message).hint(hint))
        }
        _ => Ok(()),
    }
}

fn scoring(file: &ContestFile, document: &Document<'_>) -> Checked {
    if file.scoring.unfinished_steps == Some(0) {
        let key = "scoring.unfinished_steps";
        let message = format!("`{key}`: expected an integer of at least 1, found 0");
        return Err(document.error(key, message));
    }
    let mut tie_breaks = Seen::default();
    for (index, tie_break) in file.scoring.tie_breaks.iter().enumerate() {
        let key = format!("scoring.tie_breaks[{index}]");
        let value = format!("{tie_break:?}");
        if tie_breaks.0.insert(value, key.clone()).is_some() {
            let message = format!("`{key}`: the tie-break is given twice");
            return Err(document.error(&key, message).hint("leave it out"));
        }
    }
    Ok(())
}

fn outputs(file: &ContestFile, document: &Document<'_>) -> Checked {
    let mut paths = Seen::default();
    if let Some(store) = &file.store {
        paths.note("file", &plain(store), "store", document)?;
    }
    for (key, path) in file.outputs.paths() {
        paths.note("file", &plain(path), &format!("outputs.{key}"), document)?;
    }
    Ok(())
}

/// A path without the parts that mean nothing, such as `./`.
fn plain(path: &FilePath) -> String {
    let parts = Path::new(path.as_str()).components();
    let parts: PathBuf = parts.filter(|it| *it != Component::CurDir).collect();
    parts.to_string_lossy().into_owned()
}
