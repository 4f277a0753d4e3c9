"""Where a robot is: a cell and a heading."""

from __future__ import annotations

from dataclasses import dataclass

from .interface import Cell, Heading, Turn


@dataclass(frozen=True)
class Hop:
    """A move in a straight line, in one step."""

    heading: Heading
    """The direction of travel in the maze."""
    cells: int
    """How far, in cells, at least 1."""


@dataclass(frozen=True)
class Pose:
    """A cell and a heading."""

    cell: Cell
    heading: Heading

    @staticmethod
    def at_start(start: Cell) -> Pose:
        """The pose in which both runs begin: in the start cell, heading up."""
        return Pose(start, Heading.UP)

    def hopped(self, hop: Hop) -> Pose:
        """The pose after a hop. The robot turns to the hop's heading, unless that is behind it;
        then it drives backwards."""
        turn = self.heading.turn_to(hop.heading)
        return self.moved(Turn.STRAIGHT if turn is None else turn, hop.heading, hop.cells)

    def moved(self, turn: Turn, travel: Heading, cells: int) -> Pose:
        """The pose after a turn and then `cells` cells in direction `travel`, which is the new
        heading or, for a backward move, its opposite."""
        return Pose(self.cell.toward(travel, cells), self.heading.turned(turn))
