//! The functions of preview 2 that are answered, and what a robot's entry calls.
//!
//! They have the names and the flat types that the component model gives to exports of a core
//! module: a resource is a number of ours, and what takes more than one value is returned by its
//! place in memory. The functions that are not here are in `missing`.

use crate::console::Stream;
use crate::guest::{self, Single};
use crate::random::{Random, SEED_BEFORE_START};

static RANDOM: Single<Random> = Single::new(Random::new(SEED_BEFORE_START));

#[unsafe(export_name = "wasmouse:wasi/match@0.1.0#begin")]
extern "C" fn begin(seed: u64) {
    RANDOM.with(|random| *random = Random::new(seed));
}

#[unsafe(export_name = "wasmouse:wasi/match@0.1.0#end-call")]
extern "C" fn end_call() {
    guest::end_call();
}

/// A result that is returned by its place, with the largest alignment there is.
#[repr(C, align(8))]
struct Area([u8; 16]);

static AREA: Single<Area> = Single::new(Area([0; 16]));

/// Returns a result of these parts: numbers with their offset in bytes. All else is zero.
fn result<const PARTS: usize>(parts: [(usize, u64); PARTS]) -> *const Area {
    AREA.with(|area| {
        area.0 = [0; 16];
        for (offset, value) in parts {
            let bytes = value.to_le_bytes();
            for (to, from) in area.0.iter_mut().skip(offset).zip(bytes) {
                *to = from;
            }
        }
        &raw const *area
    })
}

/// Success without a value, the empty list, no option: all are zeros. The place of an empty
/// list has to be aligned, as zero is.
fn nothing() -> *const Area {
    result([])
}

// Random numbers

fn random_bytes(length: u64) -> *const Area {
    let Ok(length) = usize::try_from(length) else {
        core::arch::wasm32::unreachable()
    };
    let at = guest::allocate(length, 1);
    // SAFETY: the memory was just allocated, and memory is zero or what another call left.
    let buffer = unsafe { core::slice::from_raw_parts_mut(at, length) };
    RANDOM.with(|random| random.fill(buffer));
    guest::release();
    result([(0, at as u64), (4, length as u64)])
}

fn random_bits() -> u64 {
    RANDOM.with(Random::bits)
}

#[unsafe(export_name = "wasi:random/random@0.2.12#get-random-bytes")]
extern "C" fn get_random_bytes(length: u64) -> *const Area {
    random_bytes(length)
}

#[unsafe(export_name = "wasi:random/random@0.2.12#get-random-u64")]
extern "C" fn get_random_u64() -> u64 {
    random_bits()
}

#[unsafe(export_name = "wasi:random/insecure@0.2.12#get-insecure-random-bytes")]
extern "C" fn get_insecure_random_bytes(length: u64) -> *const Area {
    random_bytes(length)
}

#[unsafe(export_name = "wasi:random/insecure@0.2.12#get-insecure-random-u64")]
extern "C" fn get_insecure_random_u64() -> u64 {
    random_bits()
}

#[unsafe(export_name = "wasi:random/insecure-seed@0.2.12#insecure-seed")]
extern "C" fn insecure_seed() -> *const Area {
    result([(0, random_bits()), (8, random_bits())])
}

// Clocks

/// How far a reading is from the one before. Unit: nanoseconds.
const READING_NS: u64 = 1000;

/// Both clocks. Unit: nanoseconds.
static CLOCK: Single<u64> = Single::new(0);

fn read_clock() -> u64 {
    CLOCK.with(|now| {
        *now = now.saturating_add(READING_NS);
        *now
    })
}

#[unsafe(export_name = "wasi:clocks/monotonic-clock@0.2.12#now")]
extern "C" fn monotonic_now() -> u64 {
    read_clock()
}

#[unsafe(export_name = "wasi:clocks/monotonic-clock@0.2.12#resolution")]
extern "C" fn monotonic_resolution() -> u64 {
    READING_NS
}

#[unsafe(export_name = "wasi:clocks/monotonic-clock@0.2.12#subscribe-instant")]
extern "C" fn subscribe_instant(when: u64) -> u32 {
    timer(when)
}

#[unsafe(export_name = "wasi:clocks/monotonic-clock@0.2.12#subscribe-duration")]
extern "C" fn subscribe_duration(duration: u64) -> u32 {
    timer(CLOCK.with(|now| now.saturating_add(duration)))
}

#[unsafe(export_name = "wasi:clocks/wall-clock@0.2.12#now")]
extern "C" fn wall_now() -> *const Area {
    let now = read_clock();
    result([(0, now / 1_000_000_000), (8, now % 1_000_000_000)])
}

#[unsafe(export_name = "wasi:clocks/wall-clock@0.2.12#resolution")]
extern "C" fn wall_resolution() -> *const Area {
    result([(8, READING_NS)])
}

// Waiting: everything has happened. A pollable is the time at which a timer runs down, in
// readings, so that there is nothing to remember; 0 is no timer. After 2^32 readings (71 minutes)
// timers run down at once.

#[link(wasm_import_module = "[export]wasi:io/poll@0.2.12")]
unsafe extern "C" {
    #[link_name = "[resource-new]pollable"]
    safe fn new_pollable(readings: u32) -> u32;
}

fn timer(when: u64) -> u32 {
    new_pollable(u32::try_from(when.div_ceil(READING_NS)).unwrap_or(u32::MAX))
}

