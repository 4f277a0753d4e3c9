//! [`Canvas`]: the parts that all plots have: size, title, legend and axes.

use std::ops::Range;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use wasmouse_core::guest_text::GuestStr;

use super::area::{Area, Drawn};
use super::error::PlotError;
use super::look::{Colors, bar, marker};
use super::options::Options;
use crate::report::picture::{escaped, replace_hostile};
use crate::report::text_width::{cut, width_of};

/// The width of a plot in pixels.
const WIDTH: u32 = 800;

/// The empty border.
const MARGIN: i32 = 16;

/// Letters in pixels, as a reader sees them.
const TITLE: i32 = 20;
const TEXT: i32 = 14;

/// How wide the name of a robot may be, in pixels.
const NAME_MAX: i32 = 200;

/// The height of a row of the legend.
const ROW: i32 = 22;

pub(super) type Chart<'a> =
    ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What stands above a plot.
#[derive(Clone)]
pub(super) struct Head<'a> {
    pub(super) title: &'a str,
    /// In smaller letters: what is shown, in a sentence.
    pub(super) note: String,
    /// The names of the robots in the order of their looks.
    pub(super) names: Vec<GuestStr<'a>>,
    /// Robots that are not shown.
    pub(super) more: usize,
    /// How robots are drawn.
    pub(super) key: Key,
}

/// What the legend shows of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Marker,
    Bar,
}

/// Where a plot is drawn.
pub(super) struct Canvas<'a> {
    /// All of it, in pixels.
    pub(super) root: Area<'a>,
    /// What is below the legend, in pixels of `root`.
    pub(super) place: Place,
    pub(super) colors: &'static Colors,
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) width: i32,
    pub(super) height: i32,
}

/// The axes of a chart.
pub(super) struct Axes<'a> {
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
    pub(super) x_title: &'a str,
    pub(super) y_title: &'a str,
    /// The text of a number on the x axis; `None` leaves them out.
    pub(super) x_label: Option<&'a dyn Fn(&f64) -> String>,
    pub(super) y_label: &'a dyn Fn(&f64) -> String,
}

/// Draws a plot whose part below the legend has that height in pixels.
pub(super) fn document(
    head: &Head<'_>,
    options: &Options,
    height: i32,
    draw: impl FnOnce(&Canvas<'_>) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let colors = Colors::of(options.theme);
    let title = replace_hostile(options.title.as_deref().unwrap_or(head.title));
    let legend = legend(head);
    let rows = legend.last().map_or(0, |entry| entry.row + 1);
    let top = MARGIN + TITLE + 10 + TEXT + 10 + rows * ROW + 6;
    let total = top + height + MARGIN;
    let mut svg = String::new();
    {
        let size = (WIDTH, total.unsigned_abs());
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&colors.ground)?;
        let width = WIDTH as i32 - 2 * MARGIN;
        let shown = cut(&title, hundredths(width, TITLE));
        text(
            &root,
            &shown,
            (MARGIN, MARGIN),
            TITLE,
            colors.text,
            HPos::Left,
        )?;
        let note_at = (MARGIN, MARGIN + TITLE + 10);
        let note = cut(&replace_hostile(&head.note), hundredths(width, TEXT));
        text(&root, &note, note_at, TEXT, colors.quiet, HPos::Left)?;
        let legend_top = MARGIN + TITLE + 10 + TEXT + 10;
        for (position, entry) in legend.iter().enumerate() {
            let (x, y) = (MARGIN + entry.x, legend_top + entry.row * ROW);
            if position < head.names.len() {
                let color = colors.robots[position % colors.robots.len()];
                match head.key {
                    Key::Marker => marker(&root, (x + 7, y + 7), position, 5, &color)?,
                    Key::Bar => bar(&root, ((x, y), (x + 14, y + 14)), position, colors)?,
                }
            }
            text(
                &root,
                &entry.name,
                (x + 20, y),
                TEXT,
                colors.text,
                HPos::Left,
            )?;
        }
        let place = Place {
            left: MARGIN,
            top,
            width,
            height,
        };
        draw(&Canvas {
            root: root.clone(),
            place,
            colors,
        })?;
        root.present()?;
    }
    Ok(with_description(&svg, &title, &head.note))
}

/// A name in the legend.
struct Entry {
    name: String,
    x: i32,
    row: i32,
}

