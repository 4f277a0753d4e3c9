//! The WIT changes only together with its history and the SDK's bindings.

use std::fs;

use wasmouse_engine::admission::INTERFACE_VERSION;
use wasmouse_tests::bindings;

/// One row of the history in `wit/README.md`.
struct Row {
    version: String,
    sha256: String,
}

fn read(path: &str) -> String {
    let path = xtask::repository().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn history() -> Vec<Row> {
    read("wit/README.md")
        .lines()
        .filter_map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let [version, _date, _change, sha256] = cells[..] else {
                return None;
            };
            let sha256 = sha256.trim_matches('`');
            (sha256.len() == 64).then(|| Row {
                version: version.to_owned(),
                sha256: sha256.to_owned(),
            })
        })
        .collect()
}

#[test]
fn the_history_ends_with_the_file_as_it_is() {
    let sha256 = xtask::sources::sha256(read("wit/robot.wit").as_bytes());
    let last = history().pop().expect("the history has rows");
    assert_eq!(
        last.sha256, sha256,
        "wit/robot.wit has changed: add a row to the history in wit/README.md, \
         which lists what else must change with it"
    );
}

#[test]
fn the_last_version_is_that_of_the_package() {
    let last = history().pop().expect("the history has rows");
    let package = format!("package wasmouse:robot@{};", last.version);
    assert!(
        read("wit/robot.wit").contains(&package),
        "no line `{package}`"
    );
    assert_eq!(INTERFACE_VERSION, last.version);
}

#[test]
fn the_bindings_of_the_sdk_are_those_of_the_wit() {
    let generated = bindings::generate(&read("wit/robot.wit")).expect("a valid WIT package");
    assert!(
        generated == read(bindings::FILE),
        "{} is not what the generator writes: run `{}` and commit the result",
        bindings::FILE,
        bindings::COMMAND
    );
}
