//! `wasmouse study`: the page, what it may replace, and what it refuses.

use std::fs;
use std::path::Path;
use std::process::Output;

use wasmouse::contest::STUDY_SEEDS;
use xtask::repository;

use crate::binary;
use crate::shared::shared;

/// A quick study in a folder, of robots that are fast.
fn study(folder: &Path, arguments: &[&str]) -> Output {
    binary::wasmouse()
        .args(["study", "--quick"])
        .args(arguments)
        .current_dir(folder)
        .env_remove("WASMOUSE_SHARED")
        .env("WASMOUSE_CACHE", folder.join("cache"))
        .output()
        .expect("the program can be run")
}

#[track_caller]
fn check_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
}

#[track_caller]
fn check_error(output: &Output, code: i32, expected: &str) {
    check_code(output, code);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains(expected), "{stderr}");
}

#[test]
fn the_page_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let robots = ["flood:certain", "random", "count-expansion"];
    let output = study(folder, &[&robots[..], &["-j1"]].concat());
    check_code(&output, 0);
    let page = fs::read_to_string(folder.join("docs/REFERENCE.md")).expect("the default page");
    for part in [
        "\nwasmouse study flood:certain random count-expansion --quick\n",
        "**Absent when this page was written: `test_maze_02`, `test_maze_03`.**",
        "| `flood:certain` | 21.867 (146 + 17) | - | - | - |\n",
        "| 01 | 44.100 | 45.200 (36 + 44) | +2.5 % |\n",
        "| `flood:certain` | 80 of 80 | 100.00 % |",
        "| finished | 1 of 6 | ",
        "`gen:braid:12..=20:500001..=500004`",
        "`gen:stretches:12..=20:500001..=500004`",
    ] {
        assert!(page.contains(part), "no `{part}` in\n{page}");
    }
    let output = study(folder, &[&robots[..], &["-j3", "-o", "again.md"]].concat());
    check_code(&output, 0);
    let again = fs::read_to_string(folder.join("again.md")).expect("a page");
    assert_eq!(page, again);
}

#[test]
fn only_pages_of_a_study_are_replaced() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let page = folder.join("page.md");
    fs::write(&page, "# My notes\n").expect("a file");
    let arguments = ["dfs:reset", "-o", "page.md"];
    let output = study(folder, &arguments);
    check_error(
        &output,
        3,
        "error: failed to write `page.md`: the file is there and was not written by a study\n\n\
         hint: replace it with --force\n",
    );
    assert_eq!(fs::read(&page).expect("a file"), b"# My notes\n");
    check_code(&study(folder, &[&arguments[..], &["--force"]].concat()), 0);
    let first = fs::read_to_string(&page).expect("a page");
    assert!(first.contains("dfs:reset"), "{first}");
    check_code(&study(folder, &["flood:reset", "-o", "page.md"]), 0);
    let second = fs::read_to_string(&page).expect("a page");
    assert!(!second.contains("dfs:reset"), "{second}");
}

#[test]
fn bad_input_is_refused_before_anything_is_played() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let official = include_str!("../../host/mazes/division-14.txt");
    fs::create_dir(folder.join("mazes")).expect("a folder");
    fs::write(folder.join("mazes/test_maze_02.txt"), official).expect("a maze");
    for (arguments, code, expected) in [
        (&["flood", "-o", "mazes"][..], 3, "`mazes`"),
        (
            &["flood", "--official", "nowhere"],
            3,
            "nowhere/test_maze_02.txt",
        ),
        (
            &["flood", "--official", "mazes"],
            3,
            "`mazes/test_maze_02.txt` is not the official maze of that name: its digest is sha256:",
        ),
        (
            &["flood:nosuch"],
            2,
            "robot `flood` has no setting `nosuch`",
        ),
        (&["nosuch.wasm"], 3, "failed to read robot `nosuch.wasm`"),
    ] {
        check_error(&study(folder, arguments), code, expected);
    }
    assert!(!folder.join("docs/REFERENCE.md").exists());
}

#[test]
fn a_refused_robot_is_on_the_page_and_in_the_exit_code() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("flood.wasm"), "no robot").expect("a file");
    let output = study(folder, &["flood.wasm", "flood:reset", "-o", "page.md"]);
    check_error(&output, 4, "refused `flood.wasm`");
    let page = fs::read_to_string(folder.join("page.md")).expect("a page");
    assert!(
        page.contains("| `flood` | refused | - | - | - |\n"),
        "{page}"
    );
}

#[test]
fn official_mazes_are_found_in_a_folder_or_in_the_shared_material() {
    let Some(shared) = shared() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let mazes = shared
        .join("mazes/udacity")
        .canonicalize()
        .expect("a folder");
    let mazes = mazes.to_str().expect("UTF-8");
    let arguments = ["flood:certain", "-o", "page.md", "--official", mazes];
    check_code(&study(folder, &arguments), 0);
    let page = fs::read_to_string(folder.join("page.md")).expect("a page");
    let row = "| `flood:certain` | 21.867 (146 + 17) | 28.433 (193 + 22) | 34.367 (281 + 25) \
               | 84.667 |\n";
    assert!(page.contains(row), "{page}");
    assert!(!page.contains(mazes), "no path of this machine");

    let output = binary::wasmouse()
        .args(["study", "--quick", "flood:certain", "-o", "other.md"])
        .current_dir(folder)
        .env("WASMOUSE_SHARED", shared.canonicalize().expect("a folder"))
        .env("WASMOUSE_CACHE", folder.join("cache"))
        .output()
        .expect("the program can be run");
    check_code(&output, 0);
    let other = fs::read_to_string(folder.join("other.md")).expect("a page");
    assert_eq!(page, other);
}

/// The page says that no robot was trained on its mazes. A robot that is trained
/// says on which seeds in `training.toml`, in tables with `first_seed` and
/// `last_seed`; the table `test` has those that it was not trained on.
#[test]
fn no_robot_is_trained_on_the_mazes_of_the_study() {
    let robots = fs::read_dir(repository().join("example-robots")).expect("a folder");
    for robot in robots {
        let file = robot.expect("an entry").path().join("training.toml");
        if let Ok(text) = fs::read_to_string(&file) {
            let overlap = trained_on_the_study(&text);
            assert_eq!(overlap, None, "{}", file.display());
        }
    }
    let trained = |first: u64| {
        let text = format!("[p]\nfirst_seed = {first}\nlast_seed = {}\n", first + 9);
        trained_on_the_study(&text)
    };
    assert_eq!(trained(STUDY_SEEDS.start() - 9), Some("p".into()));
    assert_eq!(trained(STUDY_SEEDS.start() - 10), None);
    assert_eq!(trained(*STUDY_SEEDS.end()), Some("p".into()));
    assert_eq!(trained(STUDY_SEEDS.end() + 1), None);
}

/// The table whose seeds are among those of the study.
fn trained_on_the_study(training: &str) -> Option<String> {
    let tables: toml::Table = training.parse().expect("a TOML file");
    let is_trained = |(name, table): &(&String, &toml::Value)| {
        let seed = |key| table.get(key)?.as_integer()?.try_into().ok();
        let seeds: Option<(u64, u64)> = seed("first_seed").zip(seed("last_seed"));
        name.as_str() != "test"
            && seeds.is_some_and(|(first, last)| {
                first <= *STUDY_SEEDS.end() && last >= *STUDY_SEEDS.start()
            })
    };
    let table = tables.iter().find(is_trained);
    table.map(|(name, _)| name.clone())
}
