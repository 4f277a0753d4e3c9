//! [`wasmouse_core::fuzz::record`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    wasmouse_core::fuzz::record(bytes);
});
