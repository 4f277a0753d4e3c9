//! The wasmtime engine: one constructor, a reason beside every setting.
//!
//! Whether two hosts give the same verdict and the same fuel depends on this
//! file, the version of wasmtime and the processor that code is made for
//! (`target`); all are in [`engine_id`], which goes into every result.

use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

use wasmtime::{
    Config, Enabled, Engine, EngineWeak, Inlining, InstanceAllocationStrategy,
    PoolingAllocationConfig, WasmBacktraceDetails,
};

use wasmouse_core::record::EngineId;

use super::FRAMES_MAX;
use super::cost;
use super::target::TARGET;
use crate::error::InfrastructureError;
use crate::limits::Limits;

/// The exact version of wasmtime in `Cargo.toml`; a test compares the two.
pub const WASMTIME_VERSION: &str = "48.0.8";

/// Raised with every change to this file that can change fuel or a verdict.
pub const ENGINE_REVISION: u32 = 5;

/// Memory that an unused slot of the pool keeps, at most, for each linear memory and
/// each table. Compiled robots write under 100 KiB; what an interpreter writes beyond
/// this goes back to the system.
const RESIDENT_BYTES_MAX: usize = 1 << 20;

/// How often a match in progress asks whether it may go on.
const EPOCH: Duration = Duration::from_millis(100);

/// What a result depends on besides robot, maze, ruleset and seed: the version
/// of wasmtime, the revision of its configuration, and the processor that code is made for.
///
/// Such as `wasmtime-48.0.8+wasmouse.5.x86-64-v2`.
pub fn engine_id() -> EngineId {
    let target = TARGET.name;
    EngineId::new(format!(
        "wasmtime-{WASMTIME_VERSION}+wasmouse.{ENGINE_REVISION}.{target}"
    ))
}

/// The engine of a host that runs up to `matches` matches at the same time.
///
/// # Errors
///
/// When the machine cannot give the address space for the pool, or cannot run what is compiled
/// for the target.
pub(crate) fn new_engine(limits: &Limits, matches: u32) -> Result<Engine, InfrastructureError> {
    TARGET.check()?;
    Engine::new(&engine_config(limits, matches)).map_err(InfrastructureError::engine)
}

/// The configuration of the engine of a host, for those who want to compare the
/// host with wasmtime alone.
pub fn engine_config(limits: &Limits, matches: u32) -> Config {
    let mut config = compiler_config(limits);
    config.allocation_strategy(InstanceAllocationStrategy::Pooling(pool(limits, matches)));
    config
}

/// An engine for one match at a time that knows, when a robot fails, where in its code
/// it was: in names and, where it has debug information, in source lines. Fuel and
/// verdicts are those of [`new_engine`]; its code is larger.
///
/// # Errors
///
/// As [`new_engine`].
pub(crate) fn new_backtrace_engine(limits: &Limits) -> Result<Engine, InfrastructureError> {
    TARGET.check()?;
    let mut config = engine_config(limits, 1);
    config.wasm_backtrace_max_frames(NonZeroUsize::new(FRAMES_MAX));
    config.generate_address_map(true);
    config.wasm_backtrace_details(WasmBacktraceDetails::Enable);
    Engine::new(&config).map_err(InfrastructureError::engine)
}

/// An engine for one match at a time of an instrumented robot. Every check of the epoch is answered
/// by looking at the function that is running, so one frame suffices. Memory comes from the system
/// and not from a pool: wrappers make instances larger than admission has computed.
///
/// # Errors
///
/// As [`new_engine`].
pub(crate) fn new_profile_engine(limits: &Limits) -> Result<Engine, InfrastructureError> {
    TARGET.check()?;
    let mut config = compiler_config(limits);
    config.wasm_backtrace_max_frames(NonZeroUsize::new(1));
    // The frame of a mark must exist.
    config.compiler_inlining(Inlining::No);
    Engine::new(&config).map_err(InfrastructureError::engine)
}

/// An engine that compiles and runs nothing: its code is that of [`new_engine`], but
/// it has no pool, whose address space a process under a memory limit cannot have.
///
/// # Errors
///
/// When wasmtime does not know this machine.
pub(crate) fn new_compiler(limits: &Limits) -> Result<Engine, InfrastructureError> {
    Engine::new(&compiler_config(limits)).map_err(InfrastructureError::engine)
}

