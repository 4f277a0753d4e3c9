//! Rust: runs cargo and finds the module that it built. Which compiler is used is decided by
//! [`super::toolchain`].

use std::ffi::OsString;
use std::fs;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;

use super::cargo_home::cargo_home;
use super::target::{MANIFEST, Target};
use super::toolchain::Toolchain;
use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Project};
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// Rust.
pub static LANGUAGE: Language = Language {
    name: "rust",
    title: "Rust",
    markers: &[MANIFEST],
    is_in: |folder| folder.join(MANIFEST).is_file(),
    open,
    compile: |project, options| {
        let profile = options.profile.as_deref().unwrap_or(DEFAULT_PROFILE);
        Crate::of(project).compile(profile)
    },
    sources: &["src", MANIFEST, "build.rs", "vendor", ".cargo"],
    tools: &[&CARGO],
    check: Some(Toolchain::check),
    setup: &[],
};

static CARGO: Tool = Tool {
    name: "cargo",
    programs: &[Program::OnPath("cargo")],
    version_arguments: &["--version"],
    // The edition of the template.
    oldest: Version(1, 85, 0),
    tested: Version(1, 95, 0),
    install: "curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh",
};

/// The cargo profile that projects are built with unless the user chooses another.
pub const DEFAULT_PROFILE: &str = "release";

/// A package with a library that becomes a module.
struct Crate<'a> {
    folder: &'a Path,
    manifest: PathBuf,
    name: &'a str,
}

/// The part of a manifest that is needed here; cargo checks the rest.
#[derive(Deserialize)]
struct Manifest {
    package: Option<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    metadata: Option<Metadata>,
}

#[derive(Deserialize)]
struct Metadata {
    /// What cargo-component reads.
    component: Option<toml::Value>,
}

/// A message of `cargo build --message-format=json`.
#[derive(Deserialize)]
struct Message {
    reason: String,
    manifest_path: Option<PathBuf>,
    #[serde(default)]
    filenames: Vec<PathBuf>,
    target: Option<CargoTarget>,
}

/// What cargo calls a target: a library or a program of a package.
#[derive(Deserialize)]
struct CargoTarget {
    crate_types: Vec<String>,
}

/// Reads the manifest of a package.
fn open(folder: &Path, language: &'static Language) -> Result<Project, Failure> {
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
    if package.metadata.is_some_and(|it| it.component.is_some()) {
        return Err(of_cargo_component(folder, &package.name));
    }
    Ok(Project {
        folder: folder.to_owned(),
        name: package.name,
        language,
    })
}

/// cargo-component generates the bindings that such a project needs, and only it does.
fn of_cargo_component(folder: &Path, name: &str) -> Failure {
    let file = format!(
        "target/{}/release/{}.wasm",
        Target::Preview1.name(),
        name.replace('-', "_")
    );
    Failure::input(text!(
        "`{}` is a project of cargo-component",
        Text::of_path(folder)
    ))
    .hint(text!(
        "run `cargo component build --release` there, then `wasmouse build {}`",
        Text::of_path(folder.join(file))
    ))
}

impl<'a> Crate<'a> {
    fn of(project: &'a Project) -> Self {
        let manifest = project.folder.join(MANIFEST);
        Self {
            folder: &project.folder,
            // Cargo reports absolute paths, and its messages are found by them.
            manifest: manifest.canonicalize().unwrap_or(manifest),
            name: &project.name,
        }
    }

    /// Runs cargo; its diagnostics go to stderr as they come.
    fn compile(&self, profile: &str) -> Result<Vec<u8>, Failure> {
        let target = Target::of(self.folder)?;
        let toolchain = Toolchain::find(self.folder, target)?;
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(cargo);
        command
            .args(["build", "--target", target.name(), "--profile", profile])
            .arg("--message-format=json-render-diagnostics")
            .arg("--manifest-path")
            .arg(&self.manifest)
            .args(&toolchain.arguments)
            .envs(toolchain.environment)
            // Cargo looks for its configuration from the current folder upwards.
            .current_dir(self.folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        add_rustflags(&mut command, target, &self.path_names());
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
fn add_rustflags(command: &mut Command, target: Target, flags: &[String]) {
    if let Some(encoded) = std::env::var_os("CARGO_ENCODED_RUSTFLAGS") {
        let flags = flags.join("\x1f");
        command.env("CARGO_ENCODED_RUSTFLAGS", join(encoded, "\x1f", &flags));
    } else if let Some(plain) = std::env::var_os("RUSTFLAGS") {
        command.env("RUSTFLAGS", join(plain, " ", &flags.join(" ")));
    } else {
        let flags = toml::Value::from(flags.to_vec());
        command
            .arg("--config")
            .arg(format!("target.{}.rustflags={flags}", target.name()));
    }
}

fn join(mut left: OsString, separator: &str, right: &str) -> OsString {
    if !left.is_empty() {
        left.push(separator);
    }
    left.push(right);
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project() -> Crate<'static> {
        Crate {
            folder: Path::new("bot"),
            manifest: "/home/me/bot/Cargo.toml".into(),
            name: "bot",
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
        let failure = open(folder.path(), &LANGUAGE).err().unwrap().to_string();
        assert!(failure.contains(message_part), "{failure}");
        assert!(failure.contains("hint: "), "{failure}");
    }

    #[test]
    fn folders_without_a_project_are_rejected() {
        check_rejected(None, "failed to read");
        check_rejected(Some("[package\n"), "failed to parse");
        check_rejected(Some("[workspace]\n"), "is a workspace without a package");
        let component = "[package]\nname = \"my-bot\"\n[package.metadata.component]\n";
        check_rejected(Some(component), "release/my_bot.wasm");
    }

    #[test]
    fn flags_are_joined_with_those_of_the_user() {
        assert_eq!(join("-C a".into(), " ", "-C b"), "-C a -C b");
        assert_eq!(join("".into(), " ", "-C b"), "-C b");
    }
}
