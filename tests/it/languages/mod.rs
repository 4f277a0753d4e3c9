//! Robots in every language: `new`, `build`, `run`, and their own tests, with the real tools.
//!
//! The tools come from `cargo xtask languages`; a test of a language without them is skipped with
//! a line on stderr.

mod broken;
mod documentation;
mod dynamic;
mod dynamic_broken;
mod native;
mod prebuilt;
mod rust_std;
mod vectors;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use xtask::languages::{Environment, Kit, STARLINGMONKEY};

use crate::binary::{Ran, path, ran, stdout_of, wasmouse};

/// The name of the projects here.
pub const NAME: &str = "mouse";

/// A new project in a temporary folder, with the tools of its language.
pub struct Project {
    parent: TempDir,
    environment: Environment,
    language: &'static str,
}

/// Creates a project for the test of that name and runs the commands that `wasmouse new` prints
/// for setting it up; `None` where the tools of the language are missing.
pub fn project(language: &'static str, test: &str) -> Option<Project> {
    let environment = Kit::of(language).find(&xtask::repository(), test)?;
    let project = Project {
        parent: tempfile::tempdir().expect("a temporary folder"),
        environment,
        language,
    };
    let is_other_engine = language == "starlingmonkey";
    let lang = match language {
        "starlingmonkey" => "javascript",
        "rust-wasip1" | "rust-wasip2" => "rust",
        language => language,
    };
    let mut new = wasmouse();
    new.args(["new", NAME, "--lang", lang]);
    let printed = stdout_of(project.in_folder(&mut new, project.parent.path()));
    if is_other_engine {
        for file in ["package.json", "package-lock.json"] {
            let from = xtask::repository().join(STARLINGMONKEY).join(file);
            fs::copy(from, project.folder().join(file)).expect("a file of the engine");
        }
    }
    // The tool of Python is on the search path already, and has nothing to install.
    if language == "python" {
        return Some(project);
    }
    for line in printed.lines().map(str::trim) {
        let setup = line.strip_prefix('(').and_then(|it| it.strip_suffix(')'));
        if let Some(setup) = setup.and_then(|it| it.split_once(" && ")) {
            project.succeed(setup.1);
        }
    }
    Some(project)
}

impl Project {
    /// Its folder.
    pub fn folder(&self) -> PathBuf {
        self.parent.path().join(NAME)
    }

    /// Runs a command in a folder, with the tools of the language.
    fn in_folder<'a>(&self, command: &'a mut Command, folder: &Path) -> &'a mut Command {
        command
            .current_dir(folder)
            .envs(self.environment.iter().cloned())
            .env("WASMOUSE_CACHE", self.parent.path().join("cache"))
            // The target folder of this repository may be in use by the cargo that runs this test.
            .env("CARGO_TARGET_DIR", self.parent.path().join("target"))
    }

    /// Calls wasmouse in the project's folder; the arguments are separated by spaces.
    pub fn wasmouse(&self, arguments: &str) -> Ran {
        let mut command = wasmouse();
        command.args(arguments.split_whitespace());
        ran(self.in_folder(&mut command, &self.folder()))
    }

    /// Runs a line of the shell in the project's folder; it has to succeed. `wasmouse` is on its
    /// search path.
    #[track_caller]
    pub fn succeed(&self, line: &str) -> String {
        let (shell, option) = if cfg!(windows) {
            ("cmd", "/C")
        } else {
            ("sh", "-c")
        };
        let mut command = Command::new(shell);
        command.args([option, line]);
        let mut search_path = OsString::from(path().parent().expect("a folder"));
        let separator = if cfg!(windows) { ";" } else { ":" };
        if let Some((_, rest)) = self.environment.iter().find(|(name, _)| *name == "PATH") {
            search_path.push(separator);
            search_path.push(rest);
        }
        let command = self.in_folder(&mut command, &self.folder());
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(command.env("PATH", search_path));
        assert!(status.success(), "{line}: {status}\n{stdout}{stderr}");
        stdout
    }

    /// Builds it and returns the component.
    #[track_caller]
    pub fn build(&self) -> Vec<u8> {
        let Ran { status, stderr, .. } = self.wasmouse("build --no-match");
        assert!(status.success(), "{}: {stderr}", self.language);
        fs::read(self.component()).expect("a component")
    }

    /// Where its component is.
    pub fn component(&self) -> PathBuf {
        self.folder().join(NAME).with_extension("wasm")
    }

    /// The number of the first line with a text in a file of the project, from 1.
    #[track_caller]
    pub fn line_of(&self, file: &str, part: &str) -> usize {
        let text = fs::read_to_string(self.folder().join(file)).expect("a file of the project");
        let line = text.lines().position(|line| line.contains(part));
        line.expect("a line with that text") + 1
    }

    /// Replaces the only occurrence of a text in a file of the project.
    #[track_caller]
    pub fn patch(&self, file: &str, from: &str, to: &str) {
        let path = self.folder().join(file);
        let text = fs::read_to_string(&path).expect("a file of the project");
        assert_eq!(text.matches(from).count(), 1, "{file}: {from}");
        fs::write(path, text.replace(from, to)).expect("the file can be written");
    }

    /// The records of matches in these mazes, of the built robot or a bundled one.
    #[track_caller]
    pub fn records(&self, robot: &str, mazes: &[String]) -> Vec<Value> {
        let mut command = wasmouse();
        command.args(["run", robot, "--json"]).args(mazes);
        let Ran { stdout, stderr, .. } = ran(self.in_folder(&mut command, &self.folder()));
        let results: Value = serde_json::from_str(&stdout)
            .unwrap_or_else(|error| panic!("{}: {error}\n{stdout}{stderr}", self.language));
        let records = results["matches"].as_array().expect("matches");
        assert_eq!(records.len(), count(mazes), "{stderr}");
        records.clone()
    }

    /// Checks that its robot answers as the bundled one does, in each step.
    #[track_caller]
    pub fn drives_as(&self, bundled: &str, mazes: &[String]) {
        let ours = self.records(&format!("{NAME}.wasm"), mazes);
        let theirs = self.records(bundled, mazes);
        for (ours, theirs) in ours.iter().zip(&theirs) {
            assert_eq!(ours["key"]["maze"], theirs["key"]["maze"]);
            // The transcript has every answer.
            for field in ["verdict", "steps", "counts", "transcript"] {
                let maze = &ours["key"]["maze"];
                assert_eq!(ours[field], theirs[field], "{} {maze}", self.language);
            }
        }
    }
}

