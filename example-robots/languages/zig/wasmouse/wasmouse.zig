//! The small SDK of a robot: geometry, the map, the search for short paths, the tracker, and the
//! interface to the host.

pub const geometry = @import("geometry.zig");
pub const interface = @import("interface.zig");
pub const journal = @import("journal.zig");

pub const Heading = geometry.Heading;
pub const Turn = geometry.Turn;
pub const Cell = geometry.Cell;
pub const Area = geometry.Area;
pub const Pose = geometry.Pose;

pub const Sensors = interface.Sensors;
pub const Briefing = interface.Briefing;
pub const BudgetScope = interface.BudgetScope;
pub const Action = interface.Action;
pub const exportRobot = interface.exportRobot;

pub const Map = @import("map.zig").Map;
pub const Wall = @import("map.zig").Wall;
pub const View = @import("map.zig").View;
pub const Search = @import("search.zig").Search;
pub const Hop = @import("search.zig").Hop;
pub const Tracker = @import("tracker.zig").Tracker;
pub const Run = @import("tracker.zig").Run;

/// Ends the match with a message and its place in the source: `fail(@src(), "no way out")`.
pub const fail = journal.fail;
