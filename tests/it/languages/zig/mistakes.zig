        const table = [_]u32{ 1, 2, 3 };
        var small: u8 = 250;
        var nothing: ?u32 = null;
        if (briefing.variant == 99) nothing = briefing.budget;
        switch (briefing.variant) {
            0 => {},
            1 => small +%= @truncate(table[briefing.budget]), // an index
            2 => small += @as(u8, @intCast(briefing.variant)) * 3, // an overflow
            3 => if (briefing.budget > 10) unreachable, // the unreachable
            4 => small +%= @truncate(nothing.?), // a null
            5 => small = @intCast(briefing.budget), // a cast
            6 => @panic("I give up"), // a panic
            7 => small /= @truncate(briefing.start.x), // a division
            else => wasmouse.fail(@src(), "this robot has only the variants 0 to 7"),
        }
        wasmouse.journal.log(.info, "{d}", .{small});
