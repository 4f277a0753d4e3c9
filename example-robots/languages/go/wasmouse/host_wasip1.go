//go:build wasip1

package wasmouse

import (
	"fmt"
	"runtime"
	"strings"
	"unsafe"
)

var (
	start func(Briefing) Robot
	robot Robot
	// What NextMove answered: 0 for a move or 1 for a reset, the turn, the advance.
	answer [3]uint8
)

// Export makes start the robot of the program: it is called once, before the first step, and
// returns the robot for the match. A panic ends the match with its message and line.
func Export(robotStart func(Briefing) Robot) {
	start = robotStart
}

//go:wasmexport wasmouse:robot/controller@0.2.0#start
func hostStart(dimension, startX, startY, goalX, goalY, goalWidth, goalHeight, budget, scope, longestMove, unitsPerCell, divisor uint32, seed uint64, variant uint32) {
	defer report()
	robot = start(Briefing{
		Dimension:          int(dimension),
		Start:              Cell{int(startX), int(startY)},
		Goal:               Area{Cell{int(goalX), int(goalY)}, int(goalWidth), int(goalHeight)},
		Budget:             int(budget),
		BudgetScope:        BudgetScope(scope),
		LongestMove:        int(longestMove),
		UnitsPerCell:       int(unitsPerCell),
		ExplorationDivisor: int(divisor),
		Seed:               seed,
		Variant:            variant,
	})
}

//go:wasmexport wasmouse:robot/controller@0.2.0#next-move
func hostNextMove(left, front, right uint32) unsafe.Pointer {
	defer report()
	action := robot.NextMove(Sensors{int(left), int(front), int(right)})
	answer = [3]uint8{0, uint8(action.Move.Turn), uint8(action.Move.Advance)}
	if action.Reset {
		answer[0] = 1
	}
	return unsafe.Pointer(&answer)
}

// Ends the match after a panic, with its message and the line where it began. The calls that led
// there are errors in the journal.
func report() {
	problem := recover()
	if problem == nil {
		return
	}
	places := callers()
	for _, place := range places {
		hostLog(uint32(Error), "  at "+place)
	}
	message := fmt.Sprint(problem)
	if len(places) > 0 {
		message += " (" + places[0] + ")"
	}
	hostPanic(message)
}

// Where the calls of the panic are in the project, from the innermost.
func callers() []string {
	counters := make([]uintptr, 64)
	frames := runtime.CallersFrames(counters[:runtime.Callers(0, counters)])
	_, self, _, _ := runtime.Caller(0)
	root := strings.TrimSuffix(self, "wasmouse/host_wasip1.go")
	var places []string
	panicked := false
	for {
		frame, more := frames.Next()
		panicked = panicked || frame.Function == "runtime.gopanic"
		file, inProject := strings.CutPrefix(frame.File, root)
		if panicked && inProject && file != "wasmouse/host_wasip1.go" {
			places = append(places, fmt.Sprintf("%s:%d", file, frame.Line))
		}
		if !more {
			return places
		}
	}
}

//go:wasmimport wasmouse:robot/journal@0.2.0 log
func hostLog(level uint32, message string)

//go:wasmimport wasmouse:robot/journal@0.2.0 paint
func hostPaint(x, y, color uint32)

//go:wasmimport wasmouse:robot/journal@0.2.0 label
func hostLabel(x, y uint32, text string)

//go:wasmimport wasmouse:robot/journal@0.2.0 wall
func hostWall(x, y uint32, side, belief uint32)

//go:wasmimport wasmouse:robot/journal@0.2.0 panic
func hostPanic(message string)
