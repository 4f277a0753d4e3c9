//! Folders of submissions may hold anything: pipes, links to files of the organiser, files that
//! are too large, and names that control a terminal.

#![cfg(unix)]

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::os::unix::ffi::OsStrExt as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use wasmouse_core::maze::bundled as bundled_mazes;
use wasmouse_engine::bundled::find;

use crate::binary::wasmouse;

/// What is only for the organiser.
const SECRET: &str = "root:$y$j9T$secret:19000:0:99999:7:::";

fn component() -> &'static [u8] {
    find("flood").expect("a bundled robot").component
}

fn maze() -> &'static str {
    bundled_mazes()[0].text
}

fn fifo(path: &Path) {
    // By its program, because macOS has no system call of that name.
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("POSIX has it").success(), "a FIFO");
}

/// Runs a command that must end soon, and returns its exit code and all that it printed.
#[track_caller]
fn run(folder: &Path, arguments: &[OsString]) -> (i32, String) {
    let mut command: Command = wasmouse();
    let mut child = command
        .args(arguments)
        .current_dir(folder)
        .env("WASMOUSE_CACHE", folder.join("cache"))
        .stdin(Stdio::null())
        .stdout(File::create(folder.join("stdout")).expect("a file"))
        .stderr(File::create(folder.join("stderr")).expect("a file"))
        .spawn()
        .expect("the program starts");
    let begin = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        if begin.elapsed() > Duration::from_secs(60) {
            child.kill().expect("my child");
            panic!("{arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    let read = |name| fs::read(folder.join(name)).expect("a file");
    let printed = [read("stdout"), read("stderr")].concat();
    let printed = String::from_utf8(printed).expect("text");
    let code = status.code();
    (
        code.unwrap_or_else(|| panic!("{arguments:?}: {status}: {printed}")),
        printed,
    )
}

fn words(line: &str) -> Vec<OsString> {
    line.split_whitespace().map(OsString::from).collect()
}

#[test]
fn pipes_are_an_error_and_not_waited_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["robot.wasm", "maze.txt", "result.json"] {
        fifo(&folder.path().join(name));
    }
    for line in [
        "run robot.wasm",
        "run flood maze.txt",
        "inspect robot.wasm",
        "build robot.wasm",
        "verify result.json",
        "verify result.json --robot robot.wasm",
        "maze check maze.txt",
        "maze show maze.txt",
        "maze solve maze.txt",
        "maze convert maze.txt --to num",
    ] {
        let (code, printed) = run(folder.path(), &words(line));
        assert_eq!(code, 3, "{line}: {printed}");
        assert!(printed.contains("not a regular file"), "{line}: {printed}");
    }
}

#[test]
fn large_files_are_not_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("maze.txt");
    let file = File::create(path).expect("a file");
    file.set_len(100_000_000_000).expect("a sparse file");
    let (code, printed) = run(folder.path(), &words("maze check maze.txt"));
    assert_eq!(code, 3, "{printed}");
    assert!(
        printed.contains("the file has more than 262144 bytes"),
        "{printed}"
    );
}

#[test]
fn links_out_of_a_folder_are_skipped() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let own = folder.path().join("submissions");
    fs::create_dir(&own).expect("a folder");
    fs::write(folder.path().join("secret"), SECRET).expect("a file");
    fs::write(folder.path().join("other.wasm"), component()).expect("a file");
    fs::write(own.join("good.wasm"), component()).expect("a file");
    fs::write(own.join("good.txt"), maze()).expect("a file");
    symlink("good.wasm", own.join("inside.wasm")).expect("a link");
    symlink("../other.wasm", own.join("outside.wasm")).expect("a link");
    symlink("nowhere", own.join("nowhere.wasm")).expect("a link");
    symlink(folder.path().join("secret"), own.join("shadow.wasm")).expect("a link");
    symlink(folder.path().join("secret"), own.join("shadow.txt")).expect("a link");
    fifo(&own.join("pipe.wasm"));
    fifo(&own.join("pipe.txt"));
    for (line, skipped) in [
        (
            "run --robot submissions -m submissions",
            &[
                "outside.wasm",
                "nowhere.wasm",
                "shadow.wasm",
                "pipe.wasm",
                "shadow.txt",
                "pipe.txt",
            ][..],
        ),
        ("maze check submissions", &["shadow.txt", "pipe.txt"]),
    ] {
        let (code, printed) = run(folder.path(), &words(line));
        assert_eq!(code, 0, "{line}: {printed}");
        for name in skipped {
            let warning = format!("warning: skipped `submissions/{name}`: it is ");
            assert!(printed.contains(&warning), "{line}: {printed}");
        }
        assert!(!printed.contains("root:"), "{line}: {printed}");
        assert!(
            !printed.contains("skipped `submissions/inside"),
            "{line}: {printed}"
        );
    }
}

