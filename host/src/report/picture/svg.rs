//! Pictures as SVG: self-contained, scalable, readable on a light and on a dark page.
//!
//! One file without scripts, fonts or links to anything. Colours are set in a
//! style sheet that follows the reader's preference for light or dark. A title
//! and a description stand for the picture where it cannot be seen, and start,
//! goal and painted cells carry their names as tooltips.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::maze::{Cell, Heading};

use crate::report::text_width::width_of;

use super::drawing::{Mark, Picture, Wall, cells};
use super::theme::Theme;

/// The side of a cell in SVG units.
const CELL: u32 = 20;

/// The empty border around the maze in SVG units.
const MARGIN: u32 = 6;

/// Levels of heat above cold.
const HEAT_LEVELS: u32 = 20;

impl Picture {
    /// The picture as an SVG document with a line feed at its end.
    pub fn to_svg(&self) -> String {
        self.to_svg_in(Theme::Auto)
    }

    /// The picture as an SVG document in a theme, with a line feed at its end.
    pub fn to_svg_in(&self, theme: Theme) -> String {
        self.svg(
            " xmlns=\"http://www.w3.org/2000/svg\"",
            &format!("<style>{}</style>\n", theme.style()),
        )
    }

    /// The picture as an element of an HTML page that has [`SVG_STYLE`](super::SVG_STYLE).
    pub fn to_svg_element(&self) -> String {
        self.svg("", "")
    }

    /// The picture as a part of a larger drawing that has [`SVG_STYLE`](super::SVG_STYLE): a square
    /// of that side with its upper left corner at `(x, y)`.
    pub(super) fn to_svg_group(&self, (x, y): (u32, u32), side: u32) -> String {
        let scale = f64::from(side) / f64::from(self.side());
        // A group and not an `svg` element, because that one would be clipped, which takes time.
        let mut svg = format!("<g transform=\"translate({x} {y}) scale({scale:.5})\">\n");
        self.content("", &mut svg);
        svg.push_str("</g>\n");
        svg
    }

