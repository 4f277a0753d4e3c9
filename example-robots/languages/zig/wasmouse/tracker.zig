//! The robot's position, the walls that it has seen, and the run that it is in.
const geometry = @import("geometry.zig");
const interface = @import("interface.zig");
const Action = interface.Action;
const Briefing = interface.Briefing;
const Heading = geometry.Heading;
const Map = @import("map.zig").Map;
const Pose = geometry.Pose;
const Turn = geometry.Turn;

pub const Run = enum { exploration, speed };

/// Stays correct as long as the robot returns only actions from `go`, `turn` and `reset`. Moves are
/// limited to what is known to be open, so the robot never bumps.
pub const Tracker = struct {
    briefing: Briefing,
    pose: Pose,
    map: Map,
    run: Run = .exploration,
    /// A step of the exploration run has ended in the goal.
    goal_seen: bool = false,
    /// Of the current budget, including this one.
    steps_left: u32,

    pub fn init(briefing: Briefing) Tracker {
        return .{
            .briefing = briefing,
            .pose = .atStart(briefing.start),
            .map = .init(briefing.dimension),
            .steps_left = briefing.budget,
        };
    }

    /// Adds the readings of this step to the map. Returns how many closed walls are new.
    pub fn observe(tracker: *Tracker, sensors: interface.Sensors) u32 {
        return tracker.map.observe(tracker.pose, sensors);
    }

    /// The action that drives up to `wish` cells in that direction of the maze, limited to cells
    /// known to be reachable and to the longest move. It drives backwards if the direction is
    /// behind the robot; if the nearest wall there is unknown, it turns right on the spot to see it.
    pub fn go(tracker: *Tracker, heading: Heading, wish: u32) Action {
        const cell = tracker.pose.cell;
        const cells = @min(wish, tracker.briefing.longest_move);
        const clear = tracker.map.clearCells(.pessimistic, cell, heading, cells);
        const advance: i8 = @intCast(clear);
        if (tracker.pose.heading.turnTo(heading)) |to| return tracker.answer(to, heading, advance);
        if (clear == 0 and cells > 0 and tracker.map.isOpen(.optimistic, cell, heading)) {
            return tracker.answer(.right, heading, 0);
        }
        return tracker.answer(.straight, heading, -advance);
    }

    /// The action that only turns.
    pub fn turn(tracker: *Tracker, to: Turn) Action {
        return tracker.answer(to, tracker.pose.heading, 0);
    }

    /// The reset, which begins the speed run in the start cell.
    pub fn reset(tracker: *Tracker) Action {
        tracker.steps_left -|= 1;
        if (tracker.mayReset()) {
            tracker.run = .speed;
            tracker.pose = .atStart(tracker.briefing.start);
            if (tracker.briefing.budget_scope == .each_run) {
                tracker.steps_left = tracker.briefing.budget;
            }
        }
        return .reset;
    }

    /// Whether the host accepts a reset: in the exploration run, after a step has ended in the goal.
    pub fn mayReset(tracker: *const Tracker) bool {
        return tracker.run == .exploration and tracker.goal_seen;
    }

    fn answer(tracker: *Tracker, to: Turn, travel: Heading, advance: i8) Action {
        tracker.pose = .{
            .cell = tracker.pose.cell.toward(travel, @abs(advance)),
            .heading = tracker.pose.heading.turned(to),
        };
        tracker.steps_left -|= 1;
        if (tracker.briefing.goal.contains(tracker.pose.cell)) tracker.goal_seen = true;
        return .{ .move = .{ .turn = to, .advance = advance } };
    }
};
