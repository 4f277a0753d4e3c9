//! What commands print, and how they fail: transcripts with exit code, standard
//! output and standard error.
//!
//! After a wanted change, `INSTA_UPDATE=always cargo test -p wasmouse-tests cli`
//! writes the transcripts again.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use insta::{Settings, assert_snapshot};
use tempfile::TempDir;

use crate::binary::{Ran, ran, wasmouse};
use crate::hostile::{IMPORT_LOG, Module, wasm};

/// A folder with robots and mazes of every kind, in which commands are run.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let talkative = Module {
        imports: IMPORT_LOG,
        rest: r#"(global $said (mut i32) (i32.const 0))
            (data (i32.const 32) "plain, \1b[31mred\1b[0m, \e2\80\aeright to left\0a<b>next</b>")"#,
        next: "(if (i32.eqz (global.get $said)) (then
                (call $log (i32.const 2) (i32.const 32) (i32.const 49))
                (global.set $said (i32.const 1))))
            i32.const 16",
        ..Module::default()
    };
    let trapping = Module {
        next: "unreachable",
        ..Module::default()
    };
    let files = [
        ("ahead.wasm", Module::default().component()),
        ("core.wasm", Module::default().core()),
        ("talkative.wasm", talkative.component()),
        ("trapping.wasm", trapping.component()),
        (
            "wasi.wasm",
            wasm(r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#),
        ),
        ("empty.wasm", Vec::new()),
        ("text.wasm", b"I am a robot\n".to_vec()),
        ("bare.wasm", wasm("(module)")),
        (
            "small.txt",
            b"4\n3,5,5,6\n10,3,6,10\n10,9,12,10\n9,5,5,12\n".to_vec(),
        ),
        ("broken.txt", b"4\n1,5,5,6\n10,3,x,10\n".to_vec()),
        ("letter.txt", b"Dear judges,\n".to_vec()),
    ];
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    for name in ["nothing", "robots", "mazes", "bad"] {
        fs::create_dir(folder.path().join(name)).expect("a folder");
    }
    for (from, to) in [
        ("ahead.wasm", "robots/ahead.wasm"),
        ("wasi.wasm", "robots/wasi.wasm"),
        ("small.txt", "mazes/small.txt"),
        ("broken.txt", "mazes/broken.txt"),
    ] {
        fs::copy(folder.path().join(from), folder.path().join(to)).expect("a file");
    }
    fs::write(folder.path().join("bad/Cargo.toml"), "[package\n").expect("a file");
    folder
}

/// The command in that folder, with nothing of the user's environment.
fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = wasmouse();
    command
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env_clear()
        .env("HOME", folder.join("home"));
    command
}

/// Runs the command lines in one folder and compares what came of them.
#[track_caller]
fn check(name: &str, command_lines: &[&str]) {
    check_in(&folder(), name, command_lines);
}

/// Runs the command lines in that folder and compares what came of them.
#[track_caller]
fn check_in(folder: &TempDir, name: &str, command_lines: &[&str]) {
    let mut transcript = String::new();
    for line in command_lines {
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(&mut command(folder.path(), line));
        let code = status.code().expect("no signal ended it");
        writeln!(transcript, "$ wasmouse {line}\n[{code}]").expect("a string");
        for (stream, text) in [("stdout", stdout), ("stderr", stderr)] {
            if !text.is_empty() {
                writeln!(
                    transcript,
                    "--- {stream}\n{}",
                    redacted(&text, folder.path())
                )
                .expect("a string");
            }
        }
        transcript.push('\n');
    }
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| assert_snapshot!(format!("cli-{name}"), transcript));
}

