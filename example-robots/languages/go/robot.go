package main

import "example.com/example-robot/wasmouse"

// Flood is the flood robot: flood fill, treating unknown walls as open.
//
//   - Exploration run: unknown walls count as open. After every reading it finds the path with the
//     fewest steps to the goal and takes its first step. In the goal it resets.
//   - Speed run: the fewest steps through walls known to be open.
//
// Between paths of equal length it prefers to drive straight, then right, then left, then
// backwards, and prefers long moves to short ones.
type Flood struct {
	tracker *wasmouse.Tracker
	search  *wasmouse.Search
	goal    []wasmouse.Cell
	// The next pose on a route of the last search that is known to be whole.
	onRoute *wasmouse.Pose
}

// Start returns the robot for a match. Everything in it stays until the match ends.
func Start(briefing wasmouse.Briefing) wasmouse.Robot {
	if briefing.Variant != 0 {
		panic("this robot has only variant 0")
	}
	return &Flood{
		tracker: wasmouse.NewTracker(briefing),
		search:  wasmouse.NewSearch(briefing.Dimension, briefing.LongestMove),
		goal:    briefing.Goal.Cells(),
	}
}

// NextMove returns the action for the readings at the current position.
func (f *Flood) NextMove(sensors wasmouse.Sensors) wasmouse.Action {
	news := f.tracker.Observe(sensors)
	if news.Closed > 0 {
		f.onRoute = nil
	}
	switch {
	case f.tracker.Run() == wasmouse.Speed:
		return f.driveToGoal(wasmouse.Pessimistic)
	case !f.tracker.MayReset():
		return f.driveToGoal(wasmouse.Optimistic)
	}
	f.onRoute = nil
	return f.tracker.Reset()
}

// The first step of a shortest path to the goal. Searches only when the path of the last search is
// no longer whole: walls that close make nothing shorter.
func (f *Flood) driveToGoal(view wasmouse.View) wasmouse.Action {
	pose := f.tracker.Pose()
	passages := f.tracker.Map().Passages(view)
	var hop wasmouse.Hop
	var found bool
	if f.onRoute != nil && *f.onRoute == pose {
		hop, found = f.search.NextHop(passages, pose)
	} else {
		hop, found = f.search.FirstHop(passages, pose)
	}
	if !found {
		f.search.FillUntil(passages, f.goal, pose.Cell)
		hop, found = f.search.NextHop(passages, pose)
	}
	if !found {
		f.onRoute = nil
		return f.tracker.Turn(wasmouse.TurnRight)
	}
	next := pose.Hopped(hop)
	f.onRoute = &next
	return f.tracker.Go(hop.Heading, hop.Cells)
}
