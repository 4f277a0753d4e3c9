//! From what users write for a maze to mazes, the same in every command.
//!
//! An argument is resolved to [`Source`]s without reading any of them (`maze_source`). Then each source
//! is read, parsed and, unless the user says `--lenient`, checked against the contest rules.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::path::Path;
use std::sync::Arc;

use wasmouse_core::maze::generate::GeneratedMaze;
use wasmouse_core::maze::{Maze, violations};
use wasmouse_core::{Digest, GuestText};

use super::failure::Failure;
use super::maze_source::{Source, resolve};
use super::output::message;
use crate::contest::MazeSource;
use crate::report::text::text;

/// What a user may write for a maze, for the long help of every command.
pub const SPECIFICATION_HELP: &str = "\
A maze is one of, in this order:
  -              standard input
  gen:tree:16:7  a generated maze: gen:KIND:SIZE:SEED with the kind division,
                 tree (also tree,loops=PERCENT), braid or stretches; size and seed
                 may be ranges such as 12..=20 and 1..=100, for many mazes
  test_maze_01   the name of a bundled maze
  a.txt          a file in any format: udacity, competition, map, num,
                 blocks
  mazes          a folder: all its .txt, .map, .maz and .num files by name,
                 without subfolders and hidden files
Write ./NAME for a file or folder that is named like one of the others.";

/// Which mazes may pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legality {
    /// Only those that keep all contest rules.
    Contest,
    /// Every maze that parses: `--lenient`.
    Lenient,
}

impl Legality {
    /// What the flag `--lenient` asks for.
    pub const fn from_flag(lenient: bool) -> Self {
        if lenient {
            Self::Lenient
        } else {
            Self::Contest
        }
    }
}

/// What to do with a file in a folder that is not a maze, or not a legal one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BadFiles {
    /// Report it and skip it.
    Skip,
    /// Fail: `--strict`.
    Fail,
}

/// Reads the mazes that the arguments name, in their order. Generated mazes are left to be
/// generated when they are needed.
///
/// # Errors
///
/// With the first argument that names nothing, the first source that cannot be read or parsed,
/// or, for [`Legality::Contest`], the first maze that breaks contest rules. Files of a folder
/// are skipped instead, with a warning, unless `bad_files` says otherwise.
pub fn load(
    arguments: &[String],
    rules: Legality,
    bad_files: BadFiles,
) -> Result<Vec<MazeSource>, Failure> {
    let mut requests = Vec::new();
    for argument in arguments {
        let bad_files = if Path::new(argument).is_dir() {
            bad_files
        } else {
            BadFiles::Fail
        };
        requests.extend(resolve(argument)?.into_iter().map(|source| Request {
            source,
            rules,
            bad_files,
        }));
    }
    let stdins = requests.iter().filter(|it| it.source == Source::Stdin);
    if stdins.count() > 1 {
        return Err(Failure::usage("standard input is given as a maze twice"));
    }
    let mazes = load_requests(&requests, "--lenient accepts it")?;
    let mazes: Vec<MazeSource> = mazes.into_iter().flatten().collect();
    let skipped = requests.len() - mazes.len();
    if mazes.is_empty() {
        return Err(Failure::input("none of the mazes can be used")
            .hint("the warnings above say why; --lenient accepts mazes that break contest rules"));
    }
    if skipped > 0 {
        message!(
            "warning: skipped {} of {} mazes; --strict makes this an error",
            skipped,
            requests.len()
        );
    }
    Ok(mazes)
}

/// A maze to load.
pub struct Request {
    /// Where it is.
    pub source: Source,
    /// Whether it has to be legal.
    pub rules: Legality,
    /// What to do if it is no maze or not legal.
    pub bad_files: BadFiles,
}

/// Loads mazes; `None` stands for one that was skipped. Two of them never have the same name,
/// unless they are the same file. The hint says how to use a maze that is not legal.
///
/// # Errors
///
/// With the first one that cannot be used, unless it may be skipped.
pub fn load_requests(
    requests: &[Request],
    hint: &'static str,
) -> Result<Vec<Option<MazeSource>>, Failure> {
    let names = unique_names(requests.iter().map(|it| &it.source));
    let load = |(request, name): (&Request, GuestText)| {
        let loaded = load_one(&request.source, name, request.rules, hint);
        match loaded {
            Err(failure) if request.bad_files == BadFiles::Skip => {
                message!("warning: skipped a maze: {}", failure.message());
                Ok(None)
            }
            loaded => loaded.map(Some),
        }
    };
    requests.iter().zip(names).map(load).collect()
}

/// Reads a maze for a contest under that name.
fn load_one(
    source: &Source,
    name: GuestText,
    rules: Legality,
    hint: &'static str,
) -> Result<MazeSource, Failure> {
    // Generated mazes are legal by construction.
    if let Source::Generated(maze) = source {
        return Ok(MazeSource::Generated(*maze));
    }
    let (maze, _) = source.read()?;
    if rules == Legality::Contest {
        require_legal(source, &maze, hint)?;
    }
    let maze = Arc::new(maze);
    Ok(MazeSource::Loaded { name, maze })
}

