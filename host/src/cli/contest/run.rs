//! `wasmouse contest run`: plays what is missing of a contest, and writes its reports.

use std::io;
use std::path::PathBuf;
use std::thread;

use wasmouse_engine::{LocalExecutor, engine_id};

use super::super::entrants;
use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::interrupt;
use super::super::output::message;
use super::super::play;
use super::super::setup::{EngineArgs, IsolationArgs, TimeArgs};
use super::super::store_failure::{store_failure, store_failure_of};
use super::failures::print_unplayed;
use super::load::FILE_NAME;
use super::planned::{Left, PlannedContest};
use super::progress::Progress;
use super::recorder::Recorder;
use super::report;
use super::shard::Shard;
use super::watch::Watch;
use crate::contest::{
    self, ContestMatch, Entrant, KeepTranscripts, NotAdmitted, Options, Plan, RejectionEntry,
    RunError, ScoreMatrix, Sink,
};
use crate::report::number::counted;
use crate::report::text::Text;
use crate::store::{KeptTranscripts, Store, StoreError, StoreSink, Submission};

const EXAMPLES: &str = "\
Examples:
  wasmouse contest run                     the contest.toml of the current folder
  wasmouse contest run spring/contest.toml
  wasmouse contest run --shard 2/4 --store part-2.db
  wasmouse contest run --watch             play what is submitted until Ctrl-C

Exit codes:
  0  every match was played, or its robot was rejected or withdrawn
  5  the host could not play some matches, or the store has two records of a match
  130  interrupted; everything that was played is in the store";

/// Play what is missing of a contest and write its reports
///
/// Results are kept in a store: a database beside the contest file. Interrupted or killed, the
/// contest goes on where it was. A robot, maze or rule that changes is played again, and nothing
/// else.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The contest file, or a folder with a contest.toml
    #[arg(value_name = "FILE", default_value = FILE_NAME)]
    file: PathBuf,
    /// Play one of N parts of the mazes, for N machines; `contest merge` joins their stores
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// The store to use instead of the one that the contest file names
    #[arg(long, value_name = "FILE")]
    store: Option<PathBuf>,
    /// Play the matches of withdrawn robots, too
    #[arg(long)]
    retry: bool,
    /// Wait for robots that are submitted or changed, and play them, until Ctrl-C
    #[arg(long)]
    watch: bool,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    interrupt::listen()?;
    if !args.watch {
        let contest = PlannedContest::read(&args.file)?;
        return args.play(&contest);
    }
    let mut watch = Watch::default();
    loop {
        let contest = PlannedContest::read(&args.file)?;
        watch.seen(&contest);
        let exit = args.play(&contest)?;
        if exit == Exit::Interrupted {
            return Ok(exit);
        }
        message!("waiting for submissions; Ctrl-C ends the contest");
        if !watch.wait(&args.file) {
            return Ok(Exit::Interrupted);
        }
    }
}

impl Args {
    fn shard(&self) -> Shard {
        self.shard.unwrap_or(Shard::ALL)
    }

    /// Plays what is missing, and writes the reports.
    fn play(&self, contest: &PlannedContest) -> Result<Exit, Failure> {
        let path = self.store.clone().unwrap_or_else(|| contest.folder.store());
        let mut store = Store::create_or_open(&path).map_err(store_failure)?;
        let left = contest.left(&store, self.shard(), self.retry)?;
        let entrants = if left.matches == 0 {
            message!("nothing to play: {} has all matches", Text::of_path(&path));
            Vec::new()
        } else {
            self.play_left(contest, &left, &mut store)?
        };
        let mut not_admitted = contest.rejections(&store)?;
        for (&robot, entrant) in left.robots.iter().zip(&entrants) {
            if let Err(reason) = &entrant.admission {
                not_admitted[robot] = Some(reason.clone());
            }
        }
        let matrix = if interrupt::flag().is_set() {
            message!("interrupted; `wasmouse contest run` goes on where this ended");
            contest.matrix(&store, &not_admitted)?
        } else {
            seal_and_read(contest, &mut store, &not_admitted)?
        };
        let has_failed = matrix
            .robots
            .iter()
            .any(|it| it.failed > 0 || matches!(it.not_admitted, Some(NotAdmitted::Failed(_))));
        if self.shard().is_all() {
            report::publish(contest, &store, &matrix)?;
        } else {
            // The reports say so otherwise.
            print_unplayed(&matrix);
            message!(
                "{} has {} of {}; `wasmouse contest merge` joins the parts",
                Text::of_path(&path),
                matrix.played(),
                counted(contest.matches(&matrix), "match")
            );
        }
        Ok(if interrupt::flag().is_set() {
            Exit::Interrupted
        } else if has_failed {
            Exit::Internal
        } else {
            Exit::Success
        })
    }

