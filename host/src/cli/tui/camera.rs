//! [`Camera`]: how large a maze is drawn, and which part of it. [`Viewport`]: where that is on the
//! screen, which also says what a mouse points at.

use ratatui::layout::Rect;
use wasmouse_core::maze::{Cell, Heading};

/// The size of a cell on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Zoom {
    /// 2 columns x 1 row: the floor is a line at the bottom of the row.
    Small,
    /// 4 columns x 2 rows, walls included.
    Medium,
    /// 6 columns x 3 rows, walls included.
    Large,
}

impl Zoom {
    /// All sizes, the largest first.
    const LARGEST_FIRST: [Self; 3] = [Self::Large, Self::Medium, Self::Small];

    /// Columns and rows from one cell to the next.
    pub const fn pitch(self) -> (u16, u16) {
        match self {
            Self::Small => (2, 1),
            Self::Medium => (4, 2),
            Self::Large => (6, 3),
        }
    }

    /// Columns and rows of a maze with that many cells along each side.
    pub const fn extent(self, dimension: u8) -> (u16, u16) {
        let (columns, rows) = self.pitch();
        let n = dimension as u16;
        (n * columns + 1, n * rows + 1)
    }

    /// The largest size at which the whole maze fits; the smallest if it does at none.
    pub fn fitting(dimension: u8, width: u16, height: u16) -> Self {
        let fits = |zoom: &Self| {
            let (columns, rows) = zoom.extent(dimension);
            columns <= width && rows <= height
        };
        let fitting = Self::LARGEST_FIRST.into_iter().find(fits);
        fitting.unwrap_or(Self::Small)
    }

    /// The next smaller size.
    const fn smaller(self) -> Self {
        match self {
            Self::Large => Self::Medium,
            Self::Medium | Self::Small => Self::Small,
        }
    }

    /// The next larger size.
    const fn larger(self) -> Self {
        match self {
            Self::Small => Self::Medium,
            Self::Medium | Self::Large => Self::Large,
        }
    }
}

/// Which part of a maze is shown, and how large. The default shows all of it as large as it fits,
/// and follows the robot where it does not.
#[derive(Clone, Copy, Debug, Default)]
pub struct Camera {
    /// As chosen; `None` for the largest that fits.
    zoom: Option<Zoom>,
    /// Where the last viewport began: the camera moves only when what it follows leaves the middle.
    corner: (u16, u16),
    /// How far the viewer has moved it, in cells. It follows nothing then.
    moved: Option<(i16, i16)>,
}

impl Camera {
    /// Draws cells larger, or smaller.
    pub fn zoom(&mut self, shown: Zoom, larger: bool) {
        self.zoom = Some(if larger {
            shown.larger()
        } else {
            shown.smaller()
        });
    }

    /// Draws the maze as large as it fits, and follows again.
    pub const fn reset(&mut self) {
        self.zoom = None;
        self.moved = None;
    }

    /// Moves the part that is shown by cells, to the right and up.
    pub fn shift(&mut self, right: i16, up: i16) {
        let (x, y) = self.moved.unwrap_or_default();
        self.moved = Some((x.saturating_add(right), y.saturating_add(up)));
    }

    /// Follows again after [`Camera::shift`].
    pub const fn follow(&mut self) {
        self.moved = None;
    }

    /// The part of a maze to show in an area, with that cell in it.
    pub fn viewport(&mut self, dimension: u8, area: Rect, cell: Cell) -> Viewport {
        let fitting = Zoom::fitting(dimension, area.width, area.height);
        let zoom = self.zoom.unwrap_or(fitting);
        let (columns, rows) = zoom.extent(dimension);
        let (pitch_x, pitch_y) = zoom.pitch();
        let n = u16::from(dimension);
        let at = (
            u16::from(cell.x) * pitch_x,
            (n - 1 - u16::from(cell.y).min(n - 1)) * pitch_y,
        );
        let (shift_x, shift_y) = self.moved.unwrap_or_default();
        let x = corner(self.corner.0, at.0, pitch_x, columns, area.width, shift_x);
        let y = corner(self.corner.1, at.1, pitch_y, rows, area.height, -shift_y);
        if self.moved.is_none() {
            self.corner = (x, y);
        }
        // A maze that is smaller than the area is in its middle.
        let width = columns.min(area.width);
        let height = rows.min(area.height);
        Viewport {
            zoom,
            dimension,
            corner: (x, y),
            area: Rect {
                x: area.x + (area.width - width) / 2,
                y: area.y + (area.height - height) / 2,
                width,
                height,
            },
        }
    }
}

