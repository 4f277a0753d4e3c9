"""Matches for a robot's tests, without WebAssembly and without the host.

A small, independent implementation of the contest rules. It has no fuel and no limits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from .interface import Action, Area, Briefing, Cell, Heading, Move, Sensors, Turn


class Robot(Protocol):
    """A robot: called with the briefing it becomes ready, and then it is asked step by step."""

    def next_move(self, sensors: Sensors) -> Action: ...


@dataclass
class Played:
    """The outcome of a match."""

    finished: bool = False
    """Whether the speed run ended in the goal."""
    goal_seen: bool = False
    """Whether a step of the exploration run ended in the goal."""
    exploration_steps: int = 0
    """Steps of the exploration run, including the reset."""
    speed_steps: int = 0
    """Steps of the speed run."""
    bumps: int = 0
    """Moves stopped by a wall."""
    actions: list[Action] = field(default_factory=list)
    """Every action, in order."""

    def score(self, divisor: int = 30) -> float:
        """The steps of the speed run plus those of the exploration run divided by `divisor`."""
        return self.speed_steps + self.exploration_steps / divisor

    def __str__(self) -> str:
        steps = f"{self.exploration_steps} + {self.speed_steps}"
        if self.finished:
            return f"finished {steps}: {self.score():.3f}"
        return f"goal seen {steps}" if self.goal_seen else f"goal not seen {steps}"


class Maze:
    """A maze by columns from the left, each from the bottom up. A cell is the sum of its open
    sides: 1 up, 2 right, 4 down, 8 left."""

    def __init__(self, columns: list[list[int]]) -> None:
        self.columns = columns
        self.dimension = len(columns)

    @staticmethod
    def parse(text: str) -> Maze:
        """Reads the text format of the contest: the dimension, then a line per column."""
        first, *lines = text.split()
        columns = [[int(value) for value in line.split(",")] for line in lines]
        if any(len(column) != int(first) for column in [columns, *columns]):
            raise ValueError("a maze has as many columns and rows as its first line says")
        return Maze(columns)

    def is_open(self, cell: Cell, heading: Heading) -> bool:
        """Whether there is no wall on that side of `cell`."""
        return self.columns[cell.x][cell.y] >> heading & 1 != 0

    def sight(self, cell: Cell, heading: Heading) -> int:
        """How many cells are free in that direction."""
        count = 0
        while self.is_open(cell, heading):
            cell, count = cell.toward(heading, 1), count + 1
        return count


# A test maze of the contest, 12 x 12. The fewest steps of a speed run are 17.
MAZE_01 = Maze.parse("""12
1,5,7,5,5,5,7,5,7,5,5,6
3,5,14,3,7,5,15,4,9,5,7,12
11,6,10,10,9,7,13,6,3,5,13,4
10,9,13,12,3,13,5,12,9,5,7,6
9,5,6,3,15,5,5,7,7,4,10,10
3,5,15,14,10,3,6,10,11,6,10,10
9,7,12,11,12,9,14,9,14,11,13,14
3,13,5,12,2,3,13,6,9,14,3,14
11,4,1,7,15,13,7,13,6,9,14,10
11,5,6,10,9,7,13,5,15,7,14,8
11,5,12,10,2,9,5,6,10,8,9,6
9,5,5,13,13,5,5,12,9,5,5,12""")


def play(robot: Callable[[Briefing], Robot], maze: Maze, briefing: Briefing | None = None) -> Played:
    """Plays one match by the rules of the ruleset `udacity`."""
    briefing = briefing or Briefing.contest(maze.dimension)
    goal: Area = briefing.goal
    mouse = robot(briefing)
    played = Played()
    cell, heading, exploring = briefing.start, Heading.UP, True
    for _ in range(briefing.budget):
        left, right = heading.turned(Turn.LEFT), heading.turned(Turn.RIGHT)
        sensors = Sensors(*(maze.sight(cell, it) for it in (left, heading, right)))
        action = mouse.next_move(sensors)
        played.actions.append(action)
        if exploring:
            played.exploration_steps += 1
        else:
            played.speed_steps += 1
        if not isinstance(action, Move):
            if exploring and played.goal_seen:
                cell, heading, exploring = briefing.start, Heading.UP, False
            continue
        heading = heading.turned(action.turn)
        travel = heading if action.advance >= 0 else heading.opposite()
        wish = min(abs(action.advance), briefing.longest_move)
        cells = min(wish, maze.sight(cell, travel))
        played.bumps += cells < wish
        cell = cell.toward(travel, cells)
        if cell in goal and exploring:
            played.goal_seen = True
        elif cell in goal:
            played.finished = True
            break
    return played