/// The mazes without those that are given twice: their matches would be the same matches.
pub fn distinct(mazes: Vec<MazeSource>) -> Vec<MazeSource> {
    let mut seen = Seen::default();
    let is_new = |maze: &MazeSource| {
        let twin = seen.twin(maze);
        if let Some(twin) = &twin {
            message!(
                "warning: skipped `{}`, which is the same maze as `{}`",
                maze.name().escaped(),
                twin.escaped()
            );
        }
        twin.is_none()
    };
    let mut mazes = mazes;
    mazes.retain(is_new);
    mazes
}

/// The mazes of a contest by now.
#[derive(Default)]
struct Seen {
    loaded: HashMap<Digest, GuestText>,
    generated: HashSet<GeneratedMaze>,
}

impl Seen {
    /// The name under which the same maze was given before.
    fn twin(&mut self, maze: &MazeSource) -> Option<GuestText> {
        match maze {
            MazeSource::Loaded { name, maze } => match self.loaded.entry(maze.digest()) {
                Entry::Occupied(twin) => Some(twin.get().clone()),
                Entry::Vacant(place) => {
                    place.insert(name.clone());
                    None
                }
            },
            MazeSource::Generated(maze) => {
                let is_new = self.generated.insert(*maze);
                (!is_new).then(|| maze.to_string().into())
            }
        }
    }
}

/// A maze with the name that results call it.
#[derive(Clone, Debug)]
pub struct NamedMaze {
    /// The bundled name, the specification of a generated maze, or the file name without its
    /// extension. Two files of the same name in different folders are named by their paths
    /// instead.
    pub name: GuestText,
    /// The maze.
    pub maze: Arc<Maze>,
}

/// Reads and generates the mazes that the arguments name, in their order.
///
/// # Errors
///
/// As [`load`] with [`BadFiles::Fail`].
pub fn load_all(arguments: &[String], rules: Legality) -> Result<Vec<NamedMaze>, Failure> {
    let sources = load(arguments, rules, BadFiles::Fail)?;
    let named = sources.into_iter().map(|source| match source {
        MazeSource::Loaded { name, maze } => NamedMaze { name, maze },
        MazeSource::Generated(generated) => NamedMaze {
            name: generated.to_string().into(),
            maze: Arc::new(generated.generate()),
        },
    });
    Ok(named.collect())
}

/// The short names, or the labels of those sources that share a short name with another.
fn unique_names<'a>(sources: impl Iterator<Item = &'a Source> + Clone) -> Vec<GuestText> {
    let mut labels: BTreeMap<GuestText, BTreeSet<GuestText>> = BTreeMap::new();
    for source in sources.clone() {
        // The name of a generated maze is unique already, and there can be a million of them.
        if !matches!(source, Source::Generated(_)) {
            let same_name = labels.entry(source.short_name()).or_default();
            same_name.insert(source.label());
        }
    }
    let unique = |source: &Source| match source {
        Source::Generated(_) => GuestText::new(),
        _ if labels[&source.short_name()].len() == 1 => source.short_name(),
        _ => source.label(),
    };
    sources.map(unique).collect()
}

