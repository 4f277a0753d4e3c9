"""Connects the class `Robot` of `robot.py` with the host. There is no need to change this file.

`componentize-py` makes a new `Controller` for every call, so the robot of the match is kept at
module level.
"""

import random
import sys
import traceback
from pathlib import PurePath
from typing import NoReturn

from wit_world import exports
from wit_world.imports import journal as host
from wit_world.imports import types

import wasmouse
from robot import Robot
from wasmouse import journal

_robot: Robot | None = None

_HEADINGS = tuple(types.Heading)
_TURNS = tuple(types.Turn)
_LEVELS = tuple(host.Level)
_COLORS = tuple(host.Color)
_BELIEFS = tuple(host.Belief)


class Controller(exports.Controller):
    """What the host calls."""

    def start(self, briefing: types.Briefing) -> None:
        global _robot
        journal.host = _Journal()
        try:
            random.seed(briefing.seed)
            _robot = Robot(_briefing(briefing))
        except BaseException as error:
            _fail(error)

    def next_move(self, sensors: types.Sensors) -> types.Action:
        assert _robot is not None, "the host calls `start` first"
        try:
            readings = wasmouse.Sensors(sensors.left, sensors.front, sensors.right)
            return _action(_robot.next_move(readings))
        except BaseException as error:
            _fail(error)


class _Journal:
    def log(self, level: journal.Level, message: str) -> None:
        host.log(_LEVELS[level.value], message)

    def paint(self, cell: wasmouse.Cell, color: journal.Color) -> None:
        host.paint(_cell(cell), _COLORS[color.value])

    def label(self, cell: wasmouse.Cell, text: str) -> None:
        host.label(_cell(cell), text)

    def wall(
        self, cell: wasmouse.Cell, side: wasmouse.Heading, belief: journal.Belief
    ) -> None:
        host.wall(_cell(cell), _HEADINGS[side], _BELIEFS[belief.value])


def _cell(cell: wasmouse.Cell) -> types.Cell:
    return types.Cell(cell.x, cell.y)


def _briefing(briefing: types.Briefing) -> wasmouse.Briefing:
    start, goal = briefing.start, briefing.goal
    return wasmouse.Briefing(
        dimension=briefing.dimension,
        start=wasmouse.Cell(start.x, start.y),
        goal=wasmouse.Area(
            wasmouse.Cell(goal.origin.x, goal.origin.y), goal.width, goal.height
        ),
        budget=briefing.budget,
        budget_scope=wasmouse.BudgetScope(briefing.budget_scope.value),
        longest_move=briefing.longest_move,
        units_per_cell=briefing.units_per_cell,
        exploration_divisor=briefing.exploration_divisor,
        seed=briefing.seed,
        variant=briefing.variant,
    )


def _action(action: wasmouse.Action) -> types.Action:
    match action:
        case wasmouse.Move(turn, advance):
            # What does not fit into the interface would end the match without a reason.
            if not (isinstance(advance, int) and -128 <= advance <= 127):
                raise ValueError(f"`advance` is {advance!r} and not a whole number from -128 to 127")
            return types.Action_Move(types.Move(_TURNS[turn], advance))
        case wasmouse.Reset():
            return types.Action_Reset()
    raise TypeError(f"`next_move` returned {action!r} and not a Move or a Reset")


def _fail(error: BaseException) -> NoReturn:
    """Ends the match with the error, the line where it was raised, and the traceback as errors in
    the journal."""
    summary = "".join(traceback.format_exception_only(error)).strip()
    frames = [it for it in traceback.extract_tb(error.__traceback__) if _name(it) != "controller.py"]
    try:
        for frame in frames:
            where = f"  {_name(frame)}:{frame.lineno} in {frame.name}"
            host.log(host.Level.ERROR, where)
        sys.stdout.flush()
    finally:
        place = f" ({_name(frames[-1])}:{frames[-1].lineno})" if frames else ""
        host.panic(summary.replace("\n", " ") + place)
    raise AssertionError("the host does not return from `panic`")


def _name(frame: traceback.FrameSummary) -> str:
    """The file's path in the project; in the component, folders have numbers."""
    path = PurePath(frame.filename)
    return str(PurePath(*path.parts[2:])) if len(path.parts) > 2 else str(path)
