//! [`Host`]: plays the bundled robots in this process.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

use wasmouse::contest::{Entrant, MazeSource, Options, Plan, RecordList, Seeds, Sink, run};
use wasmouse_core::GuestText;
use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::generate::{GENERATED_DIMENSIONS, GenSpec, Kind};
use wasmouse_core::maze::{Maze, goal_entrances};
use wasmouse_engine::bundled::bundled;
use wasmouse_engine::{Executor, InProcess, Limits};

use crate::mazes::maze_01;
use crate::page::OfficialMaze;
use crate::played::MazeSet;
use crate::published::OFFICIAL;

/// The first seed of the generated mazes. No parameter of a bundled robot may be tuned on mazes
/// of these seeds; a test compares them with the `training.toml` of each robot.
const FIRST_SEED: u64 = 500_001;

/// The robots and what plays them.
pub struct Host {
    executor: InProcess,
    jobs: usize,
    /// The robots.
    pub entrants: Vec<Entrant>,
    /// The rules of all matches.
    pub rules: Arc<Ruleset>,
}

impl Host {
    /// Admits the bundled robots with these names, or all, in every variant.
    ///
    /// # Errors
    ///
    /// If there is no robot with one of the names, or the host fails.
    pub fn new(names: &[String]) -> Result<Self, String> {
        let jobs = thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let rules = Arc::new(Ruleset::default());
        let limits = Limits::with_sandbox(rules.sandbox);
        let matches = u32::try_from(jobs).unwrap_or(u32::MAX);
        let executor = InProcess::new(limits, matches, None).map_err(|it| it.to_string())?;
        let mut entrants = Vec::new();
        for robot in bundled() {
            let admission = executor
                .admit(robot.component)
                .map_err(|it| it.to_string())?;
            let admitted = Arc::new(admission.map_err(|it| format!("`{}`: {it}", robot.name))?);
            let entrant = |name: GuestText, variant| Entrant {
                name,
                digest: *admitted.digest(),
                variant,
                admission: Ok(Arc::clone(&admitted)),
            };
            if robot.variants.is_empty() {
                entrants.push(entrant(robot.name.into(), 0));
            }
            let variants = robot.variants.iter();
            let variants =
                variants.map(|it| (format!("{}:{}", robot.name, it.name).into(), it.value));
            entrants.extend(variants.map(|(name, value)| entrant(name, value)));
        }
        let has_name = |robot: &str, name: &str| {
            let rest = robot.strip_prefix(name);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(':'))
        };
        for name in names {
            if !entrants.iter().any(|it| has_name(it.name.raw(), name)) {
                return Err(format!("no bundled robot is called `{name}`"));
            }
        }
        entrants.retain(|it| {
            names.is_empty() || names.iter().any(|name| has_name(it.name.raw(), name))
        });
        Ok(Self {
            executor,
            jobs,
            entrants,
            rules,
        })
    }

    fn play(
        &self,
        entrants: &[Entrant],
        mazes: Vec<MazeSource>,
        seeds: u32,
        sink: &mut dyn Sink,
    ) -> Result<(), String> {
        let plan = Plan {
            entrants: entrants.to_vec(),
            mazes,
            seeds: Seeds {
                first: 0,
                count: seeds,
            },
            rules: Arc::clone(&self.rules),
        };
        eprintln!("playing {} matches", plan.matches());
        let options = Options {
            jobs: self.jobs,
            cancelled: &AtomicBool::new(false),
            wanted: &|_| true,
            ended: &|_, _| Ok(()),
            robot_time: None,
        };
        run(&plan, &self.executor, &options, sink).map_err(|error| error.to_string())
    }

    /// Plays the official mazes.
    ///
    /// # Errors
    ///
    /// If the host fails, here and below.
    pub fn official(&self, mazes: [Option<Maze>; 3]) -> Result<[Option<OfficialMaze>; 3], String> {
        let mut results = [const { None }; 3];
        for (result, (maze, (name, _))) in results.iter_mut().zip(mazes.into_iter().zip(OFFICIAL)) {
            let Some(maze) = maze else { continue };
            let source = loaded(name, maze);
            let maze = source.prepare(&self.rules.game);
            let mut records = RecordList::new(u64::MAX);
            self.play(&self.entrants, vec![source], 1, &mut records)?;
            let records = records.into_records().unwrap_or_default();
            if records.len() != self.entrants.len() {
                return Err(format!("failed to play every match in `{name}`"));
            }
            *result = Some(OfficialMaze { maze, records });
        }
        Ok(results)
    }

    /// Plays mazes of every kind and size, with this many seeds.
    ///
    /// # Errors
    ///
    /// If the host fails.
    pub fn generated(&self, seeds: u64) -> Result<Vec<(Kind, MazeSet)>, String> {
        let family = |kind| {
            let seeds = FIRST_SEED..=FIRST_SEED + seeds - 1;
            let spec = GenSpec::new(kind, GENERATED_DIMENSIONS, seeds).expect("at most 500 mazes");
            let mut set = MazeSet::new(spec.to_string(), self.entrants.len());
            let mazes = spec.expand().map(MazeSource::Generated);
            self.play(&self.entrants, mazes.collect(), 1, &mut set)?;
            Ok((kind, set))
        };
        Kind::ALL.into_iter().map(family).collect()
    }

    /// Plays the mazes whose goal can be reached, by the number of entrances to it, up to `most`
    /// of each kind, and counts the others; `None` if there are no mazes.
    ///
    /// # Errors
    ///
    /// If the host fails.
    pub fn competition(
        &self,
        mazes: Vec<(String, Maze)>,
        most: usize,
    ) -> Result<Option<([MazeSet; 2], usize)>, String> {
        if mazes.is_empty() {
            return Ok(None);
        }
        let (mut single, mut several, mut unsolvable) = (Vec::new(), Vec::new(), 0);
        for (name, maze) in mazes {
            if self.rules.game.oracle_score(&maze).is_none() {
                unsolvable += 1;
            } else if goal_entrances(&maze).len() == 1 {
                single.push(loaded(name, maze));
            } else {
                several.push(loaded(name, maze));
            }
        }
        let play = |name, mut mazes: Vec<MazeSource>| {
            let mut set = MazeSet::new(name, self.entrants.len());
            mazes.truncate(most);
            self.play(&self.entrants, mazes, 1, &mut set)?;
            Ok::<_, String>(set)
        };
        let sets = [
            play("Competition mazes with one entrance", single)?,
            play("Competition mazes with several entrances", several)?,
        ];
        Ok(Some((sets, unsolvable)))
    }

    /// Plays the random robot in maze 01 with many seeds, if it is among the robots.
    ///
    /// # Errors
    ///
    /// If the host fails.
    pub fn random(&self, seeds: u32) -> Result<Option<MazeSet>, String> {
        let Some(random) = self.entrants.iter().position(|it| it.name == "random") else {
            return Ok(None);
        };
        let mut set = MazeSet::new("random robot", 1);
        let (random, mazes) = (
            &self.entrants[random..=random],
            vec![loaded("01", maze_01())],
        );
        self.play(random, mazes, seeds, &mut set)?;
        Ok(Some(set))
    }
}

fn loaded(name: impl Into<GuestText>, maze: Maze) -> MazeSource {
    MazeSource::Loaded {
        name: name.into(),
        maze: Arc::new(maze),
    }
}
