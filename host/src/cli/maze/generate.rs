//! `wasmouse maze generate`: new mazes from a kind and a seed.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser as _};

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::interrupt;
use super::super::maze_source;
use super::super::output::{self, Existing, message};
use crate::report::number::counted;
use crate::report::text::{Text, text};
use wasmouse_core::maze::Maze;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::{GenSpec, GenSpecError, Kind};

const LONG_HELP: &str = "\
Kinds:
  division   stretches of four edges, three walls and one opening, as in
             Minnett's report: open places, free-standing walls
  tree       a random spanning tree, some of its walls opened: many dead ends
  braid      straights and diagonal staircases, few dead ends: like mazes that
             people draw for contests
  stretches  stretches of one to five edges with one opening each, as in
             Minnett's program: short paths to the goal

Every maze is a legal contest maze, and the same kind, size and seed give the
same maze everywhere. A specification gen:KIND[,loops=PERCENT]:SIZE:SEED says
the same in one word, also with ranges, and other commands take it as a maze.

Examples:
  wasmouse maze generate tree
  wasmouse maze generate braid --size 20 --seed 7 -o braid.txt
  wasmouse maze generate division --count 100 -o mazes
  wasmouse maze generate gen:tree,loops=30:12..=20:1..=10 -o mazes --format num";

/// Generate legal contest mazes.
///
/// One maze goes to standard output or, with --output, to a file. Several go
/// into a folder, which is made if need be, as files named by kind, size and
/// seed.
#[derive(clap::Args)]
#[command(after_long_help = LONG_HELP)]
pub struct Args {
    /// division, tree, braid, stretches, or a specification gen:KIND:SIZE:SEED
    kind: String,
    /// Cells along each side, an even number from 12 to 20 [default: 16]
    #[arg(long, value_name = "CELLS")]
    size: Option<u8>,
    /// Number of the maze; any number below 2^64 [default: 1]
    #[arg(long)]
    seed: Option<u64>,
    /// Percentage of the walls of a tree that are opened [default: 12]
    #[arg(long, value_name = "PERCENT")]
    loops: Option<u8>,
    /// How many mazes to make, with this and the following seeds [default: 1]
    #[arg(long, value_name = "N")]
    count: Option<u64>,
    /// The format to write
    #[arg(long, value_parser = format_parser(), default_value = Format::Udacity.name())]
    format: Format,
    /// Write to a file, or several mazes into a folder
    #[arg(short, long, value_name = "FILE|FOLDER")]
    output: Option<PathBuf>,
    /// Replace files that are there already
    #[arg(long, requires = "output")]
    force: bool,
}

fn format_parser() -> impl clap::builder::TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse::<Format>())
}

/// Runs the command.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let spec = specification(&args)?;
    let existing = if args.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    match &args.output {
        Some(path) if spec.count() > 1 || path.is_dir() => {
            return save_all(&spec, args.format, path, existing);
        }
        Some(path) => output::save(path, only(&spec, args.format).as_bytes(), existing)?,
        None if spec.count() == 1 => output::print_data(&only(&spec, args.format))?,
        None => {
            let message = format!("{} mazes do not fit on standard output", spec.count());
            return Err(Failure::usage(message).hint("name a folder for them with --output"));
        }
    }
    Ok(Exit::Success)
}

/// The mazes that the arguments ask for.
fn specification(args: &Args) -> Result<GenSpec, Failure> {
    if GenSpec::is_meant_by(&args.kind) {
        let given = [
            (args.size.is_some(), "--size"),
            (args.seed.is_some(), "--seed"),
            (args.loops.is_some(), "--loops"),
            (args.count.is_some(), "--count"),
        ];
        if let Some((_, option)) = given.into_iter().find(|&(given, _)| given) {
            let message = format!(
                "{option} does not go with a specification such as `{}`",
                args.kind
            );
            return Err(Failure::usage(message).hint("put it into the specification"));
        }
        return maze_source::specification(&args.kind);
    }
    let size = args.size.unwrap_or(16);
    let first = args.seed.unwrap_or(1);
    let count = args.count.unwrap_or(1);
    let last = count
        .checked_sub(1)
        .and_then(|more| first.checked_add(more))
        .ok_or_else(|| {
            Failure::usage(format!(
                "--count {count} from seed {first} on is no range of seeds"
            ))
        })?;
    GenSpec::new(kind(args)?, size..=size, first..=last).map_err(|error| unfit(args, &error))
}

fn kind(args: &Args) -> Result<Kind, Failure> {
    let named = Kind::ALL.into_iter().find(|kind| kind.name() == args.kind);
    match (named, args.loops) {
        (Some(Kind::Tree { .. }), Some(loops)) => Ok(Kind::Tree { loops }),
        (Some(kind), None) => Ok(kind),
        (Some(kind), Some(_)) => Err(Failure::usage(format!(
            "--loops goes with tree only, not with {}",
            kind.name()
        ))),
        (None, _) => Err(Failure::usage(format!(
            "unknown kind of maze `{}`",
            args.kind.escape_debug()
        ))
        .hint("the kinds are division, tree, braid and stretches")),
    }
}

fn unfit(args: &Args, error: &GenSpecError) -> Failure {
    let kind = args.kind.escape_debug();
    Failure::usage(format!("cannot generate `{kind}`: {error}"))
}

/// The text of the only maze of a specification.
fn only(spec: &GenSpec, format: Format) -> String {
    let maze = spec
        .expand()
        .next()
        .expect("a specification has a maze")
        .generate();
    text(&maze, format)
}

fn text(maze: &Maze, format: Format) -> String {
    format::print(maze, format).expect("every format holds a contest maze")
}