/// The clock goes on to the time of a timer.
fn wait(readings: u32) {
    CLOCK.with(|now| *now = (*now).max(u64::from(readings) * READING_NS));
}

#[unsafe(export_name = "wasi:io/poll@0.2.12#[method]pollable.ready")]
extern "C" fn ready(_: u32) -> u32 {
    1
}

#[unsafe(export_name = "wasi:io/poll@0.2.12#[method]pollable.block")]
extern "C" fn block(pollable: u32) {
    wait(pollable);
}

#[unsafe(export_name = "wasi:io/poll@0.2.12#poll")]
extern "C" fn poll(at: *const u32, length: usize) -> *const Area {
    // SAFETY: the caller has just copied the list into memory that was allocated for it.
    let pollables = unsafe { core::slice::from_raw_parts(at, length) };
    let Some(bytes) = length.checked_mul(4) else {
        core::arch::wasm32::unreachable()
    };
    let list = guest::allocate(bytes, 4).cast::<u32>();
    for (index, &pollable) in pollables.iter().enumerate() {
        wait(pollable);
        // SAFETY: the list was just allocated for as many numbers.
        unsafe { list.add(index).write(index as u32) };
    }
    guest::release();
    result([(0, list as u64), (4, length as u64)])
}

// Streams

#[link(wasm_import_module = "[export]wasi:io/streams@0.2.12")]
unsafe extern "C" {
    #[link_name = "[resource-new]input-stream"]
    safe fn new_input_stream(stream: u32) -> u32;
    #[link_name = "[resource-new]output-stream"]
    safe fn new_output_stream(stream: u32) -> u32;
}

/// The numbers of standard output and standard error as resources.
const OUTPUT: u32 = 1;
const ERROR: u32 = 2;

/// How much may be written at once. Unit: bytes.
const WRITE_BYTES_MAX: u64 = 65536;

/// The error `closed` in place of a value with an alignment of 4 or 8.
fn closed(align: usize) -> *const Area {
    result([(0, 1), (align, 1)])
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]input-stream.read")]
extern "C" fn read(_: u32, _: u64) -> *const Area {
    closed(4)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]input-stream.blocking-read")]
extern "C" fn blocking_read(_: u32, _: u64) -> *const Area {
    closed(4)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]input-stream.skip")]
extern "C" fn skip(_: u32, _: u64) -> *const Area {
    closed(8)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]input-stream.blocking-skip")]
extern "C" fn blocking_skip(_: u32, _: u64) -> *const Area {
    closed(8)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]input-stream.subscribe")]
extern "C" fn subscribe_input(_: u32) -> u32 {
    new_pollable(0)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.check-write")]
extern "C" fn check_write(_: u32) -> *const Area {
    result([(8, WRITE_BYTES_MAX)])
}

fn put(stream: u32, at: *const u8, length: usize) -> *const Area {
    let stream = if stream == OUTPUT {
        Stream::Output
    } else {
        Stream::Error
    };
    // SAFETY: the caller has just copied the bytes into memory that was allocated for them.
    guest::write(stream, unsafe { core::slice::from_raw_parts(at, length) });
    guest::release();
    nothing()
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.write")]
extern "C" fn write(stream: u32, at: *const u8, length: usize) -> *const Area {
    put(stream, at, length)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.blocking-write-and-flush")]
extern "C" fn blocking_write_and_flush(stream: u32, at: *const u8, length: usize) -> *const Area {
    put(stream, at, length)
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.flush")]
extern "C" fn flush(_: u32) -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.blocking-flush")]
extern "C" fn blocking_flush(_: u32) -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.subscribe")]
extern "C" fn subscribe_output(_: u32) -> u32 {
    new_pollable(0)
}

// The program and its surroundings

#[unsafe(export_name = "wasi:cli/environment@0.2.12#get-environment")]
extern "C" fn get_environment() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:cli/environment@0.2.12#get-arguments")]
extern "C" fn get_arguments() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:cli/environment@0.2.12#initial-cwd")]
extern "C" fn initial_cwd() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:cli/exit@0.2.12#exit")]
extern "C" fn exit(status: u32) {
    guest::exit(status)
}

#[unsafe(export_name = "wasi:cli/exit@0.2.12#exit-with-code")]
extern "C" fn exit_with_code(code: u32) {
    guest::exit(code)
}

#[unsafe(export_name = "wasi:cli/stdin@0.2.12#get-stdin")]
extern "C" fn get_stdin() -> u32 {
    new_input_stream(0)
}

#[unsafe(export_name = "wasi:cli/stdout@0.2.12#get-stdout")]
extern "C" fn get_stdout() -> u32 {
    new_output_stream(OUTPUT)
}

#[unsafe(export_name = "wasi:cli/stderr@0.2.12#get-stderr")]
extern "C" fn get_stderr() -> u32 {
    new_output_stream(ERROR)
}

// No stream is a terminal: programs would colour what they write.

#[unsafe(export_name = "wasi:cli/terminal-stdin@0.2.12#get-terminal-stdin")]
extern "C" fn get_terminal_stdin() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:cli/terminal-stdout@0.2.12#get-terminal-stdout")]
extern "C" fn get_terminal_stdout() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:cli/terminal-stderr@0.2.12#get-terminal-stderr")]
extern "C" fn get_terminal_stderr() -> *const Area {
    nothing()
}

#[unsafe(export_name = "wasi:filesystem/preopens@0.2.12#get-directories")]
extern "C" fn get_directories() -> *const Area {
    nothing()
}
