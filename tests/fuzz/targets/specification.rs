//! [`wasmouse_core::fuzz::specification`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    wasmouse_core::fuzz::specification(bytes);
});
