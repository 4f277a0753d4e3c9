//! Recognising and building projects in Python.

use std::fs;
use std::io;
use std::path::Path;

use serde::Deserialize;
use wasmouse_engine::admission::ROBOT_WIT;

use super::{messages, state};
use crate::cli::failure::Failure;
use crate::cli::project::files::{self, Temporary};
use crate::cli::project::language::{Language, Options, Project};
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// Python.
pub static LANGUAGE: Language = Language {
    name: "python",
    title: "Python",
    markers: &[MANIFEST],
    is_in,
    open,
    compile,
    sources: &["*.py", "wasmouse", "src", MANIFEST],
    tools: &[&COMPONENTIZE_PY],
    check: None,
    setup: &[
        "python3 -m venv .venv",
        ".venv/bin/pip install -r requirements.txt",
    ],
};

static COMPONENTIZE_PY: Tool = Tool {
    name: "componentize-py",
    programs: &[
        Program::Venv("componentize-py"),
        Program::OnPath("componentize-py"),
    ],
    version_arguments: &["--version"],
    // The first whose components take WASI 0.2.12, with Python 3.14.
    oldest: Version(0, 25, 0),
    tested: Version(0, 25, 1),
    install: "python3 -m venv .venv && .venv/bin/pip install -r requirements.txt",
};

const MANIFEST: &str = "pyproject.toml";

/// The module that is built unless the manifest says another.
const DEFAULT_MODULE: &str = "controller";

/// The part of a manifest that is needed here.
#[derive(Deserialize)]
struct Manifest {
    project: Option<Package>,
    tool: Option<Tools>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
}

#[derive(Deserialize)]
struct Tools {
    wasmouse: Option<Settings>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    module: Option<String>,
}

/// A project whose manifest has a table for wasmouse or needs componentize-py: any other program
/// has a `pyproject.toml`, too. A manifest that does not parse is looked at as text, so that its
/// mistake is reported.
fn is_in(folder: &Path) -> bool {
    fs::read_to_string(folder.join(MANIFEST))
        .is_ok_and(|text| text.contains("[tool.wasmouse]") || text.contains("componentize-py"))
}

fn open(folder: &Path, language: &'static Language) -> Result<Project, Failure> {
    let manifest = manifest(folder)?;
    let name = match manifest.project {
        Some(package) => package.name,
        None => {
            return Err(Failure::input(text!(
                "`{}` has no `[project]`",
                Text::of_path(folder.join(MANIFEST))
            ))
            .hint("add `[project]` with `name = \"my-robot\"`"));
        }
    };
    let folder = folder.to_owned();
    Ok(Project {
        folder,
        name,
        language,
    })
}

fn manifest(folder: &Path) -> Result<Manifest, Failure> {
    let path = folder.join(MANIFEST);
    toml::from_str(&files::read(&path)?).map_err(|error| {
        Failure::input(text!(
            "failed to parse `{}`: {}",
            Text::of_path(&path),
            Text::of_lines(error.to_string().trim_end())
        ))
        .hint("`wasmouse new my-robot --lang python` creates a project with a valid one")
    })
}

fn compile(project: &Project, _: &Options) -> Result<Vec<u8>, Failure> {
    let folder = &project.folder;
    let settings = manifest(folder)?.tool.and_then(|it| it.wasmouse);
    let module = settings.and_then(|it| it.module);
    let module = module.unwrap_or_else(|| DEFAULT_MODULE.to_owned());
    check_module(folder, &module)?;
    let tool = COMPONENTIZE_PY.find(Some(folder))?;
    let output = Temporary::new("robot.wasm")?;
    let wit = output.folder().join("robot.wit");
    // The interpreter writes compiled files beside the sources that it imports.
    let sources = output.folder().join("sources");
    fs::write(&wit, ROBOT_WIT)
        .and_then(|()| copy(folder, &sources))
        .map_err(|error| {
            Failure::internal(text!(
                "failed to copy `{}`: {}",
                Text::of_path(folder),
                error
            ))
        })?;
    let mut command = tool.command();
    command
        .arg("--quiet")
        .arg("--wit-path")
        .arg(&wit)
        .args(["--world", "robot", "componentize", "--python-path"])
        .arg(&sources)
        .arg("--output")
        .arg(output.path())
        .arg(&module)
        .current_dir(output.folder())
        .env("RUST_BACKTRACE", "0");
    // Packages that are installed into the project's environment can be imported.
    match folder.join(".venv").canonicalize() {
        Ok(environment) => command.env("VIRTUAL_ENV", environment),
        Err(_) => command.env_remove("VIRTUAL_ENV"),
    };
    match tool.run_quietly(command)? {
        Ok(()) => output.read(),
        Err(printed) => Err(messages::failure(project, &module, &printed)
            .unwrap_or_else(|| tool.failed_with(&text!("build `{}`", project.name), &printed))),
    }
}

