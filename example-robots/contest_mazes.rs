//! The official mazes for the robots' unit tests.
//!
//! Included by each robot with `#[path]`, so that a robot depends on nothing but
//! the SDK. Only maze 01 is part of this repository; the others are read from
//! `$WASMOUSE_SHARED` or from `../shared` beside the repository, where present.

use std::path::PathBuf;

/// The mazes that are here, with their numbers; says which ones it skips.
pub fn contest_mazes() -> Vec<(u8, String)> {
    let mut mazes = vec![(1, wasmouse_sdk::testing::MAZE_01.to_owned())];
    for number in [2, 3] {
        let path = shared().join(format!("mazes/udacity/test_maze_{number:02}.txt"));
        match std::fs::read_to_string(&path) {
            Ok(text) => mazes.push((number, text)),
            Err(error) => println!("skipped: maze {number:02}: {}: {error}", path.display()),
        }
    }
    mazes
}

fn shared() -> PathBuf {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    std::env::var_os("WASMOUSE_SHARED").map_or_else(|| beside.into(), PathBuf::from)
}
