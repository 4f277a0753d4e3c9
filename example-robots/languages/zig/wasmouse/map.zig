//! What a robot knows about the walls.
const geometry = @import("geometry.zig");
const Sensors = @import("interface.zig").Sensors;
const journal = @import("journal.zig");
const Cell = geometry.Cell;
const Heading = geometry.Heading;
const Pose = geometry.Pose;
const dimension_max = geometry.dimension_max;

pub const Wall = journal.Belief;

/// How to treat unknown walls.
pub const View = enum {
    /// They count as open: for exploring.
    optimistic,
    /// They count as closed: for driving only where it is certain.
    pessimistic,
};

/// One bit for each heading.
const Sides = [dimension_max][dimension_max]u4;

/// The walls of a square maze, each unknown, open or closed. At first the perimeter is closed and
/// everything else is unknown.
pub const Map = struct {
    dimension: u32,
    open: Sides,
    closed: Sides,

    pub fn init(dimension: u32) Map {
        if (dimension < 2 or dimension > dimension_max) @panic("the dimension is outside 2 to 64");
        var map: Map = .{
            .dimension = dimension,
            .open = @splat(@splat(0)),
            .closed = @splat(@splat(0)),
        };
        const last = dimension - 1;
        for (0..dimension) |i| {
            map.closed[i][last] |= bit(.up);
            map.closed[last][i] |= bit(.right);
            map.closed[i][0] |= bit(.down);
            map.closed[0][i] |= bit(.left);
        }
        return map;
    }

    pub fn contains(map: *const Map, cell: Cell) bool {
        return cell.x < map.dimension and cell.y < map.dimension;
    }

    pub fn wall(map: *const Map, cell: Cell, heading: Heading) Wall {
        if (map.closed[cell.x][cell.y] & bit(heading) != 0) return .closed;
        return if (map.open[cell.x][cell.y] & bit(heading) != 0) .open else .unknown;
    }

    /// Sets a wall on both of its sides, except that the perimeter stays closed. Returns whether
    /// that was news.
    pub fn set(map: *Map, cell: Cell, heading: Heading, new: Wall) bool {
        if (map.wall(cell, heading) == new or map.isPerimeter(cell, heading)) return false;
        map.setSide(cell, heading, new);
        map.setSide(cell.toward(heading, 1), heading.opposite(), new);
        return true;
    }

    /// Adds the readings made at a pose. Returns how many walls were not known to be closed before.
    pub fn observe(map: *Map, pose: Pose, sensors: Sensors) u32 {
        return map.look(pose.cell, pose.heading.turned(.left), sensors.left) +
            map.look(pose.cell, pose.heading, sensors.front) +
            map.look(pose.cell, pose.heading.turned(.right), sensors.right);
    }

    /// Whether the robot may drive through that side of a cell.
    pub fn isOpen(map: *const Map, view: View, cell: Cell, heading: Heading) bool {
        return switch (view) {
            .optimistic => map.closed[cell.x][cell.y] & bit(heading) == 0,
            .pessimistic => map.open[cell.x][cell.y] & bit(heading) != 0,
        };
    }

    /// How many cells the robot may drive in that direction, up to a limit.
    pub fn clearCells(map: *const Map, view: View, from: Cell, heading: Heading, limit: u32) u32 {
        var cell = from;
        var cells: u32 = 0;
        while (cells < limit and map.isOpen(view, cell, heading)) : (cells += 1) {
            cell = cell.toward(heading, 1);
        }
        return cells;
    }

    fn look(map: *Map, from: Cell, heading: Heading, reading: u32) u32 {
        var cell = from;
        for (0..reading) |_| {
            _ = map.set(cell, heading, .open);
            cell = cell.toward(heading, 1);
        }
        return @intFromBool(map.set(cell, heading, .closed));
    }

    fn isPerimeter(map: *const Map, cell: Cell, heading: Heading) bool {
        return switch (heading) {
            .up => cell.y == map.dimension - 1,
            .right => cell.x == map.dimension - 1,
            .down => cell.y == 0,
            .left => cell.x == 0,
        };
    }

    fn setSide(map: *Map, cell: Cell, heading: Heading, new: Wall) void {
        const open = &map.open[cell.x][cell.y];
        const closed = &map.closed[cell.x][cell.y];
        open.* &= ~bit(heading);
        closed.* &= ~bit(heading);
        switch (new) {
            .unknown => {},
            .open => open.* |= bit(heading),
            .closed => closed.* |= bit(heading),
        }
    }
};

fn bit(heading: Heading) u4 {
    return @as(u4, 1) << @intFromEnum(heading);
}
