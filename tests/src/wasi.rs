//! [`build`]: the parts that keep WASI inside of robots, from their sources in
//! `host/engine/wasi`. `cargo xtask wasi` runs it and writes the manifest.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use wasm_encoder::{Component, RawSection};
use wasmouse_engine::admission::{INTERFACE_VERSION, ROBOT_WIT};
use wasmparser::{BinaryReader, Parser, Payload, Validator};
use wit_component::{ComponentEncoder, StringEncoding, embed_component_metadata};
use wit_parser::abi::{AbiVariant, WasmType};
use wit_parser::{Resolve, WorldId, WorldItem};

use crate::wasm_target::{WASM_TARGET, cargo};

/// The sources, below the root of the repository.
pub const FOLDER: &str = "host/engine/wasi";

/// What [`missing`] is written to, in [`FOLDER`].
const MISSING_FILE: &str = "guest/src/missing.rs";

/// Numbers of sections.
const CUSTOM_SECTION: u8 = 0;
const COMPONENT_SECTION: u8 = 4;

/// Builds everything into the folder `prebuilt`.
///
/// # Errors
///
/// What cannot be built, with the reason.
pub fn build(root: &Path) -> Result<(), String> {
    let folder = root.join(FOLDER);
    let write = |name: &str, bytes: &[u8]| {
        let file = folder.join("prebuilt").join(name).with_extension("wasm");
        fs::write(&file, bytes).map_err(|error| format!("`{}`: {error}", file.display()))
    };
    let missing = missing(root)?;
    let file = folder.join(MISSING_FILE);
    fs::write(&file, missing).map_err(|error| format!("`{}`: {error}", file.display()))?;
    write("adapter", &wat(&folder, "preview1.wat")?)?;
    for preview in PREVIEWS {
        let behind = component(root, preview)?;
        let shell = with_component(&wat(&folder, &format!("{preview}-shell.wat"))?, &behind);
        write(preview, &shell)?;
        println!(
            "{preview}: {} bytes, of which {} answer WASI",
            shell.len(),
            behind.len()
        );
    }
    Ok(())
}

/// Features of the crate, worlds of the WIT package, and names of shells.
const PREVIEWS: [&str; 2] = ["preview1", "preview2"];

/// A text in binary form, with the version of the interface and the shared imports in it.
fn wat(folder: &Path, name: &str) -> Result<Vec<u8>, String> {
    let read = |name: &str| {
        let file = folder.join(name);
        fs::read_to_string(&file).map_err(|error| format!("`{}`: {error}", file.display()))
    };
    let text = read(name)?
        .replace("TYPES", &read("types.wat")?)
        .replace("JOURNAL", &read("journal.wat")?)
        .replace("VERSION", INTERFACE_VERSION);
    let bytes = wat::parse_str(text).map_err(|error| format!("{name}: {error}"))?;
    Ok(without_names(&bytes))
}

/// A module or component without its own custom sections.
fn without_names(bytes: &[u8]) -> Vec<u8> {
    let sections = sections(bytes);
    let kept = sections.iter().filter(|(id, ..)| *id != CUSTOM_SECTION);
    let kept = kept.flat_map(|(_, _, section)| *section);
    bytes[..HEADER_BYTES].iter().chain(kept).copied().collect()
}

const HEADER_BYTES: usize = 8;

/// Outermost sections: number, data, and the section with its header.
fn sections(bytes: &[u8]) -> Vec<(u8, &[u8], &[u8])> {
    let mut reader = BinaryReader::new(&bytes[HEADER_BYTES..], 0);
    let mut found = Vec::new();
    while !reader.eof() {
        let start = usize::try_from(reader.original_position()).expect("an offset");
        let id = reader.read_u8().expect("our binary");
        let length = reader.read_var_u32().expect("our binary");
        let data = reader.read_bytes(length as usize).expect("our binary");
        let end = usize::try_from(reader.original_position()).expect("an offset");
        found.push((id, data, &bytes[HEADER_BYTES..][start..end]));
    }
    found
}

