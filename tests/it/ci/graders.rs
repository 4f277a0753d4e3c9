//! The scripts for GitHub's runner, Gradescope, Slurm and Kubernetes, with the folders and
//! variables that these provide, and the real program where it matters.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;
use wasmouse_engine::bundled::find;

use super::installer::{Release, this_target};
use super::repository_file;
use crate::binary::{Ran, path, ran};

/// Wall followers do not finish this maze, and flood does.
const RUBRIC: &str = r#"
version = 1
name = "Test"

[[mazes]]
set = "one"
paths = ["test_maze_01"]

[[criteria]]
name = "Finishes"
points = 4
finished_percent = 100
"#;

/// Writes a shell script that can be run.
fn script(path: &Path, text: &str) {
    fs::write(path, format!("#!/bin/sh\n{text}\n")).expect("a file");
    let mode = fs::Permissions::from_mode(0o755);
    fs::set_permissions(path, mode).expect("its own file");
}

/// A script that is the real program.
fn real_program() -> String {
    format!("exec '{}' \"$@\"", path().display())
}

/// What Gradescope calls `/autograder`.
struct Autograder(TempDir);

impl Autograder {
    /// Set up with that program.
    fn new(program: &str) -> Self {
        let grader = Self(tempfile::tempdir().expect("a temporary folder"));
        for folder in ["source", "submission", "results"] {
            fs::create_dir(grader.path(folder)).expect("a folder");
        }
        fs::write(grader.path("source/rubric.toml"), RUBRIC).expect("a file");
        script(&grader.path("source/wasmouse"), program);
        grader
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, name: &str) -> Command {
        let mut command = Command::new("sh");
        command
            .arg(repository_file("docs/ci/gradescope").join(name))
            .env("WASMOUSE_AUTOGRADER", self.0.path())
            .env("WASMOUSE_CACHE", self.path("cache"))
            .env("WASMOUSE_SECONDS", "60");
        command
    }

    fn set_up(&self) {
        let ran = ran(self.command("setup.sh").stdout(Stdio::null()));
        assert!(ran.status.success(), "{}", ran.stderr);
    }

    fn submit(&self, name: &str, content: &[u8]) {
        fs::write(self.path("submission").join(name), content).expect("a file");
    }

    /// Grades what was submitted; the script itself never fails.
    fn grade(&self, command: &mut Command) -> Value {
        let ran = ran(command);
        assert!(ran.status.success(), "{}", ran.stderr);
        let results = fs::read_dir(self.path("results")).expect("a folder");
        assert_eq!(results.count(), 1, "only results.json");
        let text = fs::read(self.path("results/results.json")).expect("a file");
        serde_json::from_slice(&text).expect("JSON")
    }

    fn grades(&self) -> Value {
        self.grade(&mut self.command("run_autograder"))
    }
}

fn component(name: &str) -> &'static [u8] {
    find(name).expect("a bundled robot").component
}

/// The points of all tests together.
fn points(results: &Value) -> f64 {
    let tests = results["tests"].as_array().expect("tests");
    tests.iter().filter_map(|it| it["score"].as_f64()).sum()
}

#[test]
fn gradescope_gets_the_points_of_a_robot() {
    let grader = Autograder::new(&real_program());
    grader.set_up();
    grader.submit("robot.wasm", component("flood"));
    let results = grader.grades();
    assert!((points(&results) - 4.0).abs() < 1e-9, "{results}");

    // The next submission replaces it, whatever it is worth.
    grader.submit("robot.wasm", component("wall-follower"));
    assert!(points(&grader.grades()).abs() < 1e-9);
    grader.submit("robot.wasm", b"no robot");
    let results = grader.grades();
    assert!(points(&results).abs() < 1e-9, "{results}");
    assert!(results.to_string().contains("not WebAssembly"), "{results}");
}

/// A result for a submission that cannot be graded, which has to say this.
#[track_caller]
fn expect_message(results: &Value, message: &str) {
    assert_eq!(results["score"], 0, "{results}");
    let output = results["output"].as_str().expect("text");
    assert!(output.contains(message), "{results}");
}

