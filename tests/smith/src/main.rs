//! `smith`: random WebAssembly modules with the exports of a robot.
//!
//! Takes seeds on standard input, 8 bytes each, little endian, and answers each with a
//! module on standard output: its length in 4 bytes, little endian, and the module. It is
//! the other end of a pipe from the fuzz target `matches`, and wrote the modules that
//! the tests play.

use std::io::{self, Read as _, Write as _};
use std::process::ExitCode;

use arbitrary::Unstructured;
use wasm_smith::{Config, Module};

/// Random bytes that a module is made of, at most.
const ENTROPY_BYTES_MAX: u64 = 8 << 10;

const EXPORTS: &str = r#"(module
    (memory (export "memory") 1 20)
    (func (export "wasmouse:robot/controller@0.2.0#start")
        (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))
    (func (export "wasmouse:robot/controller@0.2.0#next-move")
        (param i32 i32 i32) (result i32) i32.const 16))"#;

const IMPORTS: &str = r#"(module
    (import "wasmouse:robot/journal@0.2.0" "log" (func (param i32 i32 i32))))"#;

fn main() -> ExitCode {
    match serve() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn serve() -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::stdout().lock());
    let mut seed = [0; 8];
    loop {
        match input.read_exact(&mut seed) {
            Ok(()) => {}
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(error),
        }
        let module = module(u64::from_le_bytes(seed))?;
        let length = u32::try_from(module.len()).map_err(io::Error::other)?;
        output.write_all(&length.to_le_bytes())?;
        output.write_all(&module)?;
        output.flush()?;
    }
}

fn module(seed: u64) -> io::Result<Vec<u8>> {
    let mut random = Random(seed);
    let length = 256 + random.next() % (ENTROPY_BYTES_MAX - 256);
    let bytes: Vec<u8> = (0..length).map(|_| random.next().to_le_bytes()[0]).collect();
    let module = Module::new(config()?, &mut Unstructured::new(&bytes));
    module.map(|module| module.to_bytes()).map_err(io::Error::other)
}

fn config() -> io::Result<Config> {
    let parse = |text| wat::parse_str(text).map_err(io::Error::other);
    Ok(Config {
        exports: Some(parse(EXPORTS)?),
        available_imports: Some(parse(IMPORTS)?),
        max_funcs: 12,
        max_instructions: 200,
        max_memories: 2,
        max_memory32_bytes: 20 << 16,
        max_tables: 1,
        max_table_elements: 1000,
        // What the host has turned off.
        exceptions_enabled: false,
        gc_enabled: false,
        memory64_enabled: false,
        custom_page_sizes_enabled: false,
        relaxed_simd_enabled: false,
        shared_everything_threads_enabled: false,
        threads_enabled: false,
        wide_arithmetic_enabled: false,
        compact_imports_enabled: false,
        custom_descriptors_enabled: false,
        // External references count as garbage collection.
        reference_types_enabled: false,
        ..Config::default()
    })
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}
