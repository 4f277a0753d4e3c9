//! The journal: how a robot reports to people. `wasmouse run --explain` and the web page show it.
//! In tests on this machine the entries go nowhere.
const std = @import("std");
const builtin = @import("builtin");
const geometry = @import("geometry.zig");
const Cell = geometry.Cell;

pub const Level = enum(u32) { debug, info, warning, @"error" };
pub const Color = enum(u32) { none, red, orange, yellow, green, cyan, blue, violet, gray };
pub const Belief = enum(u32) { unknown, open, closed };

const imports = if (builtin.cpu.arch.isWasm()) struct {
    extern "wasmouse:robot/journal@0.2.0" fn log(level: u32, text: [*]const u8, bytes: usize) void;
    extern "wasmouse:robot/journal@0.2.0" fn paint(x: u32, y: u32, color: u32) void;
    extern "wasmouse:robot/journal@0.2.0" fn label(x: u32, y: u32, text: [*]const u8, bytes: usize) void;
    extern "wasmouse:robot/journal@0.2.0" fn wall(x: u32, y: u32, side: u32, belief: u32) void;
    extern "wasmouse:robot/journal@0.2.0" fn panic(text: [*]const u8, bytes: usize) void;
} else struct {
    fn log(_: u32, _: [*]const u8, _: usize) void {}
    fn paint(_: u32, _: u32, _: u32) void {}
    fn label(_: u32, _: u32, _: [*]const u8, _: usize) void {}
    fn wall(_: u32, _: u32, _: u32, _: u32) void {}
    fn panic(text: [*]const u8, bytes: usize) void {
        @panic(text[0..bytes]);
    }
};

/// Writes a line of text, formatted as by `std.fmt`; the host keeps what fits into 256 bytes.
pub fn log(level: Level, comptime format: []const u8, arguments: anytype) void {
    var buffer: [256]u8 = undefined;
    const text = std.fmt.bufPrint(&buffer, format, arguments) catch &buffer;
    imports.log(@intFromEnum(level), text.ptr, text.len);
}

/// Colours a cell.
pub fn paint(cell: Cell, color: Color) void {
    imports.paint(cell.x, cell.y, @intFromEnum(color));
}

/// Writes at most 8 characters into a cell.
pub fn label(cell: Cell, text: []const u8) void {
    imports.label(cell.x, cell.y, text.ptr, text.len);
}

/// States what the robot believes about a wall.
pub fn wall(cell: Cell, side: geometry.Heading, belief: Belief) void {
    imports.wall(cell.x, cell.y, @intFromEnum(side), @intFromEnum(belief));
}

/// Ends the match with a message.
pub fn fatal(message: []const u8) noreturn {
    imports.panic(message.ptr, message.len);
    unreachable;
}

/// Ends the match with a message and its place in the source.
pub fn fail(place: std.builtin.SourceLocation, message: []const u8) noreturn {
    var buffer: [2000]u8 = undefined;
    const text = std.fmt.bufPrint(&buffer, "{s} ({s}:{d}:{d})", .{
        message, place.file, place.line, place.column,
    }) catch message;
    fatal(text);
}
