//! From what users write for a maze to mazes: [`load`], the same in every command.
//!
//! A specification is resolved to [`Source`]s without reading any of them, then
//! each source is read, parsed and, unless the user says `--lenient`, held
//! against the contest rules. What a maze is and which rules it breaks is
//! decided in [`crate::maze`]; this file only knows names, files and hints.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::maze::format::{self, Format, ParseError, Parsed, TEXT_BYTES_MAX};
use crate::maze::generate::GenSpec;
use crate::maze::{BundledMaze, Maze, bundled, violations};

use super::failure::Failure;

/// What a user may write for a maze, for the long help of every command.
pub const SPECIFICATION_HELP: &str = "\
A maze is one of, in this order:
  -              standard input
  gen:tree:16:7  a generated maze: gen:KIND:DIMENSION:SEED with the kind division,
                 tree (also tree,loops=PERCENT), braid or stretches; dimension and
                 seed may be ranges such as 12..=20 and 1..=100, for many mazes
  test_maze_01   the name of a bundled maze
  a.txt          a file in any format: udacity, competition, map, num,
                 blocks
  mazes          a folder: all its .txt, .map, .maz and .num files by name,
                 without subfolders and hidden files
Write ./NAME for a file or folder that is named like one of the others.";

/// The endings of file names that count as mazes in a folder.
const EXTENSIONS: [&str; 4] = ["txt", "map", "maz", "num"];

/// The name and specification of standard input.
const STDIN: &str = "-";

/// How alike two names are for one to be hinted at; 1 is equal, 0 is different.
const SIMILARITY_MIN: f64 = 0.7;

/// How many names a hint offers.
const HINTS_MAX: usize = 3;

/// A maze with what a table calls it.
#[derive(Clone, Debug)]
pub struct NamedMaze {
    /// The bundled name, the specification of a generated maze, or the file name
    /// without its ending. Two files of the same name in different folders are
    /// named by their paths instead.
    pub name: String,
    /// The maze.
    pub maze: Maze,
}

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

/// The mazes that the specifications name, in their order, folders unfolded.
///
/// # Errors
///
/// With the first specification that names nothing, the first source that
/// cannot be read or parsed, or, for [`Legality::Contest`], the first maze that
/// breaks contest rules.
pub fn load(specs: &[String], rules: Legality) -> Result<Vec<NamedMaze>, Failure> {
    let mut sources = Vec::new();
    for spec in specs {
        sources.extend(resolve(spec)?);
    }
    let stdins = sources.iter().filter(|source| **source == Source::Stdin);
    if stdins.count() > 1 {
        return Err(Failure::usage("standard input is given as a maze twice"));
    }
    let names = unique_names(&sources);
    let mut mazes = Vec::new();
    for (source, name) in sources.iter().zip(names) {
        let (maze, _) = source.read()?;
        if rules == Legality::Contest {
            require_legal(source, &maze)?;
        }
        mazes.push(NamedMaze { name, maze });
    }
    Ok(mazes)
}

/// One maze that a specification names, not yet read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A generated maze; its name is the specification of it alone.
    Generated(String, Maze),
    /// A maze that comes with wasmouse.
    Bundled(&'static BundledMaze),
    /// A file.
    File(PathBuf),
    /// Standard input, to its end.
    Stdin,
}

/// The sources that one specification names: one, or all mazes of a folder.
///
/// # Errors
///
/// When it names nothing, a `gen:` specification is wrong, a folder cannot be listed, or a folder has no mazes.
pub fn resolve(spec: &str) -> Result<Vec<Source>, Failure> {
    if spec == STDIN {
        return Ok(vec![Source::Stdin]);
    }
    if GenSpec::is_meant_by(spec) {
        return generated(spec);
    }
    if let Some(maze) = bundled().iter().find(|maze| maze.name == spec) {
        return Ok(vec![Source::Bundled(maze)]);
    }
    let path = Path::new(spec);
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => folder(path),
        Ok(_) => Ok(vec![Source::File(path.to_owned())]),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(unknown(spec)),
        Err(error) => Err(unreadable(path, &error)),
    }
}

impl Source {
    /// What messages and listings call it: the name, the path, or `-`.
    pub fn label(&self) -> String {
        match self {
            Self::Generated(name, _) => name.clone(),
            Self::Bundled(maze) => maze.name.to_owned(),
            Self::File(path) => shown(path),
            Self::Stdin => STDIN.to_owned(),
        }
    }

