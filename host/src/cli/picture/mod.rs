//! `wasmouse picture`: pictures of matches, still and animated.

mod choices;

use std::io::Write;
use std::path::PathBuf;

use indicatif::ProgressStyle;
use wasmouse_core::GuestText;
use wasmouse_core::playback::Playback;
use wasmouse_core::replay::Replay;

use choices::{OverlayChoice, PictureTheme, StepChoice, StepRange};

use super::bar;
use super::exit::Exit;
use super::failure::Failure;
use super::image_file::{self, Format};
use super::interrupt;
use super::output::{self, Draft, Existing, message};
use super::replays::SourceArgs;
use crate::report::animation::{self, AnimationError, Frames, Timing};
use crate::report::number::counted;
use crate::report::picture::{Sheet, Theme};
use crate::report::scene::{
    Film, Overlays, POSTER_MAX, SEQUENCE_MAX, Shot, best_of_mazes, poster, sequence, side_by_side,
};
use crate::report::text::{Text, text};

/// Matches side by side, at most.
const SIDE_BY_SIDE_MAX: usize = 4;

/// How long frames are shown where nobody says otherwise, in milliseconds.
const DELAY: u16 = 120;
const HOLD: u16 = 3000;

/// What to do about too many matches.
const CHOOSE: &str =
    "choose matches with --match ROBOT/MAZE/SEED, or draw the best of each maze with --poster";

/// The width of a match in an animated picture where nobody says otherwise, in pixels.
const FILM_WIDTH: u32 = 420;

const EXAMPLES: &str = "\
Examples:
  wasmouse run flood test_maze_01 --replays .
  wasmouse picture flood-reset.test_maze_01.0.replay.json -o end.svg
  wasmouse picture match.replay.json -o step.png --step 40 --overlay knowledge,distances
  wasmouse picture match.replay.json -o cells.svg --step 0 --overlay costs,optimum
  wasmouse picture match.replay.json -o moments.png --sequence 12
  wasmouse picture a.replay.json b.replay.json -o match.gif --theme dark
  wasmouse picture cup/contest.db -o poster.png --poster --title 'Spring cup'
  wasmouse picture cup/contest.db -o both.gif --match flood/maze-1/0 --match dfs/maze-1/0

A step is a number of steps of both runs: 0 is the beginning. Animated pictures
(.gif, .apng) repeat forever; GIF files have at most 255 colours, and programs that
do not animate PNG files show the first frame.";

/// Draw a match, several side by side, or the best of a contest
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    source: SourceArgs,
    /// The file to write: .svg, .png, .gif or .apng
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The step to draw, or `last` [default: that of --match, or last]
    #[arg(long, value_name = "STEP", conflicts_with_all = ["sequence", "poster"])]
    step: Option<StepChoice>,
    /// The first and the last step of a sequence or an animated picture: 10..=40, 10.. or ..=40
    /// [default: the whole match]
    #[arg(long, value_name = "STEPS", conflicts_with_all = ["step", "poster"])]
    steps: Option<StepRange>,
    /// Draw that many moments of one match in a grid
    #[arg(long, value_name = "N", conflicts_with = "poster",
          value_parser = clap::value_parser!(u16).range(2..=SEQUENCE_MAX as i64))]
    sequence: Option<u16>,
    /// Draw the best finished match of each maze in a grid
    #[arg(long)]
    poster: bool,
    /// What to draw besides the maze and the robot [default: path,heat,journal; of a poster
    /// path,optimum; animated and in sequences knowledge,path,journal]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    overlay: Option<Vec<OverlayChoice>>,
    /// Leave out title and caption; for one match
    #[arg(long, conflicts_with_all = ["sequence", "poster", "title"])]
    bare: bool,
    /// The title of a poster
    #[arg(long, value_name = "TEXT", requires = "poster")]
    title: Option<String>,
    /// The colours; auto is what the reader prefers, and light for pixels
    #[arg(long, value_name = "THEME", default_value = "auto")]
    theme: PictureTheme,
    /// The width in pixels, of all but SVG files [default: depends on what is drawn]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(50..=8000))]
    width: Option<u32>,
    /// How long a frame is shown, in milliseconds [default: 120]
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u16).range(20..=60_000))]
    delay: Option<u16>,
    /// How long the last frame is shown, in milliseconds [default: 3000]
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u16).range(20..=60_000))]
    hold: Option<u16>,
    /// Steps from one frame to the next [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    every: Option<u16>,
    /// Overwrite FILE if it exists
    #[arg(long)]
    force: bool,
}

