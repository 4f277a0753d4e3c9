//! [`wasmouse_engine::fuzz::matches`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    wasmouse_engine::fuzz::matches(bytes);
});
