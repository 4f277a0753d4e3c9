"""What a robot and the host tell each other, as in `wit/robot.wit` of wasmouse.

Distances (readings, `Move.advance`, `Briefing.longest_move`) are in units. All current rulesets
have 1 unit per cell, so a distance is a number of cells.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, IntEnum


class Turn(IntEnum):
    """A rotation on the spot, done before the robot moves."""

    LEFT = 0
    """A quarter turn counterclockwise (-90 degrees)."""
    STRAIGHT = 1
    """No rotation."""
    RIGHT = 2
    """A quarter turn clockwise (+90 degrees)."""


class Heading(IntEnum):
    """A direction in the maze, independent of the robot."""

    UP = 0
    """Towards larger `y`. The robot starts both runs with this heading."""
    RIGHT = 1
    """Towards larger `x`."""
    DOWN = 2
    """Towards smaller `y`."""
    LEFT = 3
    """Towards smaller `x`."""

    def turned(self, turn: Turn) -> Heading:
        """The heading after a turn on the spot."""
        return Heading((self + turn - 1) & 3)

    def opposite(self) -> Heading:
        """The opposite heading."""
        return Heading((self + 2) & 3)

    def turn_to(self, target: Heading) -> Turn | None:
        """The turn from this heading to `target`; `None` if that is behind the robot, because
        one step cannot turn that far."""
        return _TURN_TO[(target - self) & 3]


_TURN_TO = (Turn.STRAIGHT, Turn.RIGHT, None, Turn.LEFT)


@dataclass(frozen=True)
class Sensors:
    """What the robot senses in its current position before it acts: in each direction relative
    to its heading, how far it could drive before a wall stops it.

    0 means a wall directly at that side. There is no rear sensor. Unit: units. In all current
    rulesets the readings are exact and range from 0 to `briefing.dimension` - 1.
    """

    left: int
    """Free distance to the left of the robot."""
    front: int
    """Free distance ahead of the robot."""
    right: int
    """Free distance to the right of the robot."""


@dataclass(frozen=True)
class Move:
    """Turn first, then drive along the new heading."""

    turn: Turn
    """The rotation, done first."""
    advance: int
    """How far to drive after the rotation. Unit: units, from -128 to 127. Negative drives
    backwards with the heading unchanged. The host clamps it to -`briefing.longest-move` ..=
    `briefing.longest-move` and counts the clamp. At the first wall the robot stops and keeps the
    distance it has covered, and the host counts a bump. Neither costs anything extra."""


@dataclass(frozen=True)
class Reset:
    """End the exploration run and begin the speed run in the start cell, heading up.

    The reset itself is a step of the exploration run. It is ignored (the robot stays where it is
    and the step is spent) until a step of the exploration run has ended in the goal, and
    throughout the speed run.
    """


Action = Move | Reset
"""What the robot does in one step. Every action takes one step.

- `Move`: Turn, then drive.
- `Reset`: end the exploration run.
"""


@dataclass(frozen=True, order=True)
class Cell:
    """A cell of the maze. `x` grows to the right, `y` grows upward, and (0, 0) is the bottom left
    corner."""

    x: int
    """Column, counted from the left, starting at 0."""
    y: int
    """Row, counted from the bottom, starting at 0."""

    def toward(self, heading: Heading, distance: int) -> Cell:
        """The cell `distance` cells away in that direction, ignoring walls and the size of the
        maze."""
        dx, dy = _STEP[heading]
        return Cell(self.x + dx * distance, self.y + dy * distance)


_STEP = ((0, 1), (1, 0), (0, -1), (-1, 0))


@dataclass(frozen=True)
class Area:
    """A rectangle of cells."""

    origin: Cell
    """The bottom left cell of the rectangle."""
    width: int
    """Unit: cells."""
    height: int
    """Unit: cells."""

    def __contains__(self, cell: Cell) -> bool:
        """Whether `cell` lies in the rectangle."""
        dx, dy = cell.x - self.origin.x, cell.y - self.origin.y
        return 0 <= dx < self.width and 0 <= dy < self.height

    def cells(self) -> Iterator[Cell]:
        """All cells, column by column from the left, each from the bottom up."""
        for dx in range(self.width):
            for dy in range(self.height):
                yield Cell(self.origin.x + dx, self.origin.y + dy)

    @staticmethod
    def center(dimension: int) -> Area:
        """The goal room of a contest maze: the 2 x 2 cells in the centre, or the single centre
        cell if `dimension` is odd."""
        low = (dimension - 1) // 2
        side = 2 if dimension % 2 == 0 else 1
        return Area(Cell(low, low), side, side)


class BudgetScope(Enum):
    """How `briefing.budget` applies to the two runs."""

    BOTH_RUNS = 0
    """The two runs share the budget."""
    EACH_RUN = 1
    """Each run has the whole budget for itself."""


@dataclass(frozen=True)
class Briefing:
    """Everything a robot is told before its first step.

    A match has an exploration run and then a speed run. The speed run ends with the first step
    that ends in a goal cell; passing through one does not count. The score is the number of steps
    in the speed run plus the number of steps in the exploration run divided by
    `exploration-divisor`. Lower is better.
    """

    dimension: int
    """The maze has `dimension` x `dimension` cells. Range: 2 to 64, or 0 if the track does not
    tell. All current rulesets tell it; in contest mazes it is an even number from 12 to 20."""
    start: Cell
    """The cell where both runs start. In contest mazes (0, 0)."""
    goal: Area
    """The goal cells. In contest mazes the 2 x 2 room in the centre. A `width` and a `height` of
    0 mean that the track does not tell; all current rulesets tell it."""
    budget: int
    """How many steps the robot may take. Unit: steps. Range: 1 to 1,000,000; the ruleset
    `udacity` sets 1,000. The step numbered `budget` is still executed."""
    budget_scope: BudgetScope
    """Whether the two runs share `budget` or each has all of it."""
    longest_move: int
    """The longest move in one step, forwards or backwards. Unit: units. Range: 1 to 127. The
    ruleset `udacity` sets 3."""
    units_per_cell: int
    """The distance from the centre of a cell to that of the next one. Unit: units. At least 1,
    and 1 in all current rulesets. A robot that assumes 1 should trap on any other value."""
    exploration_divisor: int
    """Steps of the exploration run are divided by this number in the score. Range: 1 to
    1,000,000; the ruleset `udacity` sets 30."""
    seed: int
    """The robot's only source of randomness. The same seed in the same maze always gives the same
    match. Range: 0 to 2**64 - 1. The module `random` is seeded with it."""
    variant: int
    """Selects a variant of the robot. Each robot documents its own; the default is 0. A robot
    should trap on a variant that it does not have."""

    @staticmethod
    def contest(dimension: int) -> Briefing:
        """The briefing of the ruleset `udacity` for a contest maze of this size, for tests."""
        return Briefing(
            dimension=dimension,
            start=Cell(0, 0),
            goal=Area.center(dimension),
            budget=1000,
            budget_scope=BudgetScope.BOTH_RUNS,
            longest_move=3,
            units_per_cell=1,
            exploration_divisor=30,
            seed=0,
            variant=0,
        )
