//! Web pages with a player: the prebuilt one is current, pages are small, and nothing hidden is in
//! them. What a browser sees is tested in `host/web/tests`.

use std::fs;
use std::path::Path;

use serde_json::Value;
use xtask::{repository, web};

use crate::binary::{stdout_of, wasmouse};

/// Five robots in 200 mazes of 16 x 16 cells, all of which can be watched.
const LARGE: &str = "
version = 1
name = \"large\"
[[robots]]
bundled = \"flood\"
[[robots]]
bundled = \"champion\"
[[robots]]
bundled = \"minnett\"
[[robots]]
bundled = \"count-expansion\"
[[robots]]
bundled = \"dfs\"
[[mazes]]
set = \"all\"
paths = [\"gen:braid:16:1..=200\"]
[run]
keep_transcripts = \"all\"
[outputs]
html = \"out.html\"
";

/// The same in small, with something to hide.
const CENSORED: &str = "
version = 1
name = \"censored\"
[[robots]]
bundled = \"flood\"
[[robots]]
bundled = \"dfs\"
[[mazes]]
set = \"public\"
paths = [\"gen:tree:12:1..=3\"]
[[mazes]]
set = \"final\"
hidden = true
paths = [\"gen:tree:14:1..=3\"]
[run]
keep_transcripts = \"all\"
[report]
hide_names = true
[outputs]
html = \"out.html\"
";

#[test]
fn the_player_is_current() {
    let problems = web::problems(&repository()).expect("the manifest and the sources");
    assert!(
        problems.is_empty(),
        "run `cargo xtask web` and commit the result:\n{}",
        problems.join("\n")
    );
}

#[test]
fn a_page_of_one_match_is_small() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let page = folder.path().join("one.html");
    let run = ["run", "champion", "test_maze_01", "--no-cache", "--html"];
    stdout_of(wasmouse().args(run).arg(&page));
    let page = fs::read_to_string(page).expect("a page");
    assert_eq!(index(&page)["matches"].as_array().map(Vec::len), Some(1));
    assert!(page.len() < 400_000, "{} bytes", page.len());
}

#[test]
fn a_page_of_a_thousand_matches_is_small() {
    let page = contest(LARGE);
    let index = index(&page);
    assert_eq!(index["version"], 1);
    assert_eq!(index["matches"].as_array().map(Vec::len), Some(1000));
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
    // Every cell of the matrix, every line of the standings, and every picture leads to its match.
    assert!(page.matches("data-play").count() > 1000 + 5 + 5);
}

#[test]
fn a_page_has_no_hidden_match() {
    let page = contest(CENSORED);
    let index = index(&page);
    let texts = |key: &str| -> Vec<&str> {
        let list = index[key].as_array().expect("a list");
        list.iter().filter_map(Value::as_str).collect()
    };
    assert_eq!(index["matches"].as_array().map(Vec::len), Some(2 * 3));
    assert_eq!(index["mazes"].as_array().map(Vec::len), Some(3));
    let is_alias = |name: &str| name.len() == 8 && name.chars().all(|it| it.is_ascii_hexdigit());
    assert!(texts("robots").into_iter().all(is_alias), "{index}");
    assert!(!page.contains("gen:tree,loops=12:14"), "a hidden maze");
}

/// Plays a contest and returns its page.
fn contest(file: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text);
    write("contest.toml", file).expect("a file");
    let contest = Path::new("contest.toml");
    let run = ["contest", "run", "--no-cache"];
    stdout_of(wasmouse().args(run).arg(contest).current_dir(folder.path()));
    fs::read_to_string(folder.path().join("out.html")).expect("a page")
}

/// The index of a page's matches.
fn index(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"wasmouse-index\">").expect("an index");
    let (index, _) = rest.split_once('<').expect("the end of the element");
    serde_json::from_str(index).expect("JSON")
}
