//! Text from outside is a type that cannot be printed, and few files may take the text out of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr as _;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Where `GuestText::raw` and `GuestStr::raw` may be called, and for what. A file that is added here
/// escapes, stores or compares text, and prints none.
const MAY_CALL_RAW: &[(&str, &str)] = &[
    (
        "host/core/src/guest_text/owned.rs",
        "adds one text to another",
    ),
    ("host/core/src/journal.rs", "keeps all texts in one buffer"),
    ("host/core/src/record/transcript.rs", "encodes"),
    ("host/core/src/replay/parts.rs", "computes a digest"),
    (
        "host/engine/src/admission/rejection.rs",
        "makes one text of another",
    ),
    (
        "host/engine/src/runtime/backtrace.rs",
        "compares names with those of runtimes",
    ),
    ("host/src/cli/grade/outputs.rs", "makes names of folders"),
    ("host/src/cli/keep.rs", "makes names of files"),
    (
        "host/src/cli/resolve.rs",
        "compares names with those of files, and parses those of generated mazes",
    ),
    ("host/src/cli/tui/lines.rs", "breaks lines and escapes them"),
    (
        "host/src/contest/commitment.rs",
        "computes a digest, and parses names of generated mazes",
    ),
    (
        "host/src/report/picture/label.rs",
        "replaces harmful characters",
    ),
    ("host/src/report/picture/svg.rs", "escapes for XML"),
    ("host/src/store/columns.rs", "writes to the database"),
    ("host/src/store/content.rs", "computes a digest"),
];

/// The crates that have such text.
const CRATES: [&str; 4] = [
    "host/core/src",
    "host/engine/src",
    "host/src",
    "host/web/core/src",
];

#[test]
fn few_files_take_text_out_of_its_type() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found: BTreeSet<String> = BTreeSet::new();
    let mut files_seen = 0;
    for folder in CRATES {
        let mut files = BTreeMap::new();
        read(&root.join(folder), &mut files);
        files_seen += files.len();
        let code: BTreeMap<&PathBuf, Code> = files
            .iter()
            .map(|(path, text)| (path, code(text)))
            .collect();
        let tests = code.iter().flat_map(|(path, it)| it.test_modules(path));
        let tests: Vec<PathBuf> = tests.collect();
        let is_test = |path: &Path| {
            let stem = path.with_extension("");
            tests.iter().any(|it| stem.starts_with(it))
        };
        for (path, code) in &code {
            if code.calls_raw && !is_test(path) {
                let path = path.strip_prefix(&root).expect("it is below the root");
                found.insert(path.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    assert!(files_seen > 300, "{files_seen} files were seen");
    let expected: BTreeSet<String> = MAY_CALL_RAW
        .iter()
        .map(|(file, _)| (*file).to_owned())
        .collect();
    let added: Vec<_> = found.difference(&expected).collect();
    assert!(
        added.is_empty(),
        "these files take text out of its type; print it with `escaped()`, or add them to the list \
         with the reason: {added:?}"
    );
    let gone: Vec<_> = expected.difference(&found).collect();
    assert!(gone.is_empty(), "these files no longer call it: {gone:?}");
}

fn read(folder: &Path, files: &mut BTreeMap<PathBuf, String>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            read(&path, files);
        } else if path.extension().is_some_and(|it| it == "rs") {
            let text = fs::read_to_string(&path).expect("a source file");
            files.insert(path, text);
        }
    }
}

/// What a file has outside of its tests.
#[derive(Debug, Default, PartialEq, Eq)]
struct Code {
    calls_raw: bool,
    /// Modules in other files that exist in tests or for a fuzzer only.
    test_modules: Vec<String>,
}

impl Code {
    /// The paths of those modules, without the ending.
    fn test_modules(&self, file: &Path) -> Vec<PathBuf> {
        let name = file.file_stem().expect("a file");
        let folder = file.parent().expect("a folder");
        let folder = match name.to_str() {
            Some("lib" | "main" | "mod") => folder.to_owned(),
            _ => folder.join(name),
        };
        let modules = self.test_modules.iter();
        modules.map(|it| folder.join(it)).collect()
    }
}

fn code(text: &str) -> Code {
    let tokens = TokenStream::from_str(text).expect("Rust");
    let mut code = Code::default();
    walk(tokens, &mut code);
    code
}

fn walk(tokens: TokenStream, code: &mut Code) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        at += 1;
        match token {
            TokenTree::Punct(sign) if sign.as_char() == '#' && is_test(tokens.get(at)) => {
                let length = item_length(&tokens[at..]);
                let item = &tokens[at..at + length];
                code.test_modules.extend(module_elsewhere(item));
                at += length;
            }
            // A method, or the path of one.
            TokenTree::Punct(sign) if matches!(sign.as_char(), '.' | ':') => {
                let next = tokens.get(at);
                code.calls_raw |= next.is_some_and(|it| it.to_string() == "raw");
            }
            TokenTree::Group(group) => walk(group.stream(), code),
            _ => {}
        }
    }
}

/// Whether this is what follows the `#` of an attribute that leaves an item to tests or fuzzers.
fn is_test(token: Option<&TokenTree>) -> bool {
    let text = token.map_or(String::new(), ToString::to_string);
    let text = text.replace(char::is_whitespace, "");
    let only = ["[cfg(test)]", "[cfg(fuzzing)]", "[cfg(any(test,fuzzing))]"];
    only.contains(&text.as_str()) || text.starts_with("[cfg(all(test,")
}

/// The tokens up to the end of an item.
fn item_length(tokens: &[TokenTree]) -> usize {
    let is_end = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        TokenTree::Punct(sign) => sign.as_char() == ';',
        _ => false,
    };
    let end = tokens.iter().position(is_end);
    end.map_or(tokens.len(), |it| it + 1)
}

/// The name in `mod name;`.
fn module_elsewhere(item: &[TokenTree]) -> Option<String> {
    let texts: Vec<String> = item.iter().map(ToString::to_string).collect();
    match &texts[..] {
        [.., word, name, end] if word == "mod" && end == ";" => Some(name.clone()),
        _ => None,
    }
}

#[test]
fn calls_are_found_wherever_they_are() {
    #[track_caller]
    fn check(text: &str, calls_raw: bool, test_modules: &[&str]) {
        let test_modules = test_modules.iter().map(|it| (*it).to_owned()).collect();
        let expected = Code {
            calls_raw,
            test_modules,
        };
        assert_eq!(code(text), expected, "{text}");
    }
    check("fn f() { name.raw(); }", true, &[]);
    check("fn f() { println!(\"{}\", name . raw()); }", true, &[]);
    check("fn f() { names.map(GuestStr::raw) }", true, &[]);
    check("fn f(raw: u8) { raw + 1; it.raws() }", false, &[]);
    check("// name.raw()\n/// `name.raw()`\nfn f() {}", false, &[]);
    check("#[cfg(test)] mod tests { fn f() { a.raw() } }", false, &[]);
    check(
        "#[cfg(test)] pub mod tests; #[cfg(all(test, unix))] mod more; fn f() { a.raw() }",
        true,
        &["tests", "more"],
    );
    check(
        "impl A { #[cfg(test)] fn f(&self) { a.raw() } fn g() {} }",
        false,
        &[],
    );
}