#[test]
fn gradescope_gets_results_when_there_is_no_grade() {
    const NOT_FINISHED: &str = "This says nothing about your robot";

    let grader = Autograder::new(&real_program());
    grader.set_up();
    expect_message(&grader.grades(), "This submission has 0.");
    grader.submit("a.wasm", b"");
    grader.submit("b.wasm", b"");
    expect_message(&grader.grades(), "This submission has 2.");
    fs::remove_file(grader.path("submission/b.wasm")).expect("a file");
    fs::write(grader.path("source/rubric.toml"), "version = 7\n").expect("a file");
    expect_message(&grader.grades(), NOT_FINISHED);

    for program in [
        "kill -9 $$",
        "echo half >\"$5\"; exit 139",
        "exec sleep 600",
    ] {
        let program = format!("case $1 in --version) ;; *) {program} ;; esac");
        let grader = Autograder::new(&program);
        grader.set_up();
        grader.submit("robot.wasm", component("flood"));
        let mut command = grader.command("run_autograder");
        let results = grader.grade(command.env("WASMOUSE_SECONDS", "1"));
        expect_message(&results, NOT_FINISHED);
    }

    // Not even set up.
    let grader = Autograder::new("");
    grader.submit("robot.wasm", component("flood"));
    expect_message(&grader.grades(), NOT_FINISHED);
}

#[test]
fn gradescope_can_download_the_program() {
    let release = Release::new(&this_target(), "wasmouse 1.2.3");
    if Command::new("curl").arg("--version").output().is_err() {
        // The script would install it.
        return;
    }
    let grader = Autograder::new("");
    fs::remove_file(grader.path("source/wasmouse")).expect("a file");
    let installer = repository_file("install.sh");
    fs::copy(installer, grader.path("source/install.sh")).expect("a copy");
    let mut command = grader.command("setup.sh");
    let ran = ran(command.env("WASMOUSE_DOWNLOAD", release.address()));
    assert_eq!(ran.stdout, "wasmouse 1.2.3\n", "{}", ran.stderr);
}

/// What GitHub's runner provides to a step.
struct Runner(TempDir);

