//! The same match on differently configured engines.
//!
//! What a robot does and what it costs may depend on nothing but the robot: not on how well
//! its code is optimized, how memory is allocated or how bounds are checked.

use std::sync::{LazyLock, Mutex, PoisonError};

use wasmouse_core::game::FaultKind;
use wasmtime::{Config, Engine, InstanceAllocationStrategy, OptLevel, RegallocAlgorithm};

use super::{limits, modules, play};
use crate::runtime::{Runtime, engine_config};

struct Variant {
    name: &'static str,
    runtime: Runtime,
}

impl Variant {
    fn new(name: &'static str, change: impl FnOnce(&mut Config)) -> Self {
        let mut config = engine_config(&limits(), 1);
        change(&mut config);
        let engine = Engine::new(&config).expect("address space for one match");
        let runtime = Runtime::with_engine(engine, limits(), None).expect("an engine");
        Self { name, runtime }
    }
}

/// The engine of a host first. No clock runs, because all matches have little fuel. Each engine
/// has room for one match, so tests take turns.
static VARIANTS: LazyLock<Mutex<Vec<Variant>>> = LazyLock::new(|| {
    let backtraces = Runtime::for_backtraces(limits()).expect("an engine");
    Mutex::new(vec![
        Variant::new("as in a contest", |_| ()),
        Variant::new("not optimized", |config| {
            config.cranelift_opt_level(OptLevel::None);
            config.cranelift_regalloc_algorithm(RegallocAlgorithm::SinglePass);
        }),
        Variant::new("optimized for size", |config| {
            config.cranelift_opt_level(OptLevel::SpeedAndSize);
        }),
        Variant::new("on demand, bounds checked in code", |config| {
            config.allocation_strategy(InstanceAllocationStrategy::OnDemand);
            config.memory_reservation(0);
            config.memory_guard_size(0);
            config.signals_based_traps(false);
        }),
        Variant {
            name: "for backtraces",
            runtime: backtraces,
        },
    ])
});

/// Plays a random module on every engine.
pub fn differential(bytes: &[u8]) -> bool {
    modules::robot(bytes).is_some_and(|file| compare(&file))
}

/// Plays a robot on every engine, and returns whether it took a step.
pub(super) fn compare(file: &[u8]) -> bool {
    let mut expected = None;
    // A failed comparison leaves the engines as they are.
    let variants = VARIANTS.lock().unwrap_or_else(PoisonError::into_inner);
    for Variant { name, runtime } in variants.iter() {
        let Ok(robot) = runtime.admit(file) else {
            assert!(expected.is_none(), "{name}: only here it is rejected");
            return false;
        };
        let played = play(runtime, &robot);
        let fault = played.record.verdict.fault();
        // The size of a stack frame is the compiler's choice.
        if fault.is_some_and(|fault| fault.kind == FaultKind::StackOverflow) {
            return true;
        }
        let expected = expected.get_or_insert_with(|| play(runtime, &robot));
        assert_eq!(played, *expected, "{name}");
    }
    expected.is_some_and(|played| played.record.steps.total() > 0)
}
