//! [`TrialArgs`]: robots played in many mazes for the numbers alone, for every command that
//! compares them.

use super::complaints;
use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::mazes::{self, BadFiles, Legality};
use super::play::{Pace, play_all};
use super::robots::RobotSpec;
use super::setup::{IsolationArgs, SeedArgs, SetupArgs, TimeArgs};
use super::verdict::{exit, print_faults};
use crate::contest::{
    ContestInfo, FaultSummary, MatrixBuilder, Plan, RESULTS_VERSION, Results, ScoreMatrix,
    StandingsBuilder, SummaryBuilder, Tee,
};

/// What is played, and how.
#[derive(clap::Args, Debug)]
pub struct TrialArgs {
    /// Mazes to play in
    #[arg(long, short, visible_alias = "maze", value_name = "MAZE", num_args = 1..)]
    mazes: Vec<String>,
    #[command(flatten)]
    seeds: SeedArgs,
    /// Accept mazes that break contest rules
    #[arg(long)]
    lenient: bool,
    /// Fail on a bad maze file in a folder instead of skipping it
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
    #[command(flatten)]
    time: TimeArgs,
}

/// What came of it.
pub struct Trial {
    /// The matches.
    pub matrix: ScoreMatrix,
    /// How the command has to end, unless it has a finding of its own to report.
    pub exit: Exit,
}

impl TrialArgs {
    /// Plays the robots, in the default maze or mazes if none is named, and says on stderr what
    /// went wrong.
    ///
    /// # Errors
    ///
    /// When an argument names nothing, or the host fails.
    pub fn play(&self, robots: &[RobotSpec], default_mazes: &str) -> Result<Trial, Failure> {
        let executor = self.setup.executor_for_all(&self.isolation, &self.time)?;
        let bad_files = match self.strict {
            true => BadFiles::Fail,
            false => BadFiles::Skip,
        };
        let default_mazes = [default_mazes.to_owned()];
        let mazes = match self.mazes.as_slice() {
            [] => &default_mazes,
            mazes => mazes,
        };
        let legality = Legality::from_flag(self.lenient);
        let plan = Plan {
            mazes: mazes::distinct(mazes::load(mazes, legality, bad_files)?),
            entrants: entrants::load(robots, &executor)?,
            seeds: self.seeds.seeds()?,
            rules: executor.rules().clone(),
        };
        let players = plan.players();
        let mut matrix = MatrixBuilder::new(&plan);
        let mut standings = StandingsBuilder::new(&plan, &players);
        let mut summary = SummaryBuilder::new();
        let mut faults = FaultSummary::default();
        let pace = Pace {
            jobs: self.setup.jobs(),
            robot_time: self.time.robot_time(),
        };
        let mut sink = Tee(vec![&mut matrix, &mut standings, &mut summary, &mut faults]);
        play_all(&plan, &executor, pace, &mut sink)?;
        let results = Results {
            version: RESULTS_VERSION,
            contest: ContestInfo::new(&plan),
            matches: Vec::new(),
            summary: summary.finish(&plan, standings.finish(&plan, &players)),
        };
        let complaints = complaints::collect(&plan, &players, &executor, &faults);
        print_faults(&plan, &players, &results, (&faults, &complaints));
        let is_rejected = plan.entrants.iter().any(|it| it.admission.is_err());
        let exit = match exit(&plan, &results) {
            // What is asked for is how robots compare, and faults are part of it.
            Exit::Robot if !is_rejected => Exit::Success,
            Exit::NoneFinished => Exit::Success,
            exit => exit,
        };
        Ok(Trial {
            matrix: matrix.finish(),
            exit,
        })
    }
}
