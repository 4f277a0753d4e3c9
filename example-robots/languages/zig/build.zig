//! `wasmouse build` runs `zig build`; `zig build test` plays a maze on this machine.
const std = @import("std");

pub fn build(b: *std.Build) void {
    // Safety checks stay on: a mistake ends the match with a message instead of going on with wrong numbers.
    const optimize = b.option(std.builtin.Optimize, "optimize", "Default: safe") orelse .safe;

    const wasm = b.resolveTargetQuery(.{ .cpu_arch = .wasm32, .os_tag = .freestanding });
    const exe = b.addExecutable(.{
        .name = "robot",
        .root_module = robotModule(b, "src/robot.zig", wasm, optimize),
    });
    exe.entry = .disabled;
    exe.rdynamic = true;
    b.installArtifact(exe);

    const tests = b.addTest(.{
        .root_module = robotModule(b, "src/test.zig", b.graph.host, .debug),
    });
    const test_step = b.step("test", "Play a maze");
    test_step.dependOn(&b.addRunArtifact(tests).step);
}

fn robotModule(
    b: *std.Build,
    root: []const u8,
    target: std.Build.ResolvedTarget,
    optimize: std.builtin.Optimize,
) *std.Build.Module {
    const sdk = b.createModule(.{
        .root_source_file = b.path("wasmouse/wasmouse.zig"),
        .target = target,
        .optimize = optimize,
    });
    return b.createModule(.{
        .root_source_file = b.path(root),
        .target = target,
        .optimize = optimize,
        .imports = &.{.{ .name = "wasmouse", .module = sdk }},
    });
}