    fn svg(&self, namespace: &str, style: &str) -> String {
        let side = self.side();
        // How large it is shown where nobody says otherwise.
        let shown = 2 * side;
        let mut svg = format!(
            "<svg{namespace} viewBox=\"0 0 {side} {side}\" \
             width=\"{shown}\" height=\"{shown}\" role=\"img\">\n"
        );
        self.content(style, &mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    /// The width and height of the drawing in its own units.
    fn side(&self) -> u32 {
        u32::from(self.dimension) * CELL + 2 * MARGIN
    }

    fn content(&self, style: &str, svg: &mut String) {
        self.head(style, svg);
        self.heat(svg);
        self.grounds(svg);
        self.walls_of(Wall::Unknown, "unknown", svg);
        self.dots(svg);
        self.walls_of(Wall::Closed, "wall", svg);
        self.perimeter(svg);
        self.optimum_line(svg);
        self.path_line(svg);
        self.texts(svg);
        self.robot_shape(svg);
    }

    fn head(&self, style: &str, svg: &mut String) {
        let side = self.side();
        let title = escaped(&self.title);
        let description = escaped(&self.description());
        write(
            svg,
            format_args!(
                "<title>{title}</title>\n<desc>{description}</desc>\n\
                 {style}<rect class=\"maze-ground\" width=\"{side}\" height=\"{side}\"/>\n"
            ),
        );
    }

    /// The heat of cells: for each level one path, because a page can have many pictures.
    fn heat(&self, svg: &mut String) {
        let mut levels: BTreeMap<u32, String> = BTreeMap::new();
        for cell in cells(self.dimension) {
            if let Some(level @ 1..) = self.heat_level(cell, HEAT_LEVELS) {
                let ((x, _), (_, y)) = (self.corner(cell), self.middle(cell));
                let lines = levels.entry(level).or_default();
                write(lines, format_args!("M{x} {y}h{CELL}"));
            }
        }
        for (level, lines) in levels {
            // Never so strong that a number on it would be hard to read.
            let share = level * 70 / HEAT_LEVELS;
            let look = format_args!("class=\"maze-heat\" stroke-opacity=\".{share:02}\"");
            write(svg, format_args!("<path {look} d=\"{lines}\"/>\n"));
        }
    }

    /// What fills cells: start, goal and paint.
    fn grounds(&self, svg: &mut String) {
        for cell in cells(self.dimension) {
            let Mark { paint, .. } = self.mark(cell);
            if cell == self.start {
                square(
                    svg,
                    cell,
                    self,
                    format_args!("class=\"maze-start\""),
                    "start",
                );
            }
            if self.goal.contains(cell) {
                square(svg, cell, self, format_args!("class=\"maze-goal\""), "goal");
            }
            if let Some(paint) = paint {
                let (hex, name) = (paint.hex(), paint.name());
                let look = format_args!("fill=\"{hex}\" fill-opacity=\".55\"");
                square(svg, cell, self, look, name);
            }
        }
    }

    fn walls_of(&self, kind: Wall, class: &str, svg: &mut String) {
        let n = self.dimension;
        let mut lines = String::new();
        // Walls in a straight line are drawn as one.
        for y in 0..n {
            let run = (0..n).map(|x| Cell::new(x, y));
            for (first, count) in self.wall_runs(run, Heading::Up, kind) {
                let (x, y) = self.corner(first);
                write(&mut lines, format_args!("M{x} {y}h{}", count * CELL));
            }
        }
        for x in 0..n {
            // From the top, because `y` grows downward in SVG.
            let run = (0..n).rev().map(|y| Cell::new(x, y));
            for (first, count) in self.wall_runs(run, Heading::Right, kind) {
                let (x, y) = self.corner(first);
                write(
                    &mut lines,
                    format_args!("M{} {y}v{}", x + CELL, count * CELL),
                );
            }
        }
        if !lines.is_empty() {
            write(
                svg,
                format_args!("<path class=\"maze-{class}\" d=\"{lines}\"/>\n"),
            );
        }
    }

    /// Neighbours of a row or column with such a wall on that side, as the first of them and their
    /// number.
    fn wall_runs(
        &self,
        cells: impl Iterator<Item = Cell>,
        side: Heading,
        kind: Wall,
    ) -> Vec<(Cell, u32)> {
        let mut runs: Vec<(Cell, u32)> = Vec::new();
        let mut is_running = false;
        for cell in cells {
            let has_wall = self.wall_place(cell, side).is_some() && self.wall(cell, side) == kind;
            match runs.last_mut() {
                Some((_, count)) if has_wall && is_running => *count += 1,
                _ if has_wall => runs.push((cell, 1)),
                _ => {}
            }
            is_running = has_wall;
        }
        runs
    }

    fn perimeter(&self, svg: &mut String) {
        let side = u32::from(self.dimension) * CELL;
        let corner = MARGIN;
        write(
            svg,
            format_args!(
                "<rect class=\"maze-wall\" x=\"{corner}\" y=\"{corner}\" width=\"{side}\" \
                 height=\"{side}\"/>\n"
            ),
        );
    }

    fn dots(&self, svg: &mut String) {
        for cell in cells(self.dimension).filter(|&cell| self.is_unknown(cell)) {
            let (x, y) = self.middle(cell);
            write(
                svg,
                format_args!("<circle class=\"maze-dot\" cx=\"{x}\" cy=\"{y}\" r=\"1\"/>\n"),
            );
        }
    }

    fn path_line(&self, svg: &mut String) {
        if self.stops.len() < 2 {
            return;
        }
        write(
            svg,
            format_args!(
                "<polyline class=\"maze-path\" points=\"{}\"/>\n",
                self.points(&self.stops)
            ),
        );
        let mut dots = String::new();
        for (x, y) in self.stops.iter().map(|&stop| self.middle(stop)) {
            write(&mut dots, format_args!("M{x} {y}h0"));
        }
        write(
            svg,
            format_args!("<path class=\"maze-stop\" d=\"{dots}\"/>\n"),
        );
    }

    fn optimum_line(&self, svg: &mut String) {
        if self.optimum.len() > 1 {
            let points = self.points(&self.optimum);
            write(
                svg,
                format_args!("<polyline class=\"maze-optimum\" points=\"{points}\"/>\n"),
            );
        }
    }

    fn points(&self, stops: &[Cell]) -> String {
        let middles = stops.iter().map(|&stop| self.middle(stop));
        let points: Vec<String> = middles.map(|(x, y)| format!("{x},{y}")).collect();
        points.join(" ")
    }

    fn texts(&self, svg: &mut String) {
        for cell in cells(self.dimension) {
            let Mark { number, label, .. } = self.mark(cell);
            let number = number.map(|number| number.to_string());
            let label = (!label.is_empty()).then(|| label.as_str());
            match (label, number.as_deref()) {
                (Some(label), Some(number)) => {
                    self.text(cell, label, -4, svg);
                    self.text(cell, number, 5, svg);
                }
                (Some(text), None) | (None, Some(text)) => self.text(cell, text, 0, svg),
                (None, None) if cell == self.start => self.text(cell, "S", 0, svg),
                (None, None) => {}
            }
        }
    }

    /// A text around the middle of a cell, moved down by some units, as small
    /// as it must be to fit.
    fn text(&self, cell: Cell, text: &str, down: i64, svg: &mut String) {
        let (x, y) = self.middle(cell);
        // As if all characters were as wide as a digit.
        let length = width_of(text).div_ceil(width_of("0"));
        // In tenths of a unit; a character is about 0.6 of the size wide.
        let size = (10 * (CELL - 2) * 10 / 6 / length.max(1)).min(85);
        let baseline = i64::from(y) * 10 + down * 10 + i64::from(size) * 35 / 100;
        let class = if self.stops.is_empty() {
            ""
        } else {
            " maze-on-path\" paint-order=\"stroke"
        };
        write(
            svg,
            format_args!(
                "<text class=\"maze-text{class}\" x=\"{x}\" y=\"{}.{}\" font-size=\"{}.{}\">{}</text>\n",
                baseline / 10,
                baseline % 10,
                size / 10,
                size % 10,
                escaped(text)
            ),
        );
    }

    fn robot_shape(&self, svg: &mut String) {
        let Some((cell, heading)) = self.robot.filter(|&(cell, _)| self.index(cell).is_some())
        else {
            return;
        };
        let (x, y) = self.middle(cell);
        // Tip, right wing, notch, left wing. Not turned by a transform: sines differ in their last
        // bits between machines, and so would pixels.
        let corners = [(0, -8), (6, 6), (0, 3), (-6, 6)].map(|(right, down)| {
            let (right, down) = match heading {
                Heading::Up => (right, down),
                Heading::Right => (-down, right),
                Heading::Down => (-right, -down),
                Heading::Left => (down, -right),
            };
            format!("{} {}", i64::from(x) + right, i64::from(y) + down)
        });
        let outline = corners.join("L");
        write(
            svg,
            format_args!("<path class=\"maze-robot\" d=\"M{outline}Z\"/>\n"),
        );
    }

    /// The upper left corner of a cell: `y` grows downward in SVG.
    fn corner(&self, cell: Cell) -> (u32, u32) {
        let row = u32::from(self.dimension - 1 - cell.y);
        (MARGIN + u32::from(cell.x) * CELL, MARGIN + row * CELL)
    }

    fn middle(&self, cell: Cell) -> (u32, u32) {
        let (x, y) = self.corner(cell);
        (x + CELL / 2, y + CELL / 2)
    }
}

/// A coloured cell with a tooltip.
fn square(
    svg: &mut String,
    cell: Cell,
    picture: &Picture,
    look: std::fmt::Arguments<'_>,
    tooltip: &str,
) {
    let (x, y) = picture.corner(cell);
    let place = format!("x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\"");
    write(
        svg,
        format_args!("<rect {look} {place}><title>{tooltip}</title></rect>\n"),
    );
}

fn write(text: &mut String, part: std::fmt::Arguments<'_>) {
    text.write_fmt(part)
        .expect("writing to a string never fails");
}

/// The text for use between XML tags and in attributes.
pub(in crate::report) fn escaped<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = text.into().raw();
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            _ => safe.push(character),
        }
    }
    safe
}
