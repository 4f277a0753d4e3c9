//! Pictures as SVG: self-contained, scalable, readable on a light and on a dark page.
//!
//! One file without scripts, fonts or links to anything. Colours are set in a
//! style sheet that follows the reader's preference for light or dark. A title
//! and a description stand for the picture where it cannot be seen, and start,
//! goal and painted cells carry their names as tooltips.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use wasmouse_core::maze::{Cell, Heading};

use super::drawing::{Mark, Picture, Wall, cells};

/// The side of a cell in SVG units.
const CELL: u32 = 20;

/// The empty border around the maze in SVG units.
const MARGIN: u32 = 6;

/// Levels of heat above cold.
const HEAT_LEVELS: u32 = 20;

/// The style sheet of all pictures. A page that [embeds](Picture::to_svg_element) some needs it
/// once; its classes begin with `maze-`, so that they are of no concern to the rest of the page.
pub const SVG_STYLE: &str = "\
.maze-ground{fill:#fff}.maze-start{fill:#3e7bfa;fill-opacity:.3}
.maze-goal{fill:#30a46c;fill-opacity:.3}
.maze-heat{fill:none;stroke:#e5484d;stroke-width:20}
.maze-wall{fill:none;stroke:#1b1c20;stroke-width:2;stroke-linecap:round}
.maze-unknown{fill:none;stroke:#8b8d98;stroke-width:2;stroke-linecap:round;stroke-dasharray:0 5}
.maze-dot{fill:#8b8d98}
.maze-path{fill:none;stroke:#3e7bfa;stroke-width:3;stroke-linejoin:round;stroke-linecap:round}
.maze-stop{fill:none;stroke:#3e7bfa;stroke-width:9;stroke-linecap:round}
.maze-optimum{fill:none;stroke:#218358;stroke-width:7;stroke-linejoin:round;stroke-opacity:.55}
.maze-robot{fill:#d6409f;stroke:#fff;stroke-width:1}
.maze-text{font-family:ui-sans-serif,system-ui,sans-serif;text-anchor:middle;fill:#1b1c20}
.maze-on-path{stroke:#fff;stroke-width:2;stroke-linejoin:round}
@media screen and (prefers-color-scheme:dark){.maze-ground{fill:#16171b}.maze-wall{stroke:#e8e8ec}
.maze-optimum{stroke:#3dd68c}.maze-text{fill:#f2f2f5}.maze-on-path,.maze-robot{stroke:#16171b}}";

impl Picture {
    /// The picture as an SVG document with a line feed at its end.
    pub fn to_svg(&self) -> String {
        self.svg(
            " xmlns=\"http://www.w3.org/2000/svg\"",
            &format!("<style>{SVG_STYLE}</style>\n"),
        )
    }

    /// The picture as an element of an HTML page that has [`SVG_STYLE`].
    pub fn to_svg_element(&self) -> String {
        self.svg("", "")
    }

    fn svg(&self, namespace: &str, style: &str) -> String {
        let mut svg = String::new();
        self.head(namespace, style, &mut svg);
        self.heat(&mut svg);
        self.grounds(&mut svg);
        self.walls_of(Wall::Unknown, "unknown", &mut svg);
        self.dots(&mut svg);
        self.walls_of(Wall::Closed, "wall", &mut svg);
        self.perimeter(&mut svg);
        self.optimum_line(&mut svg);
        self.path_line(&mut svg);
        self.texts(&mut svg);
        self.robot_shape(&mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    fn head(&self, namespace: &str, style: &str, svg: &mut String) {
        let side = u32::from(self.dimension) * CELL + 2 * MARGIN;
        // How large it is shown where nobody says otherwise.
        let shown = 2 * side;
        let title = escaped(&self.title);
        let description = escaped(&self.description());
        write(
            svg,
            format_args!(
                "<svg{namespace} viewBox=\"0 0 {side} {side}\" \
                 width=\"{shown}\" height=\"{shown}\" role=\"img\">\n\
                 <title>{title}</title>\n<desc>{description}</desc>\n\
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
        let length = u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
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
        let degrees = heading as u32 * 90;
        write(
            svg,
            format_args!(
                "<path class=\"maze-robot\" d=\"M0 -8L6 6L0 3L-6 6Z\" \
                 transform=\"translate({x} {y}) rotate({degrees})\"/>\n"
            ),
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
fn escaped(text: &str) -> String {
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