fn require_legal(source: &Source, maze: &Maze, hint: &'static str) -> Result<(), Failure> {
    let broken = violations(maze);
    if broken.is_empty() {
        return Ok(());
    }
    let rules = if broken.len() == 1 { "rule" } else { "rules" };
    let mut message = text!(
        "maze `{}` breaks {} contest {}:",
        source.label().escaped(),
        broken.len(),
        rules
    );
    for violation in broken {
        message = text!("{}\n  {}", message, violation);
    }
    Err(Failure::input(message).hint(hint))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use wasmouse_core::maze::bundled;
    use wasmouse_core::maze::format::TEXT_BYTES_MAX;

    use super::*;

    const OFFICIAL: &str = "test_maze_01";

    /// A folder with the official maze in it as several files.
    fn folder_of(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("in the folder")).expect("a folder");
            fs::write(path, text).expect("a file");
        }
        folder
    }

    fn spec(folder: &tempfile::TempDir, name: &str) -> String {
        let path = folder.path().join(name);
        path.to_str().expect("UTF-8").to_owned()
    }

    fn names(specs: &[String]) -> Vec<GuestText> {
        let mazes = load(specs, Legality::Lenient, BadFiles::Fail).expect("mazes");
        mazes.iter().map(MazeSource::name).collect()
    }

    fn check_error(spec: &str, rules: Legality, expected: &str) {
        let failure = load(&[spec.to_owned()], rules, BadFiles::Fail).expect_err(spec);
        assert_eq!(failure.to_string().replace(spec, "SPEC"), expected);
        assert_eq!(failure.exit(), super::super::exit::Exit::Input);
    }

    #[test]
    fn bundled_mazes_are_found_by_name() {
        assert_eq!(names(&[OFFICIAL.to_owned()]), [OFFICIAL]);
    }

    #[test]
    fn generated_mazes_are_named_by_their_own_specification() {
        let specs = ["gen:tree:12:1..=2".to_owned()];
        assert_eq!(
            names(&specs),
            ["gen:tree,loops=12:12:1", "gen:tree,loops=12:12:2"]
        );
    }

    #[test]
    fn folders_are_sorted_and_shallow() {
        let text = bundled()[0].text;
        let folder = folder_of(&[
            ("b.MAP", text),
            ("a.txt", text),
            ("c.num", text),
            ("README.md", "no maze"),
            (".hidden.txt", "no maze"),
            ("deeper/d.txt", text),
            ("folder.txt/e.txt", text),
        ]);
        assert_eq!(names(&[spec(&folder, "")]), ["a", "b", "c"]);
        let both = [spec(&folder, "a.txt"), spec(&folder, "deeper/d.txt")];
        assert_eq!(names(&both), ["a", "d"]);
        let mazes = load(&both, Legality::Contest, BadFiles::Fail).expect("two mazes");
        let names: Vec<GuestText> = distinct(mazes).iter().map(MazeSource::name).collect();
        assert_eq!(names, ["a"], "both files have the same maze");
    }

    #[test]
    fn equal_file_names_are_told_apart_by_path() {
        let text = bundled()[0].text;
        let folder = folder_of(&[("x/a.txt", text), ("y/a.txt", text)]);
        let specs = [spec(&folder, "x"), spec(&folder, "y")];
        let expected = ["x/a.txt", "y/a.txt"].map(|it| GuestText::from(spec(&folder, it)));
        assert_eq!(names(&specs), expected);
    }

    #[test]
    fn bad_specifications_are_named_with_a_hint() {
        check_error(
            "maze_01",
            Legality::Contest,
            "error: unknown maze `SPEC`: no bundled maze, file or folder has this name\n\n\
             hint: did you mean `test_SPEC`?",
        );
        check_error(
            "/qq/\u{1b}qq",
            Legality::Contest,
            "error: unknown maze `/qq/\\u{1b}qq`: no bundled maze, file or folder has this name\
             \n\nhint: bundled mazes are test_maze_01, braid-12, division-14, tree-16, division-18, \
             braid-20, lobato-detour",
        );
        check_error(
            "gen:tree:13:1",
            Legality::Contest,
            "error: failed to generate `SPEC`: size: expected an even number from 12 to 20, \
             or a range such as `12..=20`, found `13`",
        );
        let twice = load(
            &["-".to_owned(), "-".to_owned()],
            Legality::Lenient,
            BadFiles::Fail,
        );
        assert_eq!(
            twice.expect_err("one standard input").to_string(),
            "error: standard input is given as a maze twice"
        );
    }

    #[test]
    fn bad_files_in_a_folder_are_skipped() {
        let good = bundled()[0].text;
        let folder = folder_of(&[("a.txt", good), ("b.txt", "no maze"), ("c.txt", good)]);
        let all = [spec(&folder, "")];
        let mazes = load(&all, Legality::Contest, BadFiles::Skip).expect("two mazes");
        assert_eq!(mazes.len(), 2);
        load(&all, Legality::Contest, BadFiles::Fail).expect_err("one bad maze");
        let bad = [spec(&folder, "b.txt")];
        load(&bad, Legality::Contest, BadFiles::Skip).expect_err("it was named by itself");
    }

    #[test]
    fn bad_files_are_named_with_a_reason() {
        let folder = folder_of(&[
            ("empty.txt", ""),
            ("open.txt", "3\n3,5,6\n10,1,14\n9,5,12"),
            ("none/README.md", ""),
            ("huge.txt", &"1".repeat(TEXT_BYTES_MAX + 1)),
        ]);
        fs::write(folder.path().join("latin1.txt"), b"12\n\xe9").expect("a file");
        let bad = [
            (
                "empty.txt",
                "error: failed to parse maze `SPEC`: the text is empty",
            ),
            (
                "none",
                "error: folder `SPEC` has no mazes\n\nhint: mazes end in .txt, .map, .maz, .num",
            ),
            (
                "huge.txt",
                "error: failed to read maze `SPEC`: the file has more than 262144 bytes",
            ),
            (
                "latin1.txt",
                "error: failed to parse maze `SPEC`: byte 3 is not UTF-8\n\n\
                 hint: save the file as UTF-8 or ASCII text",
            ),
        ];
        for (name, message) in bad {
            check_error(&spec(&folder, name), Legality::Lenient, message);
        }
        check_error(
            &spec(&folder, "open.txt"),
            Legality::Contest,
            "error: maze `SPEC` breaks 2 contest rules:\n  \
             the size must be an even number from 12 to 20: it is 3\n  \
             the start must be open at the top only: (0, 0) is open up, right\n\n\
             hint: --lenient accepts it",
        );
    }
}
