"""The flood: the fewest steps from every cell to a set of cells.

A breadth-first search over steps: one step drives up to the longest move in a straight line, in
any of the four directions (including backwards, so the heading does not matter).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .interface import Cell, Heading, Turn
from .map import Passages
from .pose import Hop, Pose


class Search:
    """Distances in steps to a set of cells."""

    def __init__(self, dimension: int, longest_move: int) -> None:
        self.dimension = dimension
        self.longest_move = longest_move
        self._layers: list[int] = []
        """The cells that are 0, 1, 2, ... steps away from a target."""

    def fill(self, passages: Passages, targets: Iterable[Cell]) -> None:
        """Computes the distance of every cell to the nearest of `targets`."""
        self._search(passages, targets, 0)

    def fill_until(self, passages: Passages, targets: Iterable[Cell], origin: Cell) -> None:
        """Like `fill`, but stops when the distance of `origin` is known. All cells at most as far
        are known then; the others count as not reached."""
        self._search(passages, targets, passages.bit(origin))

    def _search(self, passages: Passages, targets: Iterable[Cell], stop: int) -> None:
        up, right, row = passages.up, passages.right, passages.dimension
        reached, new = 0, passages.set_of(targets)
        self._layers = []
        while new:
            self._layers.append(new)
            if new & stop:
                break
            reached |= new
            upward = rightward = downward = leftward = new
            new = 0
            for _ in range(min(self.longest_move, self.dimension - 1)):
                upward = (upward & up) << row
                rightward = (rightward & right) << 1
                downward = downward >> row & up
                leftward = leftward >> 1 & right
                new |= upward | rightward | downward | leftward
            new &= ~reached

    def steps(self, cell: Cell) -> int | None:
        """Steps from `cell` to the nearest target; `None` when the last search did not reach
        it."""
        if not (0 <= cell.x < self.dimension and 0 <= cell.y < self.dimension):
            return None
        bit = 1 << cell.y * self.dimension + cell.x
        for steps, layer in enumerate(self._layers):
            if layer & bit:
                return steps
        return None

    def route(self, passages: Passages, pose: Pose) -> Iterator[Hop]:
        """A shortest route to a target for a robot in this pose, hop by hop; empty if there is
        none or the robot is in a target.

        Between routes of equal length it prefers to drive straight, then right, left, backwards;
        then longer hops to shorter ones. `passages` are those of the last search, or fewer.
        """
        steps = self.steps(pose.cell)
        while steps:
            steps -= 1
            hop = self._preferred_hop(passages, pose, self._layers[steps])
            if hop is None:
                return
            yield hop
            pose = pose.hopped(hop)

    def first_hop(self, passages: Passages, pose: Pose) -> Hop | None:
        """The first hop of `route`, provided that the whole route still leads to a target.

        Closing walls makes no route shorter. So as long as `passages` are those of the last search
        with more walls closed, a route that is still open is still a shortest one, and there is no
        need to search again. `None` means that a new search is needed, or that there is no route.
        """
        route = list(self.route(passages, pose))
        return route[0] if route and len(route) == self.steps(pose.cell) else None

    def _preferred_hop(self, passages: Passages, pose: Pose, goal: int) -> Hop | None:
        ahead = pose.heading
        for heading in (
            ahead,
            ahead.turned(Turn.RIGHT),
            ahead.turned(Turn.LEFT),
            ahead.opposite(),
        ):
            cells = self._longest_hop(passages, pose.cell, heading, goal)
            if cells:
                return Hop(heading, cells)
        return None

    def _longest_hop(self, passages: Passages, cell: Cell, heading: Heading, goal: int) -> int:
        at, longest = passages.bit(cell), 0
        for cells in range(1, self.longest_move + 1):
            at = passages.step(at, heading)
            if not at:
                break
            if at & goal:
                longest = cells
        return longest
