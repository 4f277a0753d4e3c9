//! The flood robot: drives along a shortest path to the goal, taking unknown walls for open ones,
//! resets in the goal, and drives the shortest path that it knows.
const wasmouse = @import("wasmouse");
const Action = wasmouse.Action;
const Briefing = wasmouse.Briefing;
const Pose = wasmouse.Pose;
const Search = wasmouse.Search;
const Sensors = wasmouse.Sensors;
const Tracker = wasmouse.Tracker;

/// Safety checks and `@panic` end the match with their message.
pub const panic = wasmouse.interface.panic;

comptime {
    wasmouse.exportRobot(Robot);
}

pub const Robot = struct {
    tracker: Tracker,
    to_goal: Search,
    /// Where the last hop leads, if it was part of a route that was whole.
    expected: ?Pose,

    pub fn start(robot: *Robot, briefing: Briefing) void {
        if (briefing.variant != 0) wasmouse.fail(@src(), "this robot has only the variant 0");
        robot.* = .{
            .tracker = .init(briefing),
            .to_goal = .init(briefing.longest_move),
            .expected = null,
        };
    }

    pub fn nextMove(robot: *Robot, sensors: Sensors) Action {
        if (robot.tracker.observe(sensors) > 0) robot.expected = null;
        if (robot.tracker.run == .speed) return robot.driveToGoal(.pessimistic);
        if (robot.tracker.mayReset()) {
            robot.expected = null;
            return robot.tracker.reset();
        }
        return robot.driveToGoal(.optimistic);
    }

    /// The first step of a shortest path. Searches only when the path of the last search is no
    /// longer whole: walls that close make nothing shorter.
    fn driveToGoal(robot: *Robot, view: wasmouse.View) Action {
        const map = &robot.tracker.map;
        const pose = robot.tracker.pose;
        const is_expected = if (robot.expected) |expected| expected.eql(pose) else false;
        var hop = if (is_expected)
            robot.to_goal.nextHop(map, view, pose)
        else
            robot.to_goal.firstHop(map, view, pose);
        if (hop == null) {
            robot.to_goal.fillUntil(map, view, robot.tracker.briefing.goal, pose.cell);
            hop = robot.to_goal.nextHop(map, view, pose);
        }
        const found = hop orelse {
            robot.expected = null;
            return robot.tracker.turn(.right); // the goal is walled in
        };
        robot.expected = found.from(pose);
        return robot.tracker.go(found.heading, found.cells);
    }
};
