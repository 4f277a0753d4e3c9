//! The same contest gives the same bytes: twice, on one thread or many, with
//! robots compiled now or taken from the cache.

use std::path::{Path, PathBuf};

use wasmouse::contest::Results;
use wasmouse_core::maze;
use wasmouse_engine::bundled::bundled;

use crate::binary::{stdout_of, wasmouse};
use crate::shared::shared;

/// Every bundled robot, with each of its variants.
fn robots() -> Vec<String> {
    let specifications = bundled().iter().flat_map(|robot| {
        let variants = robot.variants.iter();
        let chosen = variants.map(|variant| format!("{}:{}", robot.name, variant.value));
        let plain = robot.variants.is_empty().then(|| robot.name.to_owned());
        plain.into_iter().chain(chosen)
    });
    specifications.collect()
}

fn run_json(mazes: &[PathBuf], options: &[&str], cache: Option<&Path>) -> String {
    let mut command = wasmouse();
    command.args(["run", "--json"]).args(robots()).args(options);
    for maze in mazes {
        command.arg("--maze").arg(maze);
    }
    match cache {
        Some(folder) => command.arg("--cache").arg(folder),
        None => command.arg("--no-cache"),
    };
    stdout_of(&mut command)
}

#[test]
fn a_contest_gives_the_same_bytes_however_it_is_run() {
    let mazes = maze::bundled().iter().map(|maze| maze.name.into());
    check(&mazes.collect::<Vec<PathBuf>>());
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn so_does_a_contest_in_official_mazes() {
    let folder = shared().join("mazes/udacity");
    check(&["test_maze_02.txt", "test_maze_03.txt"].map(|name| folder.join(name)));
}

fn check(mazes: &[PathBuf]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = folder.path().join("cache");
    let expected = run_json(mazes, &["--jobs", "1"], None);
    for (name, jobs, cache) in [
        ("a second time", "1", None),
        ("8 threads", "8", None),
        ("8 threads, cold cache", "8", Some(cache.as_path())),
        ("8 threads, warm cache", "8", Some(&cache)),
        ("1 thread, warm cache", "1", Some(&cache)),
    ] {
        let found = run_json(mazes, &["--jobs", jobs], cache);
        assert!(found == expected, "{name}: other bytes");
    }
    assert!(cache.read_dir().expect("a cache").count() >= bundled().len());

    let results: Results = serde_json::from_str(&expected).expect("a results document");
    assert_eq!(results.matches.len(), mazes.len() * robots().len());
    for record in &results.matches {
        assert!(record.fuel.steps > 0, "{record:?}");
    }
}
