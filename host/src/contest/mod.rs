//! Many matches: robots by mazes by seeds, and the standings they make.
//!
//! The fourth stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! A [`Contest`] is a value that says what is played; [`Contest::run`] plays it
//! on any number of threads and returns the results in the contest's own order,
//! the same on one thread or many. Prints nothing and reads no files.

mod benchmark;
mod mean;
mod run;
mod standings;
mod study;
mod tally;

pub use benchmark::Benchmark;
pub use mean::Mean;
pub use run::{
    Contest, ContestError, ContestMaze, Entrant, FailedMatch, MatchResult, Pairing, Played,
    Progress,
};
pub use standings::{Standing, standings};
pub use study::{
    CompetitionMazes, Group, STUDY_QUICK, STUDY_QUICK_COMPETITION, STUDY_SEEDS, Study,
    study_families,
};
pub use tally::{Against, Regret, Tally};
