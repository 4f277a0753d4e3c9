//! Recognising projects, and building them for whatever command takes a robot.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::language::{Language, Options, Project};
use super::languages::LANGUAGES;
use crate::cli::failure::Failure;
use crate::cli::output::{self, Existing};
use crate::report::text::{Text, text};

/// Finds out what kind of project a folder is.
///
/// # Errors
///
/// When it is none, or its manifest cannot be read.
pub fn find(folder: &Path) -> Result<Project, Failure> {
    match recognise(folder) {
        Some(language) => (language.open)(folder, language),
        None => Err(
            Failure::input(text!("`{}` is not a robot project", Text::of_path(folder))).hint(
                text!(
                    "a project has one of these files: {}; `wasmouse new my-robot` creates one",
                    markers()
                ),
            ),
        ),
    }
}

/// The files by which projects are recognised, as a list for messages.
fn markers() -> String {
    let mut markers: Vec<&str> = LANGUAGES
        .iter()
        .flat_map(|it| it.markers)
        .copied()
        .collect();
    markers.dedup();
    markers.join(", ")
}

fn recognise(folder: &Path) -> Option<&'static Language> {
    LANGUAGES
        .iter()
        .find(|language| (language.is_in)(folder))
        .copied()
}

/// Whether a folder is a robot project.
pub fn is_project(folder: &Path) -> bool {
    recognise(folder).is_some()
}

/// Builds a robot project and returns the path of its component.
///
/// # Errors
///
/// When it is not a robot project or does not compile.
pub fn build(folder: &Path) -> Result<PathBuf, Failure> {
    let project = find(folder)?;
    let component = project.build(&Options::default())?;
    let path = project.component();
    output::save(&path, &component, Existing::Replace)?;
    Ok(path)
}

/// A source file of the project that was changed after the component was built.
pub fn newer_source(folder: &Path, component: &Path) -> Option<PathBuf> {
    let language = recognise(folder)?;
    let built = modified(component)?;
    let sources = files(folder, language);
    let is_newer = |path: &PathBuf| modified(path).is_some_and(|it| it > built);
    sources.into_iter().find(is_newer)
}

/// The source files of a project or the file at `path`, with the times when they were changed.
///
/// # Errors
///
/// When the folder is not a robot project.
pub fn sources(path: &Path) -> Result<Vec<(PathBuf, SystemTime)>, Failure> {
    let mut files = if path.is_dir() {
        files(path, find(path)?.language)
    } else {
        vec![path.to_owned()]
    };
    files.sort();
    let with_time = |path: PathBuf| modified(&path).map(|time| (path, time));
    Ok(files.into_iter().filter_map(with_time).collect())
}

fn modified(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|it| it.modified()).ok()
}

/// The files that the component of a project depends on.
fn files(folder: &Path, language: &Language) -> Vec<PathBuf> {
    let mut left: Vec<PathBuf> = Vec::new();
    for source in language.sources {
        match source.strip_prefix('*') {
            None => left.push(folder.join(source)),
            Some(ending) => left.extend(files_ending_in(folder, ending)),
        }
    }
    let mut files = Vec::new();
    while let Some(path) = left.pop() {
        match fs::read_dir(&path) {
            Ok(entries) => left.extend(entries.filter_map(|it| Some(it.ok()?.path()))),
            Err(_) => files.push(path),
        }
    }
    files
}

fn files_ending_in(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let ends = |it: &fs::DirEntry| it.file_name().to_string_lossy().ends_with(ending);
    entries.filter(ends).map(|it| it.path()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_without_a_project_are_rejected() {
        let folder = tempfile::tempdir().unwrap();
        let failure = find(folder.path()).err().unwrap().to_string();
        assert!(failure.contains("is not a robot project"), "{failure}");
        assert!(failure.contains("Cargo.toml"), "{failure}");
        assert!(!is_project(folder.path()));
    }

    #[test]
    fn languages_have_names_of_their_own() {
        for (index, language) in LANGUAGES.iter().enumerate() {
            let same = |it: &&&Language| it.name == language.name;
            assert_eq!(
                LANGUAGES.iter().filter(same).count(),
                1,
                "{}",
                language.name
            );
            assert!(!language.markers.is_empty(), "{index}");
            assert!(!language.sources.is_empty(), "{index}");
        }
    }
}