/// Where the part that is shown begins, in one direction.
fn corner(before: u16, at: u16, pitch: u16, extent: u16, room: u16, shift: i16) -> u16 {
    let last = extent.saturating_sub(room);
    // What is followed stays out of the outer quarters, so that one sees where it goes.
    let margin = room / 4;
    let low = (at + pitch + 1 + margin).saturating_sub(room);
    let high = at.saturating_sub(margin);
    let followed = if low <= high {
        before.clamp(low, high)
    } else {
        at.saturating_sub(room / 2)
    };
    let shift = i32::from(shift) * i32::from(pitch);
    let shifted = i32::from(followed.min(last)) + shift;
    u16::try_from(shifted.max(0)).unwrap_or(last).min(last)
}

/// A part of a maze on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    /// The size of the cells.
    pub zoom: Zoom,
    /// Cells along each side of the maze.
    pub dimension: u8,
    /// Columns and rows of the maze that are left of and above the part.
    pub corner: (u16, u16),
    /// Where it is on the screen; never larger than the maze.
    pub area: Rect,
}

/// A place in a maze that the mouse points at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hit {
    /// The cell.
    pub cell: Cell,
    /// The side of the cell that is there; `None` in the middle of the cell.
    pub side: Option<Heading>,
}

impl Viewport {
    /// Whether a part of the maze is not shown.
    pub fn is_cut(&self) -> bool {
        let (columns, rows) = self.zoom.extent(self.dimension);
        self.area.width < columns || self.area.height < rows
    }

    /// What is at a place on the screen; `None` outside the maze, and on posts.
    pub fn hit(&self, column: u16, row: u16) -> Option<Hit> {
        let inside = column >= self.area.x
            && row >= self.area.y
            && column < self.area.right()
            && row < self.area.bottom();
        if !inside {
            return None;
        }
        let across = column - self.area.x + self.corner.0;
        let down = row - self.area.y + self.corner.1;
        let (pitch_x, pitch_y) = self.zoom.pitch();
        let (x, on_left) = (across / pitch_x, across.is_multiple_of(pitch_x));
        let n = u16::from(self.dimension);
        let cell = |x: u16, rows_above: u16| {
            let y = n.checked_sub(1 + rows_above)?;
            let inside = x < n;
            inside.then(|| Some(Cell::new(u8::try_from(x).ok()?, u8::try_from(y).ok()?)))?
        };
        if self.zoom == Zoom::Small {
            return self.hit_small(across, down, cell);
        }
        let (above, on_top) = (down / pitch_y, down.is_multiple_of(pitch_y));
        match (on_left, on_top) {
            (true, true) => None,
            (false, false) => cell(x, above).map(|cell| Hit { cell, side: None }),
            (true, false) => match cell(x, above) {
                Some(cell) => Some(Hit {
                    cell,
                    side: Some(Heading::Left),
                }),
                None => cell(x.checked_sub(1)?, above).map(|cell| Hit {
                    cell,
                    side: Some(Heading::Right),
                }),
            },
            (false, true) => match cell(x, above) {
                Some(cell) => Some(Hit {
                    cell,
                    side: Some(Heading::Up),
                }),
                None => cell(x, above.checked_sub(1)?).map(|cell| Hit {
                    cell,
                    side: Some(Heading::Down),
                }),
            },
        }
    }

