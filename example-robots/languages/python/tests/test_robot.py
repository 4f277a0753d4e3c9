"""The robot plays mazes, without WebAssembly."""

import unittest
from dataclasses import replace

from robot import Robot
from wasmouse import Briefing
from wasmouse.arena import MAZE_01, play


class RobotTest(unittest.TestCase):
    def test_plays_a_maze(self) -> None:
        played = play(Robot, MAZE_01)
        self.assertEqual(str(played), "finished 31 + 21: 22.033")
        self.assertEqual(played.bumps, 0)

    def test_rejects_unknown_variants(self) -> None:
        briefing = replace(Briefing.contest(12), variant=1)
        with self.assertRaisesRegex(ValueError, "variant 0"):
            Robot(briefing)


if __name__ == "__main__":
    unittest.main()
