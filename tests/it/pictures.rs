//! Pictures and plots: snapshots of SVG, pixels, animated files read again, hostile text.

use std::collections::BTreeSet;

use insta::{Settings, assert_snapshot};
use wasmouse::contest::{
    Benchmark, MatchScore, MatrixMaze, MatrixRobot, Outcome, ScoreMatrix, Seeds,
};
use wasmouse::report::animation::{Frames, Timing, apng, gif};
use wasmouse::report::picture::Theme;
use wasmouse::report::plot::{self, Kind, Measure};
use wasmouse::report::raster::{Image, draw, png};
use wasmouse::report::scene::{Film, Overlay, Overlays, Shot, poster, sequence, side_by_side};
use wasmouse_core::Digest;
use wasmouse_core::game::{Action, GameRules, Ruleset, Steps};
use wasmouse_core::journal::{Color, Journal, Note};
use wasmouse_core::maze::{Cell, Turn, format};
use wasmouse_core::playback::Playback;
use wasmouse_core::record::{FuelUse, Transcript, trace};

/// Text that is markup, controls a terminal, turns the direction of writing, and is far too long.
fn hostile() -> String {
    let text = "</text></svg><script>alert(1)</script>]]>&lt;\"'\u{1b}[31m\u{202e}\u{0}<!--";
    format!("{text}{}", "x".repeat(10_000))
}

const SMALL: &str = "\
o---o---o---o---o
|           |   |
o   o   o   o   o
|     G   G     |
o   o---o   o   o
|   | G   G |   |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

/// A finished match: up, right into the goal, a look around, the reset, and the speed run.
fn small_match(label: &str) -> Playback {
    let maze = format::parse(SMALL).expect("a maze").maze;
    let mut transcript = Transcript::default();
    let drive = |turn, advance| Action::Move { turn, advance };
    for action in [
        drive(Turn::Straight, 2),
        drive(Turn::Right, 2),
        drive(Turn::Left, -1),
        drive(Turn::Left, 1),
        Action::Reset,
        drive(Turn::Straight, 2),
        drive(Turn::Right, 1),
    ] {
        transcript.push(action);
    }
    let rules = GameRules::default();
    let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
    let mut journal = Journal::default();
    journal.clear(100_000);
    let cell = Cell::new(3, 0);
    journal.push(
        1,
        Note::Label {
            cell,
            text: label.into(),
        },
    );
    let color = Color::Violet;
    journal.push(2, Note::Paint { cell, color });
    Playback::new(maze, rules, trace, result.verdict, journal)
}

fn overlays(overlays: &[Overlay]) -> Overlays {
    overlays.iter().copied().collect()
}

const ALL: [Overlay; 6] = [
    Overlay::Path,
    Overlay::Knowledge,
    Overlay::Heat,
    Overlay::Distances,
    Overlay::Optimum,
    Overlay::Journal,
];

/// Three robots, of which one does not finish everything, in five mazes of three sizes.
fn matrix(names: [&str; 3]) -> ScoreMatrix {
    let rules = Ruleset::default();
    let robots = names.map(|name| {
        let digest = Digest::of(name.as_bytes());
        MatrixRobot::new(name.to_owned(), digest, 0)
    });
    let seeds = Seeds { first: 0, count: 1 };
    let mut matrix = ScoreMatrix::new(rules.clone(), seeds, robots.into());
    for (place, dimension) in (0..).zip([12_u8, 12, 14, 14, 16]) {
        let name = format!("maze-{place}");
        let maze = matrix.push_maze(MatrixMaze {
            digest: Digest::of(name.as_bytes()),
            name: name.into(),
            dimension,
            oracle: Some(rules.game.score(17 + place, 18 + place)),
            set: 0,
        });
        for (robot, worse) in [(0, 0), (1, 4), (2, 9)] {
            let outcome = match (robot, place) {
                (2, 3..) => Outcome::BudgetUsedUp { goal_reached: true },
                _ => Outcome::Finished,
            };
            let steps = Steps {
                exploration: 90 + 25 * worse + 10 * place,
                speed: 17 + place + worse,
            };
            let score = MatchScore {
                outcome,
                steps,
                fuel: FuelUse {
                    start: 1000,
                    steps: 10_u64.pow(3 + worse / 2) * u64::from(40 + place),
                    step_max: 900,
                },
                memory_bytes: 65_536,
            };
            matrix.set(robot, maze, 0, score);
        }
    }
    matrix
}

const KINDS: [(&str, Kind); 8] = [
    ("scores", Kind::Bars(Measure::Score)),
    ("exploration", Kind::Bars(Measure::Exploration)),
    ("speed", Kind::Bars(Measure::Speed)),
    ("margins", Kind::Margins(Benchmark::Lower)),
    ("margins-upper", Kind::Margins(Benchmark::Upper)),
    ("runs", Kind::Runs),
    ("fuel", Kind::Fuel),
    ("regret", Kind::Regret),
];

