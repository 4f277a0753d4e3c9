//! [`Engine`]: the JavaScript engines that run a robot in WebAssembly.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use wasmouse_engine::admission::ROBOT_WIT;

use super::bundle::Bundle;
use super::manifest::{MANIFEST, Manifest};
use crate::cli::failure::Failure;
use crate::cli::project::files::Temporary;
use crate::cli::project::language::Project;
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// Makes a component with QuickJS. It does not print its version.
pub static COMPONENTIZE_QJS: Tool = Tool {
    name: "componentize-qjs",
    programs: &[Program::Npm("componentize-qjs")],
    version_arguments: &["--help"],
    oldest: QJS_OLDEST,
    tested: Version(0, 4, 5),
    install: "npm ci",
};

/// The first with `--sync`.
const QJS_OLDEST: Version = Version(0, 4, 0);

/// Runs the script below; componentize-js is a package without a program.
static NODE_FOR_STARLINGMONKEY: Tool = Tool {
    name: "componentize-js",
    programs: &[Program::OnPath("node")],
    version_arguments: &["--version"],
    oldest: Version(20, 0, 0),
    tested: Version(20, 20, 2),
    install: "see https://nodejs.org/en/download",
};

const STARLINGMONKEY_PACKAGE: &str = "@bytecodealliance/componentize-js";

/// The features that are left out need a network, which a robot does not have.
const STARLINGMONKEY_SCRIPT: &str = r#"
import { readFile, writeFile } from "node:fs/promises";
import { componentize } from "@bytecodealliance/componentize-js";
const [source, wit, output] = process.argv.slice(1);
const { component } = await componentize(await readFile(source, "utf8"), {
  witPath: wit,
  worldName: "robot",
  sourceName: "robot.js",
  disableFeatures: ["http", "fetch-event"],
});
await writeFile(output, component);
"#;

/// What runs the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Small and quick to build.
    QuickJs,
    /// The engine of Firefox: complete, large and slower in WebAssembly.
    StarlingMonkey,
}

/// The manifest of an installed package.
#[derive(Deserialize)]
struct Installed {
    version: String,
}

impl Engine {
    /// The one that the manifest asks for.
    pub fn of(manifest: &Manifest) -> Result<Self, Failure> {
        let name = manifest.settings().1;
        match name {
            Some("quickjs") => Ok(Self::QuickJs),
            Some("starlingmonkey") => Ok(Self::StarlingMonkey),
            None if manifest.needs(STARLINGMONKEY_PACKAGE) => Ok(Self::StarlingMonkey),
            None => Ok(Self::QuickJs),
            Some(other) => Err(Failure::input(text!(
                "`{}` names the engine `{}`, which there is not",
                MANIFEST,
                other
            ))
            .hint("the engines are quickjs and starlingmonkey")),
        }
    }

    const fn package(self) -> (&'static str, Version, &'static str) {
        match self {
            Self::QuickJs => ("componentize-qjs", QJS_OLDEST, "0.4.5"),
            Self::StarlingMonkey => (STARLINGMONKEY_PACKAGE, Version(0, 19, 0), "0.23.0"),
        }
    }

    /// Whether its package is installed in a project.
    ///
    /// # Errors
    ///
    /// When it is not, or too old.
    pub fn check(self, folder: &Path) -> Result<(), Failure> {
        let (package, oldest, tested) = self.package();
        let manifest = folder.join("node_modules").join(package).join(MANIFEST);
        let installed = fs::read_to_string(manifest)
            .ok()
            .and_then(|text| serde_json::from_str::<Installed>(&text).ok());
        let is_listed = Manifest::read(folder)?.needs(package);
        // componentize-js imports a package that it does not name among those that it needs.
        let with = match self {
            Self::QuickJs => "",
            Self::StarlingMonkey => " @bytecodealliance/preview2-shim@0.26.0",
        };
        let install = text!(
            "npm install --save-dev --save-exact {}@{}{}",
            package,
            tested,
            with
        );
        match installed {
            None if is_listed => Err(Failure::input(text!("{} is not installed", package))
                .hint(text!("run `npm ci` in `{}`", Text::of_path(folder)))),
            None => Err(Failure::input(text!(
                "`{}` does not need {}",
                Text::of_path(folder.join(MANIFEST)),
                package
            ))
            .hint(text!("run `{}` in `{}`", install, Text::of_path(folder)))),
            Some(it) if Version::find(&it.version).is_some_and(|it| it < oldest) => {
                Err(Failure::input(text!(
                    "{} {} is too old; {} or later is needed",
                    package,
                    it.version,
                    oldest
                ))
                .hint(text!("run `{}` in `{}`", install, Text::of_path(folder))))
            }
            Some(_) => Ok(()),
        }
    }

