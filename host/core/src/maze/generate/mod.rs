//! Seeded maze generators, one per file, and the specification that names their mazes.
//!
//! Every generated maze is a legal contest maze by construction: `Draft` fixes the start and
//! the goal room, the generators change only the rest, and each algorithm keeps all cells
//! connected. No maze is generated and then discarded.
//!
//! Equal specifications give equal mazes on every platform and in every later version: all
//! randomness comes from ChaCha8 with the key that `Draws` defines byte by byte, drawn as
//! fixed-width integers. A changed generator would change the mazes of published results, so
//! tests pin their bytes.

mod braid;
mod division;
mod draft;
mod draws;
mod kind;
mod sets;
mod spec;
mod stretches;
#[cfg(test)]
mod tests;
mod tree;

pub use kind::{GENERATED_DIMENSIONS, Kind};
pub use spec::{GENERATED_MAX, GenSpec, GenSpecError, GeneratedMaze};