/// A match with its names.
struct Loaded {
    robot: GuestText,
    maze: GuestText,
    playback: Playback,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let format = Format::of(
        &args.output,
        &[Format::Svg, Format::Png, Format::Gif, Format::Apng],
    )?;
    let is_animated = matches!(format, Format::Gif | Format::Apng);
    if is_animated && (args.sequence.is_some() || args.poster) {
        let message = text!(
            "`{}`: a grid of matches is not animated",
            Text::of_path(&args.output)
        );
        return Err(Failure::usage(message).hint("use a name that ends in .svg or .png"));
    }
    let timings = [args.delay, args.hold, args.every];
    if !is_animated && timings.iter().any(Option::is_some) {
        let message = "--delay, --hold and --every are for animated pictures";
        return Err(Failure::usage(message).hint("use a name that ends in .gif or .apng"));
    }
    let overlays = args.overlays(is_animated)?;
    let replays = args.source.load()?;
    let chosen: Vec<&Replay> = match args.poster {
        true => best(&replays)?,
        false if replays.len() > SIDE_BY_SIDE_MAX => return Err(too_many(replays.len())),
        false => replays.iter().collect(),
    };
    let loaded: Vec<Loaded> = chosen.into_iter().map(Loaded::new).collect();
    let shots: Vec<Shot<'_>> = loaded.iter().map(Loaded::shot).collect();
    if is_animated {
        return animate(args, format, &shots, overlays);
    }
    let svg = args.svg(&shots, &overlays)?;
    let existing = Existing::from_flag(args.force);
    let width = args.width.unwrap_or(svg.width);
    image_file::save(&svg.text, (&args.output, format), width, existing)?;
    Ok(Exit::Success)
}

/// A drawing, and how wide its pixels are where nobody says otherwise.
struct Drawing {
    text: String,
    width: u32,
}

impl Args {
    fn svg(&self, shots: &[Shot<'_>], overlays: &Overlays) -> Result<Drawing, Failure> {
        let theme = self.theme.into();
        if self.poster {
            let title = self.title.as_deref().unwrap_or("Best matches");
            return Ok(Drawing::of(&poster(title, shots, overlays), theme));
        }
        if let Some(count) = self.sequence {
            let shot = one(shots, "a sequence shows")?;
            let range = self.range(shot.playback.last())?;
            let sheet = sequence(shot, usize::from(count), range, overlays);
            return Ok(Drawing::of(&sheet, theme));
        }
        if self.steps.is_some() {
            return Err(
                Failure::usage("--steps is for sequences and animated pictures")
                    .hint("draw one step with --step"),
            );
        }
        let last = together(shots)?;
        let linked = self.source.step().map(StepChoice::At);
        let position = match self.step.or(linked).unwrap_or(StepChoice::Last) {
            StepChoice::Last => last,
            StepChoice::At(step) if step <= last => step,
            StepChoice::At(step) => return Err(beyond(step, last)),
        };
        if self.bare {
            let shot = one(shots, "--bare is for")?;
            return Ok(Drawing {
                text: shot.picture(position, overlays).to_svg_in(theme),
                width: 800,
            });
        }
        Ok(Drawing::of(&side_by_side(shots, position, overlays), theme))
    }

    /// The steps that are shown of a match whose last one that is.
    fn range(&self, last: usize) -> Result<(usize, usize), Failure> {
        let range = self.steps.unwrap_or(StepRange {
            first: 0,
            last: None,
        });
        let end = range.last.unwrap_or(last);
        match [range.first, end].into_iter().find(|&it| it > last) {
            Some(step) => Err(beyond(step, last)),
            None => Ok((range.first, end)),
        }
    }

    fn overlays(&self, is_animated: bool) -> Result<Overlays, Failure> {
        use OverlayChoice as Choice;
        let default: &[Choice] = match () {
            () if self.poster => &[Choice::Path, Choice::Optimum],
            () if is_animated || self.sequence.is_some() => {
                &[Choice::Knowledge, Choice::Path, Choice::Journal]
            }
            () => &[Choice::Path, Choice::Heat, Choice::Journal],
        };
        let chosen = self.overlay.as_deref().unwrap_or(default);
        let has = |choice| chosen.contains(&choice);
        if has(Choice::Heat) && has(Choice::Costs) {
            return Err(
                Failure::usage("overlays `heat` and `costs` both colour cells")
                    .hint("choose one of them"),
            );
        }
        if has(Choice::Knowledge) && has(Choice::Beliefs) {
            let message = "overlays `knowledge` and `beliefs` both say which walls are drawn";
            return Err(Failure::usage(message).hint("choose one of them"));
        }
        if has(Choice::None) && chosen.len() > 1 {
            return Err(Failure::usage("overlay `none` stands alone"));
        }
        Ok(chosen.iter().filter_map(|&it| it.into()).collect())
    }
}

impl Drawing {
    fn of(sheet: &Sheet, theme: Theme) -> Self {
        // Sharp on a screen of today, unless it is large anyway.
        let width = sheet.width();
        Self {
            text: sheet.to_svg(theme),
            width: if width < 1000 { 2 * width } else { width },
        }
    }
}

impl Loaded {
    fn new(replay: &Replay) -> Self {
        let parts = replay.parts();
        Self {
            robot: parts.robot.clone(),
            maze: parts.maze_name.clone(),
            playback: replay.playback(),
        }
    }

