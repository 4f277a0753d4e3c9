//! `wasmouse build`: a robot crate or a core module becomes a component file.
//!
//! Runs cargo, finds the module that it made, wraps it
//! ([`crate::robot::componentize`]) and writes it. Which compiler is used is
//! [`super::toolchain`]'s decision.

use std::ffi::OsString;
use std::fmt;
use std::fs;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;
use wasmparser::{Parser, Payload};

use super::exit::Exit;
use super::failure::Failure;
use super::output::{self, Existing};
use super::toolchain::{Toolchain, WASM_TARGET};
use crate::robot::componentize::componentize;

const EXAMPLES: &str = "\
Examples:
  wasmouse build                       the crate in this folder
  wasmouse build my-robot              writes my-robot/my-robot.wasm
  wasmouse build my-robot -o bot.wasm
  wasmouse build module.wasm           wraps a core module of any language

The wasm target is added with rustup where it is missing; where rustup cannot
fetch it, a packaged compiler (Debian: rustc-web, rust-web-src, lld-22) is used.";

/// Build a robot crate, or wrap a core module, into a component.
///
/// For a crate, runs `cargo build` for wasm32-unknown-unknown and writes
/// NAME.wasm into the crate's folder. For a core module FILE.wasm, writes
/// FILE.component.wasm beside it.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// A robot crate's folder, or a core module (.wasm).
    #[arg(default_value = ".")]
    path: PathBuf,
    /// Where to write the component.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The cargo profile to build a crate with.
    #[arg(long, value_name = "NAME", default_value = "release")]
    profile: String,
}

/// The interface without functions, in any version.
const TYPES_INTERFACE: &str = "wasmouse:robot/types@";

/// Builds, writes, and prints what was made.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (core_module, default_output) = if args.path.is_dir() {
        let krate = Crate::find(&args.path)?;
        let module = krate.compile(&args.profile)?;
        (
            module,
            krate.folder.join(&krate.name).with_extension("wasm"),
        )
    } else {
        let module = fs::read(&args.path).map_err(|error| {
            Failure::input(format_args!(
                "failed to read `{}`: {error}",
                args.path.display()
            ))
            .hint("give the folder of a robot crate or a core module (.wasm)")
        })?;
        (module, args.path.with_extension("component.wasm"))
    };
    let component = componentize(&core_module).map_err(|error| {
        Failure::robot(format_args!(
            "cannot make a robot of `{}`: {error}",
            args.path.display()
        ))
        .hint(error.hint())
    })?;
    let file = args.output.as_deref().unwrap_or(&default_output);
    output::save(file, &component, Existing::Replace)?;
    output::print(&format!("{}\n", Built::new(file, &component)))?;
    Ok(Exit::Success)
}

/// A robot crate: a package with a library that becomes a module.
struct Crate {
    folder: PathBuf,
    manifest: PathBuf,
    name: String,
}

/// The part of a manifest that is needed here; cargo checks the rest.
#[derive(Deserialize)]
struct Manifest {
    package: Option<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
}

/// A message of `cargo build --message-format=json`.
#[derive(Deserialize)]
struct Message {
    reason: String,
    manifest_path: Option<PathBuf>,
    #[serde(default)]
    filenames: Vec<PathBuf>,
    target: Option<Target>,
}

#[derive(Deserialize)]
struct Target {
    crate_types: Vec<String>,
}

impl Crate {
    fn find(folder: &Path) -> Result<Self, Failure> {
        let manifest = folder.join("Cargo.toml");
        let text = fs::read_to_string(&manifest).map_err(|error| {
            Failure::input(format_args!(
                "failed to read `{}`: {error}",
                manifest.display()
            ))
            .hint("give the folder of a robot crate; `wasmouse new my-robot` makes one")
        })?;
        let parsed: Manifest = toml::from_str(&text).map_err(|error| {
            Failure::input(format_args!(
                "failed to parse `{}`: {error}",
                manifest.display()
            ))
            .hint("a cargo manifest with a `[package]` is needed")
        })?;
        let Some(package) = parsed.package else {
            return Err(Failure::input(format_args!(
                "`{}` is a workspace without a package",
                manifest.display()
            ))
            .hint("give the folder of one robot in it"));
        };
        Ok(Self {
            folder: folder.to_owned(),
            // Cargo reports absolute paths, and its messages are found by them.
            manifest: manifest.canonicalize().unwrap_or(manifest),
            name: package.name,
        })
    }

