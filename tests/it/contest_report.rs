//! Reports of a contest: what each format looks like, the JSON against its schema, and the web page
//! against a validator of HTML.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use insta::{Settings, assert_snapshot};
use jsonschema::Validator as JsonValidator;
use serde_json::Value;
use wasmouse::contest::{
    MatchScore, MatrixFault, MatrixMaze, MatrixRobot, MazeSet, Method, NotAdmitted, Outcome,
    ScoreMatrix, Scoring, Seeds,
};
use wasmouse::report::contest::{
    ContestReport, MatchPicture, Pictures, ReportOptions, html, json, markdown, matches_csv,
    robots_csv, table,
};
use wasmouse::report::table::{Layout, Lines};
use wasmouse_core::Digest;
use wasmouse_core::game::{Action, Counts, Fault, FaultKind, Phase, Ruleset, Run, Steps, Verdict};
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::{Cell, Maze, Turn, Walls};
use wasmouse_core::record::{EngineId, FuelUse, MatchKey, MatchRecord, RecordVersion, Transcript};
use wasmouse_engine::admission::Rejection;
use xtask::validators::Validator;

use crate::pointers::objects;

const SCHEMA: &str = include_str!("../../host/schema/contest-report.schema.json");

/// A contest with every state of a robot and a hidden set of mazes.
struct Contest {
    matrix: ScoreMatrix,
    scoring: Scoring,
    engine: EngineId,
}

/// How many steps more than the first robot those that play explore.
const SLOWER: [u32; 3] = [0, 10, 200];

impl Contest {
    fn new(method: Method) -> Self {
        let rules = Ruleset::default();
        let names = ["flood", "<b>bold</b>", "looper", "rejected", "unlucky"];
        let robot = |name: &str| MatrixRobot::new(name.to_owned(), Digest::of(name.as_bytes()), 0);
        let seeds = Seeds { first: 1, count: 2 };
        let mut matrix = ScoreMatrix::new(rules, seeds, names.map(robot).into());
        let set = |name: &str, is_hidden, weight| MazeSet {
            name: name.to_owned(),
            is_hidden,
            weight,
        };
        matrix.sets = vec![set("public", false, 1), set("final", true, 3)];
        let scoring = Scoring {
            method,
            ..Scoring::default()
        };
        let mut contest = Self {
            matrix,
            scoring,
            engine: EngineId::new("wasmtime-1"),
        };
        for index in 0..9 {
            contest.add_maze(index);
        }
        contest.add_states();
        contest
    }

    fn add_maze(&mut self, index: u32) {
        let matrix = &mut self.matrix;
        let name = format!("maze-{index}");
        let oracle = matrix.rules.game.score(15 + index, 16 + index);
        let maze = matrix.push_maze(MatrixMaze {
            digest: if index == 0 {
                open_maze().digest()
            } else {
                Digest::of(name.as_bytes())
            },
            name: name.into(),
            dimension: 12,
            oracle: (index != 8).then_some(oracle),
            set: usize::from(index > 4),
        });
        for seed in 0..2 {
            // The last one is withdrawn after three mazes.
            let playing = if index < 3 { 3 } else { 2 };
            for (robot, slower) in SLOWER.into_iter().enumerate().take(playing) {
                let is_stuck = robot == 1 && index == 2 && seed == 1;
                let outcome = match (robot, index) {
                    (_, 8) => Outcome::BudgetUsedUp {
                        goal_reached: false,
                    },
                    (1, 2) if is_stuck => Outcome::Fault(FaultKind::Panic),
                    _ => Outcome::Finished,
                };
                let exploration = 40 + 7 * index + slower;
                let steps = Steps {
                    exploration,
                    speed: 15 + index + robot as u32,
                };
                let fuel = u64::from(steps.total()) * 100;
                let score = MatchScore {
                    outcome,
                    steps,
                    fuel: FuelUse {
                        start: 10,
                        steps: fuel,
                        step_max: 150,
                    },
                    memory_bytes: 65_536 * (robot as u64 + 1),
                };
                matrix.set(robot, maze, seed, score);
            }
        }
    }

    fn add_states(&mut self) {
        let first = self.record(1, 2);
        let [flood, bold, looper, rejected, unlucky] = &mut self.matrix.robots[..] else {
            panic!("five robots");
        };
        flood.class = Some("small".into());
        flood.author = Some("Ann".into());
        bold.class = Some("large".into());
        bold.faults.insert("panic", MatrixFault { count: 1, first });
        looper.unplayed = BTreeMap::from([("it stalled twice".into(), 12)]);
        let rejection = Rejection::UnknownImport("wasi:cli/environment@0.2.0".into());
        rejected.not_admitted = Some(NotAdmitted::Rejected(Arc::new(rejection)));
        unlucky.not_admitted = Some(NotAdmitted::Failed("no worker process".into()));
    }