    /// Plays what is left. Returns the entrants, one for each robot that was left to play.
    fn play_left(
        &self,
        contest: &PlannedContest,
        left: &Left,
        store: &mut Store,
    ) -> Result<Vec<Entrant>, Failure> {
        let options = &contest.folder.file.run;
        let time = TimeArgs::new(options.match_time(), options.robot_time());
        let jobs = options.jobs.map(|it| it.get_u16());
        let engine = self.engine.with_jobs_default(jobs);
        let executor = engine.executor(contest.rules.clone(), &self.isolation, &time)?;
        let entrants = self.admit(contest, left, &executor)?;
        store
            .submit(&submissions(contest, left, &entrants))
            .map_err(store_failure)?;
        let playable = left.playable(&entrants);
        if playable == 0 {
            message!("nothing to play: only robots that are not admitted have matches left");
            return Ok(entrants);
        }
        let before = contest.matrix(store, &contest.rejections(store)?)?;
        let plan = Plan {
            entrants: entrants.clone(),
            mazes: left
                .mazes
                .iter()
                .map(|&maze| contest.mazes[maze].0.clone())
                .collect(),
            seeds: contest.seeds,
            rules: contest.rules.clone(),
        };
        let scoring = &contest.folder.file.scoring;
        let progress = Progress::new(&before, scoring, playable);
        let kept = match options.keep_transcripts {
            KeepTranscripts::None => KeptTranscripts::None,
            KeepTranscripts::Best => KeptTranscripts::Best,
            KeepTranscripts::All => KeptTranscripts::All,
        };
        let rules = (*contest.rules).clone();
        let sink = StoreSink::new(store, engine_id(), rules, kept).map_err(store_failure)?;
        let (played, recorded) = thread::scope(|scope| {
            let recorder = match Recorder::start(scope, sink) {
                Ok(recorder) => recorder,
                Err(error) => return (Err(RunError::Thread(error)), Ok(())),
            };
            let options = Options {
                jobs: engine.jobs(),
                cancelled: interrupt::flag().as_atomic(),
                wanted: &|key| left.wants(key),
                ended: &|maze, ended| {
                    progress.ended(ended);
                    recorder.put(maze, ended)
                },
                robot_time: time.robot_time(),
            };
            let played = contest::run(&plan, &executor, &options, &mut Nothing);
            (played, recorder.finish())
        });
        progress.finish();
        // Where the store failed, so did the run, and only the store says why.
        recorded.map_err(|error| match StoreError::of_sink(&error) {
            Some(error) => store_failure_of(error),
            None => Failure::internal(error),
        })?;
        played.map_err(|error| play::failure(&error))?;
        Ok(entrants)
    }

    /// Admits the robots that have matches to play.
    fn admit(
        &self,
        contest: &PlannedContest,
        left: &Left,
        executor: &LocalExecutor,
    ) -> Result<Vec<Entrant>, Failure> {
        let robots = left.robots.iter().map(|&it| &contest.robots[it]);
        let specs: Vec<_> = robots.clone().map(|it| it.robot.spec.clone()).collect();
        let mut entrants = entrants::load(&specs, executor)?;
        for (entrant, planned) in entrants.iter_mut().zip(robots) {
            if entrant.digest != planned.digest {
                let name = planned.robot.name.escaped();
                let message = format!("robot `{name}` was changed meanwhile");
                return Err(Failure::input(message).hint("run the contest again"));
            }
            entrant.name.clone_from(&planned.robot.name);
        }
        Ok(entrants)
    }
}

/// Seals the store, and reads the matrix from it meanwhile: both go through all records, and a
/// contest of many short matches would wait for them one after the other.
fn seal_and_read(
    contest: &PlannedContest,
    store: &mut Store,
    not_admitted: &[Option<NotAdmitted>],
) -> Result<ScoreMatrix, Failure> {
    if store.sealed().map_err(store_failure)?.is_some() {
        return contest.matrix(store, not_admitted);
    }
    let reader = Store::open_read_only(store.path()).map_err(store_failure)?;
    thread::scope(|scope| {
        let seal = move || store.seal();
        let sealing = thread::Builder::new().spawn_scoped(scope, seal);
        let sealing = sealing.map_err(|error| play::failure(&RunError::Thread(error)))?;
        let matrix = contest.matrix(&reader, not_admitted);
        let sealed = sealing.join();
        let sealed = sealed.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        sealed.map_err(store_failure)?;
        matrix
    })
}

/// What the history of the store says about the robots.
fn submissions(contest: &PlannedContest, left: &Left, entrants: &[Entrant]) -> Vec<Submission> {
    let rejection = |robot: usize| {
        let place = left.robots.iter().position(|it| *it == robot)?;
        match &entrants[place].admission {
            Err(NotAdmitted::Rejected(it)) => Some(RejectionEntry::from(&**it)),
            _ => None,
        }
    };
    let robots = contest.robots.iter().enumerate();
    let submission = |(index, planned): (usize, &super::planned::PlannedRobot)| {
        let (robot, variant) = planned.player();
        Submission {
            name: planned.robot.name.clone(),
            author: planned.robot.author.clone(),
            class: planned.robot.class.clone(),
            robot,
            variant,
            rejection: rejection(index),
        }
    };
    robots.map(submission).collect()
}

/// A sink for a contest whose matches are taken as they end.
struct Nothing;

impl Sink for Nothing {
    fn played(&mut self, _: &ContestMatch) -> io::Result<()> {
        Ok(())
    }
}
