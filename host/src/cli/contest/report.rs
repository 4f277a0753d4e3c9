//! `wasmouse contest report`: standings and reports of what is in a store. Nothing is played.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use wasmouse_core::record::MatchRecord;
use wasmouse_engine::engine_id;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output::{self, Draft, Existing, message};
use super::super::store_failure::store_failure;
use super::super::terminal;
use super::load::FILE_NAME;
use super::pictures::pictures;
use super::planned::PlannedContest;
use crate::contest::{KeepTranscripts, ScoreMatrix};
use crate::report::contest::{self as reports, ContestReport, ReportOptions};
use crate::report::jsonl::record_line;
use crate::report::text::{Text, text};
use crate::store::{Store, StoreError, StoreErrorKind};

const EXAMPLES: &str = "\
Examples:
  wasmouse contest report                          standings
  wasmouse contest report --html standings.html    and a web page
  wasmouse contest report --organiser --csv all.csv

The reports that the contest file names are written by `wasmouse contest run`.";

/// Print the standings of a contest and write reports
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The contest file, or a folder with a contest.toml
    #[arg(value_name = "FILE", default_value = FILE_NAME)]
    file: PathBuf,
    /// The store to use instead of the one that the contest file names
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
    /// Show hidden mazes, all robots and their names, whatever the contest file says
    #[arg(long)]
    organiser: bool,
    /// Write a web page to FILE
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the standings as comma-separated values to FILE
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the matches as comma-separated values to FILE
    #[arg(long, value_name = "FILE")]
    matches_csv: Option<PathBuf>,
    /// Write standings and scores as JSON to FILE
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write one match per line to FILE, as JSON
    #[arg(long, value_name = "FILE")]
    jsonl: Option<PathBuf>,
    /// Write the standings as Markdown to FILE
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Overwrite files that exist
    #[arg(long)]
    force: bool,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
}

/// For whom reports are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Audience {
    /// Contestants: without what the contest file hides.
    Everybody,
    /// The organiser, who may see everything.
    Organiser,
}

/// A report to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Html,
    Csv,
    MatchesCsv,
    Json,
    JsonLines,
    Markdown,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let contest = PlannedContest::read(&args.file)?;
    let path = args.store.clone().unwrap_or_else(|| contest.folder.store());
    let store = Store::open_read_only(&path).map_err(store_failure)?;
    let matrix = contest.matrix(&store, &contest.rejections(&store)?)?;
    let audience = if args.organiser {
        Audience::Organiser
    } else {
        Audience::Everybody
    };
    let files = [
        (Kind::Html, &args.html),
        (Kind::Csv, &args.csv),
        (Kind::MatchesCsv, &args.matches_csv),
        (Kind::Json, &args.json),
        (Kind::JsonLines, &args.jsonl),
        (Kind::Markdown, &args.markdown),
    ];
    let files = files
        .into_iter()
        .filter_map(|(kind, path)| Some((kind, path.clone()?)));
    let existing = Existing::from_flag(args.force);
    let writer = Writer {
        contest: &contest,
        store: &store,
        matrix: &matrix,
        audience,
    };
    writer.write(files.collect(), existing, args.ascii)?;
    Ok(Exit::Success)
}

/// Prints the standings and writes the reports that the contest file names. Frozen reports that
/// exist stay as they are.
///
/// # Errors
///
/// When the store cannot be read or a report cannot be written.
pub fn publish(
    contest: &PlannedContest,
    store: &Store,
    matrix: &ScoreMatrix,
) -> Result<(), Failure> {
    let outputs = contest.folder.outputs().into_iter().map(|(key, path)| {
        let kind = match key {
            "html" => Kind::Html,
            "csv" => Kind::Csv,
            "json" => Kind::Json,
            "jsonl" => Kind::JsonLines,
            _ => Kind::Markdown,
        };
        (kind, path)
    });
    let is_frozen = contest.folder.file.report.freeze;
    let (kept, outputs): (Vec<_>, Vec<_>) =
        outputs.partition(|(_, path)| is_frozen && path.exists());
    let writer = Writer {
        contest,
        store,
        matrix,
        audience: Audience::Everybody,
    };
    writer.write(outputs, Existing::Replace, false)?;
    for (_, path) in kept {
        message!("kept {}: reports are frozen", Text::of_path(&path));
    }
    Ok(())
}