    /// Runs cargo; its diagnostics go to stderr as they come.
    fn compile(&self, profile: &str) -> Result<Vec<u8>, Failure> {
        let toolchain = Toolchain::find(&self.folder)?;
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(cargo);
        command
            .args(["build", "--target", WASM_TARGET, "--profile", profile])
            .arg("--message-format=json-render-diagnostics")
            .arg("--manifest-path")
            .arg(&self.manifest)
            .args(&toolchain.arguments)
            .envs(toolchain.environment)
            // Cargo looks for its configuration from the current folder upwards.
            .current_dir(&self.folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        add_rustflags(&mut command, &self.path_names());
        let mut child = command.spawn().map_err(|error| {
            Failure::host(format_args!("failed to run cargo: {error}"))
                .hint("install Rust: https://rustup.rs")
        })?;
        let stdout = child.stdout.take().expect("stdout is piped above");
        let module = self.find_module(BufReader::new(stdout));
        let status = child
            .wait()
            .map_err(|error| Failure::host(format_args!("failed to wait for cargo: {error}")))?;
        if !status.success() {
            return Err(
                Failure::input(format_args!("cargo could not build `{}`", self.name))
                    .hint("cargo's messages are above"),
            );
        }
        let module = module
            .map_err(|error| {
                Failure::host(format_args!("failed to read cargo's messages: {error}"))
            })?
            .ok_or_else(|| {
                Failure::input(format_args!("`{}` builds no WebAssembly module", self.name)).hint(
                    "a robot is a library: put `crate-type = [\"cdylib\", \"rlib\"]` under \
                     `[lib]` in its Cargo.toml",
                )
            })?;
        fs::read(&module).map_err(|error| {
            Failure::host(format_args!(
                "failed to read `{}`: {error}",
                module.display()
            ))
        })
    }

    /// The module among the files that cargo says it made. Reads to the end, so
    /// that cargo never waits for a reader.
    fn find_module(&self, messages: impl BufRead) -> io::Result<Option<PathBuf>> {
        let mut module = None;
        for line in messages.lines() {
            // Build scripts may print anything; what is no message is not for us.
            let Ok(message) = serde_json::from_str::<Message>(&line?) else {
                continue;
            };
            module = self.module_in(message).or(module);
        }
        Ok(module)
    }

    fn module_in(&self, message: Message) -> Option<PathBuf> {
        let is_library = message
            .target
            .is_some_and(|target| target.crate_types.iter().any(|kind| kind == "cdylib"));
        let is_ours = message.manifest_path.as_deref() == Some(&self.manifest);
        if message.reason != "compiler-artifact" || !is_library || !is_ours {
            return None;
        }
        message.filenames.into_iter().find(|file| {
            file.extension()
                .is_some_and(|extension| extension == "wasm")
        })
    }

    /// Names for the folders that panic messages quote: a component must not
    /// depend on whose machine it was built on, nor tell.
    fn path_names(&self) -> Vec<String> {
        let folder = self.manifest.parent().map(Path::to_owned);
        [(folder, "/robot"), (cargo_home(), "/cargo")]
            .into_iter()
            .filter_map(|(from, to)| Some(format!("--remap-path-prefix={}={to}", from?.to_str()?)))
            .collect()
    }
}

/// Adds compiler flags to those that the user has set. Cargo takes flags from
/// one place only, and the environment wins over configuration files.
fn add_rustflags(command: &mut Command, flags: &[String]) {
    if let Some(encoded) = std::env::var_os("CARGO_ENCODED_RUSTFLAGS") {
        let flags = flags.join("\x1f");
        command.env("CARGO_ENCODED_RUSTFLAGS", join(encoded, "\x1f", &flags));
    } else if let Some(plain) = std::env::var_os("RUSTFLAGS") {
        command.env("RUSTFLAGS", join(plain, " ", &flags.join(" ")));
    } else {
        let flags = toml::Value::from(flags.to_vec());
        command
            .arg("--config")
            .arg(format!("target.{WASM_TARGET}.rustflags={flags}"));
    }
}

fn join(mut left: OsString, separator: &str, right: &str) -> OsString {
    if !left.is_empty() {
        left.push(separator);
    }
    left.push(right);
    left
}

/// Where cargo keeps the sources of dependencies.
fn cargo_home() -> Option<PathBuf> {
    std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(std::env::home_dir()?.join(".cargo")))
}

/// What is printed about a component: file, size, imports.
struct Built<'a> {
    path: &'a Path,
    size_bytes: usize,
    imports: Vec<String>,
}