/// Writes all mazes into a folder, or none when a file already exists. Ctrl-C ends it
/// between two files.
fn save_all(
    spec: &GenSpec,
    format: Format,
    folder: &Path,
    existing: Existing,
) -> Result<Exit, Failure> {
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::internal(text!(
            "failed to make folder `{}`: {}",
            Text::of_path(folder),
            error
        ))
    })?;
    let file = |name: &str| folder.join(file_name(name, format));
    let mut files = spec.expand().map(|maze| file(&maze.to_string()));
    if existing == Existing::Keep
        && let Some(file) = files.find(|file| file.exists())
    {
        let message = text!(
            "failed to write `{}`: the file already exists",
            Text::of_path(&file)
        );
        return Err(Failure::input(message).hint("replace it with --force"));
    }
    let (count, shown) = (counted(spec.count(), "maze"), Text::of_path(folder));
    let interrupted = interrupt::listen()?;
    for (written, generated) in spec.expand().enumerate() {
        let (name, maze) = (generated.to_string(), generated.generate());
        if interrupted.is_set() {
            message!("interrupted: wrote {} of {} to {}", written, count, shown);
            return Ok(Exit::Interrupted);
        }
        output::save(&file(&name), text(&maze, format).as_bytes(), existing)?;
    }
    message!("wrote {} to {}", count, shown);
    Ok(Exit::Success)
}

/// `gen:tree,loops=12:16:42` is kept in `tree-loops12-16-42.txt`.
fn file_name(name: &str, format: Format) -> String {
    let words = name.trim_start_matches("gen:").replace([':', ','], "-");
    let ending = match format {
        Format::Udacity | Format::Competition | Format::Blocks => "txt",
        Format::Map => "map",
        Format::Num => "num",
    };
    format!("{}.{ending}", words.replace('=', ""))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use clap::Parser as _;

    use super::*;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        args: Args,
    }

    fn args(line: &str) -> Args {
        let words = std::iter::once("generate").chain(line.split_whitespace());
        Line::try_parse_from(words).expect("a command line").args
    }

    #[test]
    fn arguments_become_a_specification() {
        for (line, spec) in [
            ("tree", "gen:tree,loops=12:16:1"),
            ("tree --loops 0 --size 12", "gen:tree,loops=0:12:1"),
            ("braid --seed 7 --count 3", "gen:braid:16:7..=9"),
            ("gen:division:12..=20:1..=2", "gen:division:12..=20:1..=2"),
        ] {
            let found = specification(&args(line)).expect(line);
            assert_eq!(found.to_string(), spec, "{line}");
        }
    }

    #[test]
    fn bad_arguments_are_named() {
        for (line, message) in [
            (
                "hedge",
                "error: unknown kind of maze `hedge`\n\nhint: the kinds are division, tree, braid and stretches",
            ),
            (
                "braid --loops 3",
                "error: --loops goes with tree only, not with braid",
            ),
            (
                "tree --loops 101",
                "error: cannot generate `tree`: loops: expected a percentage from 0 to 100, found `101`",
            ),
            (
                "tree --size 13",
                "error: cannot generate `tree`: size: expected an even number from 12 to 20, or a range such as `12..=20`, found `13`",
            ),
            (
                "tree --count 0",
                "error: --count 0 from seed 1 on is no range of seeds",
            ),
            (
                "tree --seed 18446744073709551615 --count 2",
                "error: --count 2 from seed 18446744073709551615 on is no range of seeds",
            ),
            (
                "tree --count 100001",
                "error: cannot generate `tree`: seed: expected ranges for at most 100000 mazes, found 100001",
            ),
            (
                "gen:tree:16:1 --seed 2",
                "error: --seed does not go with a specification such as `gen:tree:16:1`\n\nhint: put it into the specification",
            ),
        ] {
            let failure = specification(&args(line)).expect_err(line);
            assert_eq!(failure.to_string(), message, "{line}");
            assert_eq!(failure.exit(), Exit::Usage);
        }
    }

    /// As in every other command that takes one.
    #[test]
    fn a_bad_specification_is_bad_input() {
        let failure = specification(&args("gen:tree:16")).expect_err("no seed");
        assert_eq!(
            failure.to_string(),
            "error: failed to generate `gen:tree:16`: expected `gen:KIND:SIZE:SEED`, found `gen:tree:16`"
        );
        assert_eq!(failure.exit(), Exit::Input);
    }

    #[test]
    fn several_mazes_go_into_a_folder_and_replace_nothing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = folder.path().join("new/mazes");
        let line = format!(
            "tree --count 2 --size 12 --format num -o {}",
            target.display()
        );
        run(args(&line)).expect("two new files");
        let file = target.join("tree-loops12-12-2.num");
        let text = fs::read_to_string(&file).expect("the second file");
        format::parse(&text).expect("a maze");

        fs::write(&file, "mine").expect("a file");
        fs::remove_file(target.join("tree-loops12-12-1.num")).expect("the first file");
        let failure = run(args(&line)).expect_err("a file already exists");
        assert!(failure.to_string().contains("--force"), "{failure}");
        assert_eq!(
            fs::read_dir(&target).expect("a folder").count(),
            1,
            "none was written"
        );

        run(args(&format!("{line} --force"))).expect("forced");
        assert_eq!(fs::read_to_string(&file).expect("a file"), text);
    }

    #[test]
    fn one_maze_goes_into_a_file_and_several_need_a_folder() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("a.txt");
        let line = format!("braid --size 12 -o {}", file.display());
        run(args(&line)).expect("a new file");
        let text = fs::read_to_string(&file).expect("a file");
        assert!(text.starts_with("12\n"), "{text}");
        run(args(&line)).expect_err("the file already exists");
        let failure = run(args("braid --count 2")).expect_err("two mazes");
        assert!(failure.to_string().contains("--output"), "{failure}");
    }
}
