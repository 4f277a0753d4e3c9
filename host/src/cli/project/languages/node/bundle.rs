//! One file of a robot's modules, by esbuild, with a table of where its lines come from.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::lines::Lines;
use super::manifest::{MANIFEST, Manifest};
use crate::cli::failure::Failure;
use crate::cli::project::files::Temporary;
use crate::cli::project::language::Project;
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// The bundler.
pub static ESBUILD: Tool = Tool {
    name: "esbuild",
    programs: &[Program::Npm("esbuild")],
    version_arguments: &["--version"],
    oldest: Version(0, 21, 0),
    tested: Version(0, 28, 2),
    install: "npm ci",
};

/// What a robot's module has to export.
const EXPORT: &str = "controller";

/// What esbuild says about a bundle.
#[derive(Deserialize)]
struct Metadata {
    outputs: std::collections::BTreeMap<String, Output>,
}

#[derive(Deserialize)]
struct Output {
    #[serde(default)]
    exports: Vec<String>,
}

/// The name of the file, which is part of the component, so it is always the same.
const NAME: &str = "robot.js";

/// A robot in one file.
pub struct Bundle {
    file: Temporary,
    /// `None` when esbuild's source map cannot be read.
    lines: Option<Lines>,
}

impl Bundle {
    /// The file.
    pub const fn file(&self) -> &Temporary {
        &self.file
    }

    /// A text about the bundle with the places of its sources.
    pub fn in_sources(&self, text: &str) -> String {
        match &self.lines {
            Some(lines) => lines.in_sources(text, NAME),
            None => text.to_owned(),
        }
    }
}

/// Bundles the robot.
pub fn make(project: &Project, manifest: &Manifest) -> Result<Bundle, Failure> {
    let folder = &project.folder;
    let entry = entry(folder, manifest)?;
    let esbuild = ESBUILD.find(Some(folder))?;
    let output = Temporary::new(NAME)?;
    let metadata = output.folder().join("metadata.json");
    let mut command = esbuild.command();
    command
        .arg(&entry)
        .args(["--bundle", "--format=esm", "--target=es2023"])
        // Neither a browser nor Node: their modules are not there.
        .args(["--platform=neutral", "--main-fields=module,main"])
        .args(["--external:wasmouse:*", "--sourcemap=external"])
        .args(["--log-level=warning"])
        .arg(with_path("--metafile=", &metadata))
        .arg(with_path("--outfile=", output.path()))
        .current_dir(folder);
    esbuild
        .run(command, &text!("bundle `{}`", project.name))
        .map_err(|failure| {
            failure.hint(
                "the messages of esbuild are above; a robot has neither the modules of Node nor \
                 those of a browser, so packages that need them cannot be used",
            )
        })?;
    check_exports(&metadata, folder, &entry)?;
    let lines = add_lines(&output, folder)?;
    Ok(Bundle {
        file: output,
        lines,
    })
}

fn with_path(option: &str, path: &Path) -> std::ffi::OsString {
    let mut argument = std::ffi::OsString::from(option);
    argument.push(path);
    argument
}

/// The module to begin with, relative to the project.
fn entry(folder: &Path, manifest: &Manifest) -> Result<PathBuf, Failure> {
    let candidates = match manifest.settings().0 {
        Some(entry) => vec![entry],
        None => vec!["src/controller.ts", "src/controller.js"],
    };
    let found = candidates.iter().find(|it| folder.join(it).is_file());
    let Some(found) = found else {
        return Err(Failure::input(text!(
            "`{}` has no file `{}`",
            Text::of_path(folder),
            candidates.join("`, `")
        ))
        .hint(text!(
            "it is the module that exports `{}`; name another one in {}: \
             \"wasmouse\": {{\"entry\": \"...\"}}",
            EXPORT,
            MANIFEST
        )));
    };
    Ok(PathBuf::from(found))
}

/// An engine makes a component of a bundle without the export, too, which then traps.
fn check_exports(metadata: &Path, folder: &Path, entry: &Path) -> Result<(), Failure> {
    let unreadable = |error: &dyn std::fmt::Display| {
        Failure::internal(text!("failed to read what esbuild reports: {}", error))
    };
    let text = std::fs::read_to_string(metadata).map_err(|error| unreadable(&error))?;
    let metadata: Metadata = serde_json::from_str(&text).map_err(|error| unreadable(&error))?;
    let exports: Vec<&str> = metadata
        .outputs
        .values()
        .flat_map(|it| &it.exports)
        .map(String::as_str)
        .collect();
    if exports.contains(&EXPORT) {
        return Ok(());
    }
    let exports = if exports.is_empty() {
        "nothing".to_owned()
    } else {
        format!("`{}`", exports.join("`, `"))
    };
    Err(Failure::robot(text!(
        "`{}` does not export `{}`; it exports {}",
        Text::of_path(folder.join(entry)),
        EXPORT,
        exports
    ))
    .hint("a robot exports an object `controller` with the functions `start` and `nextMove`"))
}

/// Appends the table by which the robot finds the lines of its sources. Without it, errors have
/// the lines of the bundle.
fn add_lines(bundle: &Temporary, folder: &Path) -> Result<Option<Lines>, Failure> {
    let map = bundle.path().with_extension("js.map");
    let map = std::fs::read_to_string(&map).unwrap_or_default();
    let code = String::from_utf8_lossy(&bundle.read()?).into_owned();
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let lines = Lines::read(&map, bundle.folder(), &folder);
    if let Some(lines) = &lines {
        let table = lines.table();
        bundle.write(&format!("{code}globalThis.wasmouseLines = {table};\n"))?;
    }
    Ok(lines)
}
