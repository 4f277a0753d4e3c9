//! Options that commands share which run robots: rules, threads, cache.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread;

use etcetera::BaseStrategy as _;

use super::failure::Failure;
use crate::robot::{Cache, Host};
use crate::sim::Ruleset;

/// How robots are run.
#[derive(clap::Args, Debug)]
pub struct SetupArgs {
    /// The ruleset: `udacity` (1000 steps for both runs together) or
    /// `udacity-each-run` (1000 steps for each run)
    #[arg(long, value_name = "NAME", default_value = "udacity", value_parser = rules)]
    pub rules: Ruleset,
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

fn rules(name: &str) -> Result<Ruleset, String> {
    Ruleset::by_name(name).ok_or_else(|| {
        let names = Ruleset::all().map(|rules| rules.name);
        format!("no ruleset has this name; there are {}", names.join(", "))
    })
}

impl SetupArgs {
    /// Threads to play matches on, at least 1.
    pub fn threads(&self) -> usize {
        let cores = || thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        self.jobs.unwrap_or_else(cores).get()
    }

    /// A host with a cache, or without one when that cannot be used: robots are
    /// then compiled each time, which is slower and otherwise the same.
    ///
    /// # Errors
    ///
    /// When the machine cannot run robots at all.
    pub fn host(&self) -> Result<Host, Failure> {
        let matches = u32::try_from(self.threads()).unwrap_or(u32::MAX);
        Host::new(self.rules.limits, matches, self.open_cache())
            .map_err(|error| Failure::host(error).hint("try fewer threads with --jobs"))
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
