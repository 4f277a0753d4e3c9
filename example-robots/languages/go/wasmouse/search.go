package wasmouse

// Search is the flood: the fewest steps from every cell to a set of cells.
//
// A breadth-first search over steps: one step drives up to the longest move in a straight line, in
// any of the four directions (including backwards, so the heading does not matter).
type Search struct {
	dimension, longestMove int
	// By cell; -1 where the last search did not arrive.
	steps []int16
	// The cells of the last layer, and of the one before, by place.
	frontier, next []int
}

// NewSearch returns a search in which nothing is reached yet.
func NewSearch(dimension, longestMove int) *Search {
	s := &Search{
		dimension:   dimension,
		longestMove: longestMove,
		steps:       make([]int16, dimension*dimension),
	}
	s.clear()
	return s
}

func (s *Search) clear() {
	for place := range s.steps {
		s.steps[place] = -1
	}
}

// Fill computes the distance of every cell to the nearest of targets.
func (s *Search) Fill(passages *Passages, targets []Cell) {
	s.search(passages, targets, -1)
}

// FillUntil is like Fill, but stops when the distance of from is known. All cells at most as far
// are known then; the others count as not reached.
func (s *Search) FillUntil(passages *Passages, targets []Cell, from Cell) {
	s.search(passages, targets, passages.place(from))
}

func (s *Search) search(passages *Passages, targets []Cell, stop int) {
	s.clear()
	strides := [4]int{s.dimension, 1, -s.dimension, -1}
	s.frontier = s.frontier[:0]
	for _, target := range targets {
		place := passages.place(target)
		if s.steps[place] < 0 {
			s.steps[place] = 0
			s.frontier = append(s.frontier, place)
		}
	}
	for steps := int16(1); len(s.frontier) > 0 && (stop < 0 || s.steps[stop] < 0); steps++ {
		s.next = s.next[:0]
		for _, place := range s.frontier {
			for heading, stride := range strides {
				at := place
				// The perimeter is closed, so no place is outside.
				for cells := 0; cells < s.longestMove && passages.open[at][heading]; cells++ {
					at += stride
					if s.steps[at] < 0 {
						s.steps[at] = steps
						s.next = append(s.next, at)
					}
				}
			}
		}
		s.frontier, s.next = s.next, s.frontier
	}
}

// Steps returns the steps from cell to the nearest target. It is false when the last search did
// not reach it.
func (s *Search) Steps(cell Cell) (int, bool) {
	if cell.X < 0 || cell.Y < 0 || cell.X >= s.dimension || cell.Y >= s.dimension {
		return 0, false
	}
	steps := s.steps[cell.Y*s.dimension+cell.X]
	return int(steps), steps >= 0
}

// Route returns a shortest route to a target for a robot in this pose; empty if there is none or
// the robot is in a target.
//
// Between routes of equal length it prefers to drive straight, then right, left, backwards; then
// longer hops to shorter ones. The passages are those of the last search, or fewer; where they
// interrupt the route, it ends.
func (s *Search) Route(passages *Passages, pose Pose) []Hop {
	var route []Hop
	for {
		hop, found := s.NextHop(passages, pose)
		if !found {
			return route
		}
		route = append(route, hop)
		pose = pose.Hopped(hop)
	}
}

// NextHop returns the first hop of Route.
func (s *Search) NextHop(passages *Passages, pose Pose) (Hop, bool) {
	steps, reached := s.Steps(pose.Cell)
	if !reached || steps == 0 {
		return Hop{}, false
	}
	ahead := pose.Heading
	for _, heading := range [4]Heading{
		ahead, ahead.Turned(TurnRight), ahead.Turned(TurnLeft), ahead.Opposite(),
	} {
		if cells := s.longestHop(passages, pose.Cell, heading, steps-1); cells > 0 {
			return Hop{heading, cells}, true
		}
	}
	return Hop{}, false
}

// FirstHop returns the first hop of Route, provided that the whole route still leads to a target.
//
// Closing walls makes no route shorter. So as long as the passages are those of the last search
// with more walls closed, a route that is still open is still a shortest one, and there is no need
// to search again. It is false when a new search is needed, or when there is no route.
func (s *Search) FirstHop(passages *Passages, pose Pose) (Hop, bool) {
	route := s.Route(passages, pose)
	if steps, _ := s.Steps(pose.Cell); len(route) > 0 && len(route) == steps {
		return route[0], true
	}
	return Hop{}, false
}

// The longest drive in that direction that ends goal steps from a target.
func (s *Search) longestHop(passages *Passages, cell Cell, heading Heading, goal int) int {
	longest := 0
	for cells := 1; cells <= s.longestMove && passages.IsOpen(cell, heading); cells++ {
		cell = cell.Toward(heading, 1)
		if steps, reached := s.Steps(cell); reached && steps == goal {
			longest = cells
		}
	}
	return longest
}
