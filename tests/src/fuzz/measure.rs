//! What compiling a file takes.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use std::time::Instant;

use wasmouse_engine::admission::precheck::{Measure, precheck};
use wasmouse_engine::{Limits, engine_config};
use wasmtime::Engine;
use wasmtime::component::Component;

/// What admission estimates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    /// Processor time, in seconds.
    pub(super) cpu_seconds: f64,
    /// Memory, in MiB.
    pub(super) memory_mib: f64,
}

/// What was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    /// Processor time, in seconds.
    pub(super) cpu_seconds: f64,
    /// The most memory of the process meanwhile, in MiB, with what is left of other files.
    pub(super) memory_mib: u64,
    /// How much of it is more than there was before, in MiB.
    pub(super) grown_mib: u64,
}

/// How a file is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Threads {
    /// On the calling thread, whatever else the process does.
    One,
    /// On all threads of the compiler, which have to be those of a compile worker and be all that the
    /// process does.
    All,
}

/// The estimate of a file; `None` when it is not admitted.
pub(super) fn estimate(file: &[u8], limits: &Limits) -> Option<Estimate> {
    let shape = precheck(file, limits).ok()?;
    let measure = |measure| Some(f64::from(u32::try_from(shape.measures.get(measure)).ok()?));
    Some(Estimate {
        cpu_seconds: measure(Measure::Work)? / 1000.0,
        memory_mib: measure(Measure::Memory)?,
    })
}

/// Compiles and loads an admitted file; `None` when the compiler rejects it. What takes longer
/// than its estimate is measured again, and the shorter time counts: on a virtual machine,
/// processor time includes what other machines take.
///
/// # Panics
///
/// When the engine refuses to load what it has compiled, which admission has to know before.
pub(super) fn cost(
    file: &[u8],
    estimate: Estimate,
    limits: &Limits,
    threads: Threads,
) -> Option<Cost> {
    let cost = cost_once(file, limits, threads)?;
    if cost.cpu_seconds <= estimate.cpu_seconds {
        return Some(cost);
    }
    let again = cost_once(file, limits, threads)?;
    Some(Cost {
        cpu_seconds: again.cpu_seconds.min(cost.cpu_seconds),
        ..cost
    })
}

fn cost_once(component: &[u8], limits: &Limits, threads: Threads) -> Option<Cost> {
    // One for each file, as in the host: the compiler of an engine keeps tables that make a function
    // take longer after a large one, also one of another file.
    let engine = engine(limits, threads);
    let before_mib = memory_mib("VmRSS:");
    reset_peak();
    let begin = cpu_seconds(threads);
    let compiled = Component::from_binary(&engine, component);
    let cpu_seconds = cpu_seconds(threads) - begin;
    match compiled {
        Ok(_) => {
            let memory_mib = memory_mib("VmHWM:");
            Some(Cost {
                cpu_seconds,
                memory_mib,
                grown_mib: memory_mib.saturating_sub(before_mib),
            })
        }
        Err(error) => {
            let error = format!("{error:#}");
            assert!(!error.contains("pool"), "admitted and not loaded: {error}");
            None
        }
    }
}

/// An engine like that of the host.
fn engine(limits: &Limits, threads: Threads) -> Engine {
    let mut config = engine_config(limits, 1);
    config.parallel_compilation(threads == Threads::All);
    Engine::new(&config).expect("address space for one match")
}

/// Processor time so far, of this thread or of the process. Where the system does not say, the time of
/// day has to do.
fn cpu_seconds(threads: Threads) -> f64 {
    static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let seconds = match threads {
        Threads::One => of_thread("/proc/thread-self/schedstat"),
        Threads::All => of_all_threads(),
    };
    seconds.unwrap_or_else(|| BEGIN.elapsed().as_secs_f64())
}

fn of_all_threads() -> Option<f64> {
    let threads = fs::read_dir("/proc/self/task").ok()?;
    threads
        .map(|thread| of_thread(thread.ok()?.path().join("schedstat")))
        .sum()
}

fn of_thread(schedstat: impl AsRef<Path>) -> Option<f64> {
    let text = fs::read_to_string(schedstat).ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds / 1e9)
}

/// Has the system forget the most memory that this process ever had.
fn reset_peak() {
    // Where this does not work, the peak is that of all files so far.
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// What the system says of the memory of this process, in MiB: `VmRSS:` is what it has, and `VmHWM:` the
/// most that it had; 0 where the system does not say.
fn memory_mib(name: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) >> 10
}