impl Runner {
    fn new() -> Self {
        let runner = Self(tempfile::tempdir().expect("a temporary folder"));
        fs::write(runner.path("rubric.toml"), RUBRIC).expect("a file");
        runner
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs a script of the action.
    fn run(&self, name: &str, variables: &[(&str, &str)]) -> Ran {
        for file in ["output", "summary"] {
            fs::write(self.path(file), "").expect("a file");
        }
        let script = repository_file(".github/actions/grade").join(name);
        ran(Command::new("sh")
            .arg(script)
            .current_dir(self.0.path())
            .env("GITHUB_OUTPUT", self.path("output"))
            .env("GITHUB_STEP_SUMMARY", self.path("summary"))
            .env("WASMOUSE_CACHE", self.path("cache"))
            .envs(variables.iter().copied()))
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a file")
    }
}

#[test]
fn the_action_grades_and_reports() {
    let runner = Runner::new();
    let program = path().display().to_string();
    let grade = |rubric, robots| {
        let variables = [
            ("RUBRIC", rubric),
            ("ROBOTS", robots),
            ("REPORTS", "reports"),
            ("WASMOUSE", &program),
        ];
        let ran = runner.run("grade.sh", &variables);
        // The step succeeds, so that reports are uploaded.
        assert!(ran.status.success(), "{}", ran.stderr);
        (ran.stdout, runner.read("output"))
    };
    let (_, output) = grade("rubric.toml", "flood\n");
    assert_eq!(output, "exit-code=0\n");
    assert!(runner.read("summary").contains("flood"));
    assert!(runner.read("reports/junit.xml").contains("Finishes"));

    let (stdout, output) = grade("rubric.toml", "flood\nwall-follower\n\n");
    assert_eq!(output, "exit-code=1\n");
    assert!(stdout.contains("::error"), "{stdout}");
    assert!(runner.read("summary").contains("1 of 2 robots passed"));

    fs::write(runner.path("robot.wasm"), "no robot").expect("a file");
    assert_eq!(grade("rubric.toml", "robot.wasm\n").1, "exit-code=4\n");

    let (stdout, output) = grade("nowhere.toml", "flood\n");
    assert_eq!(output, "exit-code=3\n");
    assert!(stdout.contains("::error title=wasmouse::"), "{stdout}");
}

#[test]
fn the_action_fails_by_the_exit_code() {
    let action = fs::read_to_string(repository_file(".github/actions/grade/action.yml"));
    let action: Value = serde_saphyr::from_str(&action.expect("a file")).expect("YAML");
    let steps = action["runs"]["steps"].as_array().expect("steps");
    let last = steps.last().and_then(|it| it["run"].as_str());
    let last = last.expect("a script");
    for (code, fail, expected) in [
        ("0", "true", 0),
        ("0", "false", 0),
        ("1", "true", 1),
        ("1", "false", 0),
        ("4", "true", 4),
        ("4", "false", 0),
        ("3", "false", 3),
        ("5", "false", 5),
        ("130", "false", 130),
    ] {
        let mut command = Command::new("sh");
        let ran = ran(command
            .args(["-ec", last])
            .env("CODE", code)
            .env("FAIL", fail));
        assert_eq!(ran.status.code(), Some(expected), "{code}, {fail}");
    }
    // A step before it that did not get as far as to say how it ended.
    let mut command = Command::new("sh");
    let ran = ran(command
        .args(["-ec", last])
        .env("CODE", "")
        .env("FAIL", "false"));
    assert!(!ran.status.success());
}

#[test]
fn the_action_installs_a_program_or_uses_the_one_that_is_there() {
    let runner = Runner::new();
    let release = Release::new(&this_target(), "wasmouse 1.2.3");
    let bin = runner.path("bin");
    fs::create_dir(&bin).expect("a folder");
    let search = std::env::var("PATH").expect("a path");
    // Without a folder that happens to have one.
    let search = search
        .split(':')
        .filter(|it| !Path::new(it).join("wasmouse").exists());
    let search: Vec<&str> = search.collect();
    let search = format!("{}:{}", bin.display(), search.join(":"));
    let says = |version| {
        let to = runner.path("to").display().to_string();
        let address = release.address();
        let ran = runner.run(
            "install.sh",
            &[
                ("TO", &to),
                ("PATH", &search),
                ("WASMOUSE_VERSION", version),
                ("WASMOUSE_REPOSITORY", ""),
                ("WASMOUSE_DOWNLOAD", &address),
                ("SERVER", "https://example.org"),
                ("ACTION_REPOSITORY", "a/b"),
            ],
        );
        assert!(ran.status.success(), "{}", ran.stderr);
        self::ran(Command::new(runner.path("to/wasmouse")).arg("--version")).stdout
    };
    assert_eq!(says(""), "wasmouse 1.2.3\n");
    script(&bin.join("wasmouse"), "echo another");
    assert_eq!(says(""), "another\n");
    assert_eq!(says("1.2.3"), "wasmouse 1.2.3\n");
}

/// A folder with a contest, and a `wasmouse` that is the real program in `bin`.
struct Machines(TempDir);

impl Machines {
    fn new() -> Self {
        let machines = Self(tempfile::tempdir().expect("a temporary folder"));
        let contest = "version = 1\n[[robots]]\nbundled = \"flood\"\n\
                       [[mazes]]\nset = \"all\"\npaths = [\"gen:tree:12:1..=9\"]\n";
        fs::write(machines.path("contest.toml"), contest).expect("a file");
        fs::create_dir(machines.path("bin")).expect("a folder");
        script(&machines.path("bin/wasmouse"), &real_program());
        machines
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs commands in the folder.
    fn run(&self, code: &str, environment: &[(&str, &str)]) {
        let search = std::env::var("PATH").expect("a path");
        let mut shell = Command::new("sh");
        shell.args(["-euc", code]).current_dir(self.0.path());
        shell.env("PATH", format!("{}:{search}", self.path("bin").display()));
        let ran = ran(shell.envs(environment.iter().copied()));
        assert!(ran.status.success(), "{code}: {}", ran.stderr);
    }

    /// The page that was written is that of a contest on one machine.
    fn assert_reported(&self) {
        self.run("wasmouse contest run --store one.db", &[]);
        self.run(
            "wasmouse contest report --store one.db --html one.html --force",
            &[],
        );
        let page = |name| fs::read_to_string(self.path(name)).expect("a page");
        // Not `assert_eq`, which would print both.
        assert!(page("contest.html") == page("one.html"));
    }
}

/// The commands of the steps of a job, without those that have a name: they install wasmouse.
fn commands(job: &Value) -> Vec<&str> {
    let steps = job["steps"].as_array().expect("steps").iter();
    let steps = steps.filter(|it| it.get("name").is_none());
    steps.filter_map(|it| it["run"].as_str()).collect()
}

#[test]
fn a_matrix_of_jobs_gives_the_page_of_one_machine() {
    let workflow = fs::read_to_string(repository_file("docs/ci/github-shards.yml"));
    let workflow: Value = serde_saphyr::from_str(&workflow.expect("a file")).expect("YAML");
    let (play, merge) = (&workflow["jobs"]["play"], &workflow["jobs"]["merge"]);
    let machines = Machines::new();
    let shards = play["strategy"]["matrix"]["shard"].as_array();
    let shards = shards.expect("a list");
    assert_eq!(play["env"]["SHARDS"], shards.len());
    let [command] = commands(play)[..] else {
        panic!("one command: {play}");
    };
    let number = shards.len().to_string();
    for shard in shards {
        let shard = shard.to_string();
        machines.run(command, &[("SHARD", &shard), ("SHARDS", &number)]);
    }
    let [command] = commands(merge)[..] else {
        panic!("one command: {merge}");
    };
    machines.run(command, &[]);
    machines.assert_reported();
}

#[test]
fn the_commands_for_several_machines_work() {
    let page = fs::read_to_string(repository_file("docs/CI.md")).expect("a file");
    let section = page.split("\n## ");
    let mut section = section.filter(|it| it.starts_with("Play a contest on several machines"));
    let section = section.next().expect("a section");
    let commands: Vec<&str> = section
        .lines()
        .filter_map(|it| it.strip_prefix("    "))
        .collect();
    assert_eq!(commands.len(), 4);
    let machines = Machines::new();
    machines.run(&commands.join("\n"), &[]);
    machines.assert_reported();

    // The last commands are in comments of the scripts, too.
    for script in ["docs/ci/slurm.sh", "docs/ci/kubernetes.yaml"] {
        let script = fs::read_to_string(repository_file(script)).expect("a file");
        let comments = script.lines().filter_map(|it| it.strip_prefix("#     "));
        let comments: Vec<&str> = comments.filter(|it| it.starts_with("wasmouse")).collect();
        assert_eq!(comments.len(), 2);
        fs::remove_file(machines.path("merged.db")).expect("a store");
        fs::remove_file(machines.path("contest.html")).expect("a page");
        machines.run(&comments.join("\n"), &[]);
        machines.assert_reported();
    }
}

/// A folder for `PATH` with a `wasmouse` that prints its arguments.
fn echo() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    script(&folder.path().join("wasmouse"), "echo \"$*\"");
    folder
}

fn with_echo(command: &mut Command) -> Ran {
    let folder = echo();
    let search = std::env::var("PATH").expect("a path");
    ran(command.env("PATH", format!("{}:{search}", folder.path().display())))
}

#[test]
fn cluster_jobs_play_their_shard() {
    let mut slurm = Command::new("sh");
    slurm.arg(repository_file("docs/ci/slurm.sh"));
    slurm.env("SLURM_ARRAY_TASK_ID", "3");
    slurm.env("SLURM_ARRAY_TASK_COUNT", "8");
    slurm.env("SLURM_CPUS_PER_TASK", "4");
    let expected = "contest run contest.toml --shard 3/8 --store shard-3.db --jobs 4\n";
    assert_eq!(with_echo(&mut slurm).stdout, expected);

    let job = fs::read_to_string(repository_file("docs/ci/kubernetes.yaml")).expect("a file");
    let job: Value = serde_saphyr::from_str(&job).expect("YAML");
    let pod = &job["spec"]["template"]["spec"];
    let container = &pod["containers"][0];
    let words = ["command", "args"].map(|key| container[key].as_array().expect("a list"));
    let words: Vec<&str> = words
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect();
    for (index, shard) in [("0", "1"), ("7", "8")] {
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).env("JOB_COMPLETION_INDEX", index);
        let expected =
            format!("contest run contest.toml --shard {shard}/8 --store shard-{shard}.db\n");
        assert_eq!(with_echo(&mut command).stdout, expected);
    }
    assert_eq!(job["spec"]["completions"], 8);
}
