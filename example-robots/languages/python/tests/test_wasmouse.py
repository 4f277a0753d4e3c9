"""The toolkit against the cases in `vectors.json`, which come from the Rust SDK."""

import json
import unittest
from pathlib import Path
from typing import Any

from robot import Robot
from wasmouse import Action, Cell, Heading, Map, Move, Pose, Search, Sensors, Turn, Wall
from wasmouse.arena import Maze, play
from wasmouse.interface import Area

VECTORS = json.loads((Path(__file__).parent / "vectors.json").read_text())
SIGNS = {Wall.UNKNOWN: "?", Wall.OPEN: ".", Wall.CLOSED: "#"}


def heading(name: str) -> Heading:
    return Heading[name.upper()]


def pose(case: dict[str, Any]) -> Pose:
    return Pose(Cell(case["x"], case["y"]), heading(case["heading"]))


def word(action: Action) -> str:
    return f"{action.turn.name[0]}{action.advance}" if isinstance(action, Move) else "reset"


class VectorsTest(unittest.TestCase):
    def test_turns(self) -> None:
        for case in VECTORS["turns"]:
            start = heading(case["from"])
            if "to" in case:
                turn = start.turn_to(heading(case["to"]))
                self.assertEqual(case["turn"], None if turn is None else turn.name.lower())
            else:
                after = start.turned(Turn[case["turned"].upper()])
                self.assertEqual(after, heading(case["after"]))

    def test_maps(self) -> None:
        for case in VECTORS["maps"]:
            map = Map(case["dimension"])
            for seen in case["observations"]:
                news = map.observe(pose(seen), Sensors(*seen["sensors"]))
                self.assertEqual((news.opened, news.closed), (seen["opened"], seen["closed"]))
            for x, column in enumerate(case["walls"]):
                for y, walls in enumerate(column):
                    found = "".join(SIGNS[map.wall(Cell(x, y), it)] for it in Heading)
                    self.assertEqual(found, walls)

    def test_searches(self) -> None:
        for case in VECTORS["searches"]:
            maze = Maze(case["maze"])
            size = range(maze.dimension)
            map = Map(maze.dimension)
            cells = [Cell(x, y) for x in size for y in size]
            for cell in cells:
                for it in Heading:
                    map.set(cell, it, Wall.OPEN if maze.is_open(cell, it) else Wall.CLOSED)
            goal = list(Area.center(maze.dimension).cells())
            search = Search(maze.dimension, case["longest_move"])
            search.fill(map.known, goal)
            for cell in cells:
                self.assertEqual(search.steps(cell), case["steps"][cell.x][cell.y])
            start = pose(case["from"])
            search.fill_until(map.known, goal, start.cell)
            for cell in cells:
                self.assertEqual(search.steps(cell), case["steps_until"][cell.x][cell.y])
            route = [[it.heading.name.lower(), it.cells] for it in search.route(map.known, start)]
            self.assertEqual(route, case["route"])

    def test_matches(self) -> None:
        for case in VECTORS["matches"]:
            played = play(Robot, Maze(case["maze"]))
            self.assertEqual(str(played), case["summary"])
            self.assertEqual(" ".join(word(it) for it in played.actions), case["actions"])


if __name__ == "__main__":
    unittest.main()
