//! [`FuelClass`]: for which kind of language the fuel limits of a ruleset are made.

use super::SandboxLimits;

/// For which kind of language fuel limits are made.
///
/// A class is a name for limits and not a number of its own, so that it cannot contradict them and
/// changes neither rules in results nor their digests.
///
/// ```
/// use wasmouse_core::game::{FuelClass, Ruleset};
/// let rules = Ruleset::by_name("udacity-interpreted").expect("a bundled ruleset");
/// assert_eq!(rules.fuel_class(), Some(FuelClass::Interpreted));
/// assert_eq!(Ruleset::default().fuel_class(), Some(FuelClass::Compiled));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FuelClass {
    /// Languages that are compiled to WebAssembly: Rust, C, Zig, Go, AssemblyScript.
    Compiled,
    /// Languages whose interpreter is compiled to WebAssembly: Python, JavaScript.
    Interpreted,
}

impl FuelClass {
    /// All classes.
    pub const ALL: [Self; 2] = [Self::Compiled, Self::Interpreted];

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Compiled => "compiled",
            Self::Interpreted => "interpreted",
        }
    }

    /// The default limits with the fuel of this class.
    ///
    /// An interpreter takes 50 to 200 times the fuel of compiled code for the same work. A simple
    /// flood takes 12 to 17 million units a step in a maze of 20 cells in Python and QuickJS, and
    /// 42 million in StarlingMonkey, so 1,000 steps exceed the match fuel of compiled robots. Ten
    /// times as much lasts for both runs with 1,000 steps each at 100 million a step. `start` stays
    /// as it is: these robots begin from a snapshot of their interpreter and use less than a
    /// million.
    pub fn limits(self) -> SandboxLimits {
        let compiled = SandboxLimits::default();
        match self {
            Self::Compiled => compiled,
            Self::Interpreted => SandboxLimits {
                step_fuel_max: 10 * compiled.step_fuel_max,
                match_fuel_max: 10 * compiled.match_fuel_max,
                ..compiled
            },
        }
    }

    /// The class whose fuel these limits have, whatever the other limits are; `None` if they have
    /// fuel of their own.
    pub fn of(limits: &SandboxLimits) -> Option<Self> {
        let fuel = |it: &SandboxLimits| (it.start_fuel_max, it.step_fuel_max, it.match_fuel_max);
        let mut classes = Self::ALL.into_iter();
        classes.find(|class| fuel(&class.limits()) == fuel(limits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_is_its_fuel() {
        for class in FuelClass::ALL {
            let mut limits = class.limits();
            assert_eq!(FuelClass::of(&limits), Some(class));
            limits.memory_bytes_max /= 2;
            assert_eq!(FuelClass::of(&limits), Some(class), "memory is not fuel");
            limits.step_fuel_max -= 1;
            assert_eq!(FuelClass::of(&limits), None);
        }
    }

    /// What was measured for StarlingMonkey, the slowest, in both runs.
    #[test]
    fn an_honest_interpreter_does_not_run_out() {
        let limits = FuelClass::Interpreted.limits();
        let step = 42_000_000;
        assert!(2 * 1000 * step < limits.match_fuel_max / 2);
        assert!(100 * step < limits.step_fuel_max);
    }
}