    /// Reads the maze; the format is `None` when it did not come from text.
    ///
    /// # Errors
    ///
    /// When it cannot be read or is no maze.
    pub fn read(&self) -> Result<(Maze, Option<Format>), Failure> {
        let bytes = match self {
            Self::Generated(_, maze) => return Ok((maze.clone(), None)),
            Self::Bundled(maze) => maze.text.as_bytes().to_vec(),
            Self::File(path) => File::open(path)
                .and_then(read_limited)
                .map_err(|error| unreadable(path, &error))?,
            Self::Stdin => read_limited(io::stdin().lock())
                .map_err(|error| unreadable(Path::new(STDIN), &error))?,
        };
        let Parsed { format, maze } = self.parse(bytes)?;
        Ok((maze, Some(format)))
    }

    fn parse(&self, bytes: Vec<u8>) -> Result<Parsed, Failure> {
        let failed = |reason: &dyn std::fmt::Display| {
            Failure::input(format!("failed to parse maze `{}`: {reason}", self.label()))
        };
        if bytes.len() > TEXT_BYTES_MAX {
            return Err(failed(&format!(
                "more than {TEXT_BYTES_MAX} bytes, which no maze file has"
            )));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let place = error.utf8_error().valid_up_to();
            failed(&format!("byte {place} begins no UTF-8 character"))
                .hint("save the file as UTF-8 or ASCII text")
        })?;
        format::parse(&text).map_err(|error| match &error {
            ParseError::Unrecognized { .. } => {
                failed(&error).hint("`wasmouse maze convert --help` describes the formats")
            }
            _ => failed(&error),
        })
    }

    /// What results call it, if nothing else is called so.
    pub fn short_name(&self) -> String {
        match self {
            Self::File(path) => path
                .file_stem()
                .map_or_else(|| shown(path), |stem| shown(Path::new(stem))),
            Self::Generated(..) | Self::Bundled(_) | Self::Stdin => self.label(),
        }
    }
}

/// The short names, or the labels of those sources that share a short name
/// with another.
fn unique_names(sources: &[Source]) -> Vec<String> {
    let mut labels: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for source in sources {
        let same_name = labels.entry(source.short_name()).or_default();
        same_name.insert(source.label());
    }
    let unique = |source: &Source| {
        let name = source.short_name();
        if labels[&name].len() == 1 {
            name
        } else {
            source.label()
        }
    };
    sources.iter().map(unique).collect()
}

/// What a text that begins with `gen:` stands for.
///
/// # Errors
///
/// When it is no specification: an input like any other, wherever it stands.
pub fn specification(spec: &str) -> Result<GenSpec, Failure> {
    spec.parse().map_err(|error| {
        Failure::input(format!(
            "failed to generate `{}`: {error}",
            shown(Path::new(spec))
        ))
    })
}

fn generated(spec: &str) -> Result<Vec<Source>, Failure> {
    let mazes = specification(spec)?.expand();
    Ok(mazes
        .map(|(name, maze)| Source::Generated(name, maze))
        .collect())
}