/// Who names a link gets an error that says where it is no maze, and not what it holds.
#[test]
fn messages_do_not_quote_what_is_no_maze() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("secret"), SECRET).expect("a file");
    std::os::unix::fs::symlink("secret", folder.path().join("maze.txt")).expect("a link");
    for line in [
        "maze check maze.txt",
        "maze check maze.txt --json",
        "run flood maze.txt",
    ] {
        let (code, printed) = run(folder.path(), &words(line));
        assert_eq!(code, 3, "{line}: {printed}");
        assert!(
            printed.contains("failed to parse maze `maze.txt`: line 1"),
            "{line}: {printed}"
        );
        assert!(!printed.contains("root"), "{line}: {printed}");
        assert!(!printed.contains("secret"), "{line}: {printed}");
    }
}

/// What no output may have: characters that control a terminal or cannot be seen.
fn is_dangerous(character: char) -> bool {
    character != '\n'
        && (character.is_control()
            || matches!(character, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fe00}'..='\u{fe0f}'
                | '\u{e0000}'..='\u{e0fff}'))
}

/// Every command that prints names, with names that try to control the terminal, to hide, to
/// turn the text around, or to look like a line of their own.
#[test]
fn hostile_names_are_escaped_everywhere() {
    check_names(b"\x1b[31m\xe2\x80\xae\xe2\x80\x8b\xc2\x9b\xf3\xa0\x84\x80\nerror: forged\r");
}

/// Not all arguments may be something else than Unicode, but whatever is in a folder may.
#[test]
fn hostile_names_that_are_not_unicode_are_escaped_everywhere() {
    check_names(b"\x1b[31m\nerror: forged\xff\r");
}

#[track_caller]
fn check_names(stem: &[u8]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let name = |ending: &str| OsStr::from_bytes(&[stem, ending.as_bytes()].concat()).to_owned();
    let write = |ending: &str, bytes: &[u8]| {
        fs::write(folder.path().join(name(ending)), bytes).expect("a file");
        name(ending)
    };
    let robot = write(".wasm", component());
    let bad_robot = write("bad.wasm", b"no robot");
    let good = write(".txt", maze().as_bytes());
    let illegal = write("illegal.txt", b"3\n3,5,6\n10,1,14\n9,5,12");
    let bad_maze = write("bad.txt", b"\x1b[2J\n");
    let missing = name("missing");
    let module = write("core.wasm", b"\0asm\x01\0\0\0");
    let line = |before: &str, names: &[&OsString], after: &str| {
        let names = names.iter().copied().cloned();
        [words(before), names.collect(), words(after)].concat()
    };
    let html = name(".html");
    let json = name(".json");
    let lines = [
        line("run", &[&robot, &good], "--no-cache"),
        line("run", &[&robot, &good], "--no-cache --json"),
        line("run", &[&robot, &bad_robot, &good], "--no-cache"),
        line("run", &[&robot, &good, &illegal], "--no-cache"),
        line("run", &[&robot, &bad_maze], "--no-cache"),
        line("run", &[&robot, &missing], "--no-cache"),
        line("run --robot", &[&missing], "--no-cache"),
        line("run flood test_maze_01 --no-cache --html", &[&html], ""),
        line("run flood test_maze_01 --no-cache --html", &[&html], ""),
        line("run --no-cache -o", &[&json, &robot, &good], ""),
        line("run . -m . --no-cache", &[], ""),
        line("run . -m . --no-cache --json --lenient", &[], ""),
        line("maze check .", &[], ""),
        line("maze show . --lenient", &[], ""),
        line("verify --robot . -m . --no-cache", &[&json], ""),
        line("verify --no-cache", &[&json], ""),
        line("verify --no-cache", &[&json], "--json"),
        line(
            "verify --no-cache --robot",
            &[&robot, &json],
            "-m test_maze_01",
        ),
        line("verify", &[&missing], ""),
        line("verify", &[&bad_maze], "--json"),
        line("inspect --no-cache", &[&robot], ""),
        line("inspect --no-cache", &[&robot], "--json"),
        line("inspect --no-cache", &[&bad_robot], ""),
        line("inspect", &[&missing], ""),
        line("maze show", &[&good], "--path steps"),
        line("maze show", &[&good, &good], "--lenient"),
        line("maze show", &[&good], "--svg -"),
        line("maze show", &[&bad_maze], ""),
        line("maze check", &[&good, &illegal, &bad_maze, &missing], ""),
        line(
            "maze check",
            &[&good, &illegal, &bad_maze, &missing],
            "--json",
        ),
        line("maze solve", &[&good], ""),
        line("maze solve", &[&illegal], ""),
        line("maze solve --lenient", &[&good, &illegal], "--json"),
        line("maze convert --to num", &[&bad_maze], ""),
        line("maze generate tree --count 2 -o", &[&name("folder")], ""),
        line("maze generate tree --count 2 -o", &[&name("folder")], ""),
        line("maze generate", &[&missing], ""),
        line("build", &[&module], ""),
        line("build", &[&missing], ""),
        line("new", &[&missing], ""),
        line("man -o", &[&robot], ""),
        line("run flood --cache", &[&robot], ""),
        line("run flood --seed", &[&missing], ""),
        line("run flood", &[&OsString::from("--\x1b\nerror: forged")], ""),
        line("", &[&OsString::from("\x1b\nerror: forged")], ""),
        line("run flood --rules", &[&missing], ""),
    ];
    let clean = |what: &dyn std::fmt::Debug, text: &str| {
        let bad: Vec<char> = text.chars().filter(|it| is_dangerous(*it)).collect();
        assert!(
            bad.is_empty(),
            "{what:?}: {bad:?} in\n{}",
            text.escape_debug()
        );
        let forged = text.lines().any(|it| it.starts_with("error: forged"));
        assert!(!forged, "{what:?}:\n{text}");
    };
    for line in lines {
        let (_, printed) = run(folder.path(), &line);
        clean(&line, &printed);
    }
    // The page and the results of a contest are read on a terminal too.
    let contest = words("run . -m . --lenient -o out.json --html out.html --no-cache");
    run(folder.path(), &contest);
    for name in ["out.json", "out.html"] {
        let text = fs::read_to_string(folder.path().join(name)).expect("a file");
        clean(&name, &text);
    }
}

