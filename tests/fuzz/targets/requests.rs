//! [`wasmouse_engine::fuzz::requests`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    wasmouse_engine::fuzz::requests(bytes);
});
