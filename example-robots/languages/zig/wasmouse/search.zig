//! The fewest steps from every cell to a goal. One step drives up to the longest move in a straight
//! line, in any direction, so the heading does not matter.
const geometry = @import("geometry.zig");
const map_file = @import("map.zig");
const Area = geometry.Area;
const Cell = geometry.Cell;
const Heading = geometry.Heading;
const Map = map_file.Map;
const Pose = geometry.Pose;
const View = map_file.View;
const dimension_max = geometry.dimension_max;

/// A drive in a direction of the maze.
pub const Hop = struct {
    heading: Heading,
    cells: u32,

    /// The pose after it. The robot turns to its heading, unless that is behind it; then it drives
    /// backwards.
    pub fn from(hop: Hop, pose: Pose) Pose {
        return .{
            .cell = pose.cell.toward(hop.heading, hop.cells),
            .heading = if (hop.heading == pose.heading.opposite()) pose.heading else hop.heading,
        };
    }
};

/// The distances of the last search.
pub const Search = struct {
    longest_move: u32,
    /// By x and y; null for cells that were not reached.
    steps: [dimension_max][dimension_max]?u16,
    queue: [dimension_max * dimension_max]Cell,

    /// Nothing is reached yet.
    pub fn init(longest_move: u32) Search {
        return .{ .longest_move = longest_move, .steps = @splat(@splat(null)), .queue = undefined };
    }

    /// Computes the distance of every cell to the goal, until that of `from` is known: all cells at
    /// most as far as `from` are known then, and the others count as not reached.
    pub fn fillUntil(search: *Search, map: *const Map, view: View, goal: Area, from: Cell) void {
        search.steps = @splat(@splat(null));
        var head: usize = 0;
        var tail: usize = 0;
        for (0..goal.width) |x| for (0..goal.height) |y| {
            const cell: Cell = .{
                .x = goal.origin.x + @as(u32, @intCast(x)),
                .y = goal.origin.y + @as(u32, @intCast(y)),
            };
            search.steps[cell.x][cell.y] = 0;
            search.queue[tail] = cell;
            tail += 1;
        };
        while (head < tail) : (head += 1) {
            const cell = search.queue[head];
            const steps = search.steps[cell.x][cell.y].?;
            if (search.steps[from.x][from.y]) |known| {
                if (steps >= known) return;
            }
            for (Heading.all) |heading| {
                var there = cell;
                for (0..search.longest_move) |_| {
                    if (!map.isOpen(view, there, heading)) break;
                    there = there.toward(heading, 1);
                    if (search.steps[there.x][there.y] == null) {
                        search.steps[there.x][there.y] = steps + 1;
                        search.queue[tail] = there;
                        tail += 1;
                    }
                }
            }
        }
    }

    /// The next hop of a shortest route; null if the last search knows none, or in the goal.
    /// Between routes of equal length it prefers to drive straight, then right, left, backwards;
    /// then longer hops to shorter ones.
    pub fn nextHop(search: *const Search, map: *const Map, view: View, pose: Pose) ?Hop {
        const steps = search.steps[pose.cell.x][pose.cell.y] orelse return null;
        if (steps == 0) return null;
        const ahead = pose.heading;
        const order = [_]Heading{
            ahead, ahead.turned(.right), ahead.turned(.left), ahead.opposite(),
        };
        for (order) |heading| {
            const cells = search.longestHop(map, view, pose.cell, heading, steps - 1);
            if (cells > 0) return .{ .heading = heading, .cells = cells };
        }
        return null;
    }

    /// The same, provided that the whole route still leads to the goal. Walls that close make no
    /// route shorter, so as long as none opens, such a route is still a shortest one, and there is
    /// no need to search again.
    pub fn firstHop(search: *const Search, map: *const Map, view: View, pose: Pose) ?Hop {
        const first = search.nextHop(map, view, pose) orelse return null;
        var at = first.from(pose);
        while (search.nextHop(map, view, at)) |hop| at = hop.from(at);
        return if (search.steps[at.cell.x][at.cell.y] == 0) first else null;
    }

    /// The longest drive in that direction that ends `goal` steps from the goal, or 0.
    fn longestHop(
        search: *const Search,
        map: *const Map,
        view: View,
        from: Cell,
        heading: Heading,
        goal: u16,
    ) u32 {
        var cell = from;
        var longest: u32 = 0;
        for (1..search.longest_move + 1) |cells| {
            if (!map.isOpen(view, cell, heading)) break;
            cell = cell.toward(heading, 1);
            if (search.steps[cell.x][cell.y] == goal) longest = @intCast(cells);
        }
        return longest;
    }
};
