//! The toolkits say about the interface what `wit/robot.wit` says: editors show it.

use std::fs;

/// For each language, the files that have the interface.
const INTERFACES: [(&str, &[&str]); 4] = [
    (
        "go",
        &[
            "wasmouse/interface.go",
            "wasmouse/journal.go",
            "wasmouse/map.go",
        ],
    ),
    (
        "javascript",
        &["src/wasmouse/interface.d.ts", "src/wasmouse/journal.d.ts"],
    ),
    ("python", &["wasmouse/interface.py", "wasmouse/journal.py"]),
    (
        "typescript",
        &["src/wasmouse/interface.ts", "src/wasmouse/journal.ts"],
    ),
];

/// What the toolkits leave to exceptions, errors and panics.
const LEFT_OUT: &str = "Reports an error from which the robot cannot recover";

#[test]
fn toolkits_document_the_interface() {
    let root = xtask::repository();
    let wit = fs::read_to_string(root.join("wit/robot.wit")).expect("the WIT");
    let sentences = sentences(&wit);
    assert!(sentences.len() > 50, "{sentences:?}");
    for (language, files) in INTERFACES {
        let folder = root.join("example-robots/languages").join(language);
        let read = |file: &&str| fs::read_to_string(folder.join(file)).expect("a file");
        let text = plain(&files.iter().map(read).collect::<String>());
        for sentence in &sentences {
            let wanted = plain(sentence);
            assert!(text.contains(&wanted), "{language} lacks: {sentence}");
        }
    }
}

/// The first sentence of the documentation of each item in the interfaces `types` and `journal`.
/// A sentence of one word, such as the name of a colour, says nothing.
fn sentences(wit: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    let mut paragraph = String::new();
    let mut is_shared = false;
    for line in wit.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("///") {
            paragraph = format!("{paragraph} {}", text.trim());
            continue;
        }
        if let Some(interface) = line.strip_prefix("interface ") {
            is_shared = !interface.starts_with("controller");
            // What an interface is, is about the WIT.
            paragraph.clear();
        }
        // A gate stands between the text and its item.
        if line.starts_with("@since") {
            continue;
        }
        let documented = std::mem::take(&mut paragraph);
        let sentence = documented.split(". ").next().unwrap_or_default();
        let sentence = sentence.trim().trim_end_matches('.').to_owned();
        let is_world = line.starts_with("package") || line.starts_with("world");
        let is_wanted = sentence.contains(' ') && !sentence.starts_with(LEFT_OUT);
        if is_shared && is_wanted && !is_world {
            sentences.push(sentence);
        }
    }
    sentences
}

/// Without the marks of comments and the breaks of lines, in lowercase: in Go, a sentence begins
/// with a name.
fn plain(text: &str) -> String {
    let words = text
        .split_whitespace()
        .filter(|word| !matches!(*word, "*" | "//" | "/**" | "*/" | "#" | "-"));
    let words: Vec<&str> = words.collect();
    words.join(" ").to_lowercase()
}
