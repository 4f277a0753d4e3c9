"""What a robot knows about the walls.

A set of cells is an integer: the cell in column x of row y is bit y * dimension + x. Python
shifts and combines integers of hundreds of bits in one operation, so that a search for the whole
maze takes a few hundred operations instead of thousands, and fuel in proportion.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from .interface import Cell, Heading, Sensors, Turn
from .pose import Pose


class Wall(Enum):
    """What is known about one wall."""

    UNKNOWN = 0
    OPEN = 1
    CLOSED = 2


class View(Enum):
    """How to treat unknown walls."""

    OPTIMISTIC = 0
    """Unknown walls count as open: for exploring."""
    PESSIMISTIC = 1
    """Unknown walls count as closed: for driving only where it is certain."""


@dataclass
class News:
    """What was new in a reading."""

    opened: int = 0
    """Walls that were not known to be open before."""
    closed: int = 0
    """Walls that were not known to be closed before."""


class Passages:
    """Which walls of a square maze may be driven through. The perimeter never may."""

    def __init__(self, dimension: int) -> None:
        """Every wall stands. The dimension is from 2 to 64."""
        if not 2 <= dimension <= 64:
            raise ValueError(f"the dimension is {dimension} and not from 2 to 64")
        self.dimension = dimension
        self.right = 0
        """The cells with an opening to the right."""
        self.up = 0
        """The cells with an opening above."""

    @staticmethod
    def all_open(dimension: int) -> Passages:
        """Only the perimeter stands."""
        passages = Passages(dimension)
        row = (1 << dimension - 1) - 1
        passages.right = sum(row << y * dimension for y in range(dimension))
        passages.up = (1 << dimension * (dimension - 1)) - 1
        return passages

    def contains(self, cell: Cell) -> bool:
        """Whether the maze has that cell."""
        return 0 <= cell.x < self.dimension and 0 <= cell.y < self.dimension

    def bit(self, cell: Cell) -> int:
        """The set with only this cell, which has to be in the maze."""
        return 1 << cell.y * self.dimension + cell.x

    def set_of(self, cells: Iterable[Cell]) -> int:
        """The set of these cells, which have to be in the maze."""
        return sum({self.bit(cell) for cell in cells})

    def is_open(self, cell: Cell, heading: Heading) -> bool:
        """Whether the wall on that side of `cell` may be driven through; `False` outside the
        maze."""
        if not self.contains(cell):
            return False
        return self.step(self.bit(cell), heading) != 0

    def step(self, cells: int, heading: Heading) -> int:
        """The cells that can be reached by driving one cell in that direction."""
        match heading:
            case Heading.UP:
                return (cells & self.up) << self.dimension
            case Heading.RIGHT:
                return (cells & self.right) << 1
            case Heading.DOWN:
                return cells >> self.dimension & self.up
            case _:
                return cells >> 1 & self.right

    def set(self, cell: Cell, heading: Heading, is_open: bool) -> None:
        """Opens or closes the wall on that side of `cell`, for both its cells; walls of the
        perimeter stay closed."""
        other = cell.toward(heading, 1)
        if not (self.contains(cell) and self.contains(other)):
            return
        bit = self.bit(min(cell, other))
        if heading in (Heading.UP, Heading.DOWN):
            self.up = self.up | bit if is_open else self.up & ~bit
        else:
            self.right = self.right | bit if is_open else self.right & ~bit

    def clear_cells(self, cell: Cell, heading: Heading, longest: int) -> int:
        """How many cells in a row can be driven from `cell` in that direction, at most
        `longest`."""
        at = self.bit(cell)
        for count in range(longest):
            at = self.step(at, heading)
            if not at:
                return count
        return longest


class Map:
    """The walls of a square maze, each unknown, open or closed.

    At first the perimeter is closed and everything else is unknown.
    """

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        """Cells along each side, from 2 to 64."""
        self.known = Passages(dimension)
        """The walls known to be open."""
        self.possible = Passages.all_open(dimension)
        """The walls not known to be closed."""

    def contains(self, cell: Cell) -> bool:
        """Whether the maze has that cell."""
        return self.known.contains(cell)

    def wall(self, cell: Cell, heading: Heading) -> Wall:
        """What is known about the wall on that side of `cell`. The perimeter and everything
        beyond it is closed."""
        if not self.possible.is_open(cell, heading):
            return Wall.CLOSED
        return Wall.OPEN if self.known.is_open(cell, heading) else Wall.UNKNOWN

    def set(self, cell: Cell, heading: Heading, wall: Wall) -> None:
        """Overrides what is known about a wall; the perimeter stays closed."""
        self.known.set(cell, heading, wall is Wall.OPEN)
        self.possible.set(cell, heading, wall is not Wall.CLOSED)

    def passages(self, view: View) -> Passages:
        """The walls that may be driven through in that view."""
        return self.possible if view is View.OPTIMISTIC else self.known

    def observe(self, pose: Pose, sensors: Sensors) -> News:
        """Adds a reading made at `pose`: in each of the three directions that many open walls
        and then a closed one. A reading that ends outside the maze ends at its perimeter."""
        news = News()
        heading = pose.heading
        self._look(pose.cell, heading.turned(Turn.LEFT), sensors.left, news)
        self._look(pose.cell, heading, sensors.front, news)
        self._look(pose.cell, heading.turned(Turn.RIGHT), sensors.right, news)
        return news

    def _look(self, cell: Cell, heading: Heading, reading: int, news: News) -> None:
        known, possible = self.known, self.possible
        for _ in range(reading):
            there = cell.toward(heading, 1)
            if not self.contains(there):
                break
            if not known.is_open(cell, heading):
                news.opened += 1
                known.set(cell, heading, True)
                possible.set(cell, heading, True)
            cell = there
        if possible.is_open(cell, heading):
            news.closed += 1
            known.set(cell, heading, False)
            possible.set(cell, heading, False)