fn snapshot(name: &str, svg: &str) {
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| assert_snapshot!(format!("picture-{name}"), svg));
}

#[test]
fn scenes_sequences_and_posters() {
    let playback = small_match("a&b");
    let shot = Shot {
        robot: "flood".into(),
        maze: "small".into(),
        playback: &playback,
    };
    snapshot(
        "scene",
        &shot.picture(2, &overlays(&ALL)).to_svg_in(Theme::Auto),
    );
    let costs = overlays(&[Overlay::Costs, Overlay::Optimum]);
    snapshot("costs", &shot.picture(0, &costs).to_svg_in(Theme::Dark));
    let path = overlays(&[Overlay::Path, Overlay::Knowledge]);
    let sheet = sequence(&shot, 4, (0, playback.last()), &path);
    snapshot("sequence", &sheet.to_svg(Theme::Light));
    let sheet = poster("Best", &[shot, shot], &path);
    snapshot("poster", &sheet.to_svg(Theme::Auto));
}

#[test]
fn plots() {
    let matrix = matrix(["flood", "dfs", "random"]);
    for (name, kind) in KINDS {
        let svg = plot::svg(kind, &matrix, &plot::Options::default()).expect("finished matches");
        snapshot(&format!("plot-{name}"), &svg);
    }
}

/// Robot, maze, title and label are hostile: every document is still well-formed, has the elements
/// of a harmless one, and no control character.
#[test]
fn hostile_text_is_text() {
    let hostile = hostile();
    let elements = |svg: &str| -> BTreeSet<String> {
        let tags = svg.split('<').skip(1);
        let names = tags.map(|tag| {
            tag.split([' ', '>', '/'])
                .next()
                .unwrap_or_default()
                .to_owned()
        });
        names.collect()
    };
    let documents = |text: &str| {
        let playback = small_match(text);
        let shot = Shot {
            robot: text.into(),
            maze: text.into(),
            playback: &playback,
        };
        let all = overlays(&ALL);
        let mut documents = vec![
            shot.picture(3, &all).to_svg_in(Theme::Auto),
            side_by_side(&[shot, shot], 3, &all).to_svg(Theme::Auto),
            sequence(&shot, 3, (0, 5), &all).to_svg(Theme::Light),
            poster(text, &[shot], &all).to_svg(Theme::Dark),
        ];
        let mut matrix = matrix([text, "b", "c"]);
        matrix.mazes[0].name = text.into();
        let title = Some(text.to_owned());
        for (_, kind) in KINDS {
            let options = plot::Options {
                title: title.clone(),
                theme: Theme::Light,
            };
            documents.push(plot::svg(kind, &matrix, &options).expect("finished matches"));
        }
        documents
    };
    for (bad, good) in documents(&hostile).iter().zip(documents("good")) {
        assert_eq!(elements(bad), elements(&good));
        let is_hostile = |it: char| (it.is_control() && it != '\n') || it == '\u{202e}';
        assert!(!bad.contains(is_hostile), "{bad}");
        let (image, harmless) = (draw(bad, 300), draw(&good, 300));
        let size = |it: &Image| (it.width(), it.height());
        assert_eq!(image.as_ref().map(size), harmless.as_ref().map(size));
    }
}

/// Pixels of what is drawn without smoothing: the middle of areas, and the walls.
#[test]
fn pixels_have_the_colours_of_the_theme() {
    let playback = small_match("");
    let shot = Shot {
        robot: "flood".into(),
        maze: "small".into(),
        playback: &playback,
    };
    for (theme, ground, wall) in [
        (Theme::Light, [255; 3], [0x1b, 0x1c, 0x20]),
        (Theme::Dark, [0x16, 0x17, 0x1b], [0xe8, 0xe8, 0xec]),
    ] {
        let svg = shot.picture(0, &overlays(&[])).to_svg_in(theme);
        // Ten pixels for each unit; a cell has 20 units, the margin 6.
        let image = draw(&svg, 920).expect("drawn");
        assert_eq!((image.width(), image.height()), (920, 920));
        let at = |x: u32, y: u32| image.pixel(x, y);
        assert_eq!(at(10, 10), Some(ground), "the margin");
        assert_eq!(at(60, 460), Some(wall), "the left wall");
        assert_eq!(at(660, 160), Some(wall), "the wall at the upper right");
        assert_eq!(at(360, 760), Some(ground), "an empty cell");
        // The robot in the start, which looks up.
        assert_eq!(at(160, 760), Some([0xd6, 0x40, 0x9f]), "the robot");
        assert_eq!(draw(&svg, 920).as_ref(), Ok(&image), "drawn again");
        let bytes = png(&image);
        let decoder = ::png::Decoder::new(std::io::Cursor::new(&bytes));
        let mut reader = decoder.read_info().expect("a PNG file");
        let mut pixels = vec![0; 920 * 920 * 3];
        reader.next_frame(&mut pixels).expect("an image");
        assert_eq!(pixels, image.pixels().as_flattened());
    }
}