    fn record(&self, robot: usize, maze: usize) -> MatchRecord {
        let key = MatchKey {
            engine: self.engine.digest(),
            rules: self.matrix.rules.digest(),
            robot: self.matrix.robots[robot].digest,
            variant: 0,
            maze: self.matrix.mazes[maze].digest,
            seed: 2,
        };
        let fault = Fault {
            kind: FaultKind::Panic,
            phase: Phase::NextMove,
            run: Run::Exploration,
            step: 65,
            cell: Cell::new(0, 3),
            detail: "panicked: <i>no map</i>".into(),
        };
        MatchRecord {
            version: RecordVersion,
            key,
            verdict: Verdict::Fault { fault },
            steps: Steps {
                exploration: 64,
                speed: 0,
            },
            counts: Counts::default(),
            fuel: FuelUse {
                start: 10,
                steps: 6400,
                step_max: 150,
            },
            memory_bytes: 131_072,
            journal: JournalCounts::default(),
            transcript: Digest::of(&[1]),
        }
    }

    fn report(&self, options: ReportOptions) -> ContestReport<'_> {
        let mut transcript = Transcript::default();
        for advance in [3, 1] {
            let turn = Turn::Right;
            transcript.push(Action::Move { turn, advance });
        }
        let mut rules = self.matrix.rules.game;
        rules.budget = 2;
        let picture = |robot| MatchPicture::new((robot, 0, 0), &open_maze(), &rules, &transcript);
        let pictures = |robots: [usize; 2]| {
            robots
                .map(|robot| picture(robot).expect("two steps"))
                .into()
        };
        let pictures = Pictures {
            best: pictures([1, 0]),
            hardest: pictures([0, 1]),
        };
        ContestReport::new(
            "Spring cup",
            &self.matrix,
            &self.scoring,
            &self.engine,
            54,
            options,
        )
        .with_pictures(pictures)
        .with_results_digest(Digest::of(b"results"))
    }
}

fn open_maze() -> Maze {
    Maze::contest(Walls::open(12)).expect("start and goal fit")
}

/// For contestants, while the contest is frozen.
fn censored() -> ReportOptions {
    ReportOptions {
        show_top: Some(2),
        hide_names: true,
        hide_hidden_mazes: true,
        frozen: Some("since 18:00".to_owned()),
    }
}

/// The page without what is the same in all pages and without drawings, an element a line.
fn outline(page: &str) -> String {
    let mut outline = String::new();
    let mut rest = page;
    for (open, close) in [("<style>", "</style>"), ("<script>", "</script>")] {
        let (before, after) = rest.split_once(open).expect("it is there");
        let (_, after) = after.split_once(close).expect("it ends");
        outline.push_str(before);
        rest = after;
    }
    outline.push_str(rest);
    let mut without_drawings = String::new();
    let mut parts = outline.split("<svg");
    without_drawings.push_str(parts.next().unwrap_or_default());
    for part in parts {
        let (head, after) = part.split_once("</svg>").expect("it ends");
        let label = head
            .split_once("aria-label=\"")
            .and_then(|(_, it)| it.split_once('"'));
        let label = label.map_or("", |it| it.0);
        without_drawings.push_str(&format!("[drawing {label}]{after}"));
    }
    // The policy has digests of the style and of the script.
    let (before, after) = without_drawings.split_once("'sha256-").expect("a policy");
    let (_, after) = after.split_once("base-uri").expect("its end");
    let page = format!("{before}(hashes) base-uri{after}");
    // Plots have snapshots of their own.
    let mut images = page.split("data:image/svg+xml;base64,");
    let mut page = images.next().unwrap_or_default().to_owned();
    for part in images {
        let (_, after) = part.split_once('"').expect("the end of an attribute");
        page.push_str(&format!("(image)\"{after}"));
    }
    let version = env!("CARGO_PKG_VERSION");
    page.replace("><", ">\n<")
        .replace(&format!("wasmouse {version}"), "wasmouse VERSION")
}

