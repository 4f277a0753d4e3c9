//! Options that commands share which run robots: rules, threads, cache.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread;

use etcetera::BaseStrategy as _;

use super::failure::Failure;
use crate::robot::{Cache, Executable, Isolation, PATIENCE, Referee, Workers};
use crate::sim::Ruleset;

/// How robots are run.
#[derive(clap::Args, Debug)]
pub struct SetupArgs {
    /// The ruleset: `udacity` (1000 steps for both runs together) or
    /// `udacity-each-run` (1000 steps for each run)
    #[arg(long, value_name = "NAME", default_value = "udacity", value_parser = rules)]
    pub rules: Ruleset,
    #[command(flatten)]
    pub engine: EngineArgs,
}

/// What robots are run with, whatever the rules.
#[derive(clap::Args, Debug)]
pub struct EngineArgs {
    /// Threads that play matches; by default one for each core
    #[arg(long, short, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Where compiled robots are kept; by default in the user's cache folder
    #[arg(long, value_name = "FOLDER", env = "WASMOUSE_CACHE")]
    cache: Option<PathBuf>,
    /// Compile robots anew and keep nothing, whatever `--cache` says
    // No conflict with `--cache`: clap would also see one in WASMOUSE_CACHE.
    #[arg(long)]
    no_cache: bool,
}

/// Where robots from files run.
#[derive(clap::Args, Debug)]
pub struct IsolationArgs {
    /// Run robots from files inside this process, as bundled ones do: for robots of
    /// your own. Without it they run in confined worker processes
    #[arg(long)]
    trust: bool,
    /// Fail where the operating system cannot confine the worker processes completely
    #[arg(long, conflicts_with = "trust")]
    require_sandbox: bool,
}

fn rules(name: &str) -> Result<Ruleset, String> {
    Ruleset::by_name(name).ok_or_else(|| {
        let names = Ruleset::all().map(|rules| rules.name);
        format!("no ruleset has this name; there are {}", names.join(", "))
    })
}

impl SetupArgs {
    /// Threads to play matches on, at least 1.
    pub fn threads(&self) -> usize {
        self.engine.threads()
    }

    /// A referee for bundled robots, which run in this process, with a cache, or
    /// without one when that cannot be used: robots are then compiled each time, which
    /// is slower and otherwise the same.
    pub fn referee(&self) -> Referee {
        let engine = &self.engine;
        referee(
            self.rules,
            engine.threads(),
            engine.open_cache(),
            Isolation::None,
        )
    }

    /// A referee for robots of all kinds.
    ///
    /// # Errors
    ///
    /// When the program cannot find itself, to start workers from.
    pub fn referee_for_all(&self, isolation: &IsolationArgs) -> Result<Referee, Failure> {
        self.engine.referee(self.rules, isolation)
    }
}

impl EngineArgs {
    /// Threads to play matches on, at least 1.
    pub fn threads(&self) -> usize {
        let cores = || thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        self.jobs.unwrap_or_else(cores).get()
    }

    /// A referee for robots of all kinds by these rules.
    ///
    /// # Errors
    ///
    /// When the program cannot find itself, to start workers from.
    pub fn referee(&self, rules: Ruleset, isolation: &IsolationArgs) -> Result<Referee, Failure> {
        let isolation = isolation.isolation()?;
        Ok(referee(rules, self.threads(), self.open_cache(), isolation))
    }

    fn open_cache(&self) -> Option<Cache> {
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
            Ok(cache) => Some(cache),
            Err(error) => {
                tell!("warning: {error}; robots are compiled anew each time");
                None
            }
        }
    }
}

fn referee(rules: Ruleset, threads: usize, cache: Option<Cache>, isolation: Isolation) -> Referee {
    let matches = u32::try_from(threads).unwrap_or(u32::MAX);
    Referee::new(rules, matches, cache, isolation)
}

/// A referee on that many threads that has nothing in common with any other: it
/// compiles all robots anew.
///
/// # Errors
///
/// When the program cannot find itself, to start workers from.
pub fn independent_referee(
    rules: Ruleset,
    threads: usize,
    isolation: &IsolationArgs,
) -> Result<Referee, Failure> {
    Ok(referee(rules, threads, None, isolation.isolation()?))
}

impl IsolationArgs {
    fn isolation(&self) -> Result<Isolation, Failure> {
        if self.trust {
            return Ok(Isolation::None);
        }
        let executable = Executable::current().map_err(|error| {
            Failure::host(format!("failed to find the program itself: {error}"))
        })?;
        Ok(Isolation::Workers(Workers {
            executable,
            patience: PATIENCE,
            require_sandbox: self.require_sandbox,
        }))
    }
}
