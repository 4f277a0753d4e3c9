//! Options shared by the commands that run robots: rules, threads, cache, isolation.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use etcetera::BaseStrategy as _;
use wasmouse_core::game::{Ruleset, SandboxLimits};
use wasmouse_engine::sandbox::{Executable, PATIENCE, WorkerOptions};
use wasmouse_engine::{Cache, Control, Isolation, LocalExecutor, match_time_max};

use super::failure::Failure;
use super::interrupt;
use super::output::message;
use crate::contest::Seeds;
use crate::report::text::text;

/// How robots are run.
#[derive(clap::Args, Debug)]
pub struct SetupArgs {
    /// Ruleset: `udacity` (1000 steps for both runs together), `udacity-each-run` (1000 steps for
    /// each run), or one of these with the fuel that Python and JavaScript need,
    /// `udacity-interpreted` or `udacity-each-run-interpreted`
    #[arg(long, value_name = "NAME", default_value = "udacity", value_parser = rules)]
    pub rules: Ruleset,
    #[command(flatten)]
    pub engine: EngineArgs,
}

/// What robots are run with, whatever the rules.
#[derive(clap::Args, Clone, Debug)]
pub struct EngineArgs {
    /// Number of matches to play in parallel, at most 1024 [default: number of cores]
    #[arg(long, short, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    #[command(flatten)]
    cache: CacheArgs,
}

/// Where compiled robots are kept.
#[derive(clap::Args, Clone, Debug)]
pub struct CacheArgs {
    /// Cache directory for compiled robots [default: the user's cache directory]
    #[arg(long, value_name = "DIR", env = "WASMOUSE_CACHE")]
    cache: Option<PathBuf>,
    /// Largest size of the cache in MiB; what was not used for the longest time is removed
    #[arg(long, value_name = "MIB", env = "WASMOUSE_CACHE_SIZE",
          default_value_t = Cache::SIZE_MAX_DEFAULT >> 20,
          value_parser = clap::value_parser!(u64).range(0..=1 << 30))]
    cache_size: u64,
    /// Disable the compilation cache (overrides --cache)
    // No conflict with `--cache`: clap would also see one in WASMOUSE_CACHE.
    #[arg(long)]
    no_cache: bool,
}

/// Where robots from files run.
#[derive(clap::Args, Debug)]
pub struct IsolationArgs {
    /// Run robot files in-process instead of in sandboxed workers; only for robots you trust
    #[arg(long)]
    trust: bool,
    /// Fail if the operating system cannot sandbox worker processes completely
    #[arg(long, conflicts_with = "trust")]
    require_sandbox: bool,
}

/// Which random seeds matches have.
#[derive(clap::Args, Debug)]
pub struct SeedArgs {
    /// First random seed; the robot's only source of randomness
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Play each robot in each maze this many times, with seed, seed + 1, ...
    #[arg(long, value_name = "COUNT", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    repeat: u32,
}

impl SeedArgs {
    /// The seeds.
    ///
    /// # Errors
    ///
    /// When the last one would exceed the largest seed.
    pub fn seeds(&self) -> Result<Seeds, Failure> {
        let last = self.seed.checked_add(u64::from(self.repeat - 1));
        match last {
            Some(_) => Ok(Seeds {
                first: self.seed,
                count: self.repeat,
            }),
            None => Err(Failure::usage(text!(
                "seed {} repeated {} times exceeds the largest seed, {}",
                self.seed,
                self.repeat,
                u64::MAX
            ))
            .hint("choose a smaller --seed")),
        }
    }
}

/// How long robots may take.
#[derive(clap::Args, Debug, Default)]
pub struct TimeArgs {
    /// Processor time of a match, in seconds. A match that takes longer is played once more; it
    /// is never a verdict [default: 60; 600 by interpreted rules]
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..=86_400))]
    match_time: Option<u64>,
    /// Processor time that each robot may use in all its matches, in seconds, before it is
    /// withdrawn [default: 300, and 2 more for each of its matches; ten times as much by
    /// interpreted rules]
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..))]
    robot_time: Option<u64>,
}

impl TimeArgs {
    /// Processor time of a match and of each robot; `None` is the default.
    pub fn new(match_time: Option<Duration>, robot_time: Option<Duration>) -> Self {
        Self {
            match_time: match_time.map(|it| it.as_secs()),
            robot_time: robot_time.map(|it| it.as_secs()),
        }
    }

    /// Processor time of each robot; `None` is the default.
    pub fn robot_time(&self) -> Option<Duration> {
        self.robot_time.map(Duration::from_secs)
    }

    fn control(&self, limits: &SandboxLimits) -> Control {
        let given = self.match_time.map(Duration::from_secs);
        Control {
            match_time: given.unwrap_or_else(|| match_time_max(limits)),
            cancel: interrupt::flag().clone(),
        }
    }
}

