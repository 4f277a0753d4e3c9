"""What a robot for wasmouse is made of: the interface and a toolkit.

It has no dependencies and is part of your project, so change it as you like.
"""

from . import journal
from .interface import (
    Action,
    Area,
    Briefing,
    BudgetScope,
    Cell,
    Heading,
    Move,
    Reset,
    Sensors,
    Turn,
)
from .map import Map, News, Passages, View, Wall
from .pose import Hop, Pose
from .search import Search
from .tracker import Run, Tracker

__all__ = [
    "Action",
    "Area",
    "Briefing",
    "BudgetScope",
    "Cell",
    "Heading",
    "Hop",
    "Map",
    "Move",
    "News",
    "Passages",
    "Pose",
    "Reset",
    "Run",
    "Search",
    "Sensors",
    "Tracker",
    "Turn",
    "View",
    "Wall",
    "journal",
]
