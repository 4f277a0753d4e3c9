//! The interface `wasmouse:wasi/console`: what the adapter for preview 1 calls.

use crate::console::Stream;
use crate::guest;

/// What is not answered, by its number in `preview1.wat`.
const MISSING: [&str; 12] = [
    "path_create_directory",
    "path_filestat_set_times",
    "path_link",
    "path_remove_directory",
    "path_rename",
    "path_symlink",
    "path_unlink_file",
    "proc_raise",
    "sock_accept",
    "sock_recv",
    "sock_send",
    "sock_shutdown",
];

#[unsafe(export_name = "wasmouse:wasi/console@0.1.0#write")]
extern "C" fn write(descriptor: u32, at: *const u8, length: usize) {
    let stream = if descriptor == 1 {
        Stream::Output
    } else {
        Stream::Error
    };
    // SAFETY: the caller has just copied the bytes into memory that was allocated for them.
    guest::write(stream, unsafe { core::slice::from_raw_parts(at, length) });
    guest::release();
}

#[unsafe(export_name = "wasmouse:wasi/console@0.1.0#end-call")]
extern "C" fn end_call() {
    guest::end_call();
}

#[unsafe(export_name = "wasmouse:wasi/console@0.1.0#exit")]
extern "C" fn exit(code: u32) {
    guest::exit(code)
}

#[unsafe(export_name = "wasmouse:wasi/console@0.1.0#missing")]
extern "C" fn missing(function: usize) {
    guest::missing(MISSING.get(function).copied().unwrap_or("?"))
}
