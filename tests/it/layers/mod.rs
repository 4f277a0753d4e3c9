//! Imports point one way: between the crates and inside every folder.
//!
//! [`tree`] says what is seen of a file; `layers.toml` has the lists. The rules:
//!
//! - A crate depends on nothing but the `dependencies` of its list.
//! - The top level of a crate has an `order`: each part may import those before it.
//! - In every other folder, the imports between its files and folders (a folder
//!   counts as one) have no cycle.
//! - A file imports nothing that is defined in a file above it: `lib.rs`, `mod.rs`,
//!   or `a.rs` for `a/b.rs`.
//! - A file above others has only modules, imports and constants, unless it is one
//!   of the `callers` of those below.
//! - Code is pure, so it uses nothing of `outside`, unless its part of the top level
//!   is `impure`.

mod checks;
mod tree;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::Path;
use std::{fs, io};

use serde::Deserialize;

use tree::{Files, Target, Tree};

/// The contents of `layers.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    outside: Vec<String>,
    crates: Vec<CrateRules>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct CrateRules {
    /// The folder of its `Cargo.toml`, from the top of the repository.
    folder: String,
    /// Absent: any.
    dependencies: Option<Vec<String>>,
    /// Absent: any order without a cycle.
    order: Option<Vec<String>>,
    impure: Vec<String>,
    callers: Vec<String>,
    /// What pure code of this crate does not use either.
    outside: Vec<String>,
    /// A check that sees less than this is broken.
    files_min: usize,
    imports_min: usize,
}

/// What matters in a `Cargo.toml`, or in its table for a platform.
#[derive(Deserialize)]
struct Manifest {
    #[serde(default)]
    dependencies: BTreeMap<String, toml::Value>,
    #[serde(default)]
    target: BTreeMap<String, Manifest>,
}

/// The parts of a folder, what each imports, and where.
type Graph = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

#[test]
fn imports_point_one_way() {
    let rules: Rules = toml::from_str(include_str!("layers.toml")).expect("rules");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let problems = rules.problems(&root);
    assert!(problems.is_empty(), "\n{}", problems.join("\n"));
}

impl Rules {
    /// What breaks the rules in a repository.
    pub fn problems(&self, root: &Path) -> Vec<String> {
        let mut problems = Vec::new();
        for rules in &self.crates {
            let folder = root.join(&rules.folder);
            let mut files = Files::new();
            let manifest = fs::read_to_string(folder.join("Cargo.toml"));
            let read = read_files(&folder.join("src"), "", &mut files).and(manifest);
            let found = match read {
                Ok(manifest) => rules.problems(&manifest, &files, &self.outside),
                Err(error) => BTreeSet::from([error.to_string()]),
            };
            problems.extend(found.iter().map(|it| format!("{}: {it}", rules.folder)));
        }
        problems
    }
}

impl CrateRules {
    fn problems(&self, manifest: &str, files: &Files, outside: &[String]) -> BTreeSet<String> {
        let tree = Tree::read(files);
        let mut problems: BTreeSet<String> = tree.problems.iter().cloned().collect();
        problems.extend(self.unknown_dependencies(manifest));
        problems.extend(self.misplaced_code(&tree));

        let mut graphs: BTreeMap<&[String], Graph> = BTreeMap::new();
        let mut imports_inside = 0;
        for (module, written, target) in tree.imports() {
            let is_glob = written.is_glob();
            let from = &module.place;
            let place = format!("{}:{}", module.file, written.line);
            let (to, name) = match &target {
                Target::Module(to) => (&tree.modules[*to].place, is_glob.then_some("*")),
                Target::Item(to, name) => (&tree.modules[*to].place, Some(name.as_str())),
                Target::Outside(path) => {
                    let is_impure = from.first().is_some_and(|part| self.impure.contains(part));
                    let mut outside = self.outside.iter().chain(outside);
                    if !is_impure && outside.any(|it| leads_to(path, is_glob, it)) {
                        problems.insert(format!("{place} uses {path}"));
                    }
                    continue;
                }
            };
            let what = name.map_or(String::new(), |name| format!("{name} of "));
            let to_module = ["crate", &to.join("::")].join("::");
            let shown = format!("{place} imports {what}{}", to_module.trim_end_matches("::"));
            imports_inside += usize::from(from != to);
            let shared = from.iter().zip(to).take_while(|(a, b)| a == b).count();
            match (from.get(shared), to.get(shared)) {
                (Some(part), Some(other)) if shared == 0 && self.rank(part) < self.rank(other) => {
                    problems.insert(format!("{shown}: upward, {part} -> {other}"));
                }
                (Some(part), Some(other)) => {
                    let graph = graphs.entry(&from[..shared]).or_default();
                    let imports = graph.entry(part.clone()).or_default();
                    imports.entry(other.clone()).or_default().insert(shown);
                }
                (Some(_), None) if name.is_some() => {
                    problems.insert(format!("{shown}: upward"));
                }
                _ => {}
            }
        }
        problems.extend(graphs.values().flat_map(cycles));
        let files_read: BTreeSet<&str> = tree.modules.iter().map(|it| it.file.as_str()).collect();
        if files_read.len() < self.files_min || imports_inside < self.imports_min {
            let files = files_read.len();
            problems.insert(format!("only {files} files and {imports_inside} imports"));
        }
        problems
    }

