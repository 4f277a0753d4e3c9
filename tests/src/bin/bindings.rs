//! `bindings`: writes what is made of `wit/robot.wit`: the SDK's bindings, the C header and the page
//! of the binary interface. `cargo xtask bindings` runs it.

use std::fs;
use std::process::ExitCode;

use wasmouse_tests::{abi, bindings};

fn main() -> ExitCode {
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn write() -> Result<(), String> {
    let root = bindings::repository();
    let wit = root.join("wit/robot.wit");
    let text = fs::read_to_string(&wit).map_err(|error| format!("`{}`: {error}", wit.display()))?;
    for (name, made) in [
        (bindings::FILE, bindings::generate(&text)),
        (abi::HEADER, abi::header(&text)),
        (abi::PAGE, abi::page(&text)),
    ] {
        let made = made.map_err(|error| format!("wit/robot.wit: {error}"))?;
        let file = root.join(name);
        fs::write(&file, made).map_err(|error| format!("`{}`: {error}", file.display()))?;
        println!("wrote {name}");
    }
    Ok(())
}
