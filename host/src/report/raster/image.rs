//! [`Image`]: opaque pixels.

/// A rectangle of opaque pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    /// The image of these pixels.
    ///
    /// # Panics
    ///
    /// When they are not a whole number of rows.
    pub fn new(width: u32, pixels: Vec<[u8; 3]>) -> Self {
        let is_whole = width > 0 && pixels.len().is_multiple_of(width as usize);
        assert!(is_whole, "an image has whole rows");
        Self { width, pixels }
    }

    /// The width in pixels, at least 1.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The height in pixels.
    pub fn height(&self) -> u32 {
        (self.pixels.len() / self.width as usize) as u32
    }

    /// Red, green and blue of every pixel, row by row from the top.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// Red, green and blue of a pixel, from the upper left corner; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        let is_inside = x < self.width && y < self.height();
        is_inside.then(|| self.pixels[(y * self.width + x) as usize])
    }

    /// A row from `x` on, with that many pixels.
    pub fn row(&self, x: u32, y: u32, count: u32) -> &[[u8; 3]] {
        let first = y as usize * self.width as usize + x as usize;
        &self.pixels[first..first + count as usize]
    }
}