/// A shell whose first component is `inner`.
fn with_component(shell: &[u8], inner: &[u8]) -> Vec<u8> {
    let mut component = Component::new();
    let mut place = Some(inner);
    for (id, data, _) in sections(shell) {
        let data = match id {
            COMPONENT_SECTION => place.take().unwrap_or(data),
            _ => data,
        };
        component.section(&RawSection { id, data });
    }
    component.finish()
}

/// The component that the crate becomes with a feature.
fn component(root: &Path, preview: &str) -> Result<Vec<u8>, String> {
    let module = compile(root, preview)?;
    let mut module =
        fs::read(&module).map_err(|error| format!("`{}`: {error}", module.display()))?;
    let (resolve, world) = world(root, preview)?;
    embed_component_metadata(&mut module, &resolve, world, StringEncoding::UTF8, false)
        .map_err(|error| format!("{preview}: {error:#}"))?;
    let component = ComponentEncoder::default()
        .validate(true)
        .module(&module)
        .and_then(|encoder| encoder.encode())
        .map_err(|error| format!("{preview}: {error:#}"))?;
    Validator::new()
        .validate_all(&component)
        .map_err(|error| format!("{preview}: {error}"))?;
    Ok(without_names(&component))
}

/// The functions of preview 2 that are not answered, as a Rust source file: each ends the match
/// with its name. Which functions there are is in the WIT.
fn missing(root: &Path) -> Result<String, String> {
    let answered = root.join(FOLDER).join("guest/src/preview2.rs");
    let answered = fs::read_to_string(&answered)
        .map_err(|error| format!("`{}`: {error}", answered.display()))?;
    let (resolve, world) = world(root, "preview2")?;
    let mut text =
        "//! The functions of preview 2 that end the match. Written by `cargo xtask wasi`, \
                    not by hand.\n\nuse crate::guest::missing;\n"
            .to_owned();
    for (key, item) in &resolve.worlds[world].exports {
        let WorldItem::Interface { id, .. } = item else {
            continue;
        };
        let interface = resolve.name_world_key(key);
        for function in resolve.interfaces[*id].functions.values() {
            let export = format!("{interface}#{}", function.name);
            if answered.contains(&format!("{export:?}")) {
                continue;
            }
            let signature = resolve.wasm_signature(AbiVariant::GuestExport, function);
            let parameters: Vec<String> = signature
                .params
                .iter()
                .map(|ty| format!("_: {}", rust_type(*ty)))
                .collect();
            let result = signature.results.first();
            let result = result.map_or(String::new(), |ty| format!("-> {} ", rust_type(*ty)));
            let (package, _) = interface.split_once('@').unwrap_or((&interface, ""));
            let name = function.name.rsplit(']').next().unwrap_or_default();
            let number = text.matches("extern").count();
            write!(
                text,
                "\n#[unsafe(export_name = {export:?})]\n\
                 extern \"C\" fn missing_{number}({}) {result}{{\n    \
                 missing(\"{package}#{name}\")\n}}\n",
                parameters.join(", ")
            )
            .expect("writing to a string");
        }
    }
    Ok(text)
}

const fn rust_type(ty: WasmType) -> &'static str {
    match ty {
        WasmType::I64 | WasmType::PointerOrI64 => "i64",
        WasmType::F32 => "f32",
        WasmType::F64 => "f64",
        WasmType::I32 | WasmType::Pointer | WasmType::Length => "i32",
    }
}

