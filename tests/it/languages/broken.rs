//! Broken projects: each gives one clear error that says what is wrong and what to do.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use insta::{Settings, assert_snapshot};

use super::{NAME, project};
use crate::binary::{Ran, ran, stdout_of, wasmouse};

/// A project that is broken without any tool of its language.
struct Case {
    what: &'static str,
    language: &'static str,
    /// What is done to the new project.
    spoil: fn(&Path),
    /// Programs on the search path, with what they print.
    programs: &'static [(&'static str, &'static str)],
    command: &'static str,
}

const fn case(what: &'static str, language: &'static str, spoil: fn(&Path)) -> Case {
    Case {
        what,
        language,
        spoil,
        programs: &[],
        command: "build --no-match",
    }
}

impl Case {
    const fn with(mut self, programs: &'static [(&'static str, &'static str)]) -> Self {
        self.programs = programs;
        self
    }

    const fn command(mut self, command: &'static str) -> Self {
        self.command = command;
        self
    }

    /// Creates the project, breaks it, runs the command, and writes down what came of it.
    fn transcript(&self, text: &mut String) {
        let parent = tempfile::tempdir().expect("a temporary folder");
        let programs = parent.path().join("programs");
        fs::create_dir(&programs).expect("a folder");
        for (name, printed) in self.programs {
            program(&programs.join(name), printed);
        }
        let mut new = wasmouse();
        new.args(["new", NAME, "--lang", self.language]);
        stdout_of(new.current_dir(&parent));
        let folder = parent.path().join(NAME);
        (self.spoil)(&folder);
        let mut command = wasmouse();
        command
            .args(self.command.split_whitespace())
            .current_dir(&folder)
            .env("PATH", &programs)
            .env("WASMOUSE_CACHE", parent.path().join("cache"));
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(&mut command);
        let code = status.code().expect("no signal");
        assert_ne!(code, 0, "{}: {stdout}{stderr}", self.what);
        writeln!(
            text,
            "## {} ({})\nexit code {code}",
            self.what, self.language
        )
        .expect("a string");
        text.push_str(&stdout);
        text.push_str(&stderr);
        text.push('\n');
    }
}

/// A program that prints a line, whatever it is asked.
fn program(path: &Path, printed: &str) {
    fs::write(path, format!("#!/bin/sh\necho '{printed}'\n")).expect("a file");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).expect("a file");
    }
}

/// Replaces a text in the file of a WebAssembly text project.
fn wat(folder: &Path, from: &str, to: &str) {
    let path = folder.join("robot.wat");
    let text = fs::read_to_string(&path).expect("text");
    assert!(text.contains(from), "{from}");
    fs::write(path, text.replace(from, to)).expect("a file");
}

fn write(folder: &Path, file: &str, text: &str) {
    fs::write(folder.join(file), text).expect("a file");
}

fn remove(folder: &Path, file: &str) {
    fs::remove_file(folder.join(file)).expect("a file");
}