/// Writes the reports of a contest.
struct Writer<'a> {
    contest: &'a PlannedContest,
    store: &'a Store,
    matrix: &'a ScoreMatrix,
    audience: Audience,
}

impl Writer<'_> {
    /// Prints the standings and writes the files.
    fn write(
        &self,
        files: Vec<(Kind, PathBuf)>,
        existing: Existing,
        ascii: bool,
    ) -> Result<(), Failure> {
        // Before anything else, so that no report is lost over the name of another.
        let mut drafts = Vec::with_capacity(files.len());
        for (kind, path) in files {
            self.check_path(&path)?;
            let draft = Draft::create(&path, existing)?;
            drafts.push((kind, path, draft));
        }
        let (file, engine) = (&self.contest.folder.file, engine_id());
        let mut report = ContestReport::new(
            file.name.as_str(),
            self.matrix,
            &file.scoring,
            &engine,
            self.contest.matches(self.matrix),
            self.options(),
        );
        if let Some(digest) = self.store.sealed().map_err(store_failure)? {
            report = report.with_results_digest(digest);
        }
        if drafts.iter().any(|(kind, ..)| *kind == Kind::Html) {
            let keeps_all = file.run.keep_transcripts == KeepTranscripts::All;
            let (pictures, playable) = pictures(self.store, &report, keeps_all)?;
            report = report.with_pictures(pictures).with_playable(playable);
        }
        let layout = terminal::table_layout(ascii);
        output::print(&reports::table(&report, layout))?;
        for (kind, path, mut draft) in drafts {
            let failed = |error: &std::io::Error| output::failure(&path, error);
            match kind {
                Kind::JsonLines => self.write_lines(&path, &mut draft)?,
                Kind::Html => draft
                    .write_all(reports::html(&report).as_bytes())
                    .map_err(|error| failed(&error))?,
                Kind::Csv => draft
                    .write_all(reports::robots_csv(&report).as_bytes())
                    .map_err(|error| failed(&error))?,
                Kind::MatchesCsv => draft
                    .write_all(reports::matches_csv(&report).as_bytes())
                    .map_err(|error| failed(&error))?,
                Kind::Json => draft
                    .write_all(reports::json(&report).as_bytes())
                    .map_err(|error| failed(&error))?,
                Kind::Markdown => draft
                    .write_all(reports::markdown(&report).as_bytes())
                    .map_err(|error| failed(&error))?,
            }
            draft.commit()?;
            message!("wrote {}", Text::of_path(&path));
        }
        Ok(())
    }

    /// No report takes the place of what it is made from, whatever `--force` says.
    fn check_path(&self, path: &Path) -> Result<(), Failure> {
        let is = |other: &Path| match (path.canonicalize(), other.canonicalize()) {
            (Ok(path), Ok(other)) => path == other,
            _ => false,
        };
        let what = if is(self.contest.folder.path()) {
            "the contest file"
        } else if is(self.store.path()) {
            "the store"
        } else {
            return Ok(());
        };
        Err(Failure::input(text!(
            "failed to write `{}`: it is {}",
            Text::of_path(path),
            what
        )))
    }

    fn options(&self) -> ReportOptions {
        let report = &self.contest.folder.file.report;
        match self.audience {
            Audience::Organiser => ReportOptions::default(),
            Audience::Everybody => ReportOptions {
                show_top: report.show_top.map(|it| it.get_u32()),
                hide_names: report.hide_names,
                hide_hidden_mazes: true,
                frozen: None,
            },
        }
    }

    /// The records of the matches. Those in hidden mazes are the organiser's.
    fn write_lines(&self, path: &Path, draft: &mut Draft) -> Result<(), Failure> {
        let is_open =
            |set: usize| self.audience == Audience::Organiser || !self.matrix.sets[set].is_hidden;
        let mazes = self.matrix.mazes.iter();
        let mazes: Vec<_> = mazes
            .filter(|it| is_open(it.set))
            .map(|it| it.digest)
            .collect();
        let players = self.contest.players();
        let keys = self.contest.keys(&players, &mazes);
        let mut write = |record: &MatchRecord| draft.write_all(record_line(record).as_bytes());
        let written = self.store.records(&keys, &mut write);
        written
            .map(drop)
            .map_err(|error: StoreError| match error.kind {
                StoreErrorKind::Reader(error) => output::failure(path, &error),
                _ => store_failure(error),
            })
    }
}
