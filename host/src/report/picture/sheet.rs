//! [`Sheet`]: pictures in a grid, each with a caption, as one drawing.

use std::fmt::Write as _;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{GuestText, guest_text};

use crate::report::text_width::cut;

use super::drawing::Picture;
use super::label::replace_hostile;
use super::svg::escaped;
use super::theme::Theme;

/// The side of a picture in SVG units, whatever the size of its maze.
const SIDE: u32 = 400;

/// Between pictures, and around the drawing.
const GAP: u32 = 20;

/// Letters, in SVG units.
const TITLE_SIZE: u32 = 26;
const NAME_SIZE: u32 = 19;
const DETAIL_SIZE: u32 = 17;

/// From one line of text to the next, in percent of its size.
const LINE_PERCENT: u32 = 140;

const LIGHT: &str = ".sheet-ground{fill:#fff}.sheet-text{font-family:ui-sans-serif,system-ui,\
sans-serif;fill:#1b1c20}.sheet-detail{fill:#60646c}\n";
const DARK: &str =
    ".sheet-ground{fill:#16171b}.sheet-text{fill:#f2f2f5}.sheet-detail{fill:#b0b4ba}";

/// Pictures in rows, each as large as the others, with captions below.
///
/// Texts may be untrusted: they are cut to the width that they have, and escaped.
#[derive(Clone, Debug)]
pub struct Sheet {
    title: String,
    columns: usize,
    panels: Vec<Panel>,
}

#[derive(Clone, Debug)]
struct Panel {
    picture: Picture,
    caption: Caption,
}

/// The lines below a picture. Empty ones take no room if no caption of the sheet has them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Caption {
    /// What is shown.
    pub name: GuestText,
    /// What happened, in smaller letters.
    pub detail: String,
}

impl Sheet {
    /// An empty drawing with that many pictures in a row, at least 1. The empty title takes no room.
    pub fn new<'a>(title: impl Into<GuestStr<'a>>, columns: usize) -> Self {
        Self {
            title: replace_hostile(title),
            columns: columns.max(1),
            panels: Vec::new(),
        }
    }

    /// Adds a picture.
    pub fn push(&mut self, mut picture: Picture, caption: Caption) {
        let Caption { name, detail } = &caption;
        match (name.is_empty(), detail.is_empty()) {
            (true, true) => {}
            (true, false) => picture.set_title(detail),
            (false, true) => picture.set_title(name),
            (false, false) => picture.set_title(&guest_text!("{}: {}", name, detail)),
        }
        self.panels.push(Panel { picture, caption });
    }

    /// How many pictures there are.
    pub const fn len(&self) -> usize {
        self.panels.len()
    }

    /// Whether there is no picture.
    pub const fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// The width in SVG units.
    pub fn width(&self) -> u32 {
        let columns = self.columns.min(self.panels.len()).max(1) as u32;
        columns * (SIDE + GAP) + GAP
    }

    /// The drawing as an SVG document with a line feed at its end.
    pub fn to_svg(&self, theme: Theme) -> String {
        let (width, title_height) = (self.width(), self.title_height());
        let has = |part: fn(&Caption) -> bool| self.panels.iter().any(|it| part(&it.caption));
        let name_height = line(NAME_SIZE) * u32::from(has(|it| !it.name.is_empty()));
        let detail_height = line(DETAIL_SIZE) * u32::from(has(|it| !it.detail.is_empty()));
        let row_height = SIDE + name_height + detail_height + GAP;
        let rows = self.panels.len().div_ceil(self.columns) as u32;
        let height = GAP + title_height + rows * row_height;
        let title = match self.title.as_str() {
            "" => "pictures of matches",
            title => title,
        };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" role=\"img\">\n\
             <title>{}</title>\n<style>{}{}</style>\n\
             <rect class=\"sheet-ground\" width=\"{width}\" height=\"{height}\"/>\n",
            escaped(title),
            theme.style(),
            theme.of(LIGHT, DARK),
        );
        if title_height > 0 {
            let place = (GAP, GAP, width - 2 * GAP);
            text("", TITLE_SIZE, place, &self.title, &mut svg);
        }
        for (index, panel) in self.panels.iter().enumerate() {
            let (column, row) = (index % self.columns, index / self.columns);
            let x = GAP + column as u32 * (SIDE + GAP);
            let y = GAP + title_height + row as u32 * row_height;
            svg += &panel.picture.to_svg_group((x, y), SIDE);
            let Caption { name, detail } = &panel.caption;
            // In line with the outer walls.
            let place = |y| (x + 8, y, SIDE - 8);
            text("", NAME_SIZE, place(y + SIDE), name, &mut svg);
            let y = y + SIDE + name_height;
            text(" sheet-detail", DETAIL_SIZE, place(y), detail, &mut svg);
        }
        svg.push_str("</svg>\n");
        svg
    }

    const fn title_height(&self) -> u32 {
        if self.title.is_empty() {
            0
        } else {
            line(TITLE_SIZE) + GAP / 2
        }
    }
}

/// The height of a line of text.
const fn line(size: u32) -> u32 {
    size * LINE_PERCENT / 100
}

/// One line of text whose upper left corner is at `(x, y)`, cut to a width.
fn text<'a>(
    class: &str,
    size: u32,
    (x, y, width): (u32, u32, u32),
    content: impl Into<GuestStr<'a>>,
    svg: &mut String,
) {
    let content = content.into();
    if content.is_empty() {
        return;
    }
    let (baseline, shown) = (y + size, cut(&replace_hostile(content), width * 100 / size));
    writeln!(
        svg,
        "<text class=\"sheet-text{class}\" x=\"{x}\" y=\"{baseline}\" font-size=\"{size}\">{}</text>",
        escaped(&shown)
    )
    .expect("writing to a string never fails");
}