/// The text without what changes from machine to machine or with every new build
/// of a robot: folders, versions, digests.
fn redacted(text: &str, folder: &Path) -> String {
    let folder = folder.to_str().expect("the folder's name is text");
    let version = env!("CARGO_PKG_VERSION");
    let text = text
        .trim_end()
        .replace(folder, "[FOLDER]")
        .replace(&format!("wasmouse {version}"), "wasmouse [VERSION]")
        .replace(
            &format!(r#""wasmouse": "{version}""#),
            r#""wasmouse": "[VERSION]""#,
        )
        .replace(wasmouse_engine::engine_id().as_str(), "[ENGINE]");
    // Systems differ in the layers that they provide.
    let text: Vec<&str> = text
        .lines()
        .map(|line| match line.strip_prefix("  sandbox   ") {
            Some(_) => "  sandbox   [LAYERS]",
            None => line,
        })
        .collect();
    let text = text.join("\n");
    let mut redacted = String::new();
    for word in text.split_inclusive(|character: char| !character.is_ascii_hexdigit()) {
        let digits = word.trim_end_matches(|character: char| !character.is_ascii_hexdigit());
        if digits.len() == 64 {
            redacted.push_str("[SHA256]");
            redacted.push_str(&word[64..]);
        } else {
            redacted.push_str(word);
        }
    }
    redacted
}

#[test]
fn help_in_two_lengths() {
    for command in [
        "demo",
        "run",
        "profile",
        "compare",
        "picture",
        "plot",
        "study",
        "verify",
        "robots",
        "inspect",
        "maze",
        "maze check",
        "maze show",
        "maze solve",
        "maze generate",
        "maze convert",
        "maze edit",
        "drive",
        "contest",
        "contest init",
        "contest check",
        "new",
        "build",
        "doctor",
        "completions",
        "man",
    ] {
        let name = format!("help-{}", command.replace(' ', "-"));
        let (short, long) = (format!("{command} -h"), format!("{command} --help"));
        check(&name, &[&short, &long]);
    }
    check("help", &["", "-h", "--help", "--version", "race", "maze"]);
}

#[test]
fn pictures() {
    let [flood, dfs, other] = [
        "kept/flood-reset.test_maze_01.0.replay.json",
        "kept/dfs-everything.test_maze_01.0.replay.json",
        "other/flood-reset.tree-16.0.replay.json",
    ];
    let played = [
        "run flood dfs test_maze_01 --replays kept --ascii",
        "run flood tree-16 --replays other --ascii",
    ];
    let good = [
        format!("picture {flood} -o end.svg"),
        format!("picture {flood} -o end.png --bare --step 30 --width 300"),
        format!("picture {flood} -o costs.svg --step 0 --overlay costs,optimum --theme dark"),
        format!("picture {flood} {dfs} -o both.png --overlay knowledge,distances"),
        format!("picture {flood} -o moments.png --sequence 6 --steps ..=30"),
        format!("picture {flood} {dfs} {other} -o poster.png --poster --title Cup"),
        format!("picture {flood} {dfs} -o both.gif --width 200 --every 40"),
        format!("picture {flood} -o one.apng --width 100 --steps 30..=32 --overlay none"),
        format!("picture {flood} -o end.svg --force --match flood:reset/test_maze_01/0/7"),
    ];
    let good = good.iter().map(String::as_str);
    check(
        "picture",
        &played.into_iter().chain(good).collect::<Vec<_>>(),
    );
    let bad = [
        "picture".to_owned(),
        "picture missing.replay.json -o a.svg".to_owned(),
        "picture letter.txt -o a.svg".to_owned(),
        format!("picture {flood}"),
        format!("picture {flood} -o a.jpg"),
        format!("picture {flood} -o a"),
        format!("picture {flood} -o missing/a.png"),
        format!("picture {flood} -o missing/a.gif"),
        format!("picture {flood} -o a.svg --step 53"),
        format!("picture {flood} -o a.svg --step first"),
        format!("picture {flood} -o a.gif --step 3"),
        format!("picture {flood} -o a.gif --steps 50..=53"),
        format!("picture {flood} -o a.gif --steps 9..=3"),
        format!("picture {flood} -o a.gif --steps 3..9"),
        format!("picture {flood} -o a.svg --steps 3..=9"),
        format!("picture {flood} -o a.gif --sequence 4"),
        format!("picture {flood} {flood} -o a.gif --poster"),
        format!("picture {flood} -o a.svg --sequence 1"),
        format!("picture {flood} {dfs} -o a.svg --sequence 4"),
        format!("picture {flood} {dfs} -o a.svg --bare"),
        format!("picture {flood} {other} -o a.svg"),
        format!("picture {flood} {flood} {flood} {flood} {flood} -o a.svg"),
        format!("picture {flood} -o a.svg --overlay heat,costs"),
        format!("picture {flood} -o a.svg --overlay beliefs,knowledge"),
        format!("picture {flood} -o a.svg --overlay none,heat"),
        format!("picture {flood} -o a.svg --overlay glow"),
        format!("picture {flood} -o a.svg --title Cup"),
        format!("picture {flood} -o a.gif --width 8000 --delay 20"),
        format!("picture {flood} -o a.gif --delay 5"),
        format!("picture {flood} -o a.gif --every 0"),
        format!("picture {flood} -o a.png --every 2"),
        format!("picture {flood} -o letter.txt"),
        format!("picture {flood} -o a.svg --match nobody"),
    ];
    let bad = bad.iter().map(String::as_str);
    check(
        "picture-bad-input",
        &played.into_iter().chain(bad).collect::<Vec<_>>(),
    );
}

#[test]
fn plots() {
    let played = "run flood dfs test_maze_01 gen:tree:12:1 -o played.json --ascii";
    check(
        "plot",
        &[
            played,
            "plot scores played.json -o scores.svg",
            "plot exploration played.json -o exploration.PNG --width 400",
            "plot margins played.json --benchmark upper -o margins.png --theme dark --title Cup",
            "plot regret played.json -o scores.svg --force",
        ],
    );
    check(
        "plot-bad-input",
        &[
            played,
            "run ahead.wasm test_maze_01 -o unfinished.json --ascii",
            "run flood test_maze_01 --rules udacity-each-run -o other-rules.json --ascii",
            "run flood test_maze_01 --seed 7 -o other-seed.json --ascii",
            "plot",
            "plot pie played.json -o a.svg",
            "plot scores played.json",
            "plot scores missing.json -o a.svg",
            "plot scores letter.txt -o a.svg",
            "plot scores ahead.wasm -o a.svg",
            "plot scores unfinished.json -o a.svg",
            "plot scores played.json other-rules.json -o a.svg",
            "plot scores played.json other-seed.json -o a.svg",
            "plot scores nothing -o a.svg",
            "plot scores nothing played.json -o a.svg",
            "plot scores played.json --store contest.db -o a.svg",
            "plot scores played.json -o a.jpg",
            "plot scores played.json -o a.gif",
            "plot scores played.json -o scores",
            "plot scores played.json -o missing/a.svg",
            "plot scores played.json -o small.txt",
            "plot scores played.json -o a.png --width 9",
            "plot scores played.json -o a.svg --theme green",
        ],
    );
}

/// From nothing to a contest file that can be played, and files that cannot.
#[test]
fn contest_files() {
    let other = "version = 1\n[[robots]]\npath = \"../robots\"\nauthor = \"Zo\u{eb}\"\nclass = \"c\"\n\
                 [[robots]]\nbundled = \"flood\"\nvariants = [\"certain\"]\n[[classes]]\nname = \"c\"\n\
                 [[mazes]]\nset = \"a\"\npaths = [\"../mazes/s*.txt\"]\nlenient = true\nweight = 3\n\
                 [[mazes]]\nset = \"b\"\npaths = [\"gen:tree:12..=16:1..=2\"]\nhidden = true\n\
                 [seeds]\ncount = 2\n[outputs]\nmarkdown = \"a.md\"\n";
    let illegal = other.replace("lenient = true\n", "");
    let twice = other.replace(
        "[\"gen:tree:12..=16:1..=2\"]",
        "[\"braid-12\",\n  \"../mazes/small.txt\"]\nlenient = true",
    );
    let named = other.replace("author", "name").replace("../robots", "..");
    let files = [
        ("other", other),
        ("illegal", &illegal),
        ("twice", &twice),
        ("named", &named),
        ("robotless", &other.replace("../robots", "../nothing")),
        ("mazeless", &other.replace("s*.txt", "x*.txt")),
        ("misspelt", &other.replace("count", "cuont")),
        ("itself", &other.replace("a.md", "../contests/itself.toml")),
    ];
    let folder = folder();
    fs::create_dir(folder.path().join("contests")).expect("a folder");
    for (name, text) in files {
        let path = folder.path().join(format!("contests/{name}.toml"));
        fs::write(path, text).expect("a file");
    }
    check_in(
        &folder,
        "contest-files",
        &[
            "contest check",
            "contest init spring",
            "contest init spring",
            "contest init --force spring",
            "contest check spring",
            "contest init spring/autumn.toml",
            "contest check contests/other.toml",
            "contest check contests/illegal.toml",
            "contest check contests/twice.toml",
            "contest check contests/named.toml",
            "contest check contests/robotless.toml",
            "contest check contests/mazeless.toml",
            "contest check contests/misspelt.toml",
            "contest check contests/itself.toml",
            "contest check empty.wasm",
        ],
    );
    let submissions = folder.path().join("spring/submissions");
    assert!(submissions.is_dir());
    fs::copy(
        folder.path().join("ahead.wasm"),
        submissions.join("ann.wasm"),
    )
    .expect("a file");
    fs::create_dir(submissions.join("bob")).expect("a folder");
    fs::copy(
        folder.path().join("core.wasm"),
        submissions.join("bob/robot.wasm"),
    )
    .expect("a file");
    let folders = "version = 1\n[[robots]]\npath = \"submissions/*/robot.wasm\"\n\
                   names_from = \"folder\"\nvariants = [0, 3]\n\
                   [[robots]]\npath = \"submissions/ann.wasm\"\nname = \"Ann's\"\n\
                   [[robots]]\npath = \"submissions\"\n\
                   [[mazes]]\nset = \"a\"\npaths = [\"tree-16\"]\n";
    fs::write(folder.path().join("spring/folders.toml"), folders).expect("a file");
    check_in(
        &folder,
        "contest-submissions",
        &["contest check spring", "contest check spring/folders.toml"],
    );
}

#[test]
fn lists() {
    check("robots", &["robots"]);
}

#[test]
fn contests() {
    check(
        "run",
        &[
            "run ahead.wasm test_maze_01",
            "run core.wasm small.txt --lenient --ascii",
            "run ahead.wasm:7 test_maze_01 tree-16 --seed 41 --repeat 2",
            "run --robot ahead.wasm --maze test_maze_01 --rules udacity-each-run",
            "run talkative.wasm test_maze_01 --log",
            "run trapping.wasm ahead.wasm wasi.wasm empty.wasm test_maze_01",
            "run trapping.wasm gen:tree:12:1..=50 --ascii --jobs 1",
            "run trapping.wasm gen:tree:12:1..=50 --ascii --matches",
            "run ann=ahead.wasm bob=ahead.wasm test_maze_01",
            "run robots mazes --ascii --lenient -o results.json --html page.html",
            "verify results.json --robot robots --maze mazes",
            "run ahead.wasm mazes --lenient --strict",
            "run ahead.wasm trapping.wasm wasi.wasm test_maze_01 --json",
            "run wasi.wasm test_maze_01 --watch",
        ],
    );
}

#[test]
fn contests_of_bad_input() {
    check(
        "run-bad-input",
        &[
            "run",
            "run test_maze_01",
            "run missing.wasm test_maze_01",
            "run nothing test_maze_01",
            "run flod test_maze_01",
            "run flood test_maze_1",
            "run flood flood.txt",
            "run flood:2 test_maze_01",
            "run flood:fast test_maze_01",
            "run random:1 test_maze_01",
            "run flood small.txt",
            "run flood broken.txt",
            "run flood letter.txt",
            "run flood nothing",
            "run flood gen:tree:13:1",
            "run flood gen:maze:12:1",
            "run flood -m - -m -",
            "run flood test_maze_01 --rules fast",
            "run flood test_maze_01 --jobs 0",
            "run flood test_maze_01 --repeat 0",
            "run flood test_maze_01 --repeat 1000001",
            "run flood test_maze_01 --seed -1",
            "run flood test_maze_01 --seed 18446744073709551616",
            "run flood test_maze_01 --seed 18446744073709551615 --repeat 2",
            "run flood test_maze_01 --watch",
            "run flood dfs test_maze_01 --watch",
            "run flood test_maze_01 --watch --json",
            "run flood test_maze_01 --delay 5",
            "run flood test_maze_01 --force",
            "run flood test_maze_01 --html missing/page.html",
            "run flood test_maze_01 --html nothing",
            "run flood test_maze_01 --html small.txt",
            "run flood test_maze_01 -o small.txt",
            "run a=robots test_maze_01",
            "run flood flood test_maze_01",
            "run flood --robot missing --maze test_maze_01",
            "run bad test_maze_01",
        ],
    );
}

/// Commands that fill a terminal, without one and with bad input.
#[test]
fn terminal_programs_without_a_terminal() {
    check(
        "terminal-programs",
        &[
            "drive",
            "drive test_maze_01",
            "drive nothing",
            "drive gen:tree:12:1..=2",
            "drive small.txt",
            "drive test_maze_01 --replay small.txt",
            "drive test_maze_01 --force",
            "drive test_maze_01 --rules fast",
            "maze edit",
            "maze edit small.txt",
            "maze edit missing.txt",
            "maze edit test_maze_01",
            "maze edit broken.txt",
            "maze edit letter.txt",
            "maze edit small.txt --new 16",
            "maze edit new.txt --new 2",
            "maze edit new.txt --new 65",
            "maze edit new.txt --new gen:tree:12:1..=2",
            "maze edit new.txt --new missing",
            "maze edit new.txt --format num",
            "maze edit new.txt --new 16",
            "run flood dfs champion test_maze_01 --watch",
            "run flood test_maze_01 tree-16 --watch",
        ],
    );
}

#[test]
fn comparisons() {
    check(
        "compare",
        &[
            "compare flood dfs --mazes gen:tree:12:1..=12 gen:tree:14:1..=5 --ascii",
            "compare dfs flood random --mazes gen:tree:12:1..=8 --repeat 2 --json",
            "compare dfs flood --mazes gen:tree:12:1..=12 --require no-worse --ascii",
            "compare ann=flood bob=flood --maze test_maze_01 --require better",
            "compare ann=flood bob=flood --maze test_maze_01 --require no-worse --ascii",
            "compare ahead.wasm trapping.wasm --mazes test_maze_01 tree-16 --ascii",
            "compare flood wasi.wasm --mazes test_maze_01 --require better --ascii",
        ],
    );
    check(
        "study",
        &[
            "study flood --mazes gen:stretches:12..=14:1..=20 --ascii",
            "study flood ahead.wasm --mazes gen:stretches:12..=14:1..=4 --json",
            "study ahead.wasm --mazes test_maze_01",
            "study wasi.wasm --mazes test_maze_01",
        ],
    );
}

#[test]
fn comparisons_of_bad_input() {
    check(
        "compare-bad-input",
        &[
            "compare",
            "compare flood",
            "compare flood flod",
            "compare flood flood",
            "compare flood dfs:fast",
            "compare flood dfs --mazes",
            "compare flood dfs --mazes nothing",
            "compare flood dfs --mazes small.txt",
            "compare flood dfs test_maze_01",
            "compare flood dfs --require worse",
            "compare flood dfs --seed 18446744073709551615 --repeat 2",
            "study",
            "study nothing",
            "study flood --mazes gen:tree:13:1",
        ],
    );
}

#[test]
fn verifications_of_bad_input() {
    check(
        "verify-bad-input",
        &[
            "verify",
            "verify missing.json",
            "verify nothing",
            "verify small.txt letter.txt",
            "verify ahead.wasm --json",
            "verify - -",
            "verify - --maze -",
            "verify small.txt --robot missing.wasm",
            "verify small.txt --robot nothing",
            "verify small.txt --maze missing.txt",
            "verify small.txt --maze broken.txt",
            "verify small.txt --maze gen:tree:13:1",
            "verify small.txt --jobs 0",
            "verify small.txt --trust --require-sandbox",
            "verify small.txt --rules udacity",
        ],
    );
}

#[test]
fn inspections() {
    check(
        "inspect",
        &[
            "inspect core.wasm",
            "inspect talkative.wasm",
            "inspect talkative.wasm --measures",
            "inspect talkative.wasm --json",
            "inspect wasi.wasm",
            "inspect wasi.wasm --json",
            "inspect bare.wasm",
            "inspect empty.wasm",
            "inspect text.wasm --json",
            "inspect missing.wasm",
            "inspect nothing",
            "inspect",
        ],
    );
}

#[test]
fn other_commands_with_bad_input() {
    check(
        "bad-input",
        &[
            "demo --html missing/page.html",
            "demo --html nothing",
            "maze check broken.txt",
            "maze show missing.txt",
            "maze solve letter.txt",
            "maze generate gen:tree:13:1",
            "maze convert small.txt -o missing/maze.num --to num",
            "build missing",
            "build small.txt",
            "build ahead.wasm",
            "build bare.wasm",
            "build nothing",
            "new nothing",
            "new 1robot",
            "new ../x/-y",
            "completions shell",
            "man missing/man",
        ],
    );
}

/// Each job is a thread and perhaps a process.
#[test]
fn jobs_are_limited() {
    let with = |jobs: &str| {
        let jobs = format!("--jobs={jobs}");
        ran(wasmouse().args(["run", "flood", "test_maze_01", "--no-cache", &jobs]))
    };
    let most = with("1024");
    assert_eq!(most.status.code(), Some(0), "{}", most.stderr);
    for jobs in ["0", "1025", "20000", "99999"] {
        let rejected = with(jobs);
        assert_eq!(rejected.status.code(), Some(2), "{jobs}");
        let range = format!("invalid value '{jobs}' for '--jobs <N>'");
        assert!(rejected.stderr.contains(&range), "{}", rejected.stderr);
        assert!(rejected.stderr.contains("1..=1024"), "{}", rejected.stderr);
    }
}
