// This is a robot for virtual micromouse contests.
package main

import "example.com/example-robot/wasmouse"

// The host calls the robot; nothing calls main.
func main() {}

func init() {
	wasmouse.Export(Start)
}