/// A text is drawn, so the font is there: a cell with a number has dark pixels.
#[test]
fn numbers_are_drawn_with_the_bundled_font() {
    let playback = small_match("");
    let shot = Shot {
        robot: "r".into(),
        maze: "m".into(),
        playback: &playback,
    };
    let count = |names: &[Overlay]| {
        let svg = shot.picture(0, &overlays(names)).to_svg_in(Theme::Light);
        let image = draw(&svg, 920).expect("drawn");
        // Inside of the cell (3, 3), away from its walls.
        let pixels = (680..840).flat_map(|x| (80..240).map(move |y| (x, y)));
        let dark = pixels.filter(|&(x, y)| image.pixel(x, y).is_some_and(|it| it[0] < 100));
        dark.count()
    };
    assert_eq!(count(&[]), 0);
    let dark = count(&[Overlay::Distances]);
    assert!((300..6000).contains(&dark), "{dark}");
}

/// GIF and animated PNG files of two matches side by side, read again: number, size and delays of
/// frames, and the last one is the still picture.
#[test]
fn animated_files_end_with_the_still_picture() {
    let playback = small_match("");
    let shots = ["a", "b"].map(|robot| Shot {
        robot: robot.into(),
        maze: "small".into(),
        playback: &playback,
    });
    let shown = overlays(&[Overlay::Path, Overlay::Knowledge]);
    let last = playback.last();
    let look = (Theme::Light, 400);
    let film = Film::new(shots.to_vec(), shown.clone(), (0, last), 2, look);
    assert_eq!((last, film.len()), (7, 5), "steps 0, 2, 4, 6 and 7");
    let still = draw(
        &side_by_side(&shots, last, &shown).to_svg(Theme::Light),
        400,
    );
    let still = still.expect("drawn");
    let frames = Frames {
        count: film.len(),
        draw: &|index| film.frame(index),
        progress: &|_| true,
    };
    let timing = Timing {
        delay: 7,
        hold: 200,
    };
    let (mut gif_bytes, mut png_bytes) = (Vec::new(), Vec::new());
    gif(&frames, timing, &mut gif_bytes).expect("written");
    apng(&frames, timing, &mut png_bytes).expect("written");

    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(gif_bytes.as_slice()).expect("a GIF file");
    let size = (u32::from(decoder.width()), u32::from(decoder.height()));
    assert_eq!(size, (still.width(), still.height()));
    let mut canvas = vec![[0; 3]; still.pixels().len()];
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("valid") {
        delays.push(frame.delay);
        let place = [frame.left, frame.top, frame.width, frame.height].map(u32::from);
        paint(&mut canvas, still.width(), place, &frame.buffer);
    }
    assert_eq!(delays, [7, 7, 7, 7, 200]);
    // Shades along lines may be rounded; areas are exact.
    let differences = canvas.iter().zip(still.pixels());
    let worst = differences.map(|(a, b)| (0..3).map(|it| a[it].abs_diff(b[it])).max());
    assert!(worst.max().flatten() <= Some(40));
    let exact = canvas.iter().zip(still.pixels()).filter(|(a, b)| a == b);
    assert!(exact.count() * 100 > canvas.len() * 97);

    let decoder = ::png::Decoder::new(std::io::Cursor::new(&png_bytes));
    let mut reader = decoder.read_info().expect("a PNG file");
    let count = reader.info().animation_control().map(|it| it.num_frames);
    assert_eq!(count, Some(5));
    let mut canvas = vec![[0; 3]; still.pixels().len()];
    for _ in 0..5 {
        let mut bytes = vec![0; still.pixels().len() * 4];
        let read = reader.next_frame(&mut bytes).expect("a frame");
        let at = reader.info().frame_control().expect("of an animation");
        let place = [at.x_offset, at.y_offset, at.width, at.height];
        paint(
            &mut canvas,
            still.width(),
            place,
            &bytes[..read.buffer_size()],
        );
    }
    assert_eq!(canvas, still.pixels());
}

/// Paints the opaque pixels of a rectangle over a canvas of that width.
fn paint(canvas: &mut [[u8; 3]], width: u32, [left, top, across, _]: [u32; 4], rgba: &[u8]) {
    for (index, color) in (0..).zip(rgba.chunks(4)) {
        let (x, y) = (left + index % across, top + index / across);
        if color[3] > 0 {
            canvas[(y * width + x) as usize] = [color[0], color[1], color[2]];
        }
    }
}
