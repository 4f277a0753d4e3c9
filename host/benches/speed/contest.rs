//! Whole contests: matches per second, in this process and in workers.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, SamplingMode, Throughput};
use wasmouse::contest::{ContestMatch, Entrant, MazeSource, Options, Plan, Seeds, Sink, run};
use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;
use wasmouse_engine::{Executor, InProcess, Limits, Sandboxed, bundled};

use super::stage;

/// A contest with an executor that has admitted its robots.
pub struct Stage {
    plan: Plan,
    executor: Box<dyn Executor>,
}

/// Where robots run.
#[derive(Clone, Copy)]
pub enum Place {
    /// In this process.
    Here,
    /// In worker processes.
    Workers,
}

impl Stage {
    /// Those bundled robots in those mazes, on up to `jobs` threads.
    pub fn new(robots: &[(&str, u32)], mazes: &str, jobs: u32, place: Place) -> Self {
        let rules = Arc::new(Ruleset::default());
        let limits = Limits::default();
        let executor: Box<dyn Executor> = match place {
            Place::Here => Box::new(InProcess::new(limits, jobs, None).expect("address space")),
            Place::Workers => {
                let rules = Arc::clone(&rules);
                let executor = Sandboxed::new(rules, limits, stage::workers(), None);
                Box::new(executor.expect("a worker"))
            }
        };
        let entrants = robots.iter().map(|&(name, variant)| {
            let component = bundled::find(name).expect("a bundled robot").component;
            let admission = executor.admit(component).expect("the host works");
            Entrant {
                name: name.into(),
                digest: Digest::of(component),
                variant,
                admission: Ok(Arc::new(admission.expect("a robot"))),
            }
        });
        let mazes = stage::generated(mazes).into_iter();
        let plan = Plan {
            entrants: entrants.collect(),
            mazes: mazes
                .map(|(name, maze)| MazeSource::Loaded {
                    name: name.into(),
                    maze: Arc::new(maze),
                })
                .collect(),
            seeds: Seeds { first: 0, count: 1 },
            rules,
        };
        Self { plan, executor }
    }

    /// Plays all of it.
    pub fn play(&self, jobs: usize) {
        let cancelled = AtomicBool::new(false);
        let options = Options {
            jobs,
            cancelled: &cancelled,
            wanted: &|_| true,
            ended: &|_, _| Ok(()),
            robot_time: None,
        };
        let mut count = Count(0);
        run(&self.plan, &*self.executor, &options, &mut count).expect("the host works");
        assert_eq!(count.0, self.plan.matches());
    }
}

/// Counts matches.
struct Count(u64);

impl Sink for Count {
    fn played(&mut self, _: &ContestMatch) -> io::Result<()> {
        self.0 += 1;
        Ok(())
    }
}

/// `contest/...`: flood and depth-first search in 100 generated mazes.
pub fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("contest");
    group.sampling_mode(SamplingMode::Flat);
    for (place, name) in [(Place::Here, "here"), (Place::Workers, "in workers")] {
        let stage = Stage::new(&[("flood", 0), ("dfs", 0)], "gen:tree:16:1..=100", 2, place);
        group.throughput(Throughput::Elements(stage.plan.matches()));
        for jobs in [1, 2] {
            group.bench_function(format!("200 matches on {jobs} threads {name}"), |b| {
                b.iter(|| stage.play(jobs));
            });
        }
    }
    group.finish();
}
