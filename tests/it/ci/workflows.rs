//! Workflows and other YAML: they parse, fit the schemas of their services, take actions only by
//! commit, and call `wasmouse` and `cargo xtask` with arguments that exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use xtask::validators::Validator;

use super::repository_file;
use crate::binary::{path, ran};

/// Folders with YAML files, scripts or both.
const FOLDERS: [&str; 10] = [
    ".github/workflows",
    ".github/actions/grade",
    "docs/ci",
    "docs/ci/gradescope",
    "host/templates/new",
    "example-robots/languages/assemblyscript/.github/workflows",
    "example-robots/languages/c/.github/workflows",
    "example-robots/languages/cpp/.github/workflows",
    "example-robots/languages/wat/.github/workflows",
    "example-robots/languages/zig/.github/workflows",
];

/// Where the workflow for repositories of robots leaves a name and a commit to be filled in.
const PLACEHOLDER: &str = "OWNER/NAME/.github/actions/grade@COMMIT";

fn files(is_wanted: fn(&Path) -> bool) -> Vec<PathBuf> {
    let entries = FOLDERS.iter().flat_map(|folder| {
        let folder = repository_file(folder);
        fs::read_dir(folder).expect("a folder of the repository")
    });
    let paths = entries.map(|entry| entry.expect("a file").path());
    let paths: BTreeSet<PathBuf> = paths
        .filter(|path| path.is_file() && is_wanted(path))
        .collect();
    paths.into_iter().collect()
}

fn is_yaml(path: &Path) -> bool {
    path.extension()
        .is_some_and(|it| it == "yml" || it == "yaml")
}

fn is_workflow(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(path);
    let is_of_folder = folder.ends_with("workflows") || folder.ends_with("new");
    is_yaml(path) && (is_of_folder || name.starts_with("github-"))
}

fn is_script(path: &Path) -> bool {
    path.extension().is_some_and(|it| it == "sh") || path.ends_with("run_autograder")
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("a text file")
}

