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
        "## Competition mazes\n",
        "**Absent when this page was written.** `--competition FOLDER`",
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
    fs::create_dir(folder.join("empty")).expect("a folder");
    fs::create_dir(folder.join("broken")).expect("a folder");
    fs::write(folder.join("broken/a.txt"), "no maze").expect("a file");
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
            &["flood", "--competition", "nowhere"],
            3,
            "failed to read mazes from `nowhere`: not a folder",
        ),
        (&["flood", "--competition", "empty"], 3, "has no mazes"),
        (
            &["flood", "--competition", "broken"],
            3,
            "failed to parse maze `./broken/a.txt`",
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

/// Two mazes with one entrance, one of which the wall follower loses, one with
/// several, and one whose goal cannot be reached.
#[test]
fn competition_mazes_are_told_apart_by_their_entrances() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::create_dir(folder.join("contests")).expect("a folder");
    let one = include_str!("../../host/mazes/division-14.txt");
    let open = "4\n3,7,7,6\n11,15,15,14\n11,15,15,14\n9,13,13,12";
    let closed = "4\n0,3,7,6\n3,15,15,14\n11,15,15,14\n9,13,13,12";
    let official = include_str!("../../host/mazes/test_maze_01.txt");
    for (name, text) in [
        ("one.txt", one),
        ("two.txt", official),
        ("open.txt", open),
        ("closed.txt", closed),
        ("README.md", "no maze"),
    ] {
        fs::write(folder.join("contests").join(name), text).expect("a file");
    }
    let robots = ["flood:certain", "wall-follower:left"];
    let arguments = ["-o", "page.md", "--competition", "contests"];
    check_code(&study(folder, &[&robots[..], &arguments].concat()), 0);
    let page = fs::read_to_string(folder.join("page.md")).expect("a page");
    for part in [
        "\nwasmouse study flood:certain wall-follower:left --competition FOLDER --quick\n",
        "\n1 more were left out because their goal cannot be reached.\n",
        "### Competition mazes with one entrance: 2 mazes\n",
        "| `flood:certain` | 2 of 2 | 100.00 % |",
        "### Competition mazes with several entrances: 1 mazes\n",
        "| `flood:certain` | 1 of 1 | 100.00 % |",
        "Not finished:\n",
        "| `wall-follower:left` | `one`, `two`",
        "| of competitions, several entrances | `",
    ] {
        assert!(page.contains(part), "no `{part}` in\n{page}");
    }
}

#[test]
fn mazes_are_found_in_folders_or_in_the_shared_material() {
    let Some(shared) = shared() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let [mazes, contests] = ["mazes/udacity", "mazes/competition"].map(|name| {
        let path = shared.join(name).canonicalize().expect("a folder");
        path.to_str().expect("UTF-8").to_owned()
    });
    let arguments = [
        "flood:certain",
        "-o",
        "page.md",
        "--official",
        &mazes,
        "--competition",
        &contests,
    ];
    check_code(&study(folder, &arguments), 0);
    let page = fs::read_to_string(folder.join("page.md")).expect("a page");
    let row = "| `flood:certain` | 21.867 (146 + 17) | 28.433 (193 + 22) | 34.367 (281 + 25) \
               | 84.667 |\n";
    assert!(page.contains(row), "{page}");
    assert!(!page.contains(&mazes) && !page.contains(&contests));
    // All but the four of each kind that a quick study plays are left out.
    assert!(page.contains("with several entrances: 4 mazes\n"), "{page}");

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
