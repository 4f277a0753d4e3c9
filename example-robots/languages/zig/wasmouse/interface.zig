//! What the host gives and takes: numbers only. An action is three bytes in memory: its kind, the
//! turn, the advance.
const std = @import("std");
const builtin = @import("builtin");
const geometry = @import("geometry.zig");
const journal = @import("journal.zig");

/// How far the robot could drive in each direction before a wall stops it, in cells. 0 is a wall
/// directly at that side. There is no rear sensor.
pub const Sensors = struct { left: u32, front: u32, right: u32 };

pub const BudgetScope = enum(u32) { both_runs, each_run };

/// Everything that a robot is told before its first step.
pub const Briefing = struct {
    /// The maze has `dimension` x `dimension` cells: 2 to 64.
    dimension: u32,
    /// Where both runs start.
    start: geometry.Cell,
    /// In contest mazes the 2 x 2 room in the centre.
    goal: geometry.Area,
    /// How many steps the robot may take.
    budget: u32,
    budget_scope: BudgetScope,
    /// The longest move in one step, in cells.
    longest_move: u32,
    /// 1 in all current rulesets.
    units_per_cell: u32,
    /// Divides the steps of the exploration run in the score.
    exploration_divisor: u32,
    /// The only source of randomness.
    seed: u64,
    /// Selects a variant of the robot.
    variant: u32,
};

/// What the robot does in one step.
pub const Action = union(enum) {
    /// Turn, then drive that many cells; negative drives backwards.
    move: struct { turn: geometry.Turn, advance: i8 },
    /// Begin the speed run in the start cell.
    reset,
};

/// Makes a type with `fn start(*Robot, Briefing) void` and `fn nextMove(*Robot, Sensors) Action`
/// the robot of this module. Does nothing in tests on this machine.
pub fn exportRobot(comptime Robot: type) void {
    const name = "wasmouse:robot/controller@0.2.0#";
    const exports = struct {
        var robot: Robot = undefined;
        var answer: [3]u8 = undefined;

        fn start(
            dimension: u32,
            start_x: u32,
            start_y: u32,
            goal_x: u32,
            goal_y: u32,
            goal_width: u32,
            goal_height: u32,
            budget: u32,
            budget_scope: u32,
            longest_move: u32,
            units_per_cell: u32,
            exploration_divisor: u32,
            seed: u64,
            variant: u32,
        ) callconv(.c) void {
            robot.start(.{
                .dimension = dimension,
                .start = .{ .x = start_x, .y = start_y },
                .goal = .{
                    .origin = .{ .x = goal_x, .y = goal_y },
                    .width = goal_width,
                    .height = goal_height,
                },
                .budget = budget,
                .budget_scope = @enumFromInt(budget_scope),
                .longest_move = longest_move,
                .units_per_cell = units_per_cell,
                .exploration_divisor = exploration_divisor,
                .seed = seed,
                .variant = variant,
            });
        }

        fn nextMove(left: u32, front: u32, right: u32) callconv(.c) *const [3]u8 {
            answer = switch (robot.nextMove(.{ .left = left, .front = front, .right = right })) {
                .move => |it| .{ 0, @intFromEnum(it.turn), @bitCast(it.advance) },
                .reset => .{ 1, 0, 0 },
            };
            return &answer;
        }
    };
    if (builtin.cpu.arch.isWasm()) {
        @export(&exports.start, .{ .name = name ++ "start" });
        @export(&exports.nextMove, .{ .name = name ++ "next-move" });
    }
}

/// What safety checks and `@panic` call: the message ends the match. A robot has it as
/// `pub const panic = wasmouse.interface.panic;`.
pub const panic = std.debug.FullPanic(struct {
    fn report(message: []const u8, _: ?usize) noreturn {
        journal.fatal(message);
    }
}.report);
