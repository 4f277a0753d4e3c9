//! Robots with WASI inside: what each function answers, what reaches the journal, and that
//! nothing else can be reached. `docs/WASI.md` is the table that these tests hold.

use std::fs;

use wasmouse_core::journal::{Level, Note};
use wasmouse_engine::admission::wasi::compose;
use wasmouse_engine::admission::{Rejection, componentize, examine};
use wasmouse_engine::{DetailedMatch, Executor as _, InProcess, Limits};
use wasmouse_tests::binary::{ran, stdout_of, wasmouse};
use wasmouse_tests::bombs;
use wasmouse_tests::wasi::{FOLDER, functions, typed};

use crate::hostile::{Module, wasm};
use crate::matches::{bundled_mazes, rules, spec};

#[test]
fn nothing_that_answers_wasi_is_stale() {
    let problems = xtask::wasi::problems(&xtask::repository()).expect("the manifest and sources");
    assert!(
        problems.is_empty(),
        "run `cargo xtask wasi` and commit the result:\n{}",
        problems.join("\n")
    );
}

const SEED: u64 = 7;

/// The first two numbers that follow from [`SEED`], and the first before `start`.
const RANDOM: &str = "(i64.const 0x63cbe1e459320dd7)";
const RANDOM_AFTER: &str = "(i64.const 0x044c3cd7f43c661c)";
const RANDOM_BEFORE_START: &str = "(i64.const 0xe220a8397b1dcdaf)";

/// Plays a robot in the first bundled maze.
#[track_caller]
fn play(robot: &[u8]) -> DetailedMatch {
    let limits = Limits::default();
    let executor = InProcess::new(limits, 1, None).expect("address space for one match");
    let admitted = match executor.admit(robot).expect("the host works") {
        Ok(admitted) => admitted,
        Err(rejection) => panic!("rejected: {rejection}"),
    };
    let (_, maze) = &bundled_mazes()[0];
    let spec = spec(&rules(limits.sandbox), admitted.digest(), maze, (0, SEED));
    let played = || {
        let played = executor.execute_with_details(&admitted, &spec);
        played.expect("the host works")
    };
    let (first, second) = (played(), played());
    assert_eq!(first.record, second.record);
    first
}

/// What a match shows: its log with step and level, and the fault.
fn shown(played: &DetailedMatch) -> String {
    let entries = played.recording.journal.entries();
    let lines = entries.filter_map(|entry| match entry.note {
        Note::Log { level, text } => {
            let level = if level == Level::Error {
                "error"
            } else {
                "info"
            };
            Some(format!("{} {level}: {}\n", entry.step, text.raw()))
        }
        _ => None,
    });
    let mut shown: String = lines.collect();
    if let Some(fault) = played.record.verdict.fault() {
        shown.push_str(fault.describe().raw());
    }
    shown
}

/// What the probes have besides the function that they ask.
const REST: &str = r#"
    (func $is (param i64 i64) (if (i64.ne (local.get 0) (local.get 1)) (then unreachable)))
    (func $is32 (param i32 i32) (if (i32.ne (local.get 0) (local.get 1)) (then unreachable)))
    (func (export "cabi_realloc") (param i32 i32 i32 i32) (result i32) (i32.const 4096))
    (data (i32.const 512) "one\ntwo")
    (data (i32.const 600) "\00\02\00\00\07\00\00\00")"#;

/// Asks a function of preview 1 in `start`, with results beginning at 64.
#[track_caller]
fn check_preview1(function: &str, signature: &str, body: &str, expected: &str) {
    let import =
        format!(r#"(import "wasi_snapshot_preview1" "{function}" (func $ask {signature}))"#);
    let probe = Module {
        imports: &import,
        start: body,
        rest: REST,
        ..Module::default()
    };
    assert_eq!(shown(&play(&probe.core())), expected, "{function}: {body}");
}

/// Arguments of no importance.
fn zeros(signature: &str) -> String {
    signature
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| ["i32", "i64"].contains(word))
        .map(|ty| format!("({ty}.const 0) "))
        .collect()
}

