//! `wasmouse build`: turns a robot project, a core module or WebAssembly text into a component
//! file.
//!
//! Compiling is the work of [`super::project`].

use std::path::{Path, PathBuf};

use wasmouse_engine::Limits;
use wasmouse_engine::admission::examine;

use super::exit::Exit;
use super::failure::Failure;
use super::input;
use super::output::{self, Existing};
use super::project::{self, Options, to_component};
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse build                       the project in this folder
  wasmouse build my-robot              writes my-robot/my-robot.wasm
  wasmouse build my-robot -o bot.wasm
  wasmouse build module.wasm           wraps a core module of any language
  wasmouse build robot.wat             the same for WebAssembly text

`wasmouse doctor` says which tools are missing. For Rust, the wasm target is added with rustup; if
rustup cannot fetch it, a packaged compiler is used (Debian: rustc-web, rust-web-src, lld-22).";

/// Build a robot project, a core module or WebAssembly text into a component
///
/// For a project, runs the tools of its language and writes NAME.wasm into the project folder. For
/// a core module FILE.wasm or WebAssembly text FILE.wat, writes FILE.component.wasm beside it.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Robot project folder, a core module (.wasm), or WebAssembly text (.wat)
    #[arg(default_value = ".")]
    path: PathBuf,
    /// Output file for the component
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Cargo profile to build a Rust project with [default: release]
    #[arg(long, value_name = "NAME")]
    profile: Option<String>,
}

/// The largest core module that is turned into a component, in bytes. No robot is admitted that
/// is nearly as large, but `wasmouse inspect` says more about one that is too large.
const CORE_MODULE_BYTES_MAX: u64 = 256 << 20;

/// The interface without functions, in any version.
const TYPES_INTERFACE: &str = "wasmouse:robot/types@";

/// Builds, writes, and prints what was built.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (component, default_output) = if args.path.is_dir() {
        let project = project::find(&args.path)?;
        let options = Options {
            profile: args.profile.clone(),
        };
        (project.build(&options)?, project.component())
    } else {
        let module = input::read_file(&args.path, CORE_MODULE_BYTES_MAX).map_err(|error| {
            Failure::input(text!(
                "failed to read `{}`: {}",
                Text::of_path(&args.path),
                error
            ))
            .hint("give the folder of a robot project, a core module (.wasm) or WebAssembly text (.wat)")
        })?;
        let component = to_component(&module, &args.path)?;
        (component, args.path.with_extension("component.wasm"))
    };
    let file = args.output.as_deref().unwrap_or(&default_output);
    output::save(file, &component, Existing::Replace)?;
    output::print(Built::new(file, &component).text().as_str())?;
    Ok(Exit::Success)
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
