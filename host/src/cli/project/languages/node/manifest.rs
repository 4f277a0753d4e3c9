//! The `package.json` of a robot.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::cli::failure::Failure;
use crate::cli::project::files;
use crate::report::text::{Text, text};

/// The file's name.
pub const MANIFEST: &str = "package.json";

/// The packages that make components of JavaScript: evidence that a project is a robot.
const ENGINES: [&str; 2] = ["componentize-qjs", "@bytecodealliance/componentize-js"];

/// The part of a manifest that is needed here.
#[derive(Debug, Default, Deserialize)]
pub struct Manifest {
    name: Option<String>,
    #[serde(default)]
    dependencies: BTreeMap<String, serde_json::Value>,
    #[serde(default, rename = "devDependencies")]
    dev_dependencies: BTreeMap<String, serde_json::Value>,
    wasmouse: Option<Settings>,
}

/// The table for wasmouse.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The module that exports `controller`.
    pub entry: Option<String>,
    /// `quickjs` or `starlingmonkey`.
    pub engine: Option<String>,
}

impl Manifest {
    /// Whether a folder has a robot: a manifest with a table for wasmouse, or one that needs a
    /// package that makes components. A manifest that does not parse is looked at as text, so
    /// that its mistake is reported.
    pub fn is_of_robot(folder: &Path) -> bool {
        let Ok(text) = fs::read_to_string(folder.join(MANIFEST)) else {
            return false;
        };
        match serde_json::from_str::<Self>(&text) {
            // AssemblyScript has manifests of its own.
            Ok(it) => !it.needs("assemblyscript") && it.is_robot(),
            Err(_) => text.contains("\"wasmouse\"") || ENGINES.iter().any(|it| text.contains(it)),
        }
    }

    /// Reads the manifest of a project.
    ///
    /// # Errors
    ///
    /// When it cannot be read or parsed.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join(MANIFEST);
        serde_json::from_str(&files::read(&path)?).map_err(|error| {
            Failure::input(text!(
                "failed to parse `{}`: {}",
                Text::of_path(&path),
                error
            ))
            .hint(
                "`wasmouse new my-robot --lang javascript` creates a project with a valid one; \
                 its table `wasmouse` has `entry` and `engine`",
            )
        })
    }

    /// The name without its scope, or that of the folder.
    pub fn robot_name(&self, folder: &Path) -> String {
        let name = self.name.as_deref().unwrap_or_default();
        match name.rsplit('/').next() {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => {
                let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
                let name = folder.file_name().unwrap_or_default();
                name.to_string_lossy().into_owned()
            }
        }
    }

    /// What the table for wasmouse says, or nothing.
    pub fn settings(&self) -> (Option<&str>, Option<&str>) {
        let settings = self.wasmouse.as_ref();
        settings.map_or((None, None), |it| {
            (it.entry.as_deref(), it.engine.as_deref())
        })
    }

    /// Whether a package is among its dependencies.
    pub fn needs(&self, package: &str) -> bool {
        self.dependencies.contains_key(package) || self.dev_dependencies.contains_key(package)
    }

    fn is_robot(&self) -> bool {
        self.wasmouse.is_some() || ENGINES.iter().any(|it| self.needs(it))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(manifest: &str, expected: bool) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(MANIFEST), manifest).unwrap();
        assert_eq!(Manifest::is_of_robot(folder.path()), expected, "{manifest}");
    }

    #[test]
    fn other_packages_are_no_robots() {
        check("{}", false);
        check(r#"{"dependencies": {"left-pad": "1"}}"#, false);
        check(
            r#"{"devDependencies": {"componentize-qjs": "0.4.5"}}"#,
            true,
        );
        check(
            r#"{"dependencies": {"@bytecodealliance/componentize-js": "1"}}"#,
            true,
        );
        check(r#"{"wasmouse": {}}"#, true);
        check(
            r#"{"wasmouse": {}, "devDependencies": {"assemblyscript": "1"}}"#,
            false,
        );
        check(r#"{"wasmouse": {"#, true);
        check("{", false);
    }

    #[test]
    fn mistakes_have_a_place() {
        let folder = tempfile::tempdir().unwrap();
        let read = |manifest: &str| {
            fs::write(folder.path().join(MANIFEST), manifest).unwrap();
            Manifest::read(folder.path())
        };
        let failure = read("{\n  \"name\": \"x\"\n  \"type\": 1\n}")
            .unwrap_err()
            .to_string();
        assert!(failure.contains("line 3 column 3"), "{failure}");
        let failure = read(r#"{"wasmouse": {"motor": 1}}"#)
            .unwrap_err()
            .to_string();
        assert!(failure.contains("unknown field `motor`"), "{failure}");
        let scoped = read(r#"{"name": "@me/mouse"}"#).unwrap();
        assert_eq!(scoped.robot_name(folder.path()), "mouse");
        let unnamed = read("{}").unwrap().robot_name(folder.path());
        assert_eq!(Some(unnamed.as_ref()), folder.path().file_name());
    }
}
