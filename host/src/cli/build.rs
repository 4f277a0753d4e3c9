//! `wasmouse build`: turns a robot project or a core module into a component file.
//!
//! Runs cargo, finds the module that it built, wraps it ([`componentize`]) and writes it.
//! Which compiler is used is decided by [`super::toolchain`].

use std::ffi::OsString;
use std::fs;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;
use wasmouse_engine::Limits;
use wasmouse_engine::admission::{BinaryKind, componentize, examine, wasi};

use super::exit::Exit;
use super::failure::Failure;
use super::input;
use super::output::{self, Existing};
use super::toolchain::{Toolchain, WASM_TARGET};
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse build                       the project in this folder
  wasmouse build my-robot              writes my-robot/my-robot.wasm
  wasmouse build my-robot -o bot.wasm
  wasmouse build module.wasm           wraps a core module of any language
  wasmouse build component.wasm        puts what answers WASI into a component

The wasm target is added with rustup if it is missing. If rustup cannot fetch it,
a packaged compiler is used (Debian: rustc-web, rust-web-src, lld-22).";

/// Build a robot project, or wrap a core module, into a component
///
/// For a project, runs `cargo build` for wasm32-unknown-unknown and writes
/// NAME.wasm into the project folder. For a core module FILE.wasm, writes
/// FILE.component.wasm beside it. For a component FILE.wasm that imports WASI, writes
/// FILE.robot.wasm, which has what answers WASI inside.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Robot project folder, a core module, or a component that imports WASI (.wasm)
    #[arg(default_value = ".")]
    path: PathBuf,
    /// Output file for the component
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Cargo profile to build the project with
    #[arg(long, value_name = "NAME", default_value = DEFAULT_PROFILE)]
    profile: String,
}

/// The largest core module that is turned into a component, in bytes. No robot is admitted that
/// is nearly as large, but `wasmouse inspect` says more about one that is too large.
const CORE_MODULE_BYTES_MAX: u64 = 256 << 20;

/// The file that makes a folder a robot project.
const MANIFEST: &str = "Cargo.toml";

/// The cargo profile that projects are built with unless the user chooses another.
const DEFAULT_PROFILE: &str = "release";

/// The interface without functions, in any version.
const TYPES_INTERFACE: &str = "wasmouse:robot/types@";

/// Builds, writes, and prints what was built.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (core_module, default_output) = if args.path.is_dir() {
        let project = Project::find(&args.path)?;
        (project.compile(&args.profile)?, project.component())
    } else {
        let module = input::read_file(&args.path, CORE_MODULE_BYTES_MAX).map_err(|error| {
            Failure::input(text!(
                "failed to read `{}`: {}",
                Text::of_path(&args.path),
                error
            ))
            .hint("give the folder of a robot project or a core module (.wasm)")
        })?;
        let extension = match BinaryKind::of(&module) {
            BinaryKind::Component => "robot.wasm",
            _ => "component.wasm",
        };
        let default_output = args.path.with_extension(extension);
        (module, default_output)
    };
    let component = to_component(&core_module, &args.path)?;
    let file = args.output.as_deref().unwrap_or(&default_output);
    output::save(file, &component, Existing::Replace)?;
    output::print(Built::new(file, &component).text().as_str())?;
    Ok(Exit::Success)
}

/// Whether a folder is a robot project: it has a cargo manifest.
pub fn is_project(path: &Path) -> bool {
    path.join(MANIFEST).is_file()
}

/// Builds a robot project and returns the path of its component.
///
/// # Errors
///
/// When it is not a robot project or does not compile.
pub fn build_project(folder: &Path) -> Result<PathBuf, Failure> {
    let project = Project::find(folder)?;
    let component = to_component(&project.compile(DEFAULT_PROFILE)?, folder)?;
    let path = project.component();
    output::save(&path, &component, Existing::Replace)?;
    Ok(path)
}

/// A source file of the project that was changed after the component was built.
pub fn newer_source(project: &Path, component: &Path) -> Option<PathBuf> {
    let modified = |path: &Path| fs::metadata(path).and_then(|it| it.modified()).ok();
    if !is_project(project) {
        return None;
    }
    let built = modified(component)?;
    let mut left = vec![project.join("src"), project.join(MANIFEST)];
    while let Some(path) = left.pop() {
        match fs::read_dir(&path) {
            Ok(entries) => left.extend(entries.filter_map(|it| Some(it.ok()?.path()))),
            Err(_) if modified(&path).is_some_and(|it| it > built) => return Some(path),
            Err(_) => {}
        }
    }
    None
}

