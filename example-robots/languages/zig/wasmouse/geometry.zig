//! Directions, cells and poses. `x` grows to the right, `y` grows upward, and (0, 0) is the bottom
//! left cell.

/// The largest maze, in cells along each side.
pub const dimension_max = 64;

/// A direction in the maze, clockwise. The robot starts both runs heading up.
pub const Heading = enum(u2) {
    up,
    right,
    down,
    left,

    pub const all = [_]Heading{ .up, .right, .down, .left };

    pub fn turned(heading: Heading, turn: Turn) Heading {
        return @enumFromInt(@intFromEnum(heading) +% switch (turn) {
            .left => @as(u2, 3),
            .straight => 0,
            .right => 1,
        });
    }

    pub fn opposite(heading: Heading) Heading {
        return @enumFromInt(@intFromEnum(heading) +% 2);
    }

    /// The rotation to another heading; null if that is behind.
    pub fn turnTo(heading: Heading, other: Heading) ?Turn {
        return switch (@intFromEnum(other) -% @intFromEnum(heading)) {
            0 => .straight,
            1 => .right,
            2 => null,
            3 => .left,
        };
    }
};

/// A rotation on the spot.
pub const Turn = enum(u8) { left, straight, right };

pub const Cell = struct {
    x: u32,
    y: u32,

    pub fn eql(a: Cell, b: Cell) bool {
        return a.x == b.x and a.y == b.y;
    }

    /// The cell that many cells away. The caller knows that it is in the maze.
    pub fn toward(cell: Cell, heading: Heading, cells: u32) Cell {
        return switch (heading) {
            .up => .{ .x = cell.x, .y = cell.y + cells },
            .right => .{ .x = cell.x + cells, .y = cell.y },
            .down => .{ .x = cell.x, .y = cell.y - cells },
            .left => .{ .x = cell.x - cells, .y = cell.y },
        };
    }
};

/// A rectangle of cells; `origin` is the bottom left one.
pub const Area = struct {
    origin: Cell,
    width: u32,
    height: u32,

    pub fn contains(area: Area, cell: Cell) bool {
        // Wrapping: a cell before the origin is very far behind it.
        return cell.x -% area.origin.x < area.width and cell.y -% area.origin.y < area.height;
    }
};

/// Where the robot is and where it looks.
pub const Pose = struct {
    cell: Cell,
    heading: Heading,

    pub fn atStart(cell: Cell) Pose {
        return .{ .cell = cell, .heading = .up };
    }

    pub fn eql(a: Pose, b: Pose) bool {
        return a.cell.eql(b.cell) and a.heading == b.heading;
    }
};
