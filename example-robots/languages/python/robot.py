"""The flood robot: flood fill, treating unknown walls as open.

- *Exploration run*: unknown walls count as open. After every reading it finds the path with the
  fewest steps to the goal and takes its first step. In the goal it resets.
- *Speed run*: the fewest steps through walls known to be open.

Between paths of equal length it prefers to drive straight, then right, then left, then backwards,
and prefers long moves to short ones.
"""

from wasmouse import Action, Briefing, Pose, Run, Search, Sensors, Tracker, Turn, View


class Robot:
    """One robot drives one match: everything in `self` stays until the match ends."""

    def __init__(self, briefing: Briefing) -> None:
        if briefing.variant != 0:
            raise ValueError("this robot has only variant 0")
        self.tracker = Tracker(briefing)
        self.search = Search(briefing.dimension, briefing.longest_move)
        self.goal = list(briefing.goal.cells())
        # The next pose on a route of the last search that is known to be whole.
        self.on_route: Pose | None = None

    def next_move(self, sensors: Sensors) -> Action:
        """The action for the readings at the current position. Called once per step."""
        news = self.tracker.observe(sensors)
        if news.closed:
            self.on_route = None
        if self.tracker.run is Run.SPEED:
            return self.drive_to_goal(View.PESSIMISTIC)
        if not self.tracker.may_reset():
            return self.drive_to_goal(View.OPTIMISTIC)
        self.on_route = None
        return self.tracker.reset()

    def drive_to_goal(self, view: View) -> Action:
        """The first step of a shortest path to the goal. Searches only when the path of the last
        search is no longer whole: walls that close make nothing shorter."""
        pose = self.tracker.pose
        passages = self.tracker.map.passages(view)
        if self.on_route == pose:
            hop = next(self.search.route(passages, pose), None)
        else:
            hop = self.search.first_hop(passages, pose)
        if hop is None:
            self.search.fill_until(passages, self.goal, pose.cell)
            hop = next(self.search.route(passages, pose), None)
        if hop is None:
            self.on_route = None
            return self.tracker.turn(Turn.RIGHT)
        self.on_route = pose.hopped(hop)
        return self.tracker.go(hop.heading, hop.cells)
