//! Pictures as SVG: self-contained, scalable, readable on a light and on a dark page.
//!
//! One file without scripts, fonts or links to anything. Colours are set in a
//! style sheet that follows the reader's preference for light or dark. A title
//! and a description stand for the picture where it cannot be seen, and start,
//! goal and painted cells carry their names as tooltips.

use std::fmt::Write as _;

use wasmouse_core::maze::{Cell, Heading};

use super::drawing::{Mark, Picture, Wall, cells};

/// The side of a cell in SVG units.
const CELL: u32 = 20;

/// The empty border around the maze in SVG units.
const MARGIN: u32 = 6;

/// Levels of heat above cold.
const HEAT_LEVELS: u32 = 100;

const STYLE: &str = "\
.ground{fill:#fff}.start{fill:#3e7bfa;fill-opacity:.3}.goal{fill:#30a46c;fill-opacity:.3}
.heat{fill:#e5484d}
.wall{fill:none;stroke:#1b1c20;stroke-width:2;stroke-linecap:round}
.unknown{fill:none;stroke:#8b8d98;stroke-width:2;stroke-linecap:round;stroke-dasharray:0 5}
.dot{fill:#8b8d98}
.path{fill:none;stroke:#3e7bfa;stroke-width:3;stroke-linejoin:round;stroke-linecap:round}
.stop{fill:#3e7bfa}
.robot{fill:#d6409f;stroke:#fff;stroke-width:1}
text{font-family:ui-sans-serif,system-ui,sans-serif;text-anchor:middle;fill:#1b1c20}
.on-path{paint-order:stroke;stroke:#fff;stroke-width:2;stroke-linejoin:round}
@media (prefers-color-scheme:dark){.ground{fill:#16171b}.wall{stroke:#e8e8ec}
text{fill:#f2f2f5}.on-path,.robot{stroke:#16171b}}";

impl Picture {
    /// The picture as an SVG document with a line feed at its end.
    pub fn to_svg(&self) -> String {
        let mut svg = String::new();
        self.head(&mut svg);
        self.grounds(&mut svg);
        self.walls_of(Wall::Unknown, "unknown", &mut svg);
        self.dots(&mut svg);
        self.walls_of(Wall::Closed, "wall", &mut svg);
        self.perimeter(&mut svg);
        self.path_line(&mut svg);
        self.texts(&mut svg);
        self.robot_shape(&mut svg);
        svg.push_str("</svg>\n");
        svg
    }

    fn head(&self, svg: &mut String) {
        let side = u32::from(self.dimension) * CELL + 2 * MARGIN;
        // How large it is shown where nobody says otherwise.
        let shown = 2 * side;
        let title = escaped(&self.title);
        let description = escaped(&self.description());
        write(
            svg,
            format_args!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {side} {side}\" \
                 width=\"{shown}\" height=\"{shown}\" role=\"img\">\n\
                 <title>{title}</title>\n<desc>{description}</desc>\n\
                 <style>{STYLE}</style>\n\
                 <rect class=\"ground\" width=\"{side}\" height=\"{side}\"/>\n"
            ),
        );
    }

    /// What fills cells: start, goal, heat and paint.
    fn grounds(&self, svg: &mut String) {
        for cell in cells(self.dimension) {
            let Mark { paint, .. } = self.mark(cell);
            let heat = self.heat_level(cell, HEAT_LEVELS);
            if cell == self.start {
                square(svg, cell, self, format_args!("class=\"start\""), "start");
            }
            if self.goal.contains(cell) {
                square(svg, cell, self, format_args!("class=\"goal\""), "goal");
            }
            if let Some(level @ 1..) = heat {
                // Never so strong that a number on it would be hard to read.
                let share = level * 7 / 10;
                let look = format_args!("class=\"heat\" fill-opacity=\".{share:02}\"");
                square(svg, cell, self, look, "");
            }
            if let Some(paint) = paint {
                let (hex, name) = (paint.hex(), paint.name());
                let look = format_args!("fill=\"{hex}\" fill-opacity=\".55\"");
                square(svg, cell, self, look, name);
            }
        }
    }

    fn walls_of(&self, kind: Wall, class: &str, svg: &mut String) {
        let mut lines = String::new();
        for cell in cells(self.dimension) {
            let (x, y) = self.corner(cell);
            if self.wall_place(cell, Heading::Up).is_some() && self.wall(cell, Heading::Up) == kind
            {
                write(&mut lines, format_args!("M{x} {y}h{CELL}"));
            }
            if self.wall_place(cell, Heading::Right).is_some()
                && self.wall(cell, Heading::Right) == kind
            {
                write(&mut lines, format_args!("M{} {y}v{CELL}", x + CELL));
            }
        }
        if !lines.is_empty() {
            write(
                svg,
                format_args!("<path class=\"{class}\" d=\"{lines}\"/>\n"),
            );
        }
    }

    fn perimeter(&self, svg: &mut String) {
        let side = u32::from(self.dimension) * CELL;
        let corner = MARGIN;
        write(
            svg,
            format_args!(
                "<rect class=\"wall\" x=\"{corner}\" y=\"{corner}\" width=\"{side}\" \
                 height=\"{side}\"/>\n"
            ),
        );
    }

    fn dots(&self, svg: &mut String) {
        for cell in cells(self.dimension).filter(|&cell| self.is_unknown(cell)) {
            let (x, y) = self.middle(cell);
            write(
                svg,
                format_args!("<circle class=\"dot\" cx=\"{x}\" cy=\"{y}\" r=\"1\"/>\n"),
            );
        }
    }

    fn path_line(&self, svg: &mut String) {
        if self.stops.len() < 2 {
            return;
        }
        let middles = self.stops.iter().map(|&stop| self.middle(stop));
        let points: Vec<String> = middles.clone().map(|(x, y)| format!("{x},{y}")).collect();
        let points = points.join(" ");
        write(
            svg,
            format_args!("<polyline class=\"path\" points=\"{points}\"/>\n"),
        );
        for (x, y) in middles {
            write(
                svg,
                format_args!("<circle class=\"stop\" cx=\"{x}\" cy=\"{y}\" r=\"4.5\"/>\n"),
            );
        }
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
            " class=\"on-path\""
        };
        write(
            svg,
            format_args!(
                "<text{class} x=\"{x}\" y=\"{}.{}\" font-size=\"{}.{}\">{}</text>\n",
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
                "<path class=\"robot\" d=\"M0 -8L6 6L0 3L-6 6Z\" \
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

/// A coloured cell, with a tooltip unless that is empty.
fn square(
    svg: &mut String,
    cell: Cell,
    picture: &Picture,
    look: std::fmt::Arguments<'_>,
    tooltip: &str,
) {
    let (x, y) = picture.corner(cell);
    let place = format!("x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\"");
    if tooltip.is_empty() {
        write(svg, format_args!("<rect {look} {place}/>\n"));
    } else {
        write(
            svg,
            format_args!("<rect {look} {place}><title>{tooltip}</title></rect>\n"),
        );
    }
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