fn legend(head: &Head<'_>) -> Vec<Entry> {
    let mut names: Vec<String> = Vec::new();
    for name in &head.names {
        names.push(cut(&replace_hostile(*name), hundredths(NAME_MAX, TEXT)));
    }
    if head.more > 0 {
        names.push(format!("and {} more, not shown", head.more));
    }
    let (mut x, mut row) = (0, 0);
    let entries = names.into_iter().map(|name| {
        let width = 20 + pixels(&name, TEXT) + 18;
        if x > 0 && x + width > WIDTH as i32 - 2 * MARGIN {
            (x, row) = (0, row + 1);
        }
        let entry = Entry { name, x, row };
        x += width;
        entry
    });
    entries.collect()
}

impl<'a> Canvas<'a> {
    /// The axes of a chart in a part of the canvas. The title of the y axis stands above it, where
    /// it can be read without turning the head.
    pub(super) fn chart(&self, place: Place, axes: &Axes<'_>) -> Result<Chart<'a>, PlotError> {
        let colors = self.colors;
        let title_at = (place.left, place.top);
        text(
            &self.root,
            axes.y_title,
            title_at,
            TEXT,
            colors.quiet,
            HPos::Left,
        )?;
        let above = TEXT + 4;
        let area = self.root.clone().shrink(
            (place.left, place.top + above),
            (place.width, place.height - above),
        );
        let label = |size: i32| font(size).color(&colors.quiet);
        let below = if axes.x_label.is_some() || !axes.x_title.is_empty() {
            44
        } else {
            6
        };
        let mut chart = ChartBuilder::on(&area)
            .margin_right(16)
            .margin_top(4)
            .x_label_area_size(below)
            .y_label_area_size(52)
            .build_cartesian_2d(axes.x.clone(), axes.y.clone())?;
        let nothing = |_: &f64| String::new();
        let mut mesh = chart.configure_mesh();
        mesh.axis_style(colors.quiet)
            .bold_line_style(colors.grid)
            .light_line_style(colors.ground)
            .max_light_lines(1)
            .label_style(label(TEXT))
            .axis_desc_style(label(TEXT))
            .x_desc(axes.x_title)
            .x_labels(8)
            .y_labels((place.height / 45).clamp(2, 8) as usize)
            .x_label_formatter(axes.x_label.unwrap_or(&nothing))
            .y_label_formatter(axes.y_label);
        if axes.x_label.is_none() {
            mesh.disable_x_mesh()
                .set_tick_mark_size(LabelAreaPosition::Bottom, 0);
        }
        mesh.draw()?;
        drop(mesh);
        Ok(chart)
    }

    /// Text in pixels of the canvas, around or beside a place, cut to a width.
    pub(super) fn label<'t>(
        &self,
        content: impl Into<GuestStr<'t>>,
        at: (i32, i32),
        width: i32,
        anchor: HPos,
    ) -> Drawn {
        let shown = cut(&replace_hostile(content), hundredths(width, TEXT));
        text(&self.root, &shown, at, TEXT, self.colors.quiet, anchor)
    }
}

/// Where a point of a chart is, in pixels of the canvas.
pub(super) fn pixel(chart: &Chart<'_>, point: (f64, f64)) -> (i32, i32) {
    chart.plotting_area().map_coordinate(&point)
}

fn font(size: i32) -> TextStyle<'static> {
    // plotters divides by it again when it writes.
    ("sans-serif", f64::from(size) * 1.24).into_text_style(&(WIDTH, WIDTH))
}

fn text(
    area: &Area<'_>,
    content: &str,
    at: (i32, i32),
    size: i32,
    color: RGBColor,
    anchor: HPos,
) -> Drawn {
    let style = font(size).color(&color).pos(Pos::new(anchor, VPos::Top));
    area.draw(&Text::new(content.to_owned(), at, style))
}

/// How many hundredths of letters of that size fit.
fn hundredths(width: i32, size: i32) -> u32 {
    (width * 100 / size).unsigned_abs()
}

fn pixels(content: &str, size: i32) -> i32 {
    (width_of(content) as i32 * size + 99) / 100
}

/// The document with a title and a description for those who cannot see it.
fn with_description(svg: &str, title: &str, note: &str) -> String {
    let (open, rest) = svg.split_once(">\n").unwrap_or((svg, ""));
    format!(
        "{open} role=\"img\">\n<title>{}</title>\n<desc>{}</desc>\n{rest}",
        escaped(title),
        escaped(&replace_hostile(note))
    )
}