    /// Makes a component of a bundle. The robot's modules run while it is made.
    pub fn componentize(self, project: &Project, bundle: &Bundle) -> Result<Vec<u8>, Failure> {
        let file = bundle.file();
        let output = Temporary::new("robot.wasm")?;
        let wit = Temporary::with("robot.wit", ROBOT_WIT)?;
        let (tool, command) = match self {
            Self::QuickJs => {
                let tool = COMPONENTIZE_QJS.find(Some(&project.folder))?;
                let mut command = tool.command();
                // Without `--sync`, the component would need asynchronous calls.
                command
                    .args(["--sync", "--world", "robot", "--wit"])
                    .arg(wit.path());
                command.arg("--js").arg(file.path());
                command.arg("--output").arg(output.path());
                command.current_dir(file.folder());
                (tool, command)
            }
            Self::StarlingMonkey => {
                let tool = NODE_FOR_STARLINGMONKEY.find(Some(&project.folder))?;
                let mut command = tool.command();
                command
                    .args(["--input-type=module", "--eval", STARLINGMONKEY_SCRIPT])
                    .args([file.path(), wit.path(), output.path()])
                    // Node looks for packages from here on.
                    .current_dir(&project.folder);
                (tool, command)
            }
        };
        match tool.run_quietly(command)? {
            Ok(()) => output.read(),
            Err(printed) => {
                let printed = bundle.in_sources(&printed);
                Err(failure(project, &printed).unwrap_or_else(|| {
                    let purpose = text!("make a component of `{}`", project.name);
                    tool.failed_with(&purpose, &printed)
                }))
            }
        }
    }
}

/// The failure that is meant, if the robot's modules threw as they were imported.
fn failure(project: &Project, printed: &str) -> Option<Failure> {
    const MARKS: [&str; 2] = [
        "Failed to finish JavaScript module evaluation: ",
        "Exception while evaluating top-level script\n",
    ];
    let mark = MARKS.iter().find(|it| printed.contains(**it))?;
    let (_, error) = printed.split_once(mark)?;
    // The script that runs the engine is nothing of the robot's.
    let is_of_robot =
        |line: &&str| !line.contains("(file://") && !line.contains("at async file://");
    let lines = error.lines().filter(is_of_robot);
    let lines: Vec<&str> = lines
        .take_while(|it| !it.starts_with("Node.js v"))
        .collect();
    let error = lines.join("\n");
    Some(
        Failure::robot(text!(
            "`{}` failed as its modules were imported: {}",
            project.name,
            Text::of_lines(error.trim())
        ))
        .hint(
            "modules are evaluated while the robot is built, where the host is not there; do such \
             work in `start`",
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(manifest: &str, package_version: Option<&str>, expected: &str) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(MANIFEST), manifest).unwrap();
        if let Some(version) = package_version {
            let package = folder.path().join("node_modules/componentize-qjs");
            fs::create_dir_all(&package).unwrap();
            let text = format!("{{\"version\": \"{version}\"}}");
            fs::write(package.join(MANIFEST), text).unwrap();
        }
        let manifest = Manifest::read(folder.path()).unwrap();
        let result = Engine::of(&manifest).and_then(|engine| engine.check(folder.path()));
        let text = result.map_or_else(|failure| failure.to_string(), |()| "ok".to_owned());
        assert!(text.contains(expected), "{text}");
    }

    #[test]
    fn what_is_not_installed_is_named_with_its_command() {
        let listed = r#"{"devDependencies": {"componentize-qjs": "0.4.5"}}"#;
        check(listed, None, "run `npm ci` in");
        check(listed, Some("0.4.5"), "ok");
        check(listed, Some("0.3.1"), "0.3.1 is too old; 0.4.0 or later");
        let table = r#"{"wasmouse": {}}"#;
        check(table, None, "--save-exact componentize-qjs@0.4.5`");
        let engine = r#"{"wasmouse": {"engine": "v8"}}"#;
        check(engine, None, "names the engine `v8`");
        let engine = r#"{"wasmouse": {"engine": "starlingmonkey"}}"#;
        check(
            engine,
            None,
            "componentize-js@0.23.0 @bytecodealliance/preview2-shim@0.26.0`",
        );
    }

    #[test]
    fn errors_of_modules_are_told_from_those_of_tools() {
        let project = Project {
            folder: "bot".into(),
            name: "bot".to_owned(),
            language: &super::super::JAVASCRIPT,
        };
        let printed = "componentize-qjs\nError: : Failed to evaluate user JavaScript module: Failed \
            to finish JavaScript module evaluation: Error: at import\n    at <anonymous> (/bad2.js:1:40)\n";
        let found = failure(&project, printed).unwrap().to_string();
        assert!(found.contains("imported: Error: at import"), "{found}");
        let printed = "Exception while evaluating top-level script\nsrc/robot.js:415 Error: x\n    \
            at componentize (file:///home/bot/componentize.js:365:11)\n    at async \
            file:///home/bot/[eval1]:5:23\n\nNode.js v20.20.2\n";
        let found = failure(&project, printed).unwrap();
        assert!(
            found
                .message()
                .as_str()
                .ends_with("imported: src/robot.js:415 Error: x")
        );
        assert!(failure(&project, "no such file").is_none());
    }
}
