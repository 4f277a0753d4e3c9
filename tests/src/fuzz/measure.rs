//! What compiling a file takes on one thread.

use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

use wasmouse_engine::admission::BinaryKind;
use wasmouse_engine::admission::precheck::{Measure, precheck};
use wasmouse_engine::{Limits, engine_config};
use wasmparser::{Parser, Payload};
use wasmtime::Engine;
use wasmtime::component::Component;

/// What was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    /// What admission estimates, in seconds.
    pub(super) estimate: f64,
    /// Processor time, in seconds.
    pub(super) cpu_seconds: f64,
    /// The most memory of the process meanwhile, in MiB.
    pub(super) memory_mib: u64,
}

/// Estimated seconds of a file; `None` when it is not admitted.
pub(super) fn estimate(file: &[u8], limits: &Limits) -> Option<f64> {
    let shape = precheck(file, limits).ok()?;
    let ms = u32::try_from(shape.measures.get(Measure::Work)).ok()?;
    Some(f64::from(ms) / 1000.0)
}

/// An engine like that of the host, which compiles on the thread that calls it.
pub(super) fn engine(limits: &Limits) -> Engine {
    let mut config = engine_config(limits, 1);
    config.parallel_compilation(false);
    Engine::new(&config).expect("address space for one match")
}

/// Compiles and loads an admitted file; `None` when the compiler rejects it. What takes longer
/// than its estimate is measured again, and the shorter time counts: on a virtual machine,
/// processor time includes what other machines take.
///
/// # Panics
///
/// When the engine refuses to load what it has compiled, which admission has to know before.
pub(super) fn cost(file: &[u8], estimate: f64, engine: &Engine) -> Option<Cost> {
    let component = as_component(file);
    let cost = cost_once(&component, estimate, engine)?;
    if cost.cpu_seconds <= estimate {
        return Some(cost);
    }
    let again = cost_once(&component, estimate, engine)?;
    Some(Cost {
        cpu_seconds: again.cpu_seconds.min(cost.cpu_seconds),
        ..again
    })
}

fn cost_once(component: &[u8], estimate: f64, engine: &Engine) -> Option<Cost> {
    reset_peak();
    let begin = cpu_seconds();
    let compiled = Component::from_binary(engine, component);
    let cpu_seconds = cpu_seconds() - begin;
    match compiled {
        Ok(_) => Some(Cost {
            estimate,
            cpu_seconds,
            memory_mib: peak_mib(),
        }),
        Err(error) => {
            let error = format!("{error:#}");
            assert!(!error.contains("pool"), "admitted and not loaded: {error}");
            None
        }
    }
}

/// A component as it is; a core module in a component that does not instantiate it.
pub(super) fn as_component(file: &[u8]) -> Vec<u8> {
    match BinaryKind::of(file) {
        BinaryKind::CoreModule => copies(file, 1),
        _ => file.to_vec(),
    }
}

/// A component with that many copies of a core module.
pub(super) fn copies(module: &[u8], number: u32) -> Vec<u8> {
    let mut component = wasm_encoder::Component::new();
    for _ in 0..number {
        component.section(&wasm_encoder::RawSection {
            // A core module.
            id: 1,
            data: module,
        });
    }
    component.finish()
}

/// The core module with each of its functions that many times, in the place of a small one that
/// would need more copies than a file may have modules. `None` when it is no core module, or cannot
/// be read.
pub(super) fn repeated(module: &[u8], times: u32) -> Option<Vec<u8>> {
    let mut repeated = wasm_encoder::Module::new();
    let mut code = wasm_encoder::CodeSection::new();
    let mut bodies = 0;
    for payload in Parser::new(0).parse_all(module) {
        match payload.ok()? {
            Payload::FunctionSection(section) => {
                let mut functions = wasm_encoder::FunctionSection::new();
                for _ in 0..times {
                    for ty in section.clone() {
                        functions.function(ty.ok()?);
                    }
                }
                repeated.section(&functions);
            }
            Payload::CodeSectionStart { count, .. } => bodies = count.checked_mul(times)?,
            Payload::CodeSectionEntry(body) => {
                for _ in 0..times {
                    code.raw(body.as_bytes());
                    bodies = bodies.checked_sub(1)?;
                }
                if bodies == 0 {
                    repeated.section(&code);
                }
            }
            payload => {
                if let Some((id, range)) = payload.as_section() {
                    let [start, end] = [range.start, range.end].map(usize::try_from);
                    let data = module.get(start.ok()?..end.ok()?)?;
                    repeated.section(&wasm_encoder::RawSection { id, data });
                }
            }
        }
    }
    Some(repeated.finish())
}

/// Processor time of this thread so far. Where the system does not say, the time of day has to
/// do.
fn cpu_seconds() -> f64 {
    static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let nanoseconds = fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| BEGIN.elapsed().as_secs_f64(), |ns| ns / 1e9)
}

/// Has the system forget the most memory that this process ever had.
fn reset_peak() {
    // Where this does not work, the peak is that of all files so far.
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// The most memory of this process, in MiB; 0 where the system does not say.
fn peak_mib() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) >> 10
}
