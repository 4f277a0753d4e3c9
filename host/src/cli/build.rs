//! `wasmouse build`: turns a robot project, a core module or WebAssembly text into a component
//! file, and shows what a match of it costs.
//!
//! Compiling is the work of [`super::project`].

use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use wasmouse_engine::Limits;
use wasmouse_engine::admission::{BinaryKind, Outline};

use super::exit::Exit;
use super::failure::Failure;
use super::input;
use super::interrupt;
use super::output::{self, Existing, message};
use super::project::{self, Options, to_component};
use super::samples;
use super::setup::{CacheArgs, IsolationArgs};
use crate::report::built;
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse build                       the project in this folder
  wasmouse build my-robot              writes my-robot/my-robot.wasm
  wasmouse build my-robot -o bot.wasm
  wasmouse build my-robot --watch      builds and plays again when a file changes
  wasmouse build module.wasm           wraps a core module of any language
  wasmouse build robot.wat             the same for WebAssembly text
  wasmouse build component.wasm        puts what answers WASI into a component

Rust: the wasm target is added with rustup if it is missing. If rustup cannot fetch it,
a packaged compiler is used (Debian: rustc-web, rust-web-src, lld-22).
Other languages: `wasmouse doctor` says what they need.";

/// Build a robot project, a core module, text or a component with WASI into a robot
///
/// A project is compiled with the tools of its language, and NAME.wasm is written into its folder.
/// For a core module FILE.wasm or text FILE.wat, FILE.component.wasm is written beside it; for a
/// component that imports WASI, FILE.robot.wasm, which has what answers WASI inside. Then the robot
/// plays a match in a known maze and one in a large maze, to show its fuel beside the limits; a fault
/// in them is shown and is no failure of the build.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Robot project folder, a core module or component (.wasm), or WebAssembly text (.wat)
    #[arg(default_value = ".")]
    path: PathBuf,
    /// Output file for the component
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Cargo profile to build a Rust project with [default: release]
    #[arg(long, value_name = "NAME")]
    profile: Option<String>,
    /// Build again whenever a source file changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
    /// Do not play the sample matches
    #[arg(long)]
    no_match: bool,
    #[command(flatten)]
    cache: CacheArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// The largest core module that is turned into a component, in bytes. No robot is admitted that
/// is nearly as large, but `wasmouse inspect` says more about one that is too large.
const CORE_MODULE_BYTES_MAX: u64 = 256 << 20;

/// The interface without functions, in any version.
const TYPES_INTERFACE: &str = "wasmouse:robot/types@";

/// How often the sources are looked at.
const INTERVAL: Duration = Duration::from_millis(300);

/// Builds, writes, and prints what was built.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    if args.watch {
        interrupt::listen()?;
        return args.watch();
    }
    args.build()?;
    Ok(Exit::Success)
}

impl Args {
    fn build(&self) -> Result<(), Failure> {
        let (component, default_output) = if self.path.is_dir() {
            let project = project::find(&self.path)?;
            if self.profile.is_some() && project.language.name != "rust" {
                return Err(no_profile(project.language.title));
            }
            let options = Options {
                profile: self.profile.clone(),
            };
            (project.build(&options)?, project.component())
        } else if self.profile.is_some() {
            return Err(no_profile("files"));
        } else {
            let module = input::read_file(&self.path, CORE_MODULE_BYTES_MAX).map_err(|error| {
                Failure::input(text!(
                    "failed to read `{}`: {}",
                    Text::of_path(&self.path),
                    error
                ))
                .hint("give the folder of a robot project, a core module (.wasm) or text (.wat)")
            })?;
            let component = to_component(&module, &self.path)?;
            let extension = match BinaryKind::of(&module) {
                BinaryKind::Component => "robot.wasm",
                _ => "component.wasm",
            };
            (component, self.path.with_extension(extension))
        };
        let file = self.output.as_deref().unwrap_or(&default_output);
        output::save(file, &component, Existing::Replace)?;
        let size_max = Limits::default().admission.component_bytes_max;
        let text = built::component(
            &Text::of_path(file),
            component.len(),
            size_max,
            &imports(&component),
        );
        output::print(text.as_str())?;
        if !self.no_match {
            let played = samples::play(file, &self.cache, &self.isolation)?;
            output::print(built::samples(&played).as_str())?;
        }
        Ok(())
    }

    /// Builds again when something has changed. A project that does not compile is reported, and
    /// may become right again.
    fn watch(&self) -> Result<Exit, Failure> {
        loop {
            let before = project::sources(&self.path)?;
            if let Err(failure) = self.build() {
                message!("{}", failure.report());
            }
            message!("waiting for a change of the sources; Ctrl-C ends");
            loop {
                if interrupt::flag().is_set() {
                    return Ok(Exit::Interrupted);
                }
                thread::sleep(INTERVAL);
                if project::sources(&self.path)? != before {
                    break;
                }
            }
        }
    }
}

/// `--profile` would change nothing.
fn no_profile(what: &str) -> Failure {
    Failure::usage(text!("--profile is for Rust projects, not for {}", what))
        .hint("leave --profile out")
}

/// The interfaces that a component gets functions from. `types` has none, and every robot
/// imports it, so it says nothing.
fn imports(component: &[u8]) -> Vec<String> {
    // Admission, before the sample matches, is what says that a component cannot be read.
    let names = Outline::of(component).map_or_else(|_| Vec::new(), |it| it.imports);
    let has_functions = |name: &String| !name.starts_with(TYPES_INTERFACE);
    names.into_iter().filter(has_functions).collect()
}
