//! Contest files: what each mistake is answered with, and the agreement of parser, JSON Schema,
//! template and documentation.
//!
//! After a wanted change, `INSTA_UPDATE=always cargo test -p wasmouse-tests contest_file` writes the
//! messages again.

mod bad;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use insta::{Settings, assert_snapshot};
use jsonschema::Validator;
use serde_json::{Map, Value};
use wasmouse::contest::config::{BYTES_MAX, ConfigError, decode};
use wasmouse::contest::{ContestFile, KeepTranscripts, RobotSource, template};
use wasmouse::report::config::config_error;
use wasmouse::report::text::Printable as _;
use wasmouse_core::game::Ruleset;

use bad::{BAD_FILES, SeenBy};

use crate::pointers::objects;

const SCHEMA: &str = include_str!("../../../host/schema/contest.schema.json");
const REFERENCE: &str = include_str!("../../../docs/CONTEST.md");

const ROBOTS: &str = "[[robots]]\nbundled = \"flood\"\n";
const MAZES: &str = "[[mazes]]\nset = \"public\"\npaths = [\"tree-16\"]\n";

/// A contest file with every key.
const COMPLETE: &str = r#"
version = 1
name = "Spring contest"
store = "spring.db"

[[robots]]
path = "submissions/*/robot.wasm"
names_from = "folder"
class = "light"
variants = [0, 2]

[[robots]]
path = "other/bot.wasm"
name = "Zoë's"
author = "Zoë"

[[robots]]
bundled = "flood"
variants = ["certain", 0]

[[classes]]
name = "light"
step_fuel_max = 10_000
memory_bytes_max = 2_097_152

[[classes]]
name = "open"

[[mazes]]
set = "public"
paths = ["test_maze_01", "mazes", "more/*.txt"]
weight = 2
lenient = true

[[mazes]]
set = "final"
paths = ["gen:tree,loops=30:12..=20:1..=100"]
hidden = true

[seeds]
first = 18446744073709551000
count = 3

[rules]
base = "udacity-each-run"
name = "ours"
version = 2
[rules.game]
budget = 1500
budget_scope = "each-run"
longest_move = 4
exploration_divisor = 20
[rules.sandbox]
start_fuel_max = 1
step_fuel_max = 2
match_fuel_max = 3
memory_bytes_max = 65_536
table_elements_max = 4
stack_bytes_max = 16_384
journal_bytes_max = 5
host_call_bytes_max = 6

[scoring]
method = "rank-points"
unfinished_steps = 2000
tie_breaks = ["finished", "fuel"]

[run]
jobs = 4
robot_time_seconds = 3600
match_time_seconds = 10
keep_transcripts = "all"

[report]
show_top = 10
hide_names = true
freeze = true

[outputs]
html = "out/index.html"
csv = "out/standings.csv"
json = "out/results.json"
jsonl = "out/matches.jsonl"
markdown = "out/standings.md"
"#;

fn validator() -> Validator {
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    jsonschema::draft202012::meta::validate(&schema).expect("the schema is a schema");
    jsonschema::draft202012::new(&schema).expect("the schema can be used")
}

/// A contest file as JSON, which is what the schema is about.
fn json(text: &str) -> Result<Value, toml::de::Error> {
    toml::from_str(text)
}

#[track_caller]
fn parse(text: &str) -> ContestFile {
    ContestFile::parse(text).unwrap_or_else(|error| panic!("{error}: {}", error.excerpt.text))
}

#[track_caller]
fn check_valid(text: &str) {
    let value = json(text).expect("TOML");
    let errors: Vec<String> = validator()
        .iter_errors(&value)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
}

/// What the terminal shows.
fn shown(error: &ConfigError) -> String {
    let report = config_error(&"contest.toml".to_text(), error);
    let mut shown = report.as_str().to_owned();
    if let Some(hint) = &error.hint {
        write!(shown, "\n\nhint: {}", hint.to_text().as_str()).expect("a string");
    }
    shown
}