/// Everything that decides the compiled code.
fn compiler_config(limits: &Limits) -> Config {
    let mut config = Config::new();
    TARGET.apply(&mut config);

    // What ends a match. Fuel is exact and reproducible; epochs are how a match asks for
    // its processor time now and then.
    config.consume_fuel(true);
    config.operator_cost(cost::operator_cost());
    config.epoch_interruption(true);
    config.max_wasm_stack(bytes(limits.sandbox.stack_bytes_max));

    // What would make two machines differ.
    config.cranelift_nan_canonicalization(true);
    config.wasm_relaxed_simd(false);
    config.wasm_threads(false);

    // Proposals that no known toolchain needs for a robot: less code of
    // wasmtime that an untrusted robot can reach. Python, JavaScript, Rust, C, Zig and
    // AssemblyScript robots have been seen to run without them.
    config.wasm_gc(false);
    config.wasm_function_references(false);
    config.wasm_exceptions(false);
    config.wasm_memory64(false);
    config.wasm_custom_page_sizes(false);
    config.wasm_wide_arithmetic(false);
    config.wasm_stack_switching(false);
    config.gc_support(false);
    // Nothing here is asynchronous; without it a call costs less.
    config.concurrency_support(false);

    // Backtraces come from replaying a failed match, not from every match.
    config.wasm_backtrace_max_frames(None);
    config.generate_address_map(false);
    // Said, because otherwise an environment variable decides.
    config.wasm_backtrace_details(WasmBacktraceDetails::Disable);
    // Only needed by native profilers and unwinders, and on Windows, where the system itself is one.
    config.native_unwind_info(cfg!(windows));
    config
}

/// Slots for `matches` matches: instantiation then takes memory from a warm
/// pool instead of the operating system.
fn pool(limits: &Limits, matches: u32) -> PoolingAllocationConfig {
    let mut pool = PoolingAllocationConfig::new();
    pool.total_component_instances(matches);
    let instances_max = limits.admission.instances_max();
    pool.total_core_instances(matches.saturating_mul(instances_max));
    pool.total_memories(matches.saturating_mul(limits.admission.memories_max));
    pool.total_tables(matches.saturating_mul(limits.admission.tables_max));
    pool.total_gc_heaps(0);
    pool.max_core_instances_per_component(instances_max);
    pool.max_memories_per_component(limits.admission.memories_max);
    pool.max_tables_per_component(limits.admission.tables_max);
    pool.max_memories_per_module(limits.admission.memories_max);
    pool.max_tables_per_module(limits.admission.tables_max);
    pool.max_memory_size(bytes(limits.sandbox.memory_bytes_max));
    pool.table_elements(bytes(limits.sandbox.table_elements_max));
    // Admission has computed both, so that it is not the pool that refuses a robot.
    pool.max_component_instance_size(bytes(limits.admission.component_instance_bytes_max.into()));
    pool.max_core_instance_size(bytes(limits.admission.core_instance_bytes_max.into()));
    keep_pages(&mut pool);
    pool
}

/// Has a slot's pages wiped and kept after a match instead of given back, where the
/// system knows which of them were written (Linux 6.7 and later): the next match
/// then takes no page faults, which are half the time of a short one. Elsewhere
/// wasmtime would wipe all of them, written or not, which is slower than giving
/// them back. What a robot finds in its memory is the same either way.
fn keep_pages(pool: &mut PoolingAllocationConfig) {
    if PoolingAllocationConfig::is_pagemap_scan_available() {
        pool.pagemap_scan(Enabled::Auto);
        pool.linear_memory_keep_resident(RESIDENT_BYTES_MAX);
        pool.table_keep_resident(RESIDENT_BYTES_MAX);
    }
}

fn bytes(limit: u64) -> usize {
    usize::try_from(limit).unwrap_or(usize::MAX)
}

/// What advances the epoch for as long as the engine lives.
pub(crate) struct Clock(EngineWeak);

impl Clock {
    /// The clock of that engine.
    pub(crate) fn of(engine: &Engine) -> Self {
        Self(engine.weak())
    }

    /// Starts its thread.
    ///
    /// # Errors
    ///
    /// When the machine gives no thread.
    pub(crate) fn start(self) -> Result<(), InfrastructureError> {
        thread::Builder::new()
            .name("epoch-clock".into())
            .spawn(move || {
                while let Some(engine) = self.0.upgrade() {
                    engine.increment_epoch();
                    drop(engine);
                    thread::sleep(EPOCH);
                }
            })
            .map_err(InfrastructureError::Thread)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_engine_id_names_the_wasmtime_in_use() {
        let lock = include_str!("../../../../Cargo.lock");
        let locked = format!("name = \"wasmtime\"\nversion = \"{WASMTIME_VERSION}\"");
        assert!(
            lock.contains(&locked),
            "Cargo.lock does not have wasmtime {WASMTIME_VERSION}: \
             set WASMTIME_VERSION and raise ENGINE_REVISION"
        );
    }
}
