//! Files that claim to be robots: everything before they are compiled.

use wasmouse::robot::bundled::bundled;
use wasmouse::robot::componentize::{CONTROLLER_EXPORTS, JOURNAL_IMPORT};
use wasmouse::robot::worker::fuzz;

use super::Target;
use crate::composite::Composite;
use crate::module::{IMPORT_LOG, Module, wasm};

pub(super) const TARGET: Target = Target {
    name: "admission",
    about: "files that claim to be robots, until they would be compiled",
    seeds,
    words: &[
        b"\0asm\x0d\0\x01\0",
        b"\0asm\x01\0\0\0",
        CONTROLLER_EXPORTS[0].as_bytes(),
        JOURNAL_IMPORT.as_bytes(),
        b"component-type",
        b"memory",
        b"cabi_realloc",
        b"\x60\0\0",
        b"\x0b",
    ],
    bytes_max: 256 << 10,
    make: || Box::new(fuzz::admit),
    short: 4000,
    takes_modules: false,
};

fn seeds() -> Vec<Vec<u8>> {
    let logging = Module {
        imports: IMPORT_LOG,
        ..Module::default()
    };
    let mut seeds = vec![
        Module::default().component(),
        Module::default().core(),
        logging.component(),
        logging.core(),
        Composite::default().component(),
        wasm("(component)"),
        wasm("(module)"),
    ];
    let smallest = bundled().iter().min_by_key(|robot| robot.component.len());
    seeds.extend(smallest.map(|robot| robot.component.to_vec()));
    seeds
}