/// The ruleset of that name, for clap.
///
/// # Errors
///
/// When there is none.
pub fn rules(name: &str) -> Result<Ruleset, String> {
    Ruleset::by_name(name).ok_or_else(|| {
        let names = Ruleset::all().map(|rules| rules.name);
        format!("unknown ruleset; the rulesets are {}", names.join(", "))
    })
}

impl SetupArgs {
    /// Threads to play matches on, at least 1.
    pub fn jobs(&self) -> usize {
        self.engine.jobs()
    }

    /// An executor for bundled robots, which run in this process, with a cache, or without one
    /// when that cannot be used: robots are then compiled each time, which is slower and
    /// otherwise the same.
    pub fn executor(&self) -> LocalExecutor {
        let engine = &self.engine;
        let rules = Arc::new(self.rules.clone());
        let control = TimeArgs::default().control(&rules.sandbox);
        executor(
            rules,
            engine.jobs(),
            engine.cache.open(),
            (Isolation::None, control),
        )
    }

    /// An executor for all robots.
    ///
    /// # Errors
    ///
    /// When the program cannot find itself, to start workers from.
    pub fn executor_for_all(
        &self,
        isolation: &IsolationArgs,
        time: &TimeArgs,
    ) -> Result<LocalExecutor, Failure> {
        let rules = Arc::new(self.rules.clone());
        self.engine.executor(rules, isolation, time)
    }
}

impl EngineArgs {
    /// The same with another default for `--jobs`.
    #[must_use]
    pub fn with_jobs_default(&self, jobs: Option<u16>) -> Self {
        let mut args = self.clone();
        args.jobs = args.jobs.or(jobs);
        args
    }

    /// Threads to play matches on, at least 1.
    pub fn jobs(&self) -> usize {
        let cores = || thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.jobs.map_or_else(cores, usize::from)
    }

    /// An executor for all robots by these rules.
    ///
    /// # Errors
    ///
    /// When the program cannot find itself, to start workers from.
    pub fn executor(
        &self,
        rules: Arc<Ruleset>,
        isolation: &IsolationArgs,
        time: &TimeArgs,
    ) -> Result<LocalExecutor, Failure> {
        let isolation = isolation.isolation(time, &rules.sandbox)?;
        Ok(executor(rules, self.jobs(), self.cache.open(), isolation))
    }
}

impl CacheArgs {
    /// An executor for one match at a time.
    ///
    /// # Errors
    ///
    /// When the program cannot find itself, to start workers from.
    pub fn executor(
        &self,
        rules: Arc<Ruleset>,
        isolation: &IsolationArgs,
    ) -> Result<LocalExecutor, Failure> {
        let isolation = isolation.isolation(&TimeArgs::default(), &rules.sandbox)?;
        Ok(executor(rules, 1, self.open(), isolation))
    }

    fn open(&self) -> Option<Cache> {
        if self.no_cache {
            return None;
        }
        let folder = match &self.cache {
            Some(folder) => folder.clone(),
            None => etcetera::choose_base_strategy()
                .ok()?
                .cache_dir()
                .join("wasmouse")
                .join("robots"),
        };
        match Cache::open(folder) {
            Ok(cache) => Some(cache.with_size_max(self.cache_size << 20)),
            Err(error) => {
                message!("warning: {}; robots are compiled again each time", error);
                None
            }
        }
    }
}

fn executor(
    rules: Arc<Ruleset>,
    jobs: usize,
    cache: Option<Cache>,
    (isolation, control): (Isolation, Control),
) -> LocalExecutor {
    let matches = u32::try_from(jobs).unwrap_or(u32::MAX);
    LocalExecutor::new(rules, matches, cache, isolation).with_control(control)
}

/// An executor on that many threads that has nothing in common with any other: it compiles all
/// robots again.
///
/// # Errors
///
/// When the program cannot find itself, to start workers from.
pub fn independent_executor(
    rules: Arc<Ruleset>,
    jobs: usize,
    isolation: &IsolationArgs,
    time: &TimeArgs,
) -> Result<LocalExecutor, Failure> {
    let isolation = isolation.isolation(time, &rules.sandbox)?;
    Ok(executor(rules, jobs, None, isolation))
}

impl IsolationArgs {
    fn isolation(
        &self,
        time: &TimeArgs,
        limits: &SandboxLimits,
    ) -> Result<(Isolation, Control), Failure> {
        let control = time.control(limits);
        if self.trust {
            return Ok((Isolation::None, control));
        }
        let executable = Executable::current().map_err(|error| {
            Failure::internal(format!("failed to find the wasmouse executable: {error}"))
        })?;
        let workers = WorkerOptions {
            executable,
            patience: PATIENCE.max(control.match_time * 5),
            require_sandbox: self.require_sandbox,
            control: control.clone(),
        };
        Ok((Isolation::Workers(workers), control))
    }
}
