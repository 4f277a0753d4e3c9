//! Small robots in WebAssembly text, run in this process, and a good robot whose next match they
//! must not affect.

use std::sync::{Arc, OnceLock};

use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, SandboxLimits};
use wasmouse_core::record::FuelUse;
use wasmouse_engine::admission::Rejection;
use wasmouse_engine::bundled::find;
use wasmouse_engine::{AdmissionLimits, AdmittedRobot, DetailedMatch, Executor, InProcess, Limits};

use crate::matches::{bundled_mazes, rules, spec};

pub use wasmouse_tests::module::{IMPORT_LOG, Module, wasm};

/// Limits that suffice for the flood robot, with fuel that is used up in milliseconds.
pub const SMALL: Limits = Limits {
    sandbox: SandboxLimits {
        start_fuel_max: 4_000_000,
        step_fuel_max: 4_000_000,
        match_fuel_max: 40_000_000,
        memory_bytes_max: 4 << 20,
        table_elements_max: 1000,
        stack_bytes_max: 128 << 10,
        journal_bytes_max: 1000,
        host_call_bytes_max: 4096,
    },
    admission: AdmissionLimits {
        component_bytes_max: 100_000,
        core_instances_max: 8,
        memories_max: 4,
        tables_max: 4,
        ..AdmissionLimits::DEFAULT
    },
};

/// An executor for one match at a time in this process, and its rules.
pub struct Engine {
    /// The executor, without a cache.
    pub executor: InProcess,
    rules: Arc<Ruleset>,
}

impl Engine {
    /// An engine that enforces these limits.
    pub fn new(limits: Limits) -> Self {
        Self {
            executor: InProcess::new(limits, 1, None).expect("address space for one match"),
            rules: rules(limits.sandbox),
        }
    }

    /// Admits or rejects a file.
    pub fn admit(&self, file: &[u8]) -> Result<AdmittedRobot, Rejection> {
        self.executor.admit(file).expect("the host works")
    }

    /// Plays the robot in the first bundled maze.
    ///
    /// # Panics
    ///
    /// When the robot is rejected.
    #[track_caller]
    pub fn play(&self, component: &[u8]) -> DetailedMatch {
        let robot = match self.admit(component) {
            Ok(robot) => robot,
            Err(rejection) => panic!("rejected: {rejection}"),
        };
        self.play_admitted(&robot)
    }

    /// Plays a robot of this engine in the first bundled maze.
    pub fn play_admitted(&self, robot: &AdmittedRobot) -> DetailedMatch {
        let (_, maze) = &bundled_mazes()[0];
        let spec = spec(&self.rules, robot.digest(), maze, (0, 0));
        let played = self.executor.execute_with_details(robot, &spec);
        played.expect("the host works")
    }

    /// The bundled flood robot plays as in an engine that has run nothing else.
    #[track_caller]
    pub fn assert_unharmed(&self) {
        static UNHARMED: OnceLock<(FuelUse, Digest)> = OnceLock::new();
        let flood = |engine: &Self| {
            let robot = find("flood").expect("a bundled robot");
            let record = engine.play(robot.component).record;
            assert_eq!(record.verdict.title(), "finished");
            (record.fuel, record.transcript)
        };
        let expected = UNHARMED.get_or_init(|| flood(&Self::new(Limits::default())));
        assert_eq!(&flood(self), expected, "the next match differs");
    }
}
