//! Contests: robots by mazes by seeds, and the standings they make.
//!
//! A [`Plan`] says what is played. [`run`] plays it with an executor on any number of threads
//! and passes each match to a [`Sink`], in the order of the plan. Standings, fault summaries and
//! the parts of the [`Results`] document are sinks. Prints nothing and opens no files.

mod benchmark;
mod best;
mod commitment;
mod complaint;
pub mod config;
mod difference;
mod faults;
mod file;
pub mod grade;
mod hardest;
mod matrix;
mod maze_source;
mod mean;
mod plan;
mod ranking;
mod recorded;
mod results;
mod run;
mod scoring;
mod sink;
mod standings;
mod tally;
mod verify;

pub use benchmark::{Benchmark, Margins};
pub use best::{BestMatch, BestMatches};
pub use commitment::{
    Broken, COMMITMENT_VERSION, Commitment, CommittedSet, OpenedMaze, OpenedSet, Opening,
};
pub use complaint::{Complaint, Complaints};
pub use difference::{FieldDifference, differences};
pub use faults::{FaultGroup, FaultSummary};
pub use file::{
    CONTEST_FILE_VERSION, ClassEntry, ContestFile, GameEntry, KeepTranscripts, MazesEntry,
    NamesFrom, Outputs, ReportOptions, RobotSource, RobotsEntry, RulesEntry, RunOptions,
    SandboxEntry, SeedsEntry, VariantRef, template,
};
pub use hardest::HardestMazes;
pub use matrix::{
    MatchScore, MatrixBuilder, MatrixFault, MatrixMaze, MatrixRobot, MazeSet, Outcome, ScoreMatrix,
};
pub use maze_source::{ContestMaze, MazeSource};
pub use mean::Mean;
pub use plan::{Entrant, KeyParts, NotAdmitted, Plan, Player, Seeds};
pub use ranking::{
    MazeFilter, PairedComparison, PairedVerdict, Percentiles, Ranking, RankingLine, RobotState,
};
pub use recorded::{RecordedError, RecordedScores};
pub use results::{
    ContestInfo, MazeEntry, Names, RESULTS_VERSION, RejectionEntry, Results, RobotEntry, Summary,
    SummaryBuilder, WithdrawalEntry, records_digest,
};
pub use run::{OnEnded, Options, RunError, default_robot_time, run};
pub use scoring::{Method, Scoring, TIE_BREAKS_DEFAULT, TieBreak, worst_score_steps};
pub use sink::{ContestMatch, Ended, MatchFailure, RecordList, Sink, Tee};
pub use standings::{Standing, Standings, StandingsBuilder};
pub use tally::{Regret, Tally};
pub use verify::{Compared, compare, compare_played};