fn to_component(file: &[u8], source: &Path) -> Result<Vec<u8>, Failure> {
    if BinaryKind::of(file) == BinaryKind::Component {
        return wasi::compose(file, &Limits::default()).map_err(|error| {
            Failure::robot(text!(
                "cannot build a robot from `{}`: {}",
                Text::of_path(source),
                error
            ))
            .hint(error.hint())
        });
    }
    componentize(file).map_err(|error| {
        Failure::robot(text!(
            "cannot build a robot from `{}`: {}",
            Text::of_path(source),
            error
        ))
        .hint(error.hint())
    })
}

/// A robot project: a package with a library that becomes a module.
struct Project {
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

impl Project {
    fn find(folder: &Path) -> Result<Self, Failure> {
        let manifest = folder.join(MANIFEST);
        let text = fs::read_to_string(&manifest).map_err(|error| {
            Failure::input(text!(
                "failed to read `{}`: {}",
                Text::of_path(&manifest),
                error
            ))
            .hint("give the folder of a robot project; `wasmouse new my-robot` creates one")
        })?;
        let parsed: Manifest = toml::from_str(&text).map_err(|error| {
            Failure::input(text!(
                "failed to parse `{}`: {}",
                Text::of_path(&manifest),
                Text::of_lines(&error.to_string())
            ))
            .hint("a robot project has a cargo manifest with a `[package]`")
        })?;
        let Some(package) = parsed.package else {
            return Err(Failure::input(text!(
                "`{}` is a workspace without a package",
                Text::of_path(&manifest)
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

    /// Where its component is written.
    fn component(&self) -> PathBuf {
        self.folder.join(&self.name).with_extension("wasm")
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
            Failure::input(format_args!("failed to run cargo: {error}"))
                .hint("install Rust: https://rustup.rs")
        })?;
        let stdout = child.stdout.take().expect("stdout is piped above");
        let module = self.find_module(BufReader::new(stdout));
        let status = child.wait().map_err(|error| {
            Failure::internal(format_args!("failed to wait for cargo: {error}"))
        })?;
        if !status.success() {
            return Err(
                Failure::input(format_args!("cargo failed to build `{}`", self.name))
                    .hint("cargo's messages are above"),
            );
        }
        let module = module
            .map_err(|error| {
                Failure::internal(format_args!("failed to read cargo's messages: {error}"))
            })?
            .ok_or_else(|| {
                Failure::input(format_args!(
                    "`{}` does not build a WebAssembly module",
                    self.name
                ))
                .hint(
                    "a robot is a library: put `crate-type = [\"cdylib\", \"rlib\"]` under \
                     `[lib]` in its Cargo.toml",
                )
            })?;
        fs::read(&module).map_err(|error| {
            Failure::internal(text!(
                "failed to read `{}`: {}",
                Text::of_path(&module),
                error
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

    /// Names for the folders that panic messages quote: a component must neither depend on the
    /// machine that it was built on nor reveal anything of it.
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

impl Built<'_> {
    fn text(&self) -> Text {
        let imports = if self.imports.is_empty() {
            "nothing".to_owned()
        } else {
            self.imports.join(", ")
        };
        text!(
            "{}: {} bytes, imports {}\n",
            Text::of_path(self.path),
            self.size_bytes,
            imports
        )
    }
}

/// The interfaces that a component gets functions from. `types` has none, and every robot
/// imports it, so it says nothing.
fn imports(component: &[u8]) -> Vec<String> {
    let shape = examine(component, &Limits::default()).shape;
    let names = shape.map_or_else(Vec::new, |it| it.imports);
    let has_functions = |name: &String| !name.starts_with(TYPES_INTERFACE);
    names.into_iter().filter(has_functions).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project() -> Project {
        Project {
            folder: "bot".into(),
            manifest: "/home/me/bot/Cargo.toml".into(),
            name: "bot".into(),
        }
    }

    #[track_caller]
    fn check_module(messages: &str, expected: Option<&str>) {
        let module = project().find_module(messages.as_bytes()).unwrap();
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
    fn check_rejected(manifest: Option<&str>, message_part: &str) {
        let folder = tempfile::tempdir().unwrap();
        if let Some(text) = manifest {
            fs::write(folder.path().join("Cargo.toml"), text).unwrap();
        }
        let failure = Project::find(folder.path()).err().unwrap().to_string();
        assert!(failure.contains(message_part), "{failure}");
        assert!(failure.contains("hint: "), "{failure}");
    }

    #[test]
    fn folders_without_a_project_are_rejected() {
        check_rejected(None, "failed to read");
        check_rejected(Some("[package\n"), "failed to parse");
        check_rejected(Some("[workspace]\n"), "is a workspace without a package");
    }

    #[test]
    fn flags_are_joined_with_those_of_the_user() {
        assert_eq!(join("-C a".into(), " ", "-C b"), "-C a -C b");
        assert_eq!(join("".into(), " ", "-C b"), "-C b");
    }
}