/// Each mistake, and what the user is told.
#[test]
fn every_mistake_gets_one_message() {
    let validator = validator();
    let mut messages = String::new();
    let mut unexpected = Vec::new();
    for &(mistake, seen_by, text) in BAD_FILES {
        let text = text.replace("{robots}", ROBOTS).replace("{mazes}", MAZES);
        let error = ContestFile::parse(&text).expect_err(mistake);
        let is_valid = json(&text).ok().map(|value| validator.is_valid(&value));
        let expected = match seen_by {
            SeenBy::Toml => None,
            SeenBy::Schema => Some(false),
            SeenBy::Parser => Some(true),
        };
        if is_valid != expected {
            unexpected.push((mistake, is_valid));
        }
        writeln!(messages, "# {mistake}\n{}\n", shown(&error)).expect("a string");
    }
    assert_eq!(unexpected, [], "by the schema");
    let names: BTreeSet<&str> = BAD_FILES.iter().map(|it| it.0).collect();
    assert_eq!(names.len(), BAD_FILES.len());
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("../snapshots");
    settings.bind(|| assert_snapshot!("contest-file-mistakes", messages));
}

#[test]
fn bytes_that_are_no_text_are_reported() {
    let utf_16: Vec<u8> = "\u{feff}version = 1\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let check = |bytes: &[u8], place: (usize, usize), message: &str| {
        let error = decode(bytes).expect_err(message);
        assert_eq!((error.line, error.column), place);
        assert_eq!(error.message, message);
    };
    check(&utf_16, (1, 1), "expected UTF-8, found UTF-16");
    let latin_1 = b"version = 1\nname = \"\xe4\"\n";
    check(latin_1, (2, 9), "expected UTF-8, found the byte 0xe4");
    let large = vec![b'\n'; BYTES_MAX + 1];
    check(&large, (1, 1), "the file has more than 1048576 bytes");
    let marked = format!("\u{feff}{COMPLETE}");
    assert_eq!(decode(marked.as_bytes()).as_deref(), Ok(COMPLETE));
}

/// Whatever the nesting or the number of entries, the parser ends with an error.
#[test]
fn large_files_are_no_danger() {
    let depth = 100_000;
    let nested = format!("a = {}{}\n", "[".repeat(depth), "]".repeat(depth));
    let tables = format!("a = {}1{}\n", "{a=".repeat(depth), "}".repeat(depth));
    let dotted = format!("{}a = 1\n", "a.".repeat(depth));
    let header = format!("[{}a]\n", "a.".repeat(depth));
    let long = format!("version = 1\nname = \"{}\"\n", "x".repeat(1_000_000));
    let keys: String = (0..50_000).map(|it| format!("k{it} = 1\n")).collect();
    let robots = format!(
        "version = 1\n{}",
        "[[robots]]\npath = \"a\"\n".repeat(40_000)
    );
    for text in [nested, tables, dotted, header, long, keys, robots] {
        let error = ContestFile::parse(&text).expect_err("no contest file");
        let start = &text[..20];
        assert!(shown(&error).len() < 1000, "{start}");
    }
}

/// Every beginning of a file, and every file with one character replaced, is a contest file or has
/// an error that can be shown.
#[test]
fn files_that_are_cut_or_changed_are_no_danger() {
    let check = |text: &str| {
        if let Err(error) = ContestFile::parse(text) {
            assert!(error.line <= text.split('\n').count(), "{error}");
            assert!(!shown(&error).is_empty());
        }
    };
    for (at, character) in COMPLETE.char_indices() {
        let (before, after) = (&COMPLETE[..at], &COMPLETE[at + character.len_utf8()..]);
        check(before);
        for other in ["\"", "[", "\n", "0", "\u{e4}", "\u{1f42d}", "\u{1b}", ""] {
            check(&format!("{before}{other}{after}"));
        }
    }
}

