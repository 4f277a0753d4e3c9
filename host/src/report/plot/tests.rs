//! Plots of a small contest.

use super::*;
use crate::contest::{Benchmark, ScoreMatrix};
use crate::report::picture::Theme;
use crate::report::sample_matrix::matrix;

const KINDS: [Kind; 8] = [
    Kind::Bars(Measure::Score),
    Kind::Bars(Measure::Exploration),
    Kind::Bars(Measure::Speed),
    Kind::Margins(Benchmark::Lower),
    Kind::Margins(Benchmark::Upper),
    Kind::Runs,
    Kind::Fuel,
    Kind::Regret,
];

fn plot(kind: Kind, matrix: &ScoreMatrix) -> String {
    svg(kind, matrix, &Options::default()).expect("finished matches")
}

#[test]
fn every_kind_is_drawn_in_both_themes() {
    let matrix = matrix(&[12, 12, 14, 16]);
    for kind in KINDS {
        let light = plot(kind, &matrix);
        assert!(
            light.starts_with("<svg width=\"800\" "),
            "{kind:?}: {light}"
        );
        assert!(
            light.ends_with("</svg>\n") && light.contains("<title>"),
            "{kind:?}"
        );
        // All robots are in the legend.
        for name in ["a", "b", "c"] {
            assert!(
                light.contains(&format!(">\n{name}\n</text>")),
                "{kind:?}: {name}"
            );
        }
        assert_eq!(light, plot(kind, &matrix), "{kind:?}");
        let theme = Theme::Dark;
        let title = Some("dark".to_owned());
        let dark = svg(kind, &matrix, &Options { title, theme }).expect("finished matches");
        assert!(
            dark.contains("<title>dark</title>") && dark.contains("#16171B"),
            "{kind:?}"
        );
    }
}

#[test]
fn names_are_text_and_many_robots_are_counted() {
    let mut hostile = matrix(&[12, 14]);
    let long = "x".repeat(10_000);
    let names = ["</text><script>\u{1b}[31m\u{202e}", "\"&'<!--", &long];
    for (robot, name) in hostile.robots.iter_mut().zip(names) {
        robot.name = name.into();
    }
    hostile.mazes[0].name = "]]><image href='x'/>\u{0}".into();
    for kind in KINDS {
        let svg = plot(kind, &hostile);
        assert!(!svg.contains("<script") && !svg.contains("<image") && !svg.contains("<!--"));
        assert!(!svg.contains(['\u{0}', '\u{1b}', '\u{202e}']), "{kind:?}");
        assert!(svg.len() < 60_000, "{kind:?}: {}", svg.len());
        crate::report::raster::draw(&svg, 800).expect("an SVG document");
    }
}

#[test]
fn without_finished_matches_there_is_no_plot() {
    let empty = matrix(&[]);
    for kind in KINDS {
        let failure = svg(kind, &empty, &Options::default()).expect_err("nothing to plot");
        assert_eq!(failure, PlotError::Empty);
    }
}

/// What a damaged result file may claim.
#[test]
fn extreme_numbers_are_drawn() {
    let mut extreme = matrix(&[12, 255]);
    for (robot, steps) in [(0, u32::MAX), (1, 0)] {
        let mut played = *extreme.get(robot, 0, 0).expect("it was played");
        played.steps.speed = steps;
        played.steps.exploration = steps;
        played.fuel.steps = u64::from(steps) << 32;
        played.fuel.start = u64::MAX;
        extreme.set(robot, 0, 0, played);
    }
    extreme.rules.game.exploration_divisor = u32::MAX;
    extreme.mazes[0].oracle = Some(extreme.rules.game.score(u32::MAX, 0));
    extreme.mazes[1].oracle = Some(extreme.rules.game.score(0, 0));
    for kind in KINDS {
        let svg = plot(kind, &extreme);
        assert!(svg.len() < 100_000, "{kind:?}: {}", svg.len());
        crate::report::raster::draw(&svg, 400).expect("an SVG document");
    }
}