#[test]
fn preview_1_answers_as_documented() {
    let one = "(param i32) (result i32)";
    let two = "(param i32 i32) (result i32)";
    let four = "(param i32 i32 i32 i32) (result i32)";
    // Both sizes are zero.
    for name in ["args_sizes_get", "environ_sizes_get"] {
        let body = "(i64.store (i32.const 64) (i64.const -1))
            (call $is32 (call $ask (i32.const 64) (i32.const 68)) (i32.const 0))
            (call $is (i64.load (i32.const 64)) (i64.const 0))";
        check_preview1(name, two, body, "");
    }
    for name in ["args_get", "environ_get"] {
        let body = "(call $is32 (call $ask (i32.const 64) (i32.const 68)) (i32.const 0))";
        check_preview1(name, two, body, "");
    }
    let body = "(call $is32 (call $ask (i32.const 1) (i32.const 64)) (i32.const 0))
        (call $is (i64.load (i32.const 64)) (i64.const 1000))
        (call $is32 (call $ask (i32.const 2) (i32.const 64)) (i32.const 28))";
    check_preview1("clock_res_get", two, body, "");
    let body = "(call $is32 (call $ask (i32.const 0) (i64.const 0) (i32.const 64)) (i32.const 0))
        (call $is (i64.load (i32.const 64)) (i64.const 1000))
        (call $is32 (call $ask (i32.const 1) (i64.const 0) (i32.const 64)) (i32.const 0))
        (call $is (i64.load (i32.const 64)) (i64.const 2000))
        (call $is32 (call $ask (i32.const 3) (i64.const 0) (i32.const 64)) (i32.const 28))";
    let signature = "(param i32 i64 i32) (result i32)";
    check_preview1("clock_time_get", signature, body, "");
    let body = format!(
        "(call $is32 (call $ask (i32.const 64) (i32.const 11)) (i32.const 0))
        (call $is (i64.load (i32.const 64)) {RANDOM})
        (call $is (i64.load (i32.const 72)) (i64.and {RANDOM_AFTER} (i64.const 0xffffff)))"
    );
    check_preview1("random_get", two, &body, "");
    // A timer of 5 s: its event comes at once, with the data of the user.
    let body = "(i64.store (i32.const 128) (i64.const 42))
        (i64.store (i32.const 152) (i64.const 5000000000))
        (i64.store (i32.const 72) (i64.const -1))
        (call $is32 (call $ask (i32.const 128) (i32.const 64) (i32.const 1) (i32.const 96)) (i32.const 0))
        (call $is32 (i32.load (i32.const 96)) (i32.const 1))
        (call $is (i64.load (i32.const 64)) (i64.const 42))
        (call $is (i64.load (i32.const 72)) (i64.const 0))
        (call $is32 (call $ask (i32.const 128) (i32.const 64) (i32.const 0) (i32.const 96)) (i32.const 28))";
    check_preview1("poll_oneoff", four, body, "");
    check_preview1(
        "sched_yield",
        "(result i32)",
        "(call $is32 (call $ask) (i32.const 0))",
        "",
    );
    let body = "(call $ask (i32.const 3))";
    let expected = "panicked: exited with code 3 in `start`";
    check_preview1("proc_exit", "(param i32)", body, expected);
    let body = "(call $is32 (call $ask (i32.const 0) (i32.const 600) (i32.const 1) (i32.const 64)) (i32.const 0))
        (call $is32 (i32.load (i32.const 64)) (i32.const 0))
        (call $is32 (call $ask (i32.const 1) (i32.const 600) (i32.const 1) (i32.const 64)) (i32.const 8))";
    check_preview1("fd_read", four, body, "");
    for (fd, rights) in [(0, 0x800_0002), (1, 0x800_0040), (2, 0x800_0040)] {
        let body = format!(
            "(call $is32 (call $ask (i32.const {fd}) (i32.const 64)) (i32.const 0))
            (call $is (i64.load (i32.const 64)) (i64.const 2))
            (call $is (i64.load (i32.const 72)) (i64.const {rights}))"
        );
        check_preview1("fd_fdstat_get", two, &body, "");
    }
    let body = "(call $is32 (call $ask (i32.const 1) (i32.const 64)) (i32.const 0))
        (call $is (i64.load (i32.const 80)) (i64.const 2))
        (call $is32 (call $ask (i32.const 3) (i32.const 64)) (i32.const 8))";
    check_preview1("fd_filestat_get", two, body, "");
    let answers = |name: &str, signature: &str, fd: u32, error: u32| {
        let others = zeros(&signature.replacen("i32", "", 1).replace("(result i32)", ""));
        let body =
            format!("(call $is32 (call $ask (i32.const {fd}) {others}) (i32.const {error}))");
        check_preview1(name, signature, &body, "");
    };
    for (name, signature, error) in [
        ("fd_close", one, 0),
        ("fd_datasync", one, 0),
        ("fd_sync", one, 0),
        ("fd_fdstat_set_flags", two, 0),
        (
            "fd_fdstat_set_rights",
            "(param i32 i64 i64) (result i32)",
            0,
        ),
        ("fd_seek", "(param i32 i64 i32 i32) (result i32)", 70),
        ("fd_tell", two, 70),
        ("fd_pread", "(param i32 i32 i32 i64 i32) (result i32)", 70),
        ("fd_pwrite", "(param i32 i32 i32 i64 i32) (result i32)", 70),
        ("fd_advise", "(param i32 i64 i64 i32) (result i32)", 8),
        ("fd_allocate", "(param i32 i64 i64) (result i32)", 8),
        ("fd_filestat_set_size", "(param i32 i64) (result i32)", 8),
        (
            "fd_filestat_set_times",
            "(param i32 i64 i64 i32) (result i32)",
            8,
        ),
        ("fd_prestat_get", two, 8),
        ("fd_prestat_dir_name", "(param i32 i32 i32) (result i32)", 8),
        ("fd_readdir", "(param i32 i32 i32 i64 i32) (result i32)", 8),
        ("fd_renumber", two, 8),
    ] {
        answers(name, signature, 1, error);
        answers(name, signature, 3, 8);
    }
    for (name, signature) in [
        (
            "path_open",
            "(param i32 i32 i32 i32 i32 i64 i64 i32 i32) (result i32)",
        ),
        (
            "path_filestat_get",
            "(param i32 i32 i32 i32 i32) (result i32)",
        ),
        (
            "path_readlink",
            "(param i32 i32 i32 i32 i32 i32) (result i32)",
        ),
    ] {
        answers(name, signature, 3, 44);
    }
    for (name, signature) in [
        ("path_create_directory", "(param i32 i32 i32) (result i32)"),
        (
            "path_filestat_set_times",
            "(param i32 i32 i32 i32 i64 i64 i32) (result i32)",
        ),
        (
            "path_link",
            "(param i32 i32 i32 i32 i32 i32 i32) (result i32)",
        ),
        ("path_remove_directory", "(param i32 i32 i32) (result i32)"),
        (
            "path_rename",
            "(param i32 i32 i32 i32 i32 i32) (result i32)",
        ),
        ("path_symlink", "(param i32 i32 i32 i32 i32) (result i32)"),
        ("path_unlink_file", "(param i32 i32 i32) (result i32)"),
        ("proc_raise", one),
        ("sock_accept", "(param i32 i32 i32) (result i32)"),
        ("sock_recv", "(param i32 i32 i32 i32 i32 i32) (result i32)"),
        ("sock_send", "(param i32 i32 i32 i32 i32) (result i32)"),
        ("sock_shutdown", two),
    ] {
        let arguments = zeros(&signature.replace("(result i32)", ""));
        let expected =
            format!("panicked: called `{name}`, which is not available to robots in `start`");
        check_preview1(
            name,
            signature,
            &format!("(drop (call $ask {arguments}))"),
            &expected,
        );
    }
}