#[test]
fn every_format_is_as_it_was() {
    let contest = Contest::new(Method::MeanScore);
    let report = contest.report(ReportOptions::default());
    let ascii = Layout {
        lines: Lines::Ascii,
        width: None,
    };
    let unicode = Layout {
        lines: Lines::Unicode,
        width: Some(80),
    };
    let for_contestants = contest.report(censored());
    let points = Contest::new(Method::RankPoints);
    let points = points.report(ReportOptions::default());
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        assert_snapshot!("contest-report-table", table(&report, unicode));
        assert_snapshot!("contest-report-table-ascii", table(&points, ascii));
        assert_snapshot!(
            "contest-report-table-censored",
            table(&for_contestants, unicode)
        );
        assert_snapshot!("contest-report-markdown", markdown(&report));
        assert_snapshot!("contest-report-robots-csv", robots_csv(&report));
        assert_snapshot!("contest-report-matches-csv", matches_csv(&report));
        let version = format!("\"wasmouse\": \"{}\"", env!("CARGO_PKG_VERSION"));
        let json = json(&for_contestants).replace(&version, "\"wasmouse\": \"VERSION\"");
        assert_snapshot!("contest-report-json", json);
        assert_snapshot!("contest-report-html", outline(&html(&report)));
    });
}

fn validator() -> JsonValidator {
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    jsonschema::draft202012::meta::validate(&schema).expect("the schema is a schema");
    jsonschema::draft202012::new(&schema).expect("the schema can be used")
}

/// The documents of all methods, shown completely and partly.
fn documents() -> Vec<Value> {
    let methods = [Method::MeanScore, Method::Regret, Method::RankPoints];
    let of_method = |method| {
        let contest = Contest::new(method);
        let options = [ReportOptions::default(), censored()];
        options.map(|options| {
            serde_json::from_str(&json(&contest.report(options))).expect("it is JSON")
        })
    };
    methods.into_iter().flat_map(of_method).collect()
}

#[test]
fn the_json_is_valid() {
    let validator = validator();
    for document in documents() {
        let errors: Vec<String> = validator
            .iter_errors(&document)
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert!(errors.is_empty(), "{errors:#?}");
    }
}

#[test]
fn json_with_a_field_missing_or_added_is_invalid() {
    let validator = validator();
    let document = documents().swap_remove(0);
    let mut pointers = objects(&document);
    // The reasons of matches that were not played are no fields.
    pointers.retain(|pointer| !pointer.ends_with("/unplayed"));
    assert!(pointers.len() > 50, "{pointers:?}");
    for pointer in pointers {
        let fields = document.pointer(&pointer).and_then(Value::as_object);
        let fields = fields.expect("the pointer of an object");
        let is_valid = |fields: serde_json::Map<String, Value>| {
            let mut changed = document.clone();
            *changed.pointer_mut(&pointer).expect("it is there") = Value::Object(fields);
            validator.is_valid(&changed)
        };
        let mut added = fields.clone();
        added.insert("added".to_owned(), Value::Null);
        assert!(!is_valid(added), "{pointer}: added");
        for name in fields.keys() {
            let mut fewer = fields.clone();
            fewer.remove(name);
            assert!(!is_valid(fewer), "{pointer}: without {name}");
        }
    }
}

#[test]
fn a_page_of_many_matches_is_small() {
    let mut contest = Contest::new(Method::MeanScore);
    for index in 9..3000 {
        contest.add_maze(index % 100 + 100);
    }
    let page = html(&contest.report(ReportOptions::default()));
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
    assert!(
        page.contains("Shown: 2000 of 3000 mazes, the hardest ones"),
        "it says what is left out"
    );
}

#[test]
fn pages_are_valid_html() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let Some(program) = Validator::Html.find(root, "pages_are_valid_html") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let contest = Contest::new(Method::MeanScore);
    let empty = ScoreMatrix::new(Ruleset::default(), contest.matrix.seeds, Vec::new());
    let (scoring, engine) = (&contest.scoring, &contest.engine);
    let empty = ContestReport::new("none", &empty, scoring, engine, 0, ReportOptions::default());
    for (name, report) in [
        ("all.html", contest.report(ReportOptions::default())),
        ("censored.html", contest.report(censored())),
        ("empty.html", empty),
    ] {
        std::fs::write(folder.path().join(name), html(&report)).expect("a file");
    }
    let rules = r#"{"root": true, "extends": ["html-validate:recommended", "html-validate:a11y"]}"#;
    std::fs::write(folder.path().join(".htmlvalidate.json"), rules).expect("a file");
    let validate = |file: &str| {
        let mut command = std::process::Command::new(&program);
        let output = command.arg(file).current_dir(folder.path()).output();
        let output = output.expect("the validator can be started");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        (output.status.success(), text)
    };
    for file in ["all.html", "censored.html", "empty.html"] {
        let (is_valid, text) = validate(file);
        assert!(is_valid, "{file}:\n{text}");
    }
    let bad = "<!DOCTYPE html><html lang=\"en\"><title>x</title><p><div></p>";
    std::fs::write(folder.path().join("bad.html"), bad).expect("a file");
    assert!(!validate("bad.html").0, "the validator finds mistakes");
}