/// A component around a robot's core module that may import all of preview 2.
///
/// # Errors
///
/// What does not fit.
pub fn typed(module: &[u8]) -> Result<Vec<u8>, String> {
    let root = crate::bindings::repository();
    let (mut resolve, world) = world(&root, "preview2")?;
    let names: Vec<String> = resolve.worlds[world]
        .exports
        .keys()
        .map(|key| resolve.name_world_key(key))
        .filter(|name| name.starts_with("wasi:"))
        .map(|name| format!("import {name};"))
        .collect();
    let text = format!(
        "package test:probe; world probe {{ import wasmouse:robot/journal@{INTERFACE_VERSION}; {} \
         export wasmouse:robot/controller@{INTERFACE_VERSION}; }}",
        names.join(" ")
    );
    let package = resolve
        .push_str("probe.wit", &text)
        .map_err(|error| format!("{error:#}"))?;
    let world = resolve
        .select_world(&[package], Some("probe"))
        .map_err(|error| format!("{error:#}"))?;
    let mut module = module.to_vec();
    embed_component_metadata(&mut module, &resolve, world, StringEncoding::UTF8, false)
        .map_err(|error| format!("{error:#}"))?;
    ComponentEncoder::default()
        .validate(true)
        .module(&module)
        .and_then(|encoder| encoder.encode())
        .map_err(|error| format!("{error:#}"))
}

/// What the documentation has to list: the functions of preview 1, and of preview 2 the
/// interfaces and the functions that are answered.
///
/// # Errors
///
/// What cannot be read.
pub fn functions(folder: &Path) -> Result<Vec<String>, String> {
    let adapter = folder.join("prebuilt/adapter.wasm");
    let adapter =
        fs::read(&adapter).map_err(|error| format!("`{}`: {error}", adapter.display()))?;
    let mut names = Vec::new();
    for payload in Parser::new(0).parse_all(&adapter) {
        if let Ok(Payload::ExportSection(section)) = payload {
            names.extend(section.into_iter().flatten().map(|it| it.name.to_owned()));
        }
    }
    names.retain(|name| !name.starts_with("wasmouse:"));
    let (resolve, world) = world(&crate::bindings::repository(), "preview2")?;
    let answered = folder.join("guest/src/preview2.rs");
    let answered = fs::read_to_string(&answered)
        .map_err(|error| format!("`{}`: {error}", answered.display()))?;
    for (key, item) in &resolve.worlds[world].exports {
        let interface = resolve.name_world_key(key);
        let WorldItem::Interface { id, .. } = item else {
            continue;
        };
        if !interface.starts_with("wasi:") {
            continue;
        }
        for function in resolve.interfaces[*id].functions.keys() {
            if answered.contains(&format!("\"{interface}#{function}\"")) {
                let name = function.rsplit(']').next().unwrap_or_default();
                names.push(name.rsplit('.').next().unwrap_or_default().to_owned());
            }
        }
        let (interface, _) = interface.split_once('@').unwrap_or((&interface, ""));
        names.push(interface.to_owned());
    }
    Ok(names)
}

/// A world of the package `wasmouse:wasi`.
fn world(root: &Path, name: &str) -> Result<(Resolve, WorldId), String> {
    let mut resolve = Resolve::default();
    resolve
        .push_str("robot.wit", ROBOT_WIT)
        .map_err(|error| format!("{error:#}"))?;
    let (package, _) = resolve
        .push_dir(root.join(FOLDER).join("wit"))
        .map_err(|error| format!("{error:#}"))?;
    let world = resolve
        .select_world(&[package], Some(name))
        .map_err(|error| format!("{error:#}"))?;
    Ok((resolve, world))
}

/// Compiles the crate for size; returns the file.
fn compile(root: &Path, preview: &str) -> Result<PathBuf, String> {
    let target = root.join("target/wasi");
    let mut command: Command = cargo("rustc --locked --release --lib --crate-type cdylib");
    command
        .args(["--package", "wasmouse-wasi", "--features", preview])
        .args(["--target", WASM_TARGET])
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .arg("--")
        .args([
            "-C",
            "opt-level=z",
            "-C",
            "codegen-units=1",
            "-C",
            "strip=symbols",
        ])
        // The stack is small, so that all fits into one page of memory.
        .args(["-C", "link-arg=-zstack-size=8192"]);
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(status) => return Err(format!("{preview}: cargo failed ({status})")),
        Err(error) => return Err(format!("cannot run cargo: {error}")),
    }
    Ok(target.join(WASM_TARGET).join("release/wasmouse_wasi.wasm"))
}