/// Lines are put together from pieces, and what is not ended is logged at the end of the call.
#[test]
fn preview_1_writes_lines() {
    let signature = "(param i32 i32 i32 i32) (result i32)";
    let write = |fd: u32| {
        format!(
            "(call $is32 (call $ask (i32.const {fd}) (i32.const 600) (i32.const 1) (i32.const 64)) (i32.const 0))
            (call $is32 (i32.load (i32.const 64)) (i32.const 7))"
        )
    };
    let check = |body: &str, expected: &str| check_preview1("fd_write", signature, body, expected);
    check(&write(1), "0 info: one\n0 info: two\n");
    check(
        &write(2).repeat(2),
        "0 error: one\n0 error: twoone\n0 error: two\n",
    );
    let both = [write(1), write(2)].concat();
    check(
        &both,
        "0 info: one\n0 error: one\n0 info: two\n0 error: two\n",
    );
    check(
        "(call $is32 (call $ask (i32.const 3) (i32.const 600) (i32.const 1) (i32.const 64)) (i32.const 8))",
        "",
    );
    // What is left of a line comes in the step that wrote it, and the exit quotes that step.
    let imports = r#"
        (import "wasi_snapshot_preview1" "fd_write" (func $ask (param i32 i32 i32 i32) (result i32)))
        (import "wasi_snapshot_preview1" "proc_exit" (func $exit (param i32)))"#;
    let ask = "(drop (call $ask (i32.const 2) (i32.const 600) (i32.const 1) (i32.const 64)))";
    let robot = Module {
        imports,
        start: ask,
        next: &format!("{ask} (call $exit (i32.const 2)) unreachable"),
        rest: REST,
        ..Module::default()
    };
    let expected = "0 error: one\n0 error: two\n1 error: one\n1 error: two\n\
        panicked: exited with code 2: one\ntwo in step 1 (exploration run, at (0, 0))";
    assert_eq!(shown(&play(&robot.core())), expected);
}

