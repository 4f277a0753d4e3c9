//! The fuzz target `compile_cost`: searches for admitted files that take long to compile, or much memory.
//!
//! Bytes at random hardly ever make a file that is expensive; the generators of
//! [`bombs`](crate::bombs) do nothing else. The target climbs hills: it changes the parameters of
//! a generator at random and keeps what takes longest for its estimate, or the most memory for it. It
//! does the same with files of two modules, because what a compiler keeps of one function may make
//! others take longer. Then it fills files with copies of the worst, up to the limits. It runs as a
//! short test, and for as long as one wants with `cargo xtask fuzz compile_cost`.

mod candidate;
mod climb;
mod generators;
mod measure;
mod worst;

pub use climb::Climb;
pub use worst::Worst;

#[cfg(test)]
mod tests {
    use std::env;
    use std::time::Duration;

    use super::Climb;

    /// As for the other targets: run for that many seconds.
    const SECONDS_VARIABLE: &str = "WASMOUSE_FUZZ_SECONDS";

    /// Processor time that an admitted file may take to compile, on the two threads that do it:
    /// 20 s.
    const CPU_SECONDS_MAX: f64 = 40.0;

    /// Memory that it may take.
    const MEMORY_MIB_MAX: u64 = 1024;

    #[test]
    fn compile_cost() {
        let _alone = crate::MUCH_MEMORY.lock();
        let seconds = env::var(SECONDS_VARIABLE).ok();
        let seconds = seconds.and_then(|seconds| seconds.parse().ok());
        let mut climb = match seconds {
            Some(seconds) => Climb::long(Duration::from_secs(seconds)),
            None => Climb::short(),
        };
        let worst = climb.run();
        println!("{worst}");
        assert!(worst.cpu_seconds <= CPU_SECONDS_MAX, "{worst}");
        assert!(worst.memory_mib <= MEMORY_MIB_MAX, "{worst}");
    }
}