/// How many mazes that is.
fn count(mazes: &[String]) -> usize {
    let count = |maze: &String| match maze.split_once("..=") {
        Some((_, last)) => last.parse().expect("a number"),
        None => 1,
    };
    mazes.iter().map(count).sum()
}

/// 100 generated mazes, from small to large.
pub fn generated_mazes() -> Vec<String> {
    let mazes = [
        "gen:tree:12:1..=20",
        "gen:tree:20:1..=10",
        "gen:braid:12:1..=20",
        "gen:braid:16:1..=20",
        "gen:braid:20:1..=10",
        "gen:division:16:1..=20",
    ];
    let mazes: Vec<String> = mazes.map(str::to_owned).into();
    assert_eq!(count(&mazes), 100);
    mazes
}

/// The three mazes of the contest.
#[cfg(shared_material)]
pub fn official_mazes() -> Vec<String> {
    let folder = crate::shared::shared().join("mazes/udacity");
    let path = |number| folder.join(format!("test_maze_0{number}.txt"));
    (1..=3)
        .map(|number| path(number).to_str().expect("a name in UTF-8").to_owned())
        .collect()
}

/// Whether the official mazes are there; if not, says that a part of a test is skipped.
#[cfg(not(shared_material))]
pub fn official_mazes() -> Vec<String> {
    use std::io::Write as _;
    // `eprintln!` would be captured.
    let _ = writeln!(
        std::io::stderr(),
        "skipped the official mazes: set WASMOUSE_SHARED"
    );
    Vec::new()
}

/// Everything that holds for every language: a new project builds to the same bytes in any folder
/// (unless its tools are not `reproducible`), it drives as the bundled robot in all mazes, and the
/// doctor finds its tools.
pub fn is_complete(project: &Project, bundled: &str, reproducible: bool) {
    let Ran { status, stderr, .. } = project.wasmouse("build");
    assert!(status.success(), "{}: {stderr}", project.language);
    let component = fs::read(project.component()).expect("a component");
    let mazes = [official_mazes(), generated_mazes()].concat();
    project.drives_as(bundled, &mazes);
    let doctor = project.wasmouse(&format!("doctor {}", project.language));
    assert!(doctor.status.success(), "{}", doctor.stdout);
    if reproducible {
        let other = self::project(project.language, "the second build").expect("the same tools");
        let elsewhere = other.folder().parent().expect("a folder").join("a/b");
        fs::create_dir_all(&elsewhere).expect("a folder");
        let moved = elsewhere.join(NAME);
        fs::rename(other.folder(), &moved).expect("on the same file system");
        let mut command = wasmouse();
        command.args(["build", "--no-match", "--output", "again.wasm"]);
        stdout_of(other.in_folder(&mut command, &moved));
        let again = fs::read(moved.join("again.wasm")).expect("a component");
        assert!(
            again == component,
            "{}: two builds differ",
            project.language
        );
    }
    let Ran { status, stdout, .. } = project.wasmouse("run . test_maze_01");
    let is_scored = bundled == "wall-follower" || stdout.contains("finished");
    assert!(status.code().is_some() && is_scored, "{stdout}");
}
