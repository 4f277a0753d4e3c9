// Package wasmouse is what a robot for wasmouse is made of: the interface and a toolkit. It has no
// dependencies and is part of your project, so change it as you like.
//
// Distances (readings, Move.Advance, Briefing.LongestMove) are in units. All current rulesets have
// 1 unit per cell, so a distance is a number of cells.
package wasmouse

// Sensors is what the robot senses in its current position before it acts: in each direction
// relative to its heading, how far it could drive before a wall stops it.
//
// 0 means a wall directly at that side. There is no rear sensor. Unit: units. In all current
// rulesets the readings are exact and range from 0 to `briefing.dimension` - 1.
type Sensors struct {
	// Free distance to the left of the robot.
	Left int
	// Free distance ahead of the robot.
	Front int
	// Free distance to the right of the robot.
	Right int
}

// Turn is a rotation on the spot, done before the robot moves.
type Turn uint8

const (
	// A quarter turn counterclockwise (-90 degrees).
	TurnLeft Turn = iota
	// No rotation.
	Straight
	// A quarter turn clockwise (+90 degrees).
	TurnRight
)

// Move: Turn first, then drive along the new heading.
type Move struct {
	// The rotation, done first.
	Turn Turn
	// How far to drive after the rotation. Unit: units. Negative drives backwards with the heading
	// unchanged. The host clamps it to -`briefing.longest-move` ..= `briefing.longest-move` and
	// counts the clamp. At the first wall the robot stops and keeps the distance it has covered,
	// and the host counts a bump. Neither costs anything extra.
	Advance int8
}

// Action is what the robot does in one step. Every action takes one step.
type Action struct {
	// Turn, then drive.
	Move Move
	// End the exploration run and begin the speed run in the start cell, heading up. The reset
	// itself is a step of the exploration run. It is ignored (the robot stays where it is and the
	// step is spent) until a step of the exploration run has ended in the goal, and throughout the
	// speed run. A move that is a reset as well is only a reset.
	Reset bool
}

// Drive turns, then drives advance cells along the new heading; backwards when it is negative.
func Drive(turn Turn, advance int8) Action {
	return Action{Move: Move{turn, advance}}
}

// Reset ends the exploration run.
func Reset() Action {
	return Action{Reset: true}
}

// Cell is a cell of the maze. `x` grows to the right, `y` grows upward, and (0, 0) is the bottom
// left corner.
type Cell struct {
	// Column, counted from the left, starting at 0.
	X int
	// Row, counted from the bottom, starting at 0.
	Y int
}

// Toward returns the cell distance cells away in that direction, ignoring walls and the size of the
// maze.
func (c Cell) Toward(heading Heading, distance int) Cell {
	switch heading {
	case Up:
		return Cell{c.X, c.Y + distance}
	case Right:
		return Cell{c.X + distance, c.Y}
	case Down:
		return Cell{c.X, c.Y - distance}
	default:
		return Cell{c.X - distance, c.Y}
	}
}

// Area is a rectangle of cells.
type Area struct {
	// The bottom left cell of the rectangle.
	Origin Cell
	// Unit: cells.
	Width int
	// Unit: cells.
	Height int
}

// Contains reports whether cell lies in the rectangle.
func (a Area) Contains(cell Cell) bool {
	dx, dy := cell.X-a.Origin.X, cell.Y-a.Origin.Y
	return 0 <= dx && dx < a.Width && 0 <= dy && dy < a.Height
}

// Cells returns all cells, column by column from the left, each from the bottom up.
func (a Area) Cells() []Cell {
	cells := make([]Cell, 0, a.Width*a.Height)
	for dx := range a.Width {
		for dy := range a.Height {
			cells = append(cells, Cell{a.Origin.X + dx, a.Origin.Y + dy})
		}
	}
	return cells
}

