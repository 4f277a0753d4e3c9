//! [`Palette`]: the colours of a GIF file.
//!
//! Drawings have few colours and, along every line, shades of them. As long as all fit, they are
//! exact. If not, the most frequent ones stay as they are, and a rare shade becomes the nearest of
//! them: areas never change, and no pixel is dithered, which would flicker between frames.

use std::collections::{BTreeMap, HashMap};

use crate::report::raster::Image;

/// Colours of a file, at most; one more is transparent.
const COLORS_MAX: usize = 255;

/// Entries of the largest table.
const TABLE_MAX: usize = 256;

/// At most 255 colours, and the number of each colour that was ever asked for.
pub(super) struct Palette {
    colors: Vec<[u8; 3]>,
    numbers: HashMap<[u8; 3], u8>,
}

impl Palette {
    /// The colours of these frames, or those that stand for them best.
    pub(super) fn of(frames: &[Image]) -> Self {
        let mut counts: BTreeMap<[u8; 3], u64> = BTreeMap::new();
        for pixels in frames.iter().map(Image::pixels) {
            for run in pixels.chunk_by(|a, b| a == b) {
                *counts.entry(run[0]).or_default() += run.len() as u64;
            }
        }
        let mut sorted: Vec<([u8; 3], u64)> = counts.into_iter().collect();
        // The most frequent first; colours in order where that does not decide.
        sorted.sort_by_key(|&(color, count)| (std::cmp::Reverse(count), color));
        let sorted = sorted.into_iter().map(|it| it.0).collect::<Vec<_>>();
        let mut apart = 0;
        loop {
            if let Some(colors) = pick(&sorted, apart) {
                return Self {
                    colors,
                    numbers: HashMap::new(),
                };
            }
            apart = (apart * 2).max(12);
        }
    }

    /// The number of the transparent colour.
    pub(super) fn transparent(&self) -> u8 {
        u8::try_from(self.colors.len()).expect("at most 255 colours before it")
    }

    /// The table of a file: red, green and blue of each colour, the transparent one last.
    pub(super) fn table(&self) -> Vec<u8> {
        let mut table = self.colors.concat();
        table.extend([0, 0, 0]);
        debug_assert!(table.len() <= TABLE_MAX * 3, "255 colours and one");
        table
    }

    /// The numbers of the pixels, of which `None` is transparent.
    pub(super) fn numbers(&mut self, pixels: &[Option<[u8; 3]>]) -> Vec<u8> {
        let mut numbers = Vec::with_capacity(pixels.len());
        for run in pixels.chunk_by(|a, b| a == b) {
            let number = run[0].map_or(self.transparent(), |color| self.number(color));
            numbers.resize(numbers.len() + run.len(), number);
        }
        numbers
    }

    /// The number of the nearest colour.
    fn number(&mut self, color: [u8; 3]) -> u8 {
        let colors = &self.colors;
        *self.numbers.entry(color).or_insert_with(|| {
            let nearest = (0..colors.len()).min_by_key(|&it| distance(colors[it], color));
            nearest.and_then(|it| u8::try_from(it).ok()).unwrap_or(0)
        })
    }

    /// The frame as a reader of the file sees it.
    pub(super) fn shown(&mut self, frame: &Image) -> Image {
        let mut pixels = Vec::with_capacity(frame.pixels().len());
        // Most neighbours have the same colour.
        for run in frame.pixels().chunk_by(|a, b| a == b) {
            let number = self.number(run[0]);
            pixels.resize(pixels.len() + run.len(), self.colors[usize::from(number)]);
        }
        Image::new(frame.width(), pixels)
    }
}

/// The first colours that are at least that far apart; `None` if there are too many.
fn pick(sorted: &[[u8; 3]], apart: u32) -> Option<Vec<[u8; 3]>> {
    let mut colors: Vec<[u8; 3]> = Vec::new();
    for &color in sorted {
        if apart == 0 || colors.iter().all(|&it| distance(it, color) >= apart) {
            if colors.len() == COLORS_MAX {
                return None;
            }
            colors.push(color);
        }
    }
    Some(colors)
}

/// The square of the distance between two colours.
fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let parts = a.into_iter().zip(b);
    parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_exact() {
        let pixels: Vec<[u8; 3]> = (0..=254).map(|it| [it, 7, it / 2]).collect();
        let image = Image::new(15, pixels);
        let mut palette = Palette::of(std::slice::from_ref(&image));
        assert_eq!(palette.shown(&image), image);
        assert_eq!((palette.transparent(), palette.table().len()), (255, 768));
    }

    #[test]
    fn frequent_colours_stay_and_rare_ones_become_their_neighbours() {
        // 256 * 16 shades, and large areas of two colours.
        let shades = (0..4096).map(|it: u32| [(it % 256) as u8, (it / 256 * 16) as u8, 200]);
        let areas = [[[255, 255, 255]; 5000], [[1, 2, 3]; 5000]].concat();
        let pixels: Vec<[u8; 3]> = shades.chain(areas).collect();
        let image = Image::new(1, pixels);
        let mut palette = Palette::of(std::slice::from_ref(&image));
        let shown = palette.shown(&image);
        assert_eq!(shown.pixel(0, 5000), Some([255, 255, 255]));
        assert_eq!(shown.pixel(0, 10_000), Some([1, 2, 3]));
        let pairs = image.pixels().iter().zip(shown.pixels());
        let worst = pairs.map(|(a, b)| distance(*a, *b)).max();
        assert!(worst.is_some_and(|it| (1..1600).contains(&it)), "{worst:?}");
    }
}
