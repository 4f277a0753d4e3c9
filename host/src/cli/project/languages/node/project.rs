//! Recognising and building projects with a `package.json`.

use std::path::Path;

use super::engine::Engine;
use super::manifest::{MANIFEST, Manifest};
use super::{bundle, engine};
use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Options, Project};
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::text;

/// JavaScript.
pub static JAVASCRIPT: Language = Language {
    name: "javascript",
    title: "JavaScript",
    markers: &[MANIFEST],
    is_in: |folder| Manifest::is_of_robot(folder),
    open,
    compile: |project, _: &Options| compile(project),
    sources: SOURCES,
    tools: &[&NODE, &bundle::ESBUILD, &engine::COMPONENTIZE_QJS],
    check: None,
    setup: &["npm ci"],
};

/// TypeScript.
pub static TYPESCRIPT: Language = Language {
    name: "typescript",
    title: "TypeScript",
    markers: &[MANIFEST],
    is_in: |folder| folder.join("tsconfig.json").is_file() && Manifest::is_of_robot(folder),
    open,
    compile: |project, _: &Options| {
        NODE.find(None)?;
        check_types(project)?;
        compile(project)
    },
    sources: SOURCES,
    tools: &[&NODE, &TSC, &bundle::ESBUILD, &engine::COMPONENTIZE_QJS],
    check: None,
    setup: &["npm ci"],
};

const SOURCES: &[&str] = &["src", MANIFEST, "package-lock.json", "tsconfig.json"];

static NODE: Tool = Tool {
    name: "node",
    programs: &[Program::OnPath("node")],
    version_arguments: &["--version"],
    // The oldest that componentize-qjs takes is 18; the tests of the templates need this one.
    oldest: Version(20, 0, 0),
    tested: Version(20, 20, 2),
    install: "see https://nodejs.org/en/download",
};

static TSC: Tool = Tool {
    name: "tsc",
    programs: &[Program::Npm("tsc")],
    version_arguments: &["--version"],
    oldest: Version(5, 5, 0),
    tested: Version(7, 0, 2),
    install: "npm ci",
};

fn open(folder: &Path, language: &'static Language) -> Result<Project, Failure> {
    let manifest = Manifest::read(folder)?;
    Ok(Project {
        name: manifest.robot_name(folder),
        folder: folder.to_owned(),
        language,
    })
}

/// esbuild only removes types.
fn check_types(project: &Project) -> Result<(), Failure> {
    let tsc = TSC.find(Some(&project.folder))?;
    let mut command = tsc.command();
    command
        .args(["--noEmit", "--pretty", "false"])
        .current_dir(&project.folder);
    tsc.run(command, &text!("check the types of `{}`", project.name))
}

fn compile(project: &Project) -> Result<Vec<u8>, Failure> {
    NODE.find(None)?;
    let manifest = Manifest::read(&project.folder)?;
    let engine = Engine::of(&manifest)?;
    // What the engine needs is looked for first: it takes longest to install.
    engine.check(&project.folder)?;
    let bundle = bundle::make(project, &manifest)?;
    engine.componentize(project, &bundle)
}
