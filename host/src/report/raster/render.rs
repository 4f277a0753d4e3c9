//! [`draw`]: an SVG document as pixels.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, fontdb};
use thiserror::Error;

use super::image::Image;

/// Pixels that an image may have: 160 MB while it is drawn.
pub const PIXELS_MAX: u64 = 40_000_000;

/// The name of the font inside of its file.
const FONT: &str = "DejaVu Sans";

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(include_bytes!("font/DejaVuSans-subset.ttf").to_vec());
    fonts.set_sans_serif_family(FONT);
    Arc::new(fonts)
});

/// Why a document cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RasterError {
    /// It would have no pixel, or too many.
    #[error("an image of {width} x {height} pixels is not possible; at most {PIXELS_MAX} in all")]
    Size {
        /// In pixels.
        width: u64,
        /// In pixels.
        height: u64,
    },
    /// It is no SVG document.
    #[error("not an SVG document: {0}")]
    Invalid(String),
}

/// Draws a document on white, `width` pixels wide and as high as its proportions say.
///
/// ```
/// use wasmouse::report::raster::draw;
/// let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 2"><rect width="2" height="2" fill="#f00"/></svg>"##;
/// let image = draw(svg, 40).unwrap();
/// assert_eq!((image.width(), image.height()), (40, 20));
/// assert_eq!(image.pixel(5, 5), Some([255, 0, 0]));
/// assert_eq!(image.pixel(35, 5), Some([255, 255, 255]));
/// ```
///
/// # Errors
///
/// When the image would be too large, or the text is no SVG document.
pub fn draw(svg: &str, width: u32) -> Result<Image, RasterError> {
    let tree = usvg::Tree::from_str(svg, &options());
    let tree = tree.map_err(|error| RasterError::Invalid(error.to_string()))?;
    let size = tree.size();
    let height = (f64::from(width) * f64::from(size.height()) / f64::from(size.width())).round();
    let (pixels_wide, pixels_high) = (u64::from(width), height as u64);
    let too_large = RasterError::Size {
        width: pixels_wide,
        height: pixels_high,
    };
    if pixels_wide.saturating_mul(pixels_high) > PIXELS_MAX {
        return Err(too_large);
    }
    let mut pixmap = Pixmap::new(width, pixels_high as u32).ok_or(too_large)?;
    pixmap.fill(Color::WHITE);
    let scale = Transform::from_scale(
        width as f32 / size.width(),
        pixels_high as f32 / size.height(),
    );
    resvg::render(&tree, scale, &mut pixmap.as_mut());
    // On an opaque ground every pixel is opaque, so nothing is premultiplied.
    let pixels = pixmap.pixels().iter();
    let pixels = pixels.map(|it| [it.red(), it.green(), it.blue()]);
    Ok(Image::new(width, pixels.collect()))
}

fn options() -> usvg::Options<'static> {
    usvg::Options {
        font_family: FONT.to_owned(),
        fontdb: Arc::clone(&FONTS),
        // The default would open files.
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    }
}