/// A component that imports functions of preview 2, as `(interface, name, signature)`, under
/// the names `$0`, `$1`...
#[track_caller]
fn probe(imports: &[(&str, &str, &str)], body: &str, rest: &str) -> Vec<u8> {
    let imports: String = imports
        .iter()
        .enumerate()
        .map(|(number, (interface, name, signature))| {
            format!(r#"(import "wasi:{interface}@0.2.12" "{name}" (func ${number} {signature}))"#)
        })
        .collect();
    let module = Module {
        imports: &imports,
        start: body,
        rest: &format!("{REST} {rest}"),
        ..Module::default()
    };
    typed(&module.core()).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn composed(component: &[u8]) -> Vec<u8> {
    compose(component, &Limits::default()).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn check_preview2(imports: &[(&str, &str, &str)], body: &str, expected: &str) {
    let robot = composed(&probe(imports, body, ""));
    assert_eq!(shown(&play(&robot)), expected, "{imports:?}: {body}");
}

#[test]
fn preview_2_answers_as_documented() {
    let at = "(param i32)";
    // Empty lists, and no option.
    for (interface, name) in [
        ("cli/environment", "get-environment"),
        ("cli/environment", "get-arguments"),
        ("filesystem/preopens", "get-directories"),
    ] {
        let body = "(i32.store (i32.const 68) (i32.const 9)) (call $0 (i32.const 64))
            (call $is32 (i32.load (i32.const 68)) (i32.const 0))";
        check_preview2(&[(interface, name, at)], body, "");
    }
    for (interface, name) in [
        ("cli/environment", "initial-cwd"),
        ("cli/terminal-stdin", "get-terminal-stdin"),
        ("cli/terminal-stdout", "get-terminal-stdout"),
        ("cli/terminal-stderr", "get-terminal-stderr"),
    ] {
        let body = "(i32.store (i32.const 64) (i32.const 9)) (call $0 (i32.const 64))
            (call $is32 (i32.load8_u (i32.const 64)) (i32.const 0))";
        check_preview2(&[(interface, name, at)], body, "");
    }
    let exit = |name: &str, status: u32, expected: &str| {
        let body = format!("(call $0 (i32.const {status}))");
        check_preview2(&[("cli/exit", name, at)], &body, expected);
    };
    exit("exit", 0, "panicked: exited with code 0 in `start`");
    exit("exit", 1, "panicked: exited with code 1 in `start`");
    exit(
        "exit-with-code",
        42,
        "panicked: exited with code 42 in `start`",
    );
    let value = "(result i64)";
    let clock = "clocks/monotonic-clock";
    check_preview2(
        &[
            (clock, "now", value),
            (clock, "resolution", value),
            ("clocks/wall-clock", "now", at),
        ],
        "(call $is (call $0) (i64.const 1000)) (call $is (call $0) (i64.const 2000))
        (call $is (call $1) (i64.const 1000))
        (call $2 (i32.const 64)) (call $is (i64.load (i32.const 64)) (i64.const 0))
        (call $is32 (i32.load (i32.const 72)) (i32.const 3000))",
        "",
    );
    check_preview2(
        &[("clocks/wall-clock", "resolution", at)],
        "(call $0 (i32.const 64)) (call $is (i64.load (i32.const 64)) (i64.const 0))
        (call $is32 (i32.load (i32.const 72)) (i32.const 1000))",
        "",
    );
    // Waiting for 1 s takes no time but that of the clock.
    for (name, when) in [
        ("subscribe-duration", 1_000_000_000),
        ("subscribe-instant", 1_000_001_000),
    ] {
        let body = format!(
            "(local $timer i32) (drop (call $0)) (local.set $timer (call $1 (i64.const {when})))
            (call $is32 (call $2 (local.get $timer)) (i32.const 1)) (call $3 (local.get $timer))
            (call $is (call $0) (i64.const 1000002000))
            (i32.store (i32.const 128) (local.get $timer))
            (call $4 (i32.const 128) (i32.const 1) (i32.const 64))
            (call $is32 (i32.load (i32.const 68)) (i32.const 1))
            (call $is32 (i32.load (i32.load (i32.const 64))) (i32.const 0))"
        );
        let imports = [
            (clock, "now", value),
            (clock, name, "(param i64) (result i32)"),
            (
                "io/poll",
                "[method]pollable.ready",
                "(param i32) (result i32)",
            ),
            ("io/poll", "[method]pollable.block", at),
            ("io/poll", "poll", "(param i32 i32 i32)"),
        ];
        check_preview2(&imports, &body, "");
    }
    for (interface, name) in [
        ("random/random", "get-random-u64"),
        ("random/insecure", "get-insecure-random-u64"),
    ] {
        check_preview2(
            &[(interface, name, value)],
            &format!("(call $is (call $0) {RANDOM})"),
            "",
        );
    }
    for (interface, name) in [
        ("random/random", "get-random-bytes"),
        ("random/insecure", "get-insecure-random-bytes"),
    ] {
        let body = format!(
            "(call $0 (i64.const 11) (i32.const 64))
            (call $is32 (i32.load (i32.const 68)) (i32.const 11))
            (call $is (i64.load (i32.load (i32.const 64))) {RANDOM})
            (call $is (i64.load offset=8 (i32.load (i32.const 64)))
                (i64.and {RANDOM_AFTER} (i64.const 0xffffff)))"
        );
        check_preview2(&[(interface, name, "(param i64 i32)")], &body, "");
    }
    let body = format!(
        "(call $0 (i32.const 64)) (call $is (i64.load (i32.const 64)) {RANDOM})
        (call $is (i64.load (i32.const 72)) {RANDOM_AFTER})"
    );
    check_preview2(&[("random/insecure-seed", "insecure-seed", at)], &body, "");
    // Standard input is closed: a result with the error `closed`.
    let stream = |method: &str| format!("[method]input-stream.{method}");
    for (name, error_at) in [
        ("read", 68),
        ("blocking-read", 68),
        ("skip", 72),
        ("blocking-skip", 72),
    ] {
        let body = format!(
            "(call $1 (call $0) (i64.const 5) (i32.const 64))
            (call $is32 (i32.load8_u (i32.const 64)) (i32.const 1))
            (call $is32 (i32.load8_u (i32.const {error_at})) (i32.const 1))"
        );
        let imports = [
            ("cli/stdin", "get-stdin", "(result i32)"),
            ("io/streams", &*stream(name), "(param i32 i64 i32)"),
        ];
        check_preview2(&imports, &body, "");
    }
    check_preview2(
        &[
            ("cli/stdin", "get-stdin", "(result i32)"),
            (
                "io/streams",
                &stream("subscribe"),
                "(param i32) (result i32)",
            ),
            ("io/poll", "[method]pollable.block", at),
        ],
        "(call $2 (call $1 (call $0)))",
        "",
    );
}

#[test]
fn preview_2_writes_lines() {
    let stream = |method: &str| format!("[method]output-stream.{method}");
    for (interface, get, level) in [
        ("cli/stdout", "get-stdout", "info"),
        ("cli/stderr", "get-stderr", "error"),
    ] {
        for name in ["write", "blocking-write-and-flush"] {
            let imports = [
                (interface, get, "(result i32)"),
                ("io/streams", &*stream(name), "(param i32 i32 i32 i32)"),
            ];
            let write = "(call $1 (call $0) (i32.const 512) (i32.const 7) (i32.const 64))
                (call $is32 (i32.load8_u (i32.const 64)) (i32.const 0))";
            let expected = format!("0 {level}: one\n0 {level}: twoone\n0 {level}: two\n");
            check_preview2(&imports, &write.repeat(2), &expected);
        }
        for name in ["flush", "blocking-flush", "check-write"] {
            let imports = [
                (interface, get, "(result i32)"),
                ("io/streams", &*stream(name), "(param i32 i32)"),
            ];
            let body = "(call $1 (call $0) (i32.const 64))
                (call $is32 (i32.load8_u (i32.const 64)) (i32.const 0))";
            check_preview2(&imports, body, "");
        }
    }
    check_preview2(
        &[
            ("cli/stderr", "get-stderr", "(result i32)"),
            ("io/streams", &stream("write"), "(param i32 i32 i32 i32)"),
            ("cli/exit", "exit", "(param i32)"),
        ],
        "(call $1 (call $0) (i32.const 512) (i32.const 7) (i32.const 64)) (call $2 (i32.const 1))",
        "0 error: one\n0 error: two\npanicked: exited with code 1: one\ntwo in `start`",
    );
}

/// What is not answered and can be called without a file or socket, which nothing gives.
#[test]
fn preview_2_names_what_is_missing() {
    let check = |imports: &[(&str, &str, &str)], body: &str, name: &str| {
        let expected =
            format!("panicked: called `wasi:{name}`, which is not available to robots in `start`");
        check_preview2(imports, body, &expected);
    };
    for (interface, name) in [
        ("sockets/tcp-create-socket", "create-tcp-socket"),
        ("sockets/udp-create-socket", "create-udp-socket"),
    ] {
        let imports = [(interface, name, "(param i32 i32)")];
        let body = "(call $0 (i32.const 0) (i32.const 64))";
        check(&imports, body, &format!("{interface}#{name}"));
    }
    let network = (
        "sockets/instance-network",
        "instance-network",
        "(result i32)",
    );
    check(
        &[network],
        "(drop (call $0))",
        "sockets/instance-network#instance-network",
    );
    let imports = [
        ("cli/stdout", "get-stdout", "(result i32)"),
        (
            "io/streams",
            "[method]output-stream.write-zeroes",
            "(param i32 i64 i32)",
        ),
    ];
    let body = "(call $1 (call $0) (i64.const 9) (i32.const 64))";
    check(&imports, body, "io/streams#output-stream.write-zeroes");
}

/// Before `start`, numbers follow from a fixed seed; then from that of the match.
#[test]
fn the_seed_arrives_with_start() {
    let imports = [("random/random", "get-random-u64", "(result i64)")];
    let body = format!(
        "(call $is (local.get 12) (i64.const {SEED})) (call $is (call $0) {RANDOM})
        (call $is (global.get $first) {RANDOM_BEFORE_START})"
    );
    // A module's own start function runs before its imports are there, `_initialize` after.
    let initialize = "(global $first (mut i64) (i64.const 0))
        (func (export \"_initialize\") (global.set $first (call $0)))";
    let robot = composed(&probe(&imports, &body, initialize));
    assert_eq!(shown(&play(&robot)), "");
}

#[test]
fn other_versions_of_wasi_are_answered() {
    const NAME: &[u8] = b"wasi:random/random@0.2.12";
    let imports = [("random/random", "get-random-u64", "(result i64)")];
    let component = probe(&imports, &format!("(call $is (call $0) {RANDOM})"), "");
    // The names have the same length, so the rest of the file stays what it is.
    let with_version = |version: &str| {
        let mut bytes = component.clone();
        for at in 0..bytes.len() - NAME.len() {
            if bytes[at..].starts_with(NAME) {
                let end = at + NAME.len();
                bytes[end - version.len()..end].copy_from_slice(version.as_bytes());
            }
        }
        assert_ne!(bytes, component);
        bytes
    };
    for version in ["0.2.10", "0.2.99"] {
        assert_eq!(
            shown(&play(&composed(&with_version(version)))),
            "",
            "{version}"
        );
    }
    for version in ["0.3.12", "1.2.12", "0.2.0-"] {
        let error = compose(&with_version(version), &Limits::default());
        error.expect_err(version);
    }
}

/// A robot that asks for what is between the parts gets nothing, however it comes.
#[test]
fn inner_interfaces_cannot_be_imported() {
    let inner = [
        (
            "wasmouse:wasi/match@0.1.0",
            "begin",
            "(param \"seed\" u64)",
            "(param i64)",
        ),
        ("wasmouse:wasi/console@0.1.0", "end-call", "", ""),
    ];
    for (interface, name, component_type, core_type) in inner {
        let component = wasm(&format!(
            r#"(component
                (import "{interface}" (instance (export "{name}" (func {component_type}))))
                (import "wasi:random/random@0.2.0" (instance))
                (instance $empty)
                (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#
        ));
        let message =
            format!("the component imports `{interface}`, which is not available to robots");
        let error = compose(&component, &Limits::default()).expect_err(interface);
        assert_eq!(error.to_string(), message);
        let rejection = examine(&component, &Limits::default()).component.err();
        assert_eq!(rejection.map(|it| it.to_string()), Some(message));
        // Also beside preview 1, where the adapter has it.
        for wasi in [
            "",
            r#"(import "wasi_snapshot_preview1" "sched_yield" (func (result i32)))"#,
        ] {
            let module = Module {
                imports: &format!(r#"{wasi} (import "{interface}" "{name}" (func {core_type}))"#),
                ..Module::default()
            };
            let error = componentize(&module.core())
                .expect_err(interface)
                .to_string();
            let message = format!(
                "core module imports `{name}` from `{interface}`, which is not available to robots"
            );
            assert_eq!(error, message);
        }
    }
}

#[test]
fn components_that_cannot_be_composed_say_why() {
    let check = |file: &[u8], expected: &str| {
        let error = compose(file, &Limits::default()).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
        assert!(!error.hint().is_empty());
    };
    check(b"hello", "not a component");
    check(&Module::default().core(), "not a component");
    check(&wasm("(component)"), "already a component");
    let import = r#"(import "wasi:random/random@0.2.0" (instance))"#;
    check(
        &wasm(&format!("(component {import})")),
        "does not export `wasmouse:robot/controller@",
    );
    let with = |name: &str| {
        wasm(&format!(
            r#"(component {import} (import "{name}" (instance (export "f" (func)))) (instance $empty)
                (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#
        ))
    };
    check(
        &with("wasi:http/types@0.2.10"),
        "`wasi:http/types@0.2.10`, which is not among",
    );
    check(
        &with("other:thing/it@1.0.0"),
        "`other:thing/it@1.0.0`, which is not available",
    );
    check(&with("wasi:cli/exit@0.2.0"), "does not fit the interfaces");
    check(
        &with("wasmouse:robot/journal@0.1.0"),
        "built for wasmouse:robot@0.1.0",
    );
}

/// What takes long to validate is rejected before it is composed.
#[test]
fn bombs_are_not_composed() {
    let outer = wasm(
        r#"(component
            (import "wasi:random/random@0.2.0" (instance))
            (instance $empty)
            (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
    );
    for bomb in [
        bombs::declared_instances(1900, 18),
        bombs::compared_instances(2000, 100, 10),
        bombs::exported_instances(2000, 100, 10),
        bombs::nested_component_types(60),
        bombs::wide_record(9_000),
    ] {
        let mut file = outer.clone();
        let section = wasm_encoder::RawSection { id: 4, data: &bomb };
        wasm_encoder::ComponentSection::append_to_component(&section, &mut file);
        let error = compose(&file, &Limits::default()).expect_err("a bomb");
        assert!(error.to_string().contains("and the limit is"), "{error}");
    }
}

/// From a file with WASI to a score, with the commands that messages give.
#[test]
fn a_component_with_wasi_is_built_and_played() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let imports = [("random/random", "get-random-u64", "(result i64)")];
    let component = probe(&imports, &format!("(call $is (call $0) {RANDOM})"), "");
    fs::write(folder.path().join("bot.wasm"), component).expect("a file");
    let command = |arguments: &str| {
        let mut command = wasmouse();
        command
            .current_dir(folder.path())
            .args(arguments.split(' '));
        command
    };
    let rejected = ran(&mut command(
        "run bot.wasm test_maze_01 --seed 7 --no-cache",
    ));
    let text = rejected.stderr;
    assert!(text.contains("`wasmouse build FILE.wasm`"), "{text}");
    let built = stdout_of(&mut command("build bot.wasm"));
    assert!(built.starts_with("bot.robot.wasm\n"), "{built}");
    let played = ran(&mut command(
        "run bot.robot.wasm test_maze_01 --seed 7 --no-cache --reproduce",
    ));
    assert!(
        played.stdout.contains("budget used up"),
        "{}",
        played.stdout
    );
    assert!(
        played.stderr.contains("reproduced 1 match\n"),
        "{}",
        played.stderr
    );
}

/// Every interface and function has its place in the documentation.
#[test]
fn the_documentation_lists_everything() {
    let root = xtask::repository();
    let page = fs::read_to_string(root.join("docs/WASI.md")).expect("docs/WASI.md");
    for name in functions(&root.join(FOLDER)).expect("the parts are readable") {
        assert!(
            page.contains(&format!("`{name}`")),
            "`{name}` is not in docs/WASI.md"
        );
    }
}

/// Rejections name the command for components alone.
#[test]
fn the_hint_names_the_command() {
    let rejection = Rejection::UnknownImport("wasi:cli/exit@0.2.0".into());
    assert!(
        rejection
            .hint()
            .raw()
            .contains("`wasmouse build FILE.wasm`")
    );
    let rejection = Rejection::UnknownImport("other:thing/it".into());
    assert!(!rejection.hint().raw().contains("wasmouse build"));
}
