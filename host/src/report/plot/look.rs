//! How robots are told apart: colours, markers and hatchings.

use plotters::prelude::*;

use super::area::{Area, Drawn};
use crate::report::picture::Theme;

/// How many robots can be told apart.
pub(super) const LOOKS: usize = 8;

/// The colours of a theme.
pub(super) struct Colors {
    pub(super) ground: RGBColor,
    pub(super) text: RGBColor,
    pub(super) quiet: RGBColor,
    pub(super) grid: RGBColor,
    pub(super) robots: [RGBColor; LOOKS],
}

/// Those of Okabe and Ito, which can be told apart with any kind of colour vision; yellow and the
/// light blue are darker, to be seen on white.
const LIGHT: Colors = Colors {
    ground: RGBColor(255, 255, 255),
    text: RGBColor(27, 28, 32),
    quiet: RGBColor(96, 100, 108),
    grid: RGBColor(225, 227, 231),
    robots: [
        RGBColor(0, 114, 178),
        RGBColor(213, 94, 0),
        RGBColor(0, 135, 99),
        RGBColor(186, 76, 142),
        RGBColor(150, 110, 0),
        RGBColor(40, 150, 200),
        RGBColor(110, 80, 190),
        RGBColor(90, 94, 102),
    ],
};

const DARK: Colors = Colors {
    ground: RGBColor(22, 23, 27),
    text: RGBColor(242, 242, 245),
    quiet: RGBColor(176, 180, 186),
    grid: RGBColor(52, 54, 60),
    robots: [
        RGBColor(86, 180, 233),
        RGBColor(240, 130, 50),
        RGBColor(40, 190, 145),
        RGBColor(225, 140, 190),
        RGBColor(230, 190, 60),
        RGBColor(130, 210, 245),
        RGBColor(175, 155, 245),
        RGBColor(180, 184, 190),
    ],
};

impl Colors {
    pub(super) const fn of(theme: Theme) -> &'static Self {
        match theme {
            Theme::Auto | Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        }
    }
}

/// Draws the marker of the robot at that position in the legend, around a place in pixels.
pub(super) fn marker(
    area: &Area<'_>,
    (x, y): (i32, i32),
    position: usize,
    size: i32,
    color: &impl Color,
) -> Drawn {
    let at = |points: &[(i32, i32)]| -> Vec<(i32, i32)> {
        let points = points.iter();
        points.map(|&(right, down)| (x + right, y + down)).collect()
    };
    let s = size;
    match position % LOOKS {
        0 => area.draw(&Circle::new((x, y), size, color.filled())),
        1 => area.draw(&Polygon::new(
            at(&[(-s, -s), (s, -s), (s, s), (-s, s)]),
            color,
        )),
        2 => area.draw(&Polygon::new(at(&[(0, -s), (s, s), (-s, s)]), color)),
        3 => area.draw(&Polygon::new(
            at(&[(0, -s - 1), (s + 1, 0), (0, s + 1), (-s - 1, 0)]),
            color,
        )),
        4 => {
            lines(area, &at(&[(-s, -s), (s, s)]), color)?;
            lines(area, &at(&[(-s, s), (s, -s)]), color)
        }
        5 => {
            lines(area, &at(&[(-s, 0), (s, 0)]), color)?;
            lines(area, &at(&[(0, -s), (0, s)]), color)
        }
        6 => area.draw(&Polygon::new(at(&[(-s, -s), (s, -s), (0, s)]), color)),
        _ => area.draw(&Circle::new((x, y), size, color.stroke_width(2))),
    }
}

fn lines(area: &Area<'_>, points: &[(i32, i32)], color: &impl Color) -> Drawn {
    area.draw(&PathElement::new(points.to_vec(), color.stroke_width(2)))
}

/// Fills a rectangle of pixels with the colour and the hatching of the robot at that position.
/// The first has none.
pub(super) fn bar(
    area: &Area<'_>,
    ((left, top), (right, bottom)): ((i32, i32), (i32, i32)),
    position: usize,
    colors: &Colors,
) -> Drawn {
    let color = colors.robots[position % LOOKS];
    area.draw(&Rectangle::new(
        [(left, top), (right, bottom)],
        color.filled(),
    ))?;
    let line = |from: (i32, i32), to: (i32, i32)| {
        area.draw(&PathElement::new(
            vec![from, to],
            colors.ground.stroke_width(1),
        ))
    };
    let (width, height) = (right - left, bottom - top);
    let (rising, falling, level, upright) = match position % LOOKS {
        0 => (0, 0, 0, 0),
        1 => (6, 0, 0, 0),
        2 => (0, 0, 5, 0),
        3 => (0, 6, 0, 0),
        4 => (0, 0, 0, 4),
        5 => (8, 8, 0, 0),
        6 => (0, 0, 6, 6),
        _ => (3, 0, 0, 0),
    };
    // Lines on which x + y or x - y is constant, cut to the rectangle.
    for sum in every(rising, width + height) {
        let x = (sum - height).max(0)..=sum.min(width);
        line(
            (left + x.start(), bottom - height + sum - x.start()),
            (left + x.end(), bottom - height + sum - x.end()),
        )?;
    }
    for sum in every(falling, width + height) {
        let x = (sum - height).max(0)..=sum.min(width);
        line(
            (left + x.start(), bottom - sum + x.start()),
            (left + x.end(), bottom - sum + x.end()),
        )?;
    }
    for y in every(level, height) {
        line((left, bottom - y), (right, bottom - y))?;
    }
    for x in every(upright, width) {
        line((left + x, top), (left + x, bottom))?;
    }
    Ok(())
}

/// Multiples of a distance below an end; none of 0.
fn every(distance: i32, end: i32) -> impl Iterator<Item = i32> {
    let count = if distance > 0 {
        (end - 1) / distance
    } else {
        0
    };
    (1..=count.max(0)).map(move |it| it * distance)
}