#[test]
fn a_complete_file_says_everything() {
    check_valid(COMPLETE);
    let file = parse(COMPLETE);
    let rules = file.rules.ruleset().expect("a bundled base");
    assert_eq!((rules.name.as_str(), rules.version), ("ours", 2));
    assert_eq!((rules.game.budget, rules.game.longest_move), (1500, 4));
    let limits = &rules.sandbox;
    let fuel = [
        limits.start_fuel_max,
        limits.step_fuel_max,
        limits.match_fuel_max,
    ];
    assert_eq!(fuel, [1, 2, 3]);
    let others = [
        limits.memory_bytes_max,
        limits.table_elements_max,
        limits.stack_bytes_max,
        limits.journal_bytes_max,
        limits.host_call_bytes_max,
    ];
    assert_eq!(others, [65_536, 4, 16_384, 5, 6]);
    let sets: Vec<_> = file.mazes.iter().map(|it| it.maze_set()).collect();
    assert_eq!((sets[0].weight, sets[0].is_hidden), (2, false));
    assert_eq!((sets[1].weight, sets[1].is_hidden), (1, true));
    assert!(file.mazes[0].lenient && !file.mazes[1].lenient);
    assert_eq!(file.robots[0].variant_numbers(), [0, 2]);
    assert_eq!(file.robots[1].variant_numbers(), [0]);
    assert_eq!(file.robots[2].variant_numbers(), [1, 0]);
    let Some(RobotSource::Bundled(robot)) = file.robots[2].source() else {
        panic!("flood is bundled");
    };
    assert_eq!(robot.name, "flood");
    assert_eq!(file.class_by_usage(10_000, 2 << 20), Some("light"));
    assert_eq!(file.class_by_usage(10_001, 0), Some("open"));
    assert_eq!(file.class_by_usage(0, (2 << 20) + 1), Some("open"));
    assert_eq!(file.run.keep_transcripts, KeepTranscripts::All);
    assert_eq!(file.outputs.paths().len(), 5);
}

/// A file or folder can have the name of something bundled.
#[test]
fn paths_are_told_from_names() {
    parse(
        "version = 1\n[[robots]]\nbundled = \"flood\"\n[[robots]]\npath = \"flood\"\n\
         [[mazes]]\nset = \"a\"\npaths = [\"tree-16\", \"./tree-16\"]\n",
    );
}

#[test]
fn parser_and_schema_agree_about_missing_and_added_keys() {
    let validator = validator();
    let document = json(COMPLETE).expect("TOML");
    let check = |changed: &Value, what: &str| {
        let table = toml::Table::try_from(changed).expect("TOML has all of its types");
        let text = table.to_string();
        let parsed = ContestFile::parse(&text);
        assert_eq!(
            parsed.is_ok(),
            validator.is_valid(changed),
            "{what}: {:?}",
            parsed.err()
        );
        parsed.is_ok()
    };
    let pointers = objects(&document);
    assert!(pointers.len() > 10, "{pointers:?}");
    let mut required = Vec::new();
    for pointer in pointers {
        let fields = document.pointer(&pointer).and_then(Value::as_object);
        let fields = fields.expect("the pointer of an object");
        let with = |fields: Map<String, Value>| {
            let mut changed = document.clone();
            *changed.pointer_mut(&pointer).expect("it is there") = Value::Object(fields);
            // The largest seeds are not in the range of every TOML library.
            if let Some(first) = changed.pointer_mut("/seeds/first") {
                *first = 7.into();
            }
            changed
        };
        let mut added = fields.clone();
        added.insert("added".to_owned(), 1.into());
        assert!(!check(&with(added), &format!("{pointer}: added")));
        for name in fields.keys() {
            let mut fewer = fields.clone();
            fewer.remove(name);
            // The schema cannot know that a robot needs this class.
            if pointer == "/classes/0" && name == "name" || pointer.is_empty() && name == "classes"
            {
                continue;
            }
            if !check(&with(fewer), &format!("{pointer}: without {name}")) {
                required.push(format!("{pointer}/{name}"));
            }
        }
    }
    let expected = [
        "/mazes",
        "/robots",
        "/version",
        "/classes/1/name",
        "/mazes/0/paths",
        "/mazes/0/set",
        "/mazes/1/paths",
        "/mazes/1/set",
        "/robots/0/path",
        "/robots/1/path",
        "/robots/2/bundled",
        "/rules/name",
    ];
    required.sort();
    let mut expected = expected.map(str::to_owned);
    expected.sort();
    assert_eq!(required, expected);
}