    /// In small mazes there is one place for a cell and the floor below it: the floor, since the
    /// keys can choose the cell.
    fn hit_small(
        &self,
        across: u16,
        down: u16,
        cell: impl Fn(u16, u16) -> Option<Cell>,
    ) -> Option<Hit> {
        let hit = |cell: Option<Cell>, side| {
            cell.map(|cell| Hit {
                cell,
                side: Some(side),
            })
        };
        let (x, on_wall) = (across.saturating_sub(1) / 2, across.is_multiple_of(2));
        match (down.checked_sub(1), across, on_wall) {
            (None, _, true) => None,
            (None, _, false) => hit(cell(x, 0), Heading::Up),
            (Some(above), 0, _) => hit(cell(0, above), Heading::Left),
            (Some(above), _, true) => hit(cell(x, above), Heading::Right),
            (Some(above), _, false) => hit(cell(x, above), Heading::Down),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCREEN: Rect = Rect::new(0, 0, 80, 24);

    #[test]
    fn mazes_are_as_large_as_they_fit() {
        for (dimension, width, height, zoom) in [
            (16, 80, 24, Zoom::Small),
            (16, 80, 33, Zoom::Medium),
            (16, 97, 49, Zoom::Large),
            (4, 80, 24, Zoom::Large),
            (20, 40, 10, Zoom::Small),
        ] {
            assert_eq!(Zoom::fitting(dimension, width, height), zoom);
        }
    }

    #[test]
    fn the_camera_keeps_what_it_follows_in_view() {
        let mut camera = Camera::default();
        for zoom in [
            None,
            Some(Zoom::Small),
            Some(Zoom::Medium),
            Some(Zoom::Large),
        ] {
            camera.zoom = zoom;
            for cell in (0..64).map(|x| Cell::new(x, 63 - x)) {
                let view = camera.viewport(64, SCREEN, cell);
                let (pitch_x, pitch_y) = view.zoom.pitch();
                let (left, top) = (
                    u16::from(cell.x) * pitch_x,
                    u16::from(63 - cell.y) * pitch_y,
                );
                assert!(view.corner.0 <= left && left + pitch_x < view.corner.0 + 80);
                assert!(view.corner.1 <= top && top + pitch_y < view.corner.1 + 24);
            }
        }
    }

    #[test]
    fn a_shifted_camera_stays_on_the_maze() {
        let mut camera = Camera::default();
        let cell = Cell::new(0, 0);
        assert_eq!(camera.viewport(64, SCREEN, cell).corner, (0, 65 - 24));
        camera.shift(5, 0);
        assert_eq!(camera.viewport(64, SCREEN, cell).corner, (10, 65 - 24));
        camera.shift(0, 500);
        assert_eq!(camera.viewport(64, SCREEN, cell).corner, (10, 0));
        camera.shift(i16::MAX, i16::MIN);
        assert_eq!(
            camera.viewport(64, SCREEN, cell).corner,
            (129 - 80, 65 - 24)
        );
        camera.follow();
        assert_eq!(camera.viewport(64, SCREEN, cell).corner, (0, 65 - 24));
    }

    /// Every wall of the maze can be clicked at, at every size.
    #[test]
    fn every_wall_is_somewhere_on_the_screen() {
        use std::collections::BTreeSet;
        for zoom in Zoom::LARGEST_FIRST {
            let (width, height) = zoom.extent(4);
            let area = Rect::new(3, 2, width, height);
            let mut camera = Camera {
                zoom: Some(zoom),
                ..Camera::default()
            };
            let view = camera.viewport(4, area, Cell::new(0, 0));
            let mut walls = BTreeSet::new();
            for row in 0..40 {
                for column in 0..60 {
                    let Some(hit) = view.hit(column, row) else {
                        continue;
                    };
                    assert!(hit.cell.x < 4 && hit.cell.y < 4);
                    if let Some(side) = hit.side {
                        walls.insert(wall_of(hit.cell, side));
                    }
                }
            }
            assert_eq!(walls.len(), 40, "{zoom:?}: 24 inside and 16 around");
        }
    }

    /// One name for both sides of a wall: its place in half cells.
    fn wall_of(cell: Cell, side: Heading) -> (i16, i16) {
        let (x, y) = (2 * i16::from(cell.x), 2 * i16::from(cell.y));
        match side {
            Heading::Up => (x, y + 1),
            Heading::Right => (x + 1, y),
            Heading::Down => (x, y - 1),
            Heading::Left => (x - 1, y),
        }
    }
}
