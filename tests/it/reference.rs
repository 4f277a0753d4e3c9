//! `cargo xtask reference`: its page has the right numbers, and wrong mazes are errors.

use std::fs;
use std::path::Path;
use std::process::Command;

use xtask::repository;

use crate::binary::{self, Ran, ran};
use crate::shared::shared;

/// A quick run that writes `page.md` in a folder.
fn reference(folder: &Path) -> Command {
    let name = format!("reference{}", std::env::consts::EXE_SUFFIX);
    let mut command = Command::new(binary::path().with_file_name(name));
    command
        .args(["--quick", "-o", "page.md"])
        .current_dir(folder)
        .env_remove("WASMOUSE_SHARED");
    command
}

fn page(folder: &Path, command: &mut Command) -> (String, String) {
    let Ran { status, stderr, .. } = ran(command);
    assert!(status.success(), "{stderr}");
    let page = fs::read_to_string(folder.join("page.md")).expect("a page");
    (page, stderr)
}

#[track_caller]
fn check(page: &str, parts: &[&str]) {
    for part in parts {
        assert!(page.contains(part), "no `{part}` in\n{page}");
    }
    assert!(!page.contains('{'), "a placeholder is left in\n{page}");
}

/// Scores of the reports, and totals that were computed by an earlier version.
#[test]
fn the_page_has_the_results_of_the_robots() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let robots = [
        "flood:certain",
        "minnett:final",
        "random",
        "count-expansion",
    ];
    let (page, stderr) = page(folder.path(), reference(folder.path()).args(robots));
    check(
        &page,
        &[
            "| `flood:certain` | 21.867 (146 + 17) | - | - | - |\n",
            "| `minnett:final` | 20.667 (110 + 17) | - | - | - |\n",
            "| best by others | 19.033 | 27.667 | 32.600 | 79.300 |\n",
            "| **oracle score** | 17.600 (18 + 17) | - | - | - |\n",
            "| 44.100 / 45.200 (+2.5 %) | - | - |\n",
            "| 20.667 / 20.667 (+0.0 %) | - | - |\n",
            "| finished | 1 of 6 | 23 of 60 (38.33 %) |\n",
            "| 420 of 483 (86.96 %) | 18 of 20 (90.00 %) | 16 of 19 (84.21 %) |\n",
            "| `flood:certain` | 80 of 80 | 100.00 % | 18.869 | 3.413 (3.413 + 0.000) | 1.783 |",
            "| `flood:certain` | 82.50 %, +1.336 | 95.00 %, +4.856 |",
            "| `random` | 28 of 80 | 0.00 % | 248.133 | 235.331 (7.867 + 227.464) |",
            "| `gen:braid:12..=20:500001..=500004` |",
            "Not played.\n\n## What was played\n",
        ],
    );
    check(&stderr, &["without --official DIR or $WASMOUSE_SHARED"]);
}

#[test]
fn wrong_mazes_and_names_are_errors() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for name in ["other", "empty", "broken"] {
        fs::create_dir(folder.join(name)).expect("a folder");
    }
    let other = include_str!("../../host/core/mazes/division-14.txt");
    fs::write(folder.join("other/test_maze_02.txt"), other).expect("a maze");
    fs::write(folder.join("other/test_maze_03.txt"), other).expect("a maze");
    fs::write(folder.join("broken/a.txt"), "no maze").expect("a file");
    for (arguments, expected) in [
        (["--official", "nowhere"], "`nowhere/test_maze_02.txt`"),
        (
            ["--official", "other"],
            "`test_maze_02` is not the official maze",
        ),
        (["--competition", "nowhere"], "failed to read `nowhere`"),
        (
            ["--competition", "empty"],
            "failed to read `empty`: no mazes",
        ),
        (["--competition", "broken"], "failed to read `broken/a.txt`"),
        (["flood", "flod"], "no bundled robot is called `flod`"),
    ] {
        let Ran { status, stderr, .. } = ran(reference(folder).args(arguments));
        assert_eq!(status.code(), Some(1), "{arguments:?}: {stderr}");
        assert!(stderr.contains(expected), "{arguments:?}: {stderr}");
    }
    assert!(!folder.join("page.md").exists());
}