/// Only a few places write to a terminal, and they escape what they write: see
/// `cli::output` and `report::text`.
#[test]
fn messages_have_one_way_out() {
    let allowed = ["output.rs", "terminal.rs", "screen.rs"];
    let mut left = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../host/src")];
    let mut files = 0;
    while let Some(path) = left.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            left.extend(entries.map(|it| it.expect("an entry").path()));
            continue;
        }
        if path
            .file_name()
            .is_some_and(|it| allowed.iter().any(|name| it == *name))
        {
            continue;
        }
        // Beside the code there is a font.
        if path.extension().is_none_or(|it| it != "rs") {
            continue;
        }
        files += 1;
        let source = fs::read_to_string(&path).expect("a source file");
        let code = source
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        for line in code {
            for way in [
                "println!",
                "eprint",
                "print!(",
                "io::stderr",
                "io::stdout()",
                "anstream::stderr",
                "Text::from_arguments",
            ] {
                let is_definition = path.ends_with("report/text.rs");
                assert!(
                    is_definition || !line.contains(way),
                    "{}: {line}",
                    path.display()
                );
            }
        }
    }
    assert!(files > 60, "{files}");
}

/// Whether the process has begun to play.
#[cfg(target_os = "linux")]
fn plays(process: u32) -> bool {
    let threads = fs::read_dir(format!("/proc/{process}/task")).expect("the process runs");
    let names = threads.filter_map(|it| fs::read_to_string(it.ok()?.path().join("comm")).ok());
    { names }.any(|name| name.starts_with("matches-"))
}

/// The stack that the system gives is not what commands and signals depend on.
#[cfg(target_os = "linux")]
#[test]
fn a_small_stack_is_enough() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("robot.wasm"), component()).expect("a file");
    for kib in [8192, 256, 64] {
        let command = |arguments: &str| {
            let script = format!("ulimit -s {kib}; exec \"$WASMOUSE\" {arguments} --no-cache");
            let mut command = Command::new("bash");
            command
                .args(["-c", &script])
                .current_dir(folder.path())
                .env("WASMOUSE", crate::binary::path())
                .stdin(Stdio::null());
            command
        };
        let run = "run robot.wasm flood test_maze_01 --json";
        let output = command(run).output().expect("there is bash");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{kib} KiB: {stderr}");

        let mut child = command("run robot.wasm flood gen:braid:16:1..=3000 -o out.json --force")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("there is bash");
        let begin = Instant::now();
        while !plays(child.id()) {
            assert!(
                begin.elapsed() < Duration::from_secs(60),
                "{kib} KiB: it never plays"
            );
            std::thread::sleep(Duration::from_millis(10));
        }
        wasmouse_tests::program::signal(child.id(), "INT");
        let status = child.wait().expect("a child");
        assert_eq!(status.code(), Some(130), "{kib} KiB: {status}");
        let text = fs::read_to_string(folder.path().join("out.json")).expect("a result");
        let _: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    }
}