// Center returns the goal room of a contest maze: the 2 x 2 cells in the centre, or the single
// centre cell if dimension is odd.
func Center(dimension int) Area {
	low, side := (dimension-1)/2, 2-dimension%2
	return Area{Cell{low, low}, side, side}
}

// Heading is a direction in the maze, independent of the robot.
type Heading uint8

const (
	// Towards larger `y`. The robot starts both runs with this heading.
	Up Heading = iota
	// Towards larger `x`.
	Right
	// Towards smaller `y`.
	Down
	// Towards smaller `x`.
	Left
)

// Headings are all four, clockwise from Up.
var Headings = [4]Heading{Up, Right, Down, Left}

// Turned returns the heading after a turn on the spot.
func (h Heading) Turned(turn Turn) Heading {
	return (h + Heading(turn) + 3) & 3
}

// Opposite returns the opposite heading.
func (h Heading) Opposite() Heading {
	return (h + 2) & 3
}

// TurnTo returns the turn from this heading to target. It is false if target is behind the robot,
// because one step cannot turn that far.
func (h Heading) TurnTo(target Heading) (Turn, bool) {
	switch (target - h) & 3 {
	case 0:
		return Straight, true
	case 1:
		return TurnRight, true
	case 3:
		return TurnLeft, true
	default:
		return Straight, false
	}
}

// BudgetScope is how `briefing.budget` applies to the two runs.
type BudgetScope uint8

const (
	// The two runs share the budget.
	BothRuns BudgetScope = iota
	// Each run has the whole budget for itself.
	EachRun
)

// Briefing is everything a robot is told before its first step.
//
// A match has an exploration run and then a speed run. The speed run ends with the first step that
// ends in a goal cell; passing through one does not count. The score is the number of steps in the
// speed run plus the number of steps in the exploration run divided by `exploration-divisor`. Lower
// is better.
type Briefing struct {
	// The maze has `dimension` x `dimension` cells. Range: 2 to 64, or 0 if the track does not
	// tell. All current rulesets tell it; in contest mazes it is an even number from 12 to 20.
	Dimension int
	// The cell where both runs start. In contest mazes (0, 0).
	Start Cell
	// The goal cells. In contest mazes the 2 x 2 room in the centre. A `width` and a `height` of 0
	// mean that the track does not tell; all current rulesets tell it.
	Goal Area
	// How many steps the robot may take. Unit: steps. Range: 1 to 1,000,000; the ruleset `udacity`
	// sets 1,000. The step numbered `budget` is still executed.
	Budget int
	// Whether the two runs share `budget` or each has all of it.
	BudgetScope BudgetScope
	// The longest move in one step, forwards or backwards. Unit: units. Range: 1 to 127. The
	// ruleset `udacity` sets 3.
	LongestMove int
	// The distance from the centre of a cell to that of the next one. Unit: units. At least 1, and
	// 1 in all current rulesets. A robot that assumes 1 should trap on any other value.
	UnitsPerCell int
	// Steps of the exploration run are divided by this number in the score. Range: 1 to 1,000,000;
	// the ruleset `udacity` sets 30.
	ExplorationDivisor int
	// The robot's only source of randomness. The same seed in the same maze always gives the same
	// match. Range: any. For chance, use rand.New(rand.NewPCG(briefing.Seed, 0)) of math/rand/v2.
	Seed uint64
	// Selects a variant of the robot. Each robot documents its own; the default is 0. A robot
	// should trap on a variant that it does not have.
	Variant uint32
}

// ContestBriefing returns the briefing of the ruleset `udacity` for a contest maze of this size,
// for tests.
func ContestBriefing(dimension int) Briefing {
	return Briefing{
		Dimension:          dimension,
		Goal:               Center(dimension),
		Budget:             1000,
		LongestMove:        3,
		UnitsPerCell:       1,
		ExplorationDivisor: 30,
	}
}

// Robot drives one match.
type Robot interface {
	// NextMove is called once per step with the readings at the robot's current position.
	NextMove(Sensors) Action
}
