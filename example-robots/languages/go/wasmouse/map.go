package wasmouse

import "fmt"

// Wall is what the robot believes about one wall.
type Wall uint8

const (
	// Not known.
	UnknownWall Wall = iota
	// There is no wall.
	OpenWall
	// There is a wall.
	ClosedWall
)

// View is how to treat unknown walls.
type View uint8

const (
	// Unknown walls count as open: for exploring.
	Optimistic View = iota
	// Unknown walls count as closed: for driving only where it is certain.
	Pessimistic
)

// News is what was new in a reading.
type News struct {
	// Walls that were not known to be open before.
	Opened int
	// Walls that were not known to be closed before.
	Closed int
}

// Passages are the walls of a square maze that may be driven through. The perimeter never may.
type Passages struct {
	dimension int
	// By cell and heading: whether there is an opening.
	open [][4]bool
}

// NewPassages returns a maze in which every wall stands. The dimension is from 2 to 64.
func NewPassages(dimension int) *Passages {
	if dimension < 2 || dimension > 64 {
		panic(fmt.Sprintf("the dimension is %d and not from 2 to 64", dimension))
	}
	return &Passages{dimension, make([][4]bool, dimension*dimension)}
}

// AllOpen returns a maze in which only the perimeter stands.
func AllOpen(dimension int) *Passages {
	p := NewPassages(dimension)
	for _, cell := range (Area{Cell{}, dimension, dimension}).Cells() {
		for _, heading := range Headings {
			p.Set(cell, heading, true)
		}
	}
	return p
}

// Contains reports whether the maze has that cell.
func (p *Passages) Contains(cell Cell) bool {
	return cell.X >= 0 && cell.Y >= 0 && cell.X < p.dimension && cell.Y < p.dimension
}

// The place of a cell in slices with an element for every cell.
func (p *Passages) place(cell Cell) int {
	return cell.Y*p.dimension + cell.X
}

// IsOpen reports whether the wall on that side of cell may be driven through; false outside the
// maze.
func (p *Passages) IsOpen(cell Cell, heading Heading) bool {
	return p.Contains(cell) && p.open[p.place(cell)][heading]
}

// Set opens or closes the wall on that side of cell, for both its cells; walls of the perimeter
// stay closed.
func (p *Passages) Set(cell Cell, heading Heading, open bool) {
	other := cell.Toward(heading, 1)
	if p.Contains(cell) && p.Contains(other) {
		p.open[p.place(cell)][heading] = open
		p.open[p.place(other)][heading.Opposite()] = open
	}
}

// ClearCells returns how many cells in a row can be driven from cell in that direction, at most
// longest.
func (p *Passages) ClearCells(cell Cell, heading Heading, longest int) int {
	count := 0
	for count < longest && p.IsOpen(cell, heading) {
		cell = cell.Toward(heading, 1)
		count++
	}
	return count
}

// Map has the walls of a square maze, each unknown, open or closed. At first the perimeter is
// closed and everything else is unknown.
type Map struct {
	// The walls known to be open.
	known *Passages
	// The walls not known to be closed.
	possible *Passages
}

// NewMap returns a map that knows the perimeter and nothing else. The dimension is from 2 to 64.
func NewMap(dimension int) *Map {
	return &Map{NewPassages(dimension), AllOpen(dimension)}
}

// Contains reports whether the maze has that cell.
func (m *Map) Contains(cell Cell) bool {
	return m.known.Contains(cell)
}

// Wall returns what is known about the wall on that side of cell. The perimeter and everything
// beyond it is closed.
func (m *Map) Wall(cell Cell, heading Heading) Wall {
	switch {
	case !m.possible.IsOpen(cell, heading):
		return ClosedWall
	case m.known.IsOpen(cell, heading):
		return OpenWall
	default:
		return UnknownWall
	}
}

// Set overrides what is known about a wall; the perimeter stays closed.
func (m *Map) Set(cell Cell, heading Heading, wall Wall) {
	m.known.Set(cell, heading, wall == OpenWall)
	m.possible.Set(cell, heading, wall != ClosedWall)
}

// Passages returns the walls that may be driven through in that view.
func (m *Map) Passages(view View) *Passages {
	if view == Optimistic {
		return m.possible
	}
	return m.known
}

// Observe adds a reading made at pose: in each of the three directions that many open walls and
// then a closed one. A reading that ends outside the maze ends at its perimeter.
func (m *Map) Observe(pose Pose, sensors Sensors) News {
	var news News
	m.look(pose.Cell, pose.Heading.Turned(TurnLeft), sensors.Left, &news)
	m.look(pose.Cell, pose.Heading, sensors.Front, &news)
	m.look(pose.Cell, pose.Heading.Turned(TurnRight), sensors.Right, &news)
	return news
}

func (m *Map) look(cell Cell, heading Heading, reading int, news *News) {
	for range reading {
		there := cell.Toward(heading, 1)
		if !m.Contains(there) {
			break
		}
		if !m.known.IsOpen(cell, heading) {
			news.Opened++
			m.Set(cell, heading, OpenWall)
		}
		cell = there
	}
	if m.possible.IsOpen(cell, heading) {
		news.Closed++
		m.Set(cell, heading, ClosedWall)
	}
}
