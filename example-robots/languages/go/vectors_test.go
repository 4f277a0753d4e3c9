package main

import (
	"encoding/json"
	"fmt"
	"os"
	"reflect"
	"strings"
	"testing"

	"example.com/example-robot/wasmouse"
	"example.com/example-robot/wasmouse/arena"
)

// The toolkit against the cases in vectors.json, which come from the Rust SDK.
type vectors struct {
	Turns []struct {
		From, To, Turn, Turned, After string
	}
	Maps []struct {
		Dimension    int
		Observations []struct {
			pose
			Sensors        [3]int
			Opened, Closed int
		}
		Walls [][]string
	}
	Searches []struct {
		Maze        arenaMaze
		LongestMove int `json:"longest_move"`
		Steps       [][]*int
		From        pose
		StepsUntil  [][]*int `json:"steps_until"`
		Route       [][2]any
	}
	Matches []struct {
		Maze             arenaMaze
		Summary, Actions string
	}
}

// JSON has numbers where Go would expect the text of bytes.
type arenaMaze [][]int

type pose struct {
	X, Y    int
	Heading string
}

var (
	headingNames = []string{"up", "right", "down", "left"}
	turnNames    = []string{"left", "straight", "right"}
)

func load(t *testing.T) (v vectors) {
	t.Helper()
	text, err := os.ReadFile("testdata/vectors.json")
	if err == nil {
		err = json.Unmarshal(text, &v)
	}
	if err != nil {
		t.Fatal(err)
	}
	return v
}

func heading(t *testing.T, name string) wasmouse.Heading {
	t.Helper()
	for _, heading := range wasmouse.Headings {
		if headingNames[heading] == name {
			return heading
		}
	}
	t.Fatalf("no heading %q", name)
	return 0
}

func (p pose) value(t *testing.T) wasmouse.Pose {
	return wasmouse.Pose{Cell: wasmouse.Cell{X: p.X, Y: p.Y}, Heading: heading(t, p.Heading)}
}

func (m arenaMaze) maze() arena.Maze {
	maze := make(arena.Maze, len(m))
	for x, column := range m {
		for _, value := range column {
			maze[x] = append(maze[x], uint8(value))
		}
	}
	return maze
}

func allCells(dimension int) []wasmouse.Cell {
	return wasmouse.Area{Width: dimension, Height: dimension}.Cells()
}

func TestTurns(t *testing.T) {
	for _, c := range load(t).Turns {
		from := heading(t, c.From)
		if c.To != "" {
			turn, ahead := from.TurnTo(heading(t, c.To))
			if ahead != (c.Turn != "") || ahead && turnNames[turn] != c.Turn {
				t.Errorf("%+v: got %v, %v", c, turn, ahead)
			}
			continue
		}
		for turn, name := range turnNames {
			if after := from.Turned(wasmouse.Turn(turn)); name == c.Turned && headingNames[after] != c.After {
				t.Errorf("%+v: got %v", c, after)
			}
		}
	}
}

func TestMaps(t *testing.T) {
	for _, c := range load(t).Maps {
		m := wasmouse.NewMap(c.Dimension)
		for _, seen := range c.Observations {
			sensors := wasmouse.Sensors{Left: seen.Sensors[0], Front: seen.Sensors[1], Right: seen.Sensors[2]}
			news := m.Observe(seen.value(t), sensors)
			if want := (wasmouse.News{Opened: seen.Opened, Closed: seen.Closed}); news != want {
				t.Errorf("%+v: got %+v", seen, news)
			}
		}
		for _, cell := range allCells(c.Dimension) {
			var found strings.Builder
			for _, heading := range wasmouse.Headings {
				found.WriteByte("?.#"[m.Wall(cell, heading)])
			}
			if want := c.Walls[cell.X][cell.Y]; found.String() != want {
				t.Errorf("%v: got %s, want %s", cell, found.String(), want)
			}
		}
	}
}

func TestSearches(t *testing.T) {
	for _, c := range load(t).Searches {
		maze := c.Maze.maze()
		m := wasmouse.NewMap(len(maze))
		for _, cell := range allCells(len(maze)) {
			for _, heading := range wasmouse.Headings {
				wall := wasmouse.ClosedWall
				if maze.IsOpen(cell, heading) {
					wall = wasmouse.OpenWall
				}
				m.Set(cell, heading, wall)
			}
		}
		passages := m.Passages(wasmouse.Pessimistic)
		goal := wasmouse.Center(len(maze)).Cells()
		search := wasmouse.NewSearch(len(maze), c.LongestMove)
		search.Fill(passages, goal)
		checkSteps(t, search, c.Steps)
		from := c.From.value(t)
		search.FillUntil(passages, goal, from.Cell)
		checkSteps(t, search, c.StepsUntil)
		var route [][2]any
		for _, hop := range search.Route(passages, from) {
			route = append(route, [2]any{headingNames[hop.Heading], float64(hop.Cells)})
		}
		if len(route) != len(c.Route) || len(route) > 0 && !reflect.DeepEqual(route, c.Route) {
			t.Errorf("got %v, want %v", route, c.Route)
		}
	}
}

func checkSteps(t *testing.T, search *wasmouse.Search, want [][]*int) {
	t.Helper()
	for _, cell := range allCells(len(want)) {
		steps, reached := search.Steps(cell)
		if want := want[cell.X][cell.Y]; reached != (want != nil) || reached && steps != *want {
			t.Errorf("%v: got %d, %v", cell, steps, reached)
		}
	}
}

func TestMatches(t *testing.T) {
	for _, c := range load(t).Matches {
		maze := c.Maze.maze()
		played := arena.Play(Start, maze, wasmouse.ContestBriefing(len(maze)))
		if got := played.String(); got != c.Summary {
			t.Errorf("got %q, want %q", got, c.Summary)
		}
		var words []string
		for _, action := range played.Actions {
			if action.Reset {
				words = append(words, "reset")
			} else {
				words = append(words, fmt.Sprintf("%c%d", "LSR"[action.Move.Turn], action.Move.Advance))
			}
		}
		if got := strings.Join(words, " "); got != c.Actions {
			t.Errorf("got %s, want %s", got, c.Actions)
		}
	}
}
