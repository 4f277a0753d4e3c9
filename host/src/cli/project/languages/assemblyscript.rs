//! AssemblyScript: a project has an `asconfig.json`, and its compiler comes from npm.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Project};
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// AssemblyScript.
pub static LANGUAGE: Language = Language {
    name: "assemblyscript",
    title: "AssemblyScript",
    markers: &[CONFIGURATION],
    is_in: |folder| folder.join(CONFIGURATION).is_file(),
    open,
    compile: |project, _| compile(project),
    sources: &["assembly", "wasmouse", CONFIGURATION, "package-lock.json"],
    tools: &[&NODE, &ASC],
    check: None,
    setup: &["npm ci"],
};

const CONFIGURATION: &str = "asconfig.json";
const MANIFEST: &str = "package.json";

/// The target in the configuration that is built.
const TARGET: &str = "release";

/// The file with the robot.
const ENTRY: &str = "assembly/index.ts";

static NODE: Tool = Tool {
    name: "node",
    programs: &[Program::OnPath("node")],
    version_arguments: &["--version"],
    oldest: Version(20, 0, 0),
    tested: Version(20, 20, 2),
    install: "https://nodejs.org/en/download, or on Debian: apt-get install nodejs npm",
};

static ASC: Tool = Tool {
    name: "asc",
    programs: &[Program::Npm("asc")],
    version_arguments: &["--version"],
    oldest: Version(0, 27, 0),
    tested: Version(0, 28, 20),
    install: "npm ci",
};

/// The part of `package.json` that is needed here.
#[derive(Deserialize)]
struct Package {
    name: String,
}

fn open(folder: &Path, language: &'static Language) -> Result<Project, Failure> {
    let path = folder.join(MANIFEST);
    let read = fs::read_to_string(&path).map_err(|error| {
        Failure::input(text!(
            "failed to read `{}`: {}",
            Text::of_path(&path),
            error
        ))
    });
    let package: Package = serde_json::from_str(&read?).map_err(|error| {
        Failure::input(text!(
            "failed to parse `{}`: {}",
            Text::of_path(&path),
            error
        ))
        .hint("it has to be a JSON object with a \"name\"")
    })?;
    Ok(Project {
        folder: folder.to_owned(),
        name: package.name,
        language,
    })
}

/// Runs `asc`; its diagnostics go to stderr as they come.
fn compile(project: &Project) -> Result<Vec<u8>, Failure> {
    NODE.find(None)?;
    let asc = ASC.find(Some(&project.folder))?;
    if !project.folder.join(ENTRY).is_file() {
        return Err(Failure::input(text!(
            "`{}` has no {}",
            Text::of_path(&project.folder),
            ENTRY
        ))
        .hint("that is the file that `asc` compiles: it exports `start` and `next_move`"));
    }
    let scratch = tempfile::tempdir()
        .map_err(|error| Failure::internal(text!("no temporary folder: {}", error)))?;
    let module = scratch.path().join("robot.wasm");
    let mut command = asc.command();
    command
        .args([ENTRY, "--target", TARGET, "--outFile"])
        .arg(&module)
        .current_dir(&project.folder);
    asc.run(command, &text!("compile `{}`", project.name))?;
    fs::read(&module).map_err(|error| Failure::input(text!("asc wrote no module: {}", error)))
}
