module example.com/example-robot

go 1.25.0

toolchain go1.27.3