    fn rank(&self, part: &str) -> Option<usize> {
        self.order.iter().flatten().position(|it| it == part)
    }

    fn unknown_dependencies(&self, manifest: &str) -> Vec<String> {
        let manifest: Manifest = match toml::from_str(manifest) {
            Ok(manifest) => manifest,
            Err(error) => return vec![format!("Cargo.toml: {error}")],
        };
        // What only a fuzzer builds is no part of the crate.
        let targets = manifest.target.iter();
        let targets = targets.filter(|(target, _)| *target != "cfg(fuzzing)");
        let tables = targets.map(|(_, table)| table).chain([&manifest]);
        let names = tables.flat_map(|table| table.dependencies.keys());
        let is_known = |name: &String| {
            self.dependencies
                .as_ref()
                .is_none_or(|it| it.contains(name))
        };
        let unknown = names.filter(|name| !is_known(name));
        unknown
            .map(|name| format!("Cargo.toml: depends on {name}"))
            .collect()
    }

    /// Parts that are missing in the order or too many, and code above other files.
    fn misplaced_code(&self, tree: &Tree) -> Vec<String> {
        let mut problems = Vec::new();
        let parts: BTreeSet<&String> = tree.modules[0].children.keys().collect();
        let order: BTreeSet<&String> = self.order.iter().flatten().collect();
        if self.order.is_some() && order != parts {
            problems.push(format!("lib.rs has {parts:?}, the order is {order:?}"));
        }
        for module in &tree.modules {
            let mut children = module.children.values().map(|it| &tree.modules[*it].place);
            let items = module.items.iter();
            let code = items.filter(|(_, is_constant)| !**is_constant);
            let code: Vec<&str> = code.map(|(name, _)| name.as_str()).collect();
            let is_caller = self.callers.contains(&module.place.join("::"));
            if children.any(|it| *it != module.place) && !is_caller && !code.is_empty() {
                problems.push(format!("{} defines {}", module.file, code.join(", ")));
            }
        }
        problems
    }
}

/// Whether a path is one that leads outside or begins with it, or imports all of a
/// module with such a path.
fn leads_to(path: &str, is_glob: bool, outside: &str) -> bool {
    let begins = |path: &str, start: &str| format!("{path}::").starts_with(&format!("{start}::"));
    let is_macro = outside.ends_with('!') && path.rsplit("::").next() == Some(outside);
    is_macro || begins(path, outside) || (is_glob && begins(outside, path))
}

/// An import for every pair of parts on a cycle, with the shortest cycle.
fn cycles(graph: &Graph) -> Vec<String> {
    let mut cycles = Vec::new();
    for (part, imports) in graph {
        for (other, places) in imports {
            if let Some(back) = shortest_path(graph, other, part) {
                let first = places.first().map_or("", |it| it);
                let more = match places.len() {
                    1 => String::new(),
                    count => format!(" (and {} more)", count - 1),
                };
                let back = back.join(" -> ");
                cycles.push(format!("{first}{more}: cycle {part} -> {back}"));
            }
        }
    }
    cycles
}

fn shortest_path<'a>(graph: &'a Graph, from: &'a str, to: &str) -> Option<Vec<&'a str>> {
    let mut seen = BTreeSet::from([from]);
    let mut paths = VecDeque::from([vec![from]]);
    while let Some(path) = paths.pop_front() {
        let last = path.last().copied()?;
        if last == to {
            return Some(path);
        }
        for next in graph.get(last).into_iter().flat_map(BTreeMap::keys) {
            if seen.insert(next) {
                paths.push_back([&path[..], &[next]].concat());
            }
        }
    }
    None
}

fn read_files(folder: &Path, above: &str, files: &mut Files) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            read_files(&path, &format!("{above}{name}/"), files)?;
        } else if name.ends_with(".rs") {
            files.insert(format!("{above}{name}"), fs::read_to_string(&path)?);
        }
    }
    Ok(())
}
