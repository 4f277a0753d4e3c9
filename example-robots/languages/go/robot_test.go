package main

import (
	"testing"

	"example.com/example-robot/wasmouse"
	"example.com/example-robot/wasmouse/arena"
)

// The robot plays a maze, without WebAssembly.
func TestPlaysAMaze(t *testing.T) {
	played := arena.Play(Start, arena.Maze01(), wasmouse.ContestBriefing(12))
	if got, want := played.String(), "finished 31 + 21: 22.033"; got != want {
		t.Errorf("got %q, want %q", got, want)
	}
	if played.Bumps != 0 {
		t.Errorf("%d bumps", played.Bumps)
	}
}

func TestRejectsUnknownVariants(t *testing.T) {
	defer func() {
		if recover() == nil {
			t.Error("variant 1 was accepted")
		}
	}()
	briefing := wasmouse.ContestBriefing(12)
	briefing.Variant = 1
	Start(briefing)
}
