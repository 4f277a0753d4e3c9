//! Robots in other languages: the projects of `example-robots/languages`.

/// The cases that the SDK of every language is tested with.
mod vectors;