impl<'a> Built<'a> {
    fn new(path: &'a Path, component: &[u8]) -> Self {
        Self {
            path,
            size_bytes: component.len(),
            imports: imports(component),
        }
    }
}

impl fmt::Display for Built<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let imports = if self.imports.is_empty() {
            "nothing".to_owned()
        } else {
            self.imports.join(", ")
        };
        write!(
            f,
            "{}: {} bytes, imports {imports}",
            self.path.display(),
            self.size_bytes
        )
    }
}

/// The interfaces that give functions to a component. `types` holds none, and
/// every robot imports it, so it says nothing.
fn imports(component: &[u8]) -> Vec<String> {
    let mut depth = 0_u32;
    let mut names = Vec::new();
    for payload in Parser::new(0).parse_all(component).map_while(Result::ok) {
        match payload {
            Payload::ModuleSection { .. } | Payload::ComponentSection { .. } => depth += 1,
            Payload::End(_) => depth = depth.saturating_sub(1),
            Payload::ComponentImportSection(section) if depth == 0 => {
                let imports = section.into_iter().map_while(Result::ok);
                names.extend(
                    imports
                        .map(|import| import.name.name.to_owned())
                        .filter(|name| !name.starts_with(TYPES_INTERFACE)),
                );
            }
            _ => {}
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    fn krate() -> Crate {
        Crate {
            folder: "bot".into(),
            manifest: "/home/me/bot/Cargo.toml".into(),
            name: "bot".into(),
        }
    }

    #[track_caller]
    fn check_module(messages: &str, expected: Option<&str>) {
        let module = krate().find_module(messages.as_bytes()).unwrap();
        assert_eq!(module, expected.map(PathBuf::from));
    }

    fn artifact(manifest: &str, kind: &str, files: &str) -> String {
        format!(
            r#"{{"reason":"compiler-artifact","manifest_path":"{manifest}","target":{{"crate_types":["{kind}"]}},"filenames":[{files}]}}"#
        )
    }

    #[test]
    fn the_module_of_the_crate_itself_is_found() {
        let dependency = artifact("/home/me/sdk/Cargo.toml", "cdylib", r#""sdk.wasm""#);
        let binary = artifact("/home/me/bot/Cargo.toml", "bin", r#""tool.wasm""#);
        let ours = artifact(
            "/home/me/bot/Cargo.toml",
            "cdylib",
            r#""bot.rlib","bot.wasm""#,
        );
        let noise = r#"{"reason":"build-finished","success":true}"#;
        check_module("", None);
        check_module("hello from a build script\n[1, 2]\n", None);
        check_module(&[dependency.as_str(), &binary, noise].join("\n"), None);
        check_module(
            &[&ours, dependency.as_str(), "hello", noise].join("\n"),
            Some("bot.wasm"),
        );
    }

    #[track_caller]
    fn check_refused(manifest: Option<&str>, message_part: &str) {
        let folder = tempfile::tempdir().unwrap();
        if let Some(text) = manifest {
            fs::write(folder.path().join("Cargo.toml"), text).unwrap();
        }
        let failure = Crate::find(folder.path()).err().unwrap().to_string();
        assert!(failure.contains(message_part), "{failure}");
        assert!(failure.contains("hint: "), "{failure}");
    }

    #[test]
    fn folders_without_a_crate_are_refused() {
        check_refused(None, "failed to read");
        check_refused(Some("[package\n"), "failed to parse");
        check_refused(Some("[workspace]\n"), "is a workspace without a package");
    }

    #[test]
    fn flags_are_joined_with_those_of_the_user() {
        assert_eq!(join("-C a".into(), " ", "-C b"), "-C a -C b");
        assert_eq!(join("".into(), " ", "-C b"), "-C b");
    }

    #[test]
    fn only_functions_count_as_imports() {
        let component = |imports: &str| {
            let text = format!("(component {imports})");
            imports_of(&wat::parse_str(text).unwrap())
        };
        let types = r#"(import "wasmouse:robot/types@0.2.0" (instance))"#;
        let journal = r#"(import "wasmouse:robot/journal@0.2.0" (instance))"#;
        assert_eq!(component(types), "imports nothing");
        assert_eq!(
            component(&format!("{types}{journal}")),
            "imports wasmouse:robot/journal@0.2.0"
        );
    }

    fn imports_of(component: &[u8]) -> String {
        let printed = Built::new(Path::new("bot.wasm"), component).to_string();
        printed.rsplit_once(" bytes, ").unwrap().1.to_owned()
    }
}
