"""The state of a match as a robot knows it. It decides nothing."""

from __future__ import annotations

from enum import Enum

from .interface import Action, Briefing, BudgetScope, Cell, Heading, Move, Reset, Sensors, Turn
from .map import Map, News
from .pose import Pose


class Run(Enum):
    """One of the two runs of a match."""

    EXPLORATION = 1
    """The exploration run: find the goal, learn the maze, reset."""
    SPEED = 2
    """The speed run: to the goal in as few steps as possible."""


class Tracker:
    """The robot's position, the walls that it has seen, and the steps that are left.

    In each step, pass the readings to `observe` and return the action from `go`, `turn` or
    `reset`. Moves are limited to what is known to be open, so the robot never bumps and always
    knows its position.
    """

    def __init__(self, briefing: Briefing) -> None:
        self.briefing = briefing
        self.map = Map(briefing.dimension)
        if not self.map.contains(briefing.start):
            raise ValueError("the start is outside the maze")
        self.pose = Pose.at_start(briefing.start)
        self.run = Run.EXPLORATION
        self.steps_left = briefing.budget
        """How many steps are left, including this one. If each run has its own budget, that of the
        current run."""
        self._goal_seen = False

    @property
    def cell(self) -> Cell:
        """The robot's cell."""
        return self.pose.cell

    def observe(self, sensors: Sensors) -> News:
        """Adds the readings of this step to the map."""
        return self.map.observe(self.pose, sensors)

    def go(self, heading: Heading, cells: int) -> Action:
        """The action that drives up to `cells` cells in that direction of the maze, limited to
        cells known to be reachable and to the longest move.

        It turns if the direction is to a side, and drives backwards if it is behind the robot.
        There is no rear sensor: if the nearest wall behind is unknown, the action turns right on
        the spot instead, to see it in the next step.
        """
        cells = min(cells, self.briefing.longest_move)
        clear = self.map.known.clear_cells(self.cell, heading, cells)
        turn = self.pose.heading.turn_to(heading)
        if turn is not None:
            return self._answer(turn, heading, clear)
        if clear == 0 and cells > 0 and self.map.possible.is_open(self.cell, heading):
            return self._answer(Turn.RIGHT, heading, 0)
        return self._answer(Turn.STRAIGHT, heading, -clear)

    def turn(self, turn: Turn) -> Action:
        """The action that only turns."""
        return self._answer(turn, self.pose.heading, 0)

    def reset(self) -> Action:
        """The reset, which begins the speed run in the start cell. Where the host ignores it (see
        `may_reset`) the position stays and the step is spent."""
        self.steps_left = max(self.steps_left - 1, 0)
        if self.may_reset():
            self.run = Run.SPEED
            self.pose = Pose.at_start(self.briefing.start)
            if self.briefing.budget_scope is BudgetScope.EACH_RUN:
                self.steps_left = self.briefing.budget
        return Reset()

    def may_reset(self) -> bool:
        """Whether the host accepts a reset: in the exploration run, after a step has ended in the
        goal."""
        return self.run is Run.EXPLORATION and self._goal_seen

    def in_goal(self) -> bool:
        """Whether the robot is in the goal."""
        return self.cell in self.briefing.goal

    def _answer(self, turn: Turn, travel: Heading, advance: int) -> Action:
        self.pose = self.pose.moved(turn, travel, abs(advance))
        self.steps_left = max(self.steps_left - 1, 0)
        self._goal_seen = self._goal_seen or self.in_goal()
        return Move(turn, advance)