const CASES: &[Case] = &[
    case("a profile of cargo", "wat", |_| ()).command("build --no-match --profile dev"),
    case("no tools", "c", |_| ()),
    case("no tools", "cpp", |_| ()),
    case("no tools", "zig", |_| ()),
    case("no tools", "assemblyscript", |_| ()),
    case("packages are not installed", "assemblyscript", |_| ()).with(&[("node", "v22.20.0")]),
    case("a tool that is too old", "zig", |_| ()).with(&[("zig", "0.11.0")]),
    case("a tool that is too old", "c", |_| ())
        .with(&[("zig", "0.11.0"), ("clang", "clang 14.0.6")]),
    case("a tool that is too old", "assemblyscript", |_| ()).with(&[("node", "v12.22.0")]),
    case("two robots", "c", |folder| {
        write(folder, "src/robot.cpp", "")
    }),
    case("no entry file", "c", |folder| remove(folder, "src/robot.c")),
    case("no entry file", "assemblyscript", |folder| {
        remove(folder, "assembly/index.ts");
        fs::create_dir_all(folder.join("node_modules/.bin")).expect("a folder");
        program(&folder.join("node_modules/.bin/asc"), "Version 0.28.20");
    })
    .with(&[("node", "v22.20.0")]),
    case("no flags", "cpp", |folder| {
        remove(folder, "compile_flags.txt")
    })
    .with(&[("zig", "0.17.1")]),
    case("flags that cannot be read", "c", |folder| {
        remove(folder, "compile_flags.txt");
        fs::create_dir(folder.join("compile_flags.txt")).expect("a folder");
    })
    .with(&[("zig", "0.17.1")]),
    case("a compiler that writes nothing", "c", |_| ()).with(&[("zig", "0.17.1")]),
    case("a build that installs nothing", "zig", |_| ()).with(&[("zig", "0.17.1")]),
    case("a manifest that is no JSON", "assemblyscript", |folder| {
        write(folder, "package.json", "{\"name\": ");
    }),
    case("a manifest without a name", "assemblyscript", |folder| {
        write(folder, "package.json", "{}");
    }),
    case("empty source", "wat", |folder| {
        write(folder, "robot.wat", "")
    }),
    case("source that cannot be read", "wat", |folder| {
        write(folder, "robot.wat", "(module \u{1f980}\n");
    }),
    case("an instruction that does not exist", "wat", |folder| {
        wat(
            folder,
            "(i32.eq (global.get $heading) (i32.const 0))",
            "(i32.equal)",
        );
    }),
    case("a type error", "wat", |folder| {
        wat(
            folder,
            "(then (return (call $move (i32.const 2) (i32.const 1)))))",
            "(then (return)))",
        );
    }),
    case("a missing export", "wat", |folder| {
        wat(
            folder,
            " (export \"wasmouse:robot/controller@0.2.0#next-move\")",
            "",
        );
    }),
    case("no memory", "wat", |folder| {
        wat(folder, " (export \"memory\")", "")
    }),
    case("a wrong signature", "wat", |folder| {
        wat(folder, "(param $seed i64)", "(param $seed i32)");
    }),
    case("a WIT of another version", "wat", |folder| {
        wat(folder, "@0.2.0", "@7.0.0")
    }),
    case("an unknown import", "wat", |folder| {
        wat(
            folder,
            "(import",
            "(import \"env\" \"now\" (func $now (result i64)))\n  (import",
        );
    }),
    case("an unknown function of the journal", "wat", |folder| {
        wat(folder, "\"panic\"", "\"shout\"")
    }),
    case("an error in `start`", "wat", |folder| {
        wat(
            folder,
            "(global.set $prefers_right (local.get $variant))",
            "unreachable",
        );
    })
    .command("run . test_maze_01"),
    case("not a project", "wat", |folder| remove(folder, "robot.wat")),
    case("not a project", "zig", |folder| remove(folder, "build.zig"))
        .command("run . test_maze_01"),
    case("a folder that is not there", "zig", |_| ()).command("build nowhere"),
];

#[cfg(unix)]
#[test]
fn broken_projects_say_what_is_wrong() {
    let mut text = String::new();
    for case in CASES {
        case.transcript(&mut text);
    }
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("../snapshots");
    settings.bind(|| assert_snapshot!("languages-broken", text));
}

/// Each compiler points at the mistake, and wasmouse says which one it was.
#[track_caller]
fn check_compile_error(
    language: &'static str,
    file: &str,
    from: &str,
    to: &str,
    expected: &[&str],
) {
    let Some(project) = project(language, "compile errors") else {
        return;
    };
    project.patch(file, from, to);
    let Ran { status, stderr, .. } = project.wasmouse("build");
    assert_eq!(status.code(), Some(3), "{stderr}");
    for expected in expected {
        assert!(
            stderr.contains(expected),
            "{language}, {expected}: {stderr}"
        );
    }
    let component: PathBuf = project.component();
    assert!(!component.exists(), "nothing is left of a failed build");
}

#[test]
fn compile_errors_have_their_line() {
    check_compile_error(
        "c",
        "src/robot.c",
        "static bool on_route;",
        "static boolean on_route;",
        &[
            "src/robot.c:12:8: error: unknown type name 'boolean'",
            "error: zig failed to compile `mouse`",
            "hint: the messages of zig are above",
        ],
    );
    check_compile_error(
        "zig",
        "src/robot.zig",
        "expected: ?Pose,",
        "expected: ?Place,",
        &[
            "src/robot.zig:22:16: error: use of undeclared identifier 'Place'",
            "error: zig failed to compile `mouse`",
        ],
    );
    check_compile_error(
        "assemblyscript",
        "assembly/robot.ts",
        "private onRoute: bool",
        "private onRoute: boolish",
        &[
            "assembly/robot.ts(14,20)",
            "error: asc failed to compile `mouse`",
            "hint: the messages of asc are above",
        ],
    );
}

/// A function that the host calls and the robot does not have.
#[test]
fn missing_functions_are_named() {
    check_compile_error(
        "cpp",
        "src/robot.cpp",
        "WASMOUSE_ROBOT(FloodRobot)",
        "",
        &["start_robot", "error: zig failed to compile `mouse`"],
    );
    check_compile_error(
        "c",
        "src/robot.c",
        "Action robot_next_move(",
        "Action next_move_of_robot(",
        &["robot_next_move", "error: zig failed to compile `mouse`"],
    );
}

#[test]
fn a_standard_library_has_to_be_asked_for() {
    check_compile_error(
        "cpp",
        "src/robot.cpp",
        "#include \"wasmouse/robot.hpp\"",
        "#include <vector>\n#include \"wasmouse/robot.hpp\"",
        &[
            "'vector' file not found",
            "write `--target=wasm32-wasi` into compile_flags.txt",
        ],
    );
}