/// Reads at most one byte more than a maze file may have, so that neither a
/// huge file nor an endless device does any harm.
fn read_limited(reader: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let limit = TEXT_BYTES_MAX as u64 + 1;
    reader.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn folder(path: &Path) -> Result<Vec<Source>, Failure> {
    let failed = |error: io::Error| unreadable(path, &error);
    let mut files = Vec::new();
    for entry in fs::read_dir(path).map_err(failed)? {
        let file = entry.map_err(failed)?.path();
        if is_maze_file(&file) {
            files.push(file);
        }
    }
    if files.is_empty() {
        let message = format!("folder `{}` has no mazes", shown(path));
        let hint = format!("mazes end in .{}", EXTENSIONS.join(", ."));
        return Err(Failure::input(message).hint(hint));
    }
    files.sort();
    Ok(files.into_iter().map(Source::File).collect())
}

fn is_maze_file(path: &Path) -> bool {
    let is_hidden = path
        .file_name()
        .is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
    let has_extension = path.extension().is_some_and(|extension| {
        EXTENSIONS
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    });
    has_extension && !is_hidden && !path.is_dir()
}

fn require_legal(source: &Source, maze: &Maze) -> Result<(), Failure> {
    let broken = violations(maze);
    if broken.is_empty() {
        return Ok(());
    }
    let rules = if broken.len() == 1 { "rule" } else { "rules" };
    let mut message = format!(
        "maze `{}` breaks {} contest {rules}:",
        source.label(),
        broken.len()
    );
    for violation in broken {
        message.push_str(&format!("\n  {violation}"));
    }
    Err(Failure::input(message).hint("use it as it is with --lenient"))
}

fn unreadable(path: &Path, error: &io::Error) -> Failure {
    Failure::input(format!("failed to read maze `{}`: {error}", shown(path)))
}

fn unknown(spec: &str) -> Failure {
    let message = format!(
        "unknown maze `{}`: no bundled maze, file or folder has this name",
        shown(Path::new(spec))
    );
    let mut names: Vec<(f64, &str)> = bundled()
        .iter()
        .map(|maze| (strsim::jaro_winkler(spec, maze.name), maze.name))
        .filter(|&(similarity, _)| similarity >= SIMILARITY_MIN)
        .collect();
    names.sort_by(|a, b| b.0.total_cmp(&a.0));
    let names: Vec<String> = names
        .iter()
        .take(HINTS_MAX)
        .map(|(_, name)| format!("`{name}`"))
        .collect();
    Failure::input(message).hint(if names.is_empty() {
        let all: Vec<&str> = bundled().iter().map(|maze| maze.name).collect();
        format!("bundled mazes are {}", all.join(", "))
    } else {
        format!("did you mean {}?", names.join(" or "))
    })
}

/// A path for people: control characters, which could play with a terminal, are
/// escaped.
fn shown(path: &Path) -> String {
    let mut text = String::new();
    for character in path.display().to_string().chars() {
        if character.is_control() {
            text.extend(character.escape_debug());
        } else {
            text.push(character);
        }
    }
    text
}

#[cfg(test)]
mod tests {
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

    fn names(specs: &[String]) -> Vec<String> {
        let mazes = load(specs, Legality::Lenient).expect("mazes");
        mazes.into_iter().map(|maze| maze.name).collect()
    }

    fn check_error(spec: &str, rules: Legality, expected: &str) {
        let failure = load(&[spec.to_owned()], rules).expect_err(spec);
        assert_eq!(failure.to_string().replace(spec, "SPEC"), expected);
        assert_eq!(failure.exit(), super::super::exit::Exit::Input);
    }

    #[test]
    fn bundled_mazes_are_found_by_name() {
        let mazes = load(&[OFFICIAL.to_owned()], Legality::Contest).expect("legal");
        assert_eq!(mazes[0].name, OFFICIAL);
    }

    #[test]
    fn generated_mazes_are_named_by_their_own_specification() {
        let specs = ["gen:tree:12:1..=2".to_owned()];
        let mazes = load(&specs, Legality::Contest).expect("legal");
        let names: Vec<&str> = mazes.iter().map(|maze| &maze.name[..]).collect();
        assert_eq!(names, ["gen:tree,loops=12:12:1", "gen:tree,loops=12:12:2"]);
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
        let same = [spec(&folder, "a.txt"), spec(&folder, "a.txt")];
        assert_eq!(names(&same), ["a", "a"]);
    }

    #[test]
    fn equal_file_names_are_told_apart_by_path() {
        let text = bundled()[0].text;
        let folder = folder_of(&[("x/a.txt", text), ("y/a.txt", text)]);
        let specs = [spec(&folder, "x"), spec(&folder, "y")];
        let expected = [spec(&folder, "x/a.txt"), spec(&folder, "y/a.txt")];
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
            "error: failed to generate `SPEC`: dimension: expected an even number from 12 to 20, \
             or a range such as `12..=20`, found `13`",
        );
        let twice = load(&["-".to_owned(), "-".to_owned()], Legality::Lenient);
        assert_eq!(
            twice.expect_err("one standard input").to_string(),
            "error: standard input is given as a maze twice"
        );
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
                "error: failed to parse maze `SPEC`: more than 262144 bytes, which no maze file has",
            ),
            (
                "latin1.txt",
                "error: failed to parse maze `SPEC`: byte 3 begins no UTF-8 character\n\n\
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
             the dimension is an even number from 12 to 20: it is 3\n  \
             the start is open at the top only: (0, 0) is open up, right\n\n\
             hint: use it as it is with --lenient",
        );
    }
}