/// The keys of the schema, with those of its definitions.
fn schema_keys(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(fields) => {
            // In conditions, keys are repeated.
            for (name, value) in fields.iter().filter(|(name, _)| *name != "if") {
                if name == "properties" {
                    found.extend(value.as_object().expect("properties").keys().cloned());
                }
                schema_keys(value, found);
            }
        }
        Value::Array(values) => values.iter().for_each(|it| schema_keys(it, found)),
        _ => {}
    }
}

#[test]
fn every_key_is_documented_and_in_the_complete_file() {
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let mut keys = BTreeSet::new();
    schema_keys(&schema, &mut keys);
    assert!(keys.len() > 50, "{keys:?}");
    let complete = COMPLETE.replace(['[', ']', '.'], " ");
    let words: BTreeSet<&str> = complete.split_whitespace().collect();
    for key in keys {
        assert!(words.contains(key.as_str()), "{key} in the complete file");
        assert!(
            REFERENCE.contains(&format!("`{key}`")),
            "{key} in the reference"
        );
    }
}

/// The reference shows contest files: all of them are valid.
#[test]
fn the_examples_of_the_reference_are_valid() {
    let blocks = REFERENCE.split("```toml\n").skip(1);
    let examples: Vec<&str> = blocks.filter_map(|it| it.split("```").next()).collect();
    assert!(examples.len() > 5, "{examples:?}");
    for example in examples {
        let has = |key: &str| example.lines().any(|it| it.starts_with(key));
        let mut text = String::new();
        if !has("version") {
            text += "version = 1\n";
        }
        text += example;
        if !has("[[robots]]") {
            text += ROBOTS;
        }
        if !has("[[mazes]]") {
            text += MAZES;
        }
        parse(&text);
        check_valid(&text);
    }
}

/// The template with everything that is commented out in it.
fn uncommented(template: &str) -> String {
    let lines = template.lines().map(|line| match line.strip_prefix('#') {
        Some(key) if !key.starts_with(' ') => key,
        _ => line,
    });
    lines.collect::<Vec<&str>>().join("\n")
}

#[test]
fn the_template_is_valid_with_and_without_its_options() {
    let text = template("Ann's \"spring\" \\ 1");
    let file = parse(&text);
    check_valid(&text);
    assert_eq!(file.name.as_str(), "Ann's \"spring\" \\ 1");
    let all = uncommented(&text);
    assert!(all.lines().count() == text.lines().count() && all != text);
    let all = parse(&all);
    check_valid(&uncommented(&text));
    // What is commented out and is no example is the default.
    let rules = all.rules.ruleset().expect("a bundled base");
    let default = Ruleset::default();
    assert_eq!((rules.game, rules.sandbox), (default.game, default.sandbox));
    assert_eq!(file.rules.ruleset(), Some(default));
    assert_eq!(all.seeds.first, file.seeds.first);
    assert_eq!(all.seeds.count, file.seeds.count);
    assert_eq!(all.run.keep_transcripts, file.run.keep_transcripts);
    assert_eq!(all.mazes[0].weight, file.mazes[0].weight);
    assert_eq!(
        all.robots[0].variant_numbers(),
        file.robots[0].variant_numbers()
    );
    // It has every key of the schema.
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let mut keys = BTreeSet::new();
    schema_keys(&schema, &mut keys);
    for key in keys {
        let is_in = |line: &str| {
            let line = line.trim_start_matches(['#', '[']);
            line.starts_with(&format!("{key} =")) || line.starts_with(&format!("{key}]"))
        };
        let is_in_rules = text.contains(&format!("[rules.{key}]"));
        assert!(is_in_rules || text.lines().any(is_in), "{key}");
    }
}
