// Package arena plays matches for a robot's tests, without WebAssembly and without the host.
//
// It is a small, independent implementation of the contest rules. It has no fuel and no limits.
package arena

import (
	"fmt"
	"strconv"
	"strings"

	"example.com/example-robot/wasmouse"
)

// Played is the outcome of a match.
type Played struct {
	// Whether the speed run ended in the goal.
	Finished bool
	// Whether a step of the exploration run ended in the goal.
	GoalSeen bool
	// Steps of the exploration run, including the reset.
	ExplorationSteps int
	// Steps of the speed run.
	SpeedSteps int
	// Moves stopped by a wall.
	Bumps int
	// Every action, in order.
	Actions []wasmouse.Action
}

// String returns the outcome in one line, such as `finished 31 + 21: 22.033`.
func (p Played) String() string {
	steps := fmt.Sprintf("%d + %d", p.ExplorationSteps, p.SpeedSteps)
	switch {
	case p.Finished:
		return fmt.Sprintf("finished %s: %.3f", steps, float64(p.SpeedSteps)+float64(p.ExplorationSteps)/30)
	case p.GoalSeen:
		return "goal seen " + steps
	default:
		return "goal not seen " + steps
	}
}

// Maze is a maze by columns from the left, each from the bottom up. A cell is the sum of its open
// sides: 1 up, 2 right, 4 down, 8 left.
type Maze [][]uint8

// Parse reads the text format of the contest: the dimension, then a line per column.
func Parse(text string) (Maze, error) {
	lines := strings.Fields(text)
	var maze Maze
	for _, line := range lines[min(1, len(lines)):] {
		var column []uint8
		for value := range strings.SplitSeq(line, ",") {
			number, err := strconv.ParseUint(value, 10, 4)
			if err != nil {
				return nil, err
			}
			column = append(column, uint8(number))
		}
		maze = append(maze, column)
	}
	for _, column := range maze {
		if strconv.Itoa(len(maze)) != lines[0] || len(column) != len(maze) {
			return nil, fmt.Errorf("a maze has as many columns and rows as its first line says")
		}
	}
	return maze, nil
}

// Maze01 returns a test maze of the contest, 12 x 12. The fewest steps of a speed run are 17.
func Maze01() Maze {
	maze, err := Parse(`12
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
9,5,5,13,13,5,5,12,9,5,5,12`)
	if err != nil {
		panic(err)
	}
	return maze
}

// IsOpen reports whether there is no wall on that side of cell.
func (m Maze) IsOpen(cell wasmouse.Cell, heading wasmouse.Heading) bool {
	return m[cell.X][cell.Y]>>heading&1 != 0
}

// Sight returns how many cells are free in that direction.
func (m Maze) Sight(cell wasmouse.Cell, heading wasmouse.Heading) int {
	count := 0
	for m.IsOpen(cell, heading) {
		cell = cell.Toward(heading, 1)
		count++
	}
	return count
}

// Play plays one match by the rules of the ruleset `udacity`.
func Play(start func(wasmouse.Briefing) wasmouse.Robot, maze Maze, briefing wasmouse.Briefing) Played {
	robot := start(briefing)
	var played Played
	pose, exploring := wasmouse.AtStart(briefing.Start), true
	for len(played.Actions) < briefing.Budget && !played.Finished {
		action := robot.NextMove(wasmouse.Sensors{
			Left:  maze.Sight(pose.Cell, pose.Heading.Turned(wasmouse.TurnLeft)),
			Front: maze.Sight(pose.Cell, pose.Heading),
			Right: maze.Sight(pose.Cell, pose.Heading.Turned(wasmouse.TurnRight)),
		})
		played.Actions = append(played.Actions, action)
		if exploring {
			played.ExplorationSteps++
		} else {
			played.SpeedSteps++
		}
		if action.Reset {
			if exploring && played.GoalSeen {
				pose, exploring = wasmouse.AtStart(briefing.Start), false
			}
			continue
		}
		travel, wish := pose.Heading.Turned(action.Move.Turn), int(action.Move.Advance)
		if wish < 0 {
			travel, wish = travel.Opposite(), -wish
		}
		wish = min(wish, briefing.LongestMove)
		cells := min(wish, maze.Sight(pose.Cell, travel))
		if cells < wish {
			played.Bumps++
		}
		pose = pose.Moved(action.Move.Turn, travel, cells)
		if briefing.Goal.Contains(pose.Cell) {
			played.GoalSeen = played.GoalSeen || exploring
			played.Finished = !exploring
		}
	}
	return played
}
