//! [`AnimationError`]: why an animated picture cannot be written.

use std::io;

use thiserror::Error;

use crate::report::raster::RasterError;

/// Pixels of all frames together, at most: some minutes of work.
pub const PIXELS_MAX: u64 = 2_000_000_000;

/// Why an animated picture cannot be written.
#[derive(Debug, Error)]
pub enum AnimationError {
    /// All frames together have too many pixels.
    #[error(
        "{frames} frames of {width} x {height} pixels are too many; an animated picture has at \
         most {PIXELS_MAX} pixels in all frames together"
    )]
    TooLarge {
        /// How many.
        frames: usize,
        /// In pixels.
        width: u32,
        /// In pixels.
        height: u32,
    },
    /// A frame is wider or higher than the format allows.
    #[error("a GIF file has at most 65535 x 65535 pixels, found {width} x {height}")]
    Side {
        /// In pixels.
        width: u32,
        /// In pixels.
        height: u32,
    },
    /// There is no frame.
    #[error("an animated picture without frames")]
    Empty,
    /// A frame cannot be drawn.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// It was cancelled.
    #[error("interrupted")]
    Cancelled,
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] io::Error),
}

impl From<gif::EncodingError> for AnimationError {
    fn from(error: gif::EncodingError) -> Self {
        Self::Write(match error {
            gif::EncodingError::Io(error) => error,
            error => io::Error::other(error),
        })
    }
}

impl From<png::EncodingError> for AnimationError {
    fn from(error: png::EncodingError) -> Self {
        Self::Write(match error {
            png::EncodingError::IoError(error) => error,
            error => io::Error::other(error),
        })
    }
}
