//! Plays a maze on this machine: run with `zig build test`.
const std = @import("std");
const wasmouse = @import("wasmouse");
const Robot = @import("robot.zig").Robot;
const Cell = wasmouse.Cell;
const Heading = wasmouse.Heading;
const Pose = wasmouse.Pose;
const expect = std.testing.expect;
const expectEqual = std.testing.expectEqual;

const Maze = struct {
    dimension: u32,
    /// By x and y: a bit for each heading without a wall.
    open: [64][64]u4,

    /// Reads the Udacity format: the dimension, then one line per column.
    fn parse(text: []const u8) !Maze {
        var numbers = std.mem.tokenizeAny(u8, text, ",\n");
        var maze: Maze = .{ .dimension = 0, .open = @splat(@splat(0)) };
        maze.dimension = try std.fmt.parseInt(u32, numbers.next().?, 10);
        for (0..maze.dimension) |x| for (0..maze.dimension) |y| {
            maze.open[x][y] = try std.fmt.parseInt(u4, numbers.next().?, 10);
        };
        return maze;
    }

    fn clearCells(maze: *const Maze, from: Cell, heading: Heading) u32 {
        var cell = from;
        var cells: u32 = 0;
        while (maze.open[cell.x][cell.y] >> @intFromEnum(heading) & 1 != 0) : (cells += 1) {
            cell = cell.toward(heading, 1);
        }
        return cells;
    }
};

const Played = struct {
    finished: bool = false,
    exploration_steps: u32 = 0,
    speed_steps: u32 = 0,
    /// Moves that a wall cut short.
    bumps: u32 = 0,
};

var robot: Robot = undefined;

/// A match by the rules of the contest.
fn play(maze: *const Maze) Played {
    const centre = maze.dimension / 2 - 1;
    const briefing: wasmouse.Briefing = .{
        .dimension = maze.dimension,
        .start = .{ .x = 0, .y = 0 },
        .goal = .{ .origin = .{ .x = centre, .y = centre }, .width = 2, .height = 2 },
        .budget = 1000,
        .budget_scope = .both_runs,
        .longest_move = 3,
        .units_per_cell = 1,
        .exploration_divisor = 30,
        .seed = 0,
        .variant = 0,
    };
    var played: Played = .{};
    var pose: Pose = .atStart(briefing.start);
    var goal_seen = false;
    var in_speed_run = false;
    robot.start(briefing);
    for (0..briefing.budget) |_| {
        const action = robot.nextMove(.{
            .left = maze.clearCells(pose.cell, pose.heading.turned(.left)),
            .front = maze.clearCells(pose.cell, pose.heading),
            .right = maze.clearCells(pose.cell, pose.heading.turned(.right)),
        });
        if (in_speed_run) played.speed_steps += 1 else played.exploration_steps += 1;
        switch (action) {
            .reset => if (goal_seen and !in_speed_run) {
                in_speed_run = true;
                pose = .atStart(briefing.start);
            },
            .move => |move| {
                pose.heading = pose.heading.turned(move.turn);
                const travel = if (move.advance < 0) pose.heading.opposite() else pose.heading;
                const wish: u32 = @min(@abs(move.advance), briefing.longest_move);
                const cells = @min(wish, maze.clearCells(pose.cell, travel));
                if (cells < wish) played.bumps += 1;
                pose.cell = pose.cell.toward(travel, cells);
                if (!briefing.goal.contains(pose.cell)) continue;
                goal_seen = true;
                if (in_speed_run) {
                    played.finished = true;
                    break;
                }
            },
        }
    }
    return played;
}

test "the robot finishes a maze" {
    const maze: Maze = try .parse(@embedFile("maze.txt"));
    const expected: Played = .{ .finished = true, .exploration_steps = 31, .speed_steps = 21 };
    try expectEqual(expected, play(&maze));
}

test "readings are on both sides of each wall" {
    var map: wasmouse.Map = .init(12);
    const pose: Pose = .atStart(.{ .x = 0, .y = 0 });
    // To the right, and ahead of the third cell; the perimeter is known.
    try expectEqual(2, map.observe(pose, .{ .left = 0, .front = 2, .right = 0 }));
    try expectEqual(.open, map.wall(.{ .x = 0, .y = 2 }, .down));
    try expectEqual(.closed, map.wall(.{ .x = 0, .y = 3 }, .down));
    try expectEqual(.unknown, map.wall(.{ .x = 0, .y = 2 }, .right));
}

test "a step drives up to three cells" {
    const map: wasmouse.Map = .init(12);
    var search: wasmouse.Search = .init(3);
    const pose: Pose = .atStart(.{ .x = 0, .y = 0 });
    const goal: wasmouse.Area = .{ .origin = .{ .x = 5, .y = 0 }, .width = 1, .height = 1 };
    search.fillUntil(&map, .optimistic, goal, pose.cell);
    try expectEqual(2, search.steps[0][0]);
    const hop = search.nextHop(&map, .optimistic, pose).?;
    try expect(hop.heading == .right and hop.cells == 3);
}
