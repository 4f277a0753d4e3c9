package wasmouse

// Run is one of the two runs of a match.
type Run uint8

const (
	// The exploration run: find the goal, learn the maze, reset.
	Exploration Run = iota
	// The speed run: to the goal in as few steps as possible.
	Speed
)

// Tracker has the robot's position, the walls that it has seen, and the steps that are left. It
// decides nothing.
//
// In each step, pass the readings to Observe and return the action from Go, Turn or Reset. Moves
// are limited to what is known to be open, so the robot never bumps and always knows its position.
type Tracker struct {
	briefing  Briefing
	m         *Map
	pose      Pose
	run       Run
	stepsLeft int
	// Whether a step of the exploration run has ended in the goal.
	goalSeen bool
}

// NewTracker returns the state at the start of the exploration run, with an empty map.
func NewTracker(briefing Briefing) *Tracker {
	t := &Tracker{
		briefing:  briefing,
		m:         NewMap(briefing.Dimension),
		pose:      AtStart(briefing.Start),
		stepsLeft: briefing.Budget,
	}
	if !t.m.Contains(briefing.Start) {
		panic("the start is outside the maze")
	}
	return t
}

// Pose returns the robot's position.
func (t *Tracker) Pose() Pose { return t.pose }

// Cell returns the robot's cell.
func (t *Tracker) Cell() Cell { return t.pose.Cell }

// Map returns what is known about the walls.
func (t *Tracker) Map() *Map { return t.m }

// Run returns the current run.
func (t *Tracker) Run() Run { return t.run }

// Briefing returns the briefing of the match.
func (t *Tracker) Briefing() Briefing { return t.briefing }

// StepsLeft returns how many steps are left, including this one. If each run has its own budget,
// that of the current run.
func (t *Tracker) StepsLeft() int { return t.stepsLeft }

// Observe adds the readings of this step to the map.
func (t *Tracker) Observe(sensors Sensors) News {
	return t.m.Observe(t.pose, sensors)
}

// Go returns the action that drives up to cells cells in that direction of the maze, limited to
// cells known to be reachable and to the longest move.
//
// It turns if the direction is to a side, and drives backwards if it is behind the robot. There is
// no rear sensor: if the nearest wall behind is unknown, the action turns right on the spot
// instead, to see it in the next step.
func (t *Tracker) Go(heading Heading, cells int) Action {
	cells = min(cells, t.briefing.LongestMove)
	clear := t.m.known.ClearCells(t.pose.Cell, heading, cells)
	turn, ahead := t.pose.Heading.TurnTo(heading)
	switch {
	case ahead:
		return t.answer(turn, heading, clear)
	case clear == 0 && cells > 0 && t.m.possible.IsOpen(t.pose.Cell, heading):
		return t.answer(TurnRight, heading, 0)
	default:
		return t.answer(Straight, heading, -clear)
	}
}

// Turn returns the action that only turns.
func (t *Tracker) Turn(turn Turn) Action {
	return t.answer(turn, t.pose.Heading, 0)
}

// Reset returns the reset, which begins the speed run in the start cell. Where the host ignores it
// (see MayReset) the position stays and the step is spent.
func (t *Tracker) Reset() Action {
	t.stepsLeft = max(t.stepsLeft-1, 0)
	if t.MayReset() {
		t.run = Speed
		t.pose = AtStart(t.briefing.Start)
		if t.briefing.BudgetScope == EachRun {
			t.stepsLeft = t.briefing.Budget
		}
	}
	return Reset()
}

// MayReset reports whether the host accepts a reset: in the exploration run, after a step has
// ended in the goal.
func (t *Tracker) MayReset() bool {
	return t.run == Exploration && t.goalSeen
}

// InGoal reports whether the robot is in the goal.
func (t *Tracker) InGoal() bool {
	return t.briefing.Goal.Contains(t.pose.Cell)
}

func (t *Tracker) answer(turn Turn, travel Heading, advance int) Action {
	t.pose = t.pose.Moved(turn, travel, max(advance, -advance))
	t.stepsLeft = max(t.stepsLeft-1, 0)
	t.goalSeen = t.goalSeen || t.InGoal()
	return Drive(turn, int8(advance))
}
