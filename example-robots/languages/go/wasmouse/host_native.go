//go:build !wasip1

package wasmouse

// Export makes start the robot of the program; in tests it does nothing.
func Export(start func(Briefing) Robot) {}

func hostLog(level uint32, message string)       {}
func hostPaint(x, y, color uint32)               {}
func hostLabel(x, y uint32, text string)         {}
func hostWall(x, y uint32, side, belief uint32)  {}
