//! [`png()`]: an image as a PNG file.

use png::{BitDepth, ColorType, Compression, Encoder};

use super::image::Image;

/// The image as a PNG file, without a date and without transparency.
pub fn png(image: &Image) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, image.width(), image.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(image.pixels().as_flattened()))
        .expect("a vector takes all bytes, and an image has as many as its header says");
    bytes
}
