//! The two functions of the crate `wit-bindgen` that the generated code calls, so that the SDK
//! has no dependencies.

/// Runs the module's static constructors before the first call into the robot.
///
/// Because something calls `__wasm_call_ctors`, the linker does not wrap every export in a
/// function that calls it again. Every exported function calls this one first.
// Not inlined, as in the crate `wit-bindgen`: otherwise each step would use 4 units of fuel
// less, and fuel could not be compared with that of earlier builds.
#[cfg(target_arch = "wasm32")]
#[inline(never)]
pub fn run_ctors_once() {
    unsafe extern "C" {
        /// Provided by the linker.
        fn __wasm_call_ctors();
    }
    static mut HAVE_RUN: bool = false;
    // SAFETY: a WebAssembly instance has one thread, and constructors do not call exports.
    unsafe {
        if !HAVE_RUN {
            __wasm_call_ctors();
            HAVE_RUN = true;
        }
    }
}

/// Would make the linker export an allocator for values that the host passes in memory.
/// The host passes only numbers to a robot, so there is nothing to do.
pub const fn maybe_link_cabi_realloc() {}