/// The module is there and keeps nothing where it gets lost.
fn check_module(folder: &Path, module: &str) -> Result<(), Failure> {
    let relative = module.replace('.', "/");
    let candidates = [format!("{relative}.py"), format!("{relative}/__init__.py")];
    let Some(file) = candidates.iter().find(|it| folder.join(it).is_file()) else {
        return Err(Failure::input(text!(
            "`{}` has no module `{}`",
            Text::of_path(folder),
            module
        ))
        .hint(text!(
            "it is the module with the class `Controller`; name another one in {}: \
             [tool.wasmouse] module = \"...\"",
            MANIFEST
        )));
    };
    let path = folder.join(file);
    let text = files::read(&path)?;
    let problem = |line: usize, problem: Text| {
        Failure::robot(text!(
            "`{}`, line {}: {}",
            Text::of_path(&path),
            line,
            problem
        ))
    };
    match state::check(&text) {
        state::Found::Nothing => Ok(()),
        state::Found::NoController => Err(Failure::robot(text!(
            "`{}` has no class `Controller`",
            Text::of_path(&path)
        ))
        .hint("the host calls its methods `start` and `next_move`")),
        state::Found::State { line, name } => Err(problem(
            line,
            text!(
                "`self.{}` is lost: every call gets a new `Controller`",
                name
            ),
        )
        .hint("keep it in a variable of the module, as the template's controller.py does")),
    }
}

/// Copies what a robot may be made of, in the order of names: without environments, caches, tests
/// and results.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    let mut entries: Vec<_> = fs::read_dir(from)?.collect::<Result<_, _>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_left_out = name.starts_with('.')
            || ["__pycache__", "node_modules", "tests", "venv"].contains(&&*name)
            || name.ends_with(".wasm");
        let (path, copied) = (entry.path(), to.join(entry.file_name()));
        if is_left_out {
            continue;
        } else if entry.file_type()?.is_dir() {
            copy(&path, &copied)?;
        } else if path.is_file() {
            fs::copy(&path, copied)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(manifest: &str, module: &str, expected: &str) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(MANIFEST), manifest).unwrap();
        fs::write(folder.path().join("controller.py"), module).unwrap();
        assert!(is_in(folder.path()), "{manifest}");
        let failure = open(folder.path(), &LANGUAGE)
            .and_then(|project| compile(&project, &Options::default()))
            .unwrap_err()
            .to_string();
        assert!(failure.contains(expected), "{failure}");
        assert!(failure.contains("hint: "), "{failure}");
    }

    #[test]
    fn mistakes_are_found_before_the_tool_runs() {
        let table = "[project]\nname = \"x\"\n[tool.wasmouse]\n";
        check("[tool.wasmouse]\n[project\n", "", "line 2, column 9");
        check("[tool.wasmouse]\n", "", "has no `[project]`");
        check(&format!("{table}modul = 1\n"), "", "unknown field `modul`");
        check(
            &format!("{table}module = \"a.b\"\n"),
            "",
            "has no module `a.b`",
        );
        check(
            table,
            "class Robot:\n    pass\n",
            "has no class `Controller`",
        );
        let state = "class Controller:\n    def start(self, briefing):\n        self.x = 1\n";
        check(table, state, "line 3: `self.x` is lost");
    }

    #[test]
    fn other_programs_are_no_robots() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(MANIFEST), "[project]\nname = \"x\"\n").unwrap();
        assert!(!is_in(folder.path()));
    }

    #[test]
    fn environments_and_results_are_not_copied() {
        let (from, to) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        for file in [
            ".venv/a.py",
            "__pycache__/a.pyc",
            "tests/a.py",
            "x.wasm",
            "p/a.py",
            "a.py",
        ] {
            let path = from.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "").unwrap();
        }
        copy(from.path(), to.path()).unwrap();
        let mut copied: Vec<_> = fs::read_dir(to.path())
            .unwrap()
            .map(|it| it.unwrap().file_name())
            .collect();
        copied.sort();
        assert_eq!(copied, ["a.py", "p"]);
    }
}
