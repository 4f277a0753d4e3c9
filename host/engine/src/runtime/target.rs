//! [`TARGET`]: the processor that robots are compiled for.
//!
//! By default wasmtime compiles for the processor that it runs on. With the features of a
//! processor the size of stack frames changes, so a recursion that overflows the stack on one
//! machine would return on another. Robots are compiled for a baseline instead, which is part of
//! the engine id. Frames differ between architectures too, so each has an id of its own.

use wasmtime::Config;

use crate::error::InfrastructureError;

/// A baseline: the features that code may use, and no others.
pub(super) struct Target {
    /// The name in engine ids.
    pub(super) name: &'static str,
    /// The settings of Cranelift that say so.
    settings: &'static [&'static str],
    /// Why this machine cannot run such code.
    obstacle: fn() -> Option<String>,
}

/// What x86-64 processors have had since 2008 to 2013, and all virtual machines have. Code for
/// later ones (x86-64-v3, or everything that this machine's processor has) was not seen to be
/// faster, in the bundled robots or in loops of floats, vectors and bit counting.
#[cfg(target_arch = "x86_64")]
pub(super) const TARGET: Target = Target {
    name: "x86-64-v2",
    settings: &[
        "has_sse3",
        "has_ssse3",
        "has_sse41",
        "has_sse42",
        "has_popcnt",
        "has_cmpxchg16b",
    ],
    obstacle: || {
        let features = [
            ("SSE3", is_x86_feature_detected!("sse3")),
            ("SSSE3", is_x86_feature_detected!("ssse3")),
            ("SSE4.1", is_x86_feature_detected!("sse4.1")),
            ("SSE4.2", is_x86_feature_detected!("sse4.2")),
            ("POPCNT", is_x86_feature_detected!("popcnt")),
            ("CMPXCHG16B", is_x86_feature_detected!("cmpxchg16b")),
        ];
        lacking(&features)
    },
};

/// What every 64-bit ARM processor has.
#[cfg(target_arch = "aarch64")]
pub(super) const TARGET: Target = Target {
    name: "armv8-a",
    settings: &[],
    obstacle: || None,
};

/// No baseline was chosen, so other machines could not reproduce results.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(super) const TARGET: Target = Target {
    name: std::env::consts::ARCH,
    settings: &[],
    obstacle: || {
        let here = std::env::consts::ARCH;
        Some(format!(
            "robots run on x86-64 and aarch64, and this is {here}"
        ))
    },
};

#[cfg(target_arch = "x86_64")]
fn lacking(features: &[(&str, bool)]) -> Option<String> {
    let (name, _) = features.iter().find(|(_, is_there)| !is_there)?;
    let target = TARGET.name;
    Some(format!("it has no {name}, which is part of {target}"))
}

impl Target {
    /// Checks that this machine can run what is compiled for the target.
    ///
    /// # Errors
    ///
    /// What is missing.
    pub(super) fn check(&self) -> Result<(), InfrastructureError> {
        match (self.obstacle)() {
            None => Ok(()),
            Some(reason) => Err(InfrastructureError::Processor(reason)),
        }
    }

    /// Has an engine compile for the target.
    pub(super) fn apply(&self, config: &mut Config) {
        // With a target, even this machine's own, wasmtime looks for no features of its own.
        config
            .target(&target_lexicon::HOST.to_string())
            .expect("wasmtime knows the platform that it was built for");
        for setting in self.settings {
            // SAFETY: these are features of the instruction set, and wasmtime refuses to load
            // code if the processor does not have them.
            unsafe { config.cranelift_flag_enable(setting) };
        }
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    #[test]
    fn the_feature_that_is_missing_is_named() {
        let features = [("SSE3", true), ("AVX512", false)];
        let reason = lacking(&features).expect("one is missing");
        assert_eq!(reason, "it has no AVX512, which is part of x86-64-v2");
        assert_eq!(lacking(&features[..1]), None);
    }
}