fn yaml(path: &Path) -> Value {
    serde_saphyr::from_str(&text(path))
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn jobs_have_few_permissions_and_a_time_limit() {
    let workflows = files(is_workflow);
    assert!(workflows.len() >= 4, "{workflows:?}");
    for path in workflows {
        let workflow = yaml(&path);
        let permissions = workflow["permissions"].as_object();
        let permissions = permissions.unwrap_or_else(|| panic!("{}", path.display()));
        let read_only = permissions.values().all(|it| it == "read");
        assert!(
            read_only,
            "{}: jobs ask for what they write",
            path.display()
        );
        for (name, job) in workflow["jobs"].as_object().expect("jobs") {
            assert!(
                job["timeout-minutes"].is_u64(),
                "{}: {name}",
                path.display()
            );
        }
    }
}

#[test]
fn actions_are_pinned_to_commits() {
    let mut pinned = 0;
    for path in files(is_yaml) {
        for line in text(&path).lines() {
            let line = line.trim().trim_start_matches("- ");
            let Some(action) = line.strip_prefix("uses: ") else {
                continue;
            };
            if action == PLACEHOLDER {
                continue;
            }
            let (_, rest) = action.split_once('@').expect("a version");
            let (commit, comment) = rest.split_once(" # ").unwrap_or((rest, ""));
            let is_commit = commit.len() == 40 && commit.bytes().all(|it| it.is_ascii_hexdigit());
            assert!(
                is_commit && comment.starts_with('v'),
                "{}: {action}",
                path.display()
            );
            pinned += 1;
        }
    }
    assert!(pinned > 10, "{pinned}");
}

/// All strings that a runner gives to a shell.
fn shell_code(value: &Value, is_code: bool, code: &mut Vec<String>) {
    const KEYS: [&str; 5] = ["run", "script", "before_script", "args", "command"];
    match value {
        Value::String(text) if is_code => code.push(text.clone()),
        Value::Array(values) => values.iter().for_each(|it| shell_code(it, is_code, code)),
        Value::Object(values) => {
            for (key, value) in values {
                shell_code(value, KEYS.contains(&key.as_str()), code);
            }
        }
        _ => {}
    }
}

/// The shell code of the repository's files for CI, by file.
fn all_shell_code() -> Vec<(PathBuf, String)> {
    let mut all = Vec::new();
    for path in files(is_yaml) {
        let mut code = Vec::new();
        shell_code(&yaml(&path), false, &mut code);
        all.extend(code.into_iter().map(|code| (path.clone(), code)));
    }
    for path in files(is_script) {
        let code = text(&path);
        all.push((path, code));
    }
    let page = repository_file("docs/CI.md");
    let indented = text(&page);
    let indented = indented
        .lines()
        .filter_map(|line| line.strip_prefix("    "));
    let indented: Vec<&str> = indented.collect();
    all.push((page, indented.join("\n")));
    all
}

/// Replaces what a shell would replace by something that is a number and a name.
fn without_variables(code: &str) -> String {
    let mut result = String::new();
    let mut rest = code;
    while let Some(at) = rest.find('$') {
        result.push_str(&rest[..at]);
        let after = &rest[at + 1..];
        let length = match after.as_bytes().first() {
            Some(b'{') if after.starts_with("{{") => after.find("}}").map_or(0, |end| end + 2),
            Some(b'{') => after.find('}').map_or(after.len(), |end| end + 1),
            Some(b'(') => after.find(')').map_or(after.len(), |end| end + 1),
            Some(b'@') => 1,
            _ => {
                let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
                after.find(|c| !is_name(c)).unwrap_or(after.len())
            }
        };
        result.push('1');
        rest = &after[length..];
    }
    result + rest
}

/// The programs whose arguments are checked: as they are written, and what they are.
const PROGRAMS: [(&str, &str); 6] = [
    ("wasmouse ", "wasmouse"),
    ("exec wasmouse ", "wasmouse"),
    ("\"$WASMOUSE\" ", "wasmouse"),
    ("\"$RUNNER_TEMP/bin/wasmouse\" ", "wasmouse"),
    ("set -- \"$root/bin/wasmouse\" ", "wasmouse"),
    ("cargo xtask ", "xtask"),
];

/// Every call of these programs: which program, and its arguments.
fn calls(code: &str) -> Vec<(&'static str, Vec<String>)> {
    let joined = code.replace("\\\n", " ");
    let commands = joined.split(['\n', ';']).flat_map(|it| it.split("||"));
    let commands = commands.flat_map(|it| it.split("&&"));
    let call = |command: &str| {
        let command = command.trim();
        let (beginning, program) = PROGRAMS.iter().find(|it| command.starts_with(it.0))?;
        let arguments = without_variables(&command[beginning.len()..]);
        Some((
            *program,
            shlex::split(&arguments).expect("quotes are closed"),
        ))
    };
    commands.filter_map(call).collect()
}

#[test]
fn commands_exist_with_their_arguments() {
    let folder = path().parent().expect("a folder").to_owned();
    let mut checked = 0;
    for (file, code) in all_shell_code() {
        for (program, arguments) in calls(&code) {
            let name = format!("{program}{}", std::env::consts::EXE_SUFFIX);
            let program = folder.join(name);
            // What follows `--help` is not looked at; what precedes it is an error first.
            let ran = ran(Command::new(&program).args(&arguments).arg("--help"));
            assert!(
                ran.status.success(),
                "{}: {arguments:?}\n{}",
                file.display(),
                ran.stderr
            );
            checked += 1;
        }
    }
    assert!(checked >= 8, "{checked}");
}

#[test]
fn wrong_arguments_are_noticed() {
    let code = "  wasmouse run \"$A\" --no-such \\\n  x || true\ncargo xtask unknown";
    let calls = calls(code);
    let arguments: Vec<_> = calls.iter().map(|it| it.1.join(" ")).collect();
    assert_eq!(arguments, ["run 1 --no-such x", "unknown"]);
    let ran = ran(Command::new(path()).args(&calls[0].1).arg("--help"));
    assert_eq!(ran.status.code(), Some(2));
    assert_eq!(
        without_variables("a ${{ b }} \"$C/$D\" $(e f) ${G:-1}"),
        "a 1 \"1/1\" 1 1"
    );
}

/// Runs a validator that must find nothing.
fn accepts(validator: Validator, test: &str, arguments: &[&str], files: &[PathBuf]) {
    assert!(!files.is_empty());
    if let Some(program) = validator.find(&xtask::repository(), test) {
        let ran = ran(Command::new(program).args(arguments).args(files));
        assert!(
            ran.status.success(),
            "{arguments:?}\n{}\n{}",
            ran.stdout,
            ran.stderr
        );
    }
}

#[test]
fn files_fit_the_schemas_of_their_services() {
    let test = "files_fit_the_schemas_of_their_services";
    for (schema, files) in [
        ("vendor.github-workflows", files(is_workflow)),
        (
            "vendor.github-actions",
            vec![repository_file(".github/actions/grade/action.yml")],
        ),
        (
            "vendor.gitlab-ci",
            vec![repository_file("docs/ci/gitlab.yml")],
        ),
    ] {
        accepts(
            Validator::JsonSchema,
            test,
            &["--builtin-schema", schema],
            &files,
        );
    }
}

#[test]
fn workflows_are_secure() {
    let test = "workflows_are_secure";
    let mut audited = files(is_workflow);
    audited.push(repository_file(".github/actions/grade/action.yml"));
    // What is left to be filled in is filled in.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let workflows = folder.path().join(".github/workflows");
    fs::create_dir_all(&workflows).expect("a folder");
    for path in &mut audited {
        let text = text(path);
        if text.contains(PLACEHOLDER) {
            *path = workflows.join(path.file_name().expect("a file"));
            let commit = PLACEHOLDER.replace("COMMIT", &"0".repeat(40));
            fs::write(&path, text.replace(PLACEHOLDER, &commit)).expect("a file");
        }
    }
    accepts(
        Validator::Zizmor,
        test,
        &["--offline", "--no-progress"],
        &audited,
    );
}

#[test]
fn scripts_pass_shellcheck() {
    let mut scripts = files(is_script);
    scripts.push(repository_file("install.sh"));
    assert!(scripts.len() >= 6, "{scripts:?}");
    accepts(
        Validator::ShellCheck,
        "scripts_pass_shellcheck",
        &[],
        &scripts,
    );
}

/// Code blocks of the page that say which file they are from are in that file.
#[test]
fn the_page_quotes_the_workflow() {
    let page = text(&repository_file("docs/CI.md"));
    let quoted = page.split("```yaml\n").nth(1).expect("a block");
    let quoted = quoted.split("```").next().expect("a block");
    let workflow = text(&repository_file("docs/ci/github-grade.yml"));
    for line in quoted.lines() {
        let there = workflow.lines().any(|it| it.trim() == line.trim());
        assert!(there, "{line}");
    }
}
