//! `bindings`: writes the SDK's bindings of `wit/robot.wit`; `cargo xtask bindings` runs it.

use std::fs;
use std::process::ExitCode;

use wasmouse_tests::bindings;

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
    let source = bindings::generate(&text).map_err(|error| format!("wit/robot.wit: {error}"))?;
    let file = root.join(bindings::FILE);
    fs::write(&file, source).map_err(|error| format!("`{}`: {error}", file.display()))?;
    println!("wrote {}", bindings::FILE);
    Ok(())
}
