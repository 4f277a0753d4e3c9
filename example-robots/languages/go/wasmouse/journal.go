package wasmouse

// The journal is how a robot reports to people. In a match the functions call the host, and
// `wasmouse run --log` shows what they wrote; elsewhere they do nothing. No call returns anything,
// so the journal cannot influence a match. Every call costs fuel: 200, plus 1 per byte of text.
// What is printed becomes a line of the journal, too.
//
// To report an error from which the robot cannot recover, panic.

// Level is the severity of a log message.
type Level uint8

const (
	// For the author of the robot.
	Debug Level = iota
	// For anyone who watches.
	Info
	// Something unexpected that the robot can handle.
	Warning
	// Something that should not have happened.
	Error
)

// Color is the colour of a cell.
type Color uint8

const (
	// Removes the colour of the cell.
	NoColor Color = iota
	Red
	Orange
	Yellow
	Green
	Cyan
	Blue
	Violet
	Gray
)

// Log writes a line of text.
func Log(level Level, message string) {
	hostLog(uint32(level), message)
}

// Paint colours a cell. Cells outside the maze are ignored.
func Paint(cell Cell, color Color) {
	hostPaint(uint32(cell.X), uint32(cell.Y), uint32(color))
}

// Label writes a short text into a cell. At most 8 characters are shown; the empty text removes the
// label. Cells outside the maze are ignored.
func Label(cell Cell, text string) {
	hostLabel(uint32(cell.X), uint32(cell.Y), text)
}

// ReportWall states what the robot believes about the wall on one side of a cell. Cells outside the
// maze are ignored.
func ReportWall(cell Cell, side Heading, belief Wall) {
	hostWall(uint32(cell.X), uint32(cell.Y), uint32(side), uint32(belief))
}
