package wasmouse

// Hop is a move in a straight line, in one step.
type Hop struct {
	// The direction of travel in the maze.
	Heading Heading
	// How far, in cells, at least 1.
	Cells int
}

// Pose is a cell and a heading.
type Pose struct {
	Cell    Cell
	Heading Heading
}

// AtStart returns the pose in which both runs begin: in the start cell, heading up.
func AtStart(start Cell) Pose {
	return Pose{start, Up}
}

// Hopped returns the pose after a hop. The robot turns to the hop's heading, unless that is behind
// it; then it drives backwards.
func (p Pose) Hopped(hop Hop) Pose {
	turn, _ := p.Heading.TurnTo(hop.Heading)
	return p.Moved(turn, hop.Heading, hop.Cells)
}

// Moved returns the pose after a turn and then cells cells in direction travel, which is the new
// heading or, for a backward move, its opposite.
func (p Pose) Moved(turn Turn, travel Heading, cells int) Pose {
	return Pose{p.Cell.Toward(travel, cells), p.Heading.Turned(turn)}
}
