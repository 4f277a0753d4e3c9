"""How a robot reports to people: log messages, colours, labels, beliefs about walls.

In a match the functions call the host, and `wasmouse run --log` shows what they wrote. Elsewhere
they do nothing. No call returns anything, so the journal cannot influence a match. Every call
costs fuel: 200, plus 1 per byte of text. `print` works, too: it logs its lines.

To report an error from which the robot cannot recover, raise an exception.
"""

from __future__ import annotations

from enum import Enum
from typing import Protocol

from .interface import Cell, Heading


class Level(Enum):
    """The severity of a log message."""

    DEBUG = 0
    """For the author of the robot."""
    INFO = 1
    """For anyone who watches."""
    WARNING = 2
    """Something unexpected that the robot can handle."""
    ERROR = 3
    """Something that should not have happened."""


class Color(Enum):
    """The colour of a cell."""

    NONE = 0
    """Removes the colour of the cell."""
    RED = 1
    ORANGE = 2
    YELLOW = 3
    GREEN = 4
    CYAN = 5
    BLUE = 6
    VIOLET = 7
    GRAY = 8


class Belief(Enum):
    """What the robot believes about one wall."""

    UNKNOWN = 0
    """Not known."""
    OPEN = 1
    """There is no wall."""
    CLOSED = 2
    """There is a wall."""


class Host(Protocol):
    """What `controller.py` connects in a match."""

    def log(self, level: Level, message: str) -> None: ...
    def paint(self, cell: Cell, color: Color) -> None: ...
    def label(self, cell: Cell, text: str) -> None: ...
    def wall(self, cell: Cell, side: Heading, belief: Belief) -> None: ...


host: Host | None = None


def log(level: Level, message: str) -> None:
    """Writes a line of text."""
    if host:
        host.log(level, message)


def paint(cell: Cell, color: Color) -> None:
    """Colours a cell. Cells outside the maze are ignored."""
    if host:
        host.paint(cell, color)


def label(cell: Cell, text: str) -> None:
    """Writes a short text into a cell. At most 8 characters are shown; the empty text removes the
    label. Cells outside the maze are ignored."""
    if host:
        host.label(cell, text)


def wall(cell: Cell, side: Heading, belief: Belief) -> None:
    """States what the robot believes about the wall on one side of a cell. Cells outside the maze
    are ignored."""
    if host:
        host.wall(cell, side, belief)


def debug(message: str) -> None:
    """Writes a line for the author of the robot."""
    log(Level.DEBUG, message)


def info(message: str) -> None:
    """Writes a line for anyone who watches."""
    log(Level.INFO, message)


def warning(message: str) -> None:
    """Writes a line about something unexpected that the robot can handle."""
    log(Level.WARNING, message)


def error(message: str) -> None:
    """Writes a line about something that should not have happened."""
    log(Level.ERROR, message)
