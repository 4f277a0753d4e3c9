//! WAT: a project is `robot.wat`, and wasmouse itself is the assembler.

use std::fs;

use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Project};
use crate::report::text::{Text, text};

/// WAT, the text format of WebAssembly.
pub static LANGUAGE: Language = Language {
    name: "wat",
    title: "WebAssembly text",
    markers: &[SOURCE],
    is_in: |folder| folder.join(SOURCE).is_file(),
    open: Project::named_after_folder,
    compile: |project, _| compile(project),
    sources: &[SOURCE],
    tools: &[],
    check: None,
    setup: &[],
};

const SOURCE: &str = "robot.wat";

/// The text as it is: `componentize` takes modules in text.
fn compile(project: &Project) -> Result<Vec<u8>, Failure> {
    let path = project.folder.join(SOURCE);
    fs::read(&path).map_err(|error| {
        Failure::input(text!(
            "failed to read `{}`: {}",
            Text::of_path(&path),
            error
        ))
    })
}