    fn shot(&self) -> Shot<'_> {
        Shot {
            robot: self.robot.as_guest(),
            maze: self.maze.as_guest(),
            playback: &self.playback,
        }
    }
}

/// The matches of a poster.
fn best(replays: &[Replay]) -> Result<Vec<&Replay>, Failure> {
    let best = best_of_mazes(replays);
    match best.len() {
        0 => Err(Failure::input(
            "no match for a poster: none of them is finished",
        )),
        1..=POSTER_MAX => Ok(best),
        found => Err(Failure::usage(format!(
            "a poster has room for {POSTER_MAX} mazes, found {found}"
        ))
        .hint("choose some with --match /MAZE")),
    }
}

/// The only match.
fn one<'a, 'b>(shots: &'a [Shot<'b>], what: &str) -> Result<&'a Shot<'b>, Failure> {
    match shots {
        [shot] => Ok(shot),
        _ => Err(
            Failure::usage(format!("{what} one match, found {}", shots.len()))
                .hint("choose one with --match ROBOT/MAZE/SEED"),
        ),
    }
}

/// The last step of the longest of some matches that can be drawn side by side.
fn together(shots: &[Shot<'_>]) -> Result<usize, Failure> {
    let Some(first) = shots.first() else {
        return Err(Failure::input("no match to draw"));
    };
    let digest = first.playback.maze().digest();
    if let Some(other) = shots
        .iter()
        .find(|it| it.playback.maze().digest() != digest)
    {
        let message = text!(
            "matches side by side are of one maze, found `{}` and `{}`",
            first.maze.escaped(),
            other.maze.escaped()
        );
        return Err(Failure::usage(message).hint(CHOOSE));
    }
    let longest = shots.iter().map(|it| it.playback.last()).max();
    Ok(longest.unwrap_or(0))
}

fn too_many(found: usize) -> Failure {
    let message = format!("at most {SIDE_BY_SIDE_MAX} matches fit side by side, found {found}");
    Failure::usage(message).hint(CHOOSE)
}

fn beyond(step: usize, last: usize) -> Failure {
    Failure::usage(format!(
        "there is no step {step}: the match has {last} steps"
    ))
    .hint(format!("use a number from 0 to {last}"))
}

/// Writes an animated picture, unless a signal asks to stop.
fn animate(
    args: &Args,
    format: Format,
    shots: &[Shot<'_>],
    overlays: Overlays,
) -> Result<Exit, Failure> {
    if args.step.is_some() {
        return Err(Failure::usage("an animated picture has no single step")
            .hint("choose its steps with --steps"));
    }
    let range = args.range(together(shots)?)?;
    let width = args.width.unwrap_or(FILM_WIDTH * shots.len() as u32);
    let look = (args.theme.into(), width);
    let film = Film::new(
        shots.to_vec(),
        overlays,
        range,
        usize::from(args.every.unwrap_or(1)),
        look,
    );
    // Before there is a file that a signal could leave behind.
    let interrupted = interrupt::listen()?;
    let mut draft = Draft::create(&args.output, Existing::from_flag(args.force))?;
    let bar = bar::new(
        film.len() as u64,
        ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left")
            .expect("a constant template"),
    );
    let frames = Frames {
        count: film.len(),
        draw: &|index| film.frame(index),
        progress: &|done| {
            bar.set_position(done as u64);
            !interrupted.is_set()
        },
    };
    // Hundredths of a second.
    let timing = Timing {
        delay: args.delay.unwrap_or(DELAY) / 10,
        hold: args.hold.unwrap_or(HOLD) / 10,
    };
    let written = match format {
        Format::Gif => animation::gif(&frames, timing, &mut draft),
        _ => animation::apng(&frames, timing, &mut draft),
    };
    bar.finish_and_clear();
    let path = Text::of_path(&args.output);
    match written {
        Ok(()) => {
            draft
                .flush()
                .map_err(|error| output::failure(&args.output, &error))?;
            draft.commit()?;
            message!("wrote {} ({})", path, counted(film.len(), "frame"));
            Ok(Exit::Success)
        }
        Err(AnimationError::Cancelled) => {
            message!("interrupted: `{}` is not written", path);
            Ok(Exit::Interrupted)
        }
        Err(AnimationError::Write(error)) => Err(output::failure(&args.output, &error)),
        Err(error) => {
            Err(Failure::usage(error).hint("make it smaller with --width, --steps or --every"))
        }
    }
}
