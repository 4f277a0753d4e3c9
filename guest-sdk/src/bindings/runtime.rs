//! What the bindings need at run time, so that the SDK has no dependencies: the two
//! functions of the crate `wit-bindgen` that the generated code calls, and the panic hook.

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

/// Makes every panic end the match with the fault `panic` and a message of the form
/// `MESSAGE (FILE:LINE:COLUMN)`, in place of a bare trap.
///
/// [`export_robot!`](crate::export_robot) calls it while the robot is instantiated, so it
/// uses no fuel of `start` or `next-move`.
#[cfg(target_arch = "wasm32")]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|panic| {
        let message = panic.payload_as_str().unwrap_or("panic");
        let message = match panic.location() {
            Some(location) => format!("{message} ({location})"),
            None => message.to_owned(),
        };
        super::wasmouse::robot::journal::panic(&message);
    }));
}
