//! [`Area`]: where is drawn, in pixels.

use std::io;

use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingAreaErrorKind, SVGBackend};

/// A part of the drawing, or all of it.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Whether something could be drawn.
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;