/// Two mazes with one entrance, which the wall follower does not finish, one with several, and
/// one whose goal cannot be reached.
#[test]
fn competition_mazes_are_listed_by_entrances() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mazes = folder.path().join("mazes");
    fs::create_dir(&mazes).expect("a folder");
    for (name, text) in [
        (
            "one.txt",
            include_str!("../../host/core/mazes/division-14.txt"),
        ),
        (
            "two.txt",
            include_str!("../../host/core/mazes/test_maze_01.txt"),
        ),
        (
            "open.txt",
            "4\n3,7,7,6\n11,15,15,14\n11,15,15,14\n9,13,13,12",
        ),
        (
            "closed.txt",
            "4\n0,3,7,6\n3,15,15,14\n11,15,15,14\n9,13,13,12",
        ),
        ("README.md", "no maze"),
    ] {
        fs::write(mazes.join(name), text).expect("a file");
    }
    let mut command = reference(folder.path());
    let arguments = [
        "flood:certain",
        "wall-follower:left",
        "--competition",
        "mazes",
    ];
    let (page, _) = page(folder.path(), command.args(arguments));
    check(
        &page,
        &[
            "Excluded because their goal is unreachable: 1.\n",
            "### Competition mazes with one entrance (2)\n",
            "### Competition mazes with several entrances (1)\n",
            "| `flood:certain` | 2 of 2 | 100.00 % |",
            "| `flood:certain` | 1 of 1 | 100.00 % |",
            "| `wall-follower:left` | `one`, `two`",
        ],
    );
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn all_official_mazes_are_compared() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut command = reference(folder.path());
    command.arg("rai:full").env(
        "WASMOUSE_SHARED",
        shared().canonicalize().expect("a folder"),
    );
    let (page, stderr) = page(folder.path(), &mut command);
    check(
        &page,
        &[
            "| `rai:full` | 29.733 (382 + 17) | 47.900 (657 + 26) | 52.867 (776 + 27) | 130.500 |\n",
            "| 22.667 / 29.733 (**+31.2 %**) | 37.333 / 47.900 (**+28.3 %**) |",
            "| **oracle score** | 17.600 (18 + 17) | 22.767 (23 + 22) | 25.867 (26 + 25) | 66.233 |\n",
            "### Competition mazes with several entrances (4)\n",
        ],
    );
    assert!(!stderr.contains("hint"), "{stderr}");
}

/// The page says that no robot was tuned on its mazes. A robot that is trained lists its seeds in
/// `training.toml`, in tables with `first_seed` and `last_seed`; the table `test` has those that
/// it was not trained on.
#[test]
fn no_robot_is_trained_on_the_mazes_of_the_page() {
    let page = include_str!("../../docs/REFERENCE.md");
    let reserved = 500_001..=500_100;
    for kind in ["division", "tree,loops=12", "braid", "stretches"] {
        check(
            page,
            &[&format!("| `gen:{kind}:12..=20:500001..=500100` |")],
        );
    }
    let mut trained = 0;
    for robot in fs::read_dir(repository().join("example-robots")).expect("a folder") {
        let file = robot.expect("an entry").path().join("training.toml");
        let Ok(text) = fs::read_to_string(&file) else {
            continue;
        };
        let tables: toml::Table = text.parse().expect("a TOML file");
        for (_, table) in tables.iter().filter(|(name, _)| *name != "test") {
            let seed = |key| table.get(key)?.as_integer();
            if let Some((first, last)) = seed("first_seed").zip(seed("last_seed")) {
                let overlaps = first <= *reserved.end() && last >= *reserved.start();
                assert!(!overlaps, "{}: {first} to {last}", file.display());
                trained += 1;
            }
        }
    }
    assert!(trained > 0, "no robot has a training.toml with seeds");
}
