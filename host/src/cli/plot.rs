//! `wasmouse plot`: plots of results.

use std::path::{Path, PathBuf};

use super::contest::scores;
use super::exit::Exit;
use super::failure::Failure;
use super::image_file::{self, Format};
use super::input;
use super::output::Existing;
use super::theme::ThemeChoice;
use crate::contest::{Benchmark, RecordedScores, ScoreMatrix};
use crate::report::plot::{self, Kind, Measure, Options, PlotError};
use crate::report::results_json::read_results;
use crate::report::text::{Text, text};

/// The largest result file that is read, in bytes.
const RESULT_BYTES_MAX: u64 = 1 << 30;

const EXAMPLES: &str = "\
Examples:
  wasmouse run champion flood dfs --output results.json
  wasmouse plot scores results.json -o scores.svg
  wasmouse plot margins results.json --benchmark upper -o margins.png --theme dark
  wasmouse plot regret cup -o regret.svg               a contest: cup/contest.toml

A plot shows the best 8 robots that have finished a match. Of a contest, it shows
everything, also mazes and names that the contest file hides from contestants.";

/// Plot results: scores, margins, runs, fuel, regret
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// What to plot
    #[arg(value_name = "KIND")]
    kind: KindChoice,
    /// Result files of one set of rules and seeds, or one contest: its file, or a folder
    /// with a contest.toml
    #[arg(value_name = "SOURCE", required = true)]
    sources: Vec<PathBuf>,
    /// The file to write: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The benchmark of margins: optimal speed run, and one (lower) or two (upper) steps of
    /// exploration for each cell
    #[arg(long, value_name = "BENCHMARK", default_value = "lower")]
    benchmark: BenchmarkChoice,
    /// Instead of the title that names the kind
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Dark on white, or light on near-black
    #[arg(long, value_name = "THEME", default_value = "light")]
    theme: ThemeChoice,
    /// The width of a PNG file in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(100..=8000))]
    width: u32,
    /// The store to use instead of the one that the contest file names
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
    /// Overwrite FILE if it exists
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum KindChoice {
    /// Scores of robots side by side, by maze, or by size of more than 8 mazes
    Scores,
    /// The same with the steps of the exploration run
    Exploration,
    /// The same with the steps of the speed run
    Speed,
    /// Benchmark minus score, a histogram for each size
    Margins,
    /// Exploration run against speed run
    Runs,
    /// Score against fuel
    Fuel,
    /// The share of matches with at most so much regret
    Regret,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum BenchmarkChoice {
    Lower,
    Upper,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let format = Format::of(&args.output, &[Format::Svg, Format::Png])?;
    let matrix = matrix(args)?;
    let kind = match args.kind {
        KindChoice::Scores => Kind::Bars(Measure::Score),
        KindChoice::Exploration => Kind::Bars(Measure::Exploration),
        KindChoice::Speed => Kind::Bars(Measure::Speed),
        KindChoice::Margins => Kind::Margins(match args.benchmark {
            BenchmarkChoice::Lower => Benchmark::Lower,
            BenchmarkChoice::Upper => Benchmark::Upper,
        }),
        KindChoice::Runs => Kind::Runs,
        KindChoice::Fuel => Kind::Fuel,
        KindChoice::Regret => Kind::Regret,
    };
    let options = Options {
        title: args.title.clone(),
        theme: args.theme.into(),
    };
    let svg = plot::svg(kind, &matrix, &options).map_err(|error| match error {
        PlotError::Empty => Failure::input(error)
            .hint("a plot needs a match that a robot finished, in a maze with a solution"),
        PlotError::Draw(_) => Failure::internal(error),
    })?;
    let existing = Existing::from_flag(args.force);
    image_file::save(&svg, (&args.output, format), args.width, existing)?;
    Ok(Exit::Success)
}

fn matrix(args: &Args) -> Result<ScoreMatrix, Failure> {
    let is_contest =
        |path: &PathBuf| path.is_dir() || path.extension().is_some_and(|it| it == "toml");
    if let Some(contest) = args.sources.iter().find(|it| is_contest(it)) {
        return match args.sources.as_slice() {
            [_] => scores(contest, args.store.as_deref()),
            _ => Err(Failure::usage(
                "a contest cannot be plotted together with other sources",
            )),
        };
    }
    if args.store.is_some() {
        return Err(Failure::usage(
            "--store needs a contest file, and the sources are results",
        ));
    }
    let mut recorded = RecordedScores::default();
    for path in &args.sources {
        let bytes = read(path)?;
        let shown = Text::of_path(path);
        let results = read_results(&bytes).map_err(|error| {
            Failure::input(text!("failed to read result `{}`: {}", shown, error)).hint(error.hint())
        })?;
        recorded.push(results).map_err(|error| {
            Failure::input(text!("failed to plot result `{}`: {}", shown, error))
                .hint("plot fewer files at once")
        })?;
    }
    Ok(recorded.matrix())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = match path.as_os_str() == "-" {
        true => input::read_stdin(RESULT_BYTES_MAX),
        false => input::read_file(path, RESULT_BYTES_MAX),
    };
    bytes.map_err(|error| input::failure("result", path, &error))
}
