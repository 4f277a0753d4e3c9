//! Files that are no robots: each is refused with its own reason before anything
//! of it runs, and the host goes on as ever.

use std::panic::{AssertUnwindSafe, catch_unwind};

use wasmouse::robot::bundled::find;
use wasmouse::robot::componentize::componentize;
use wasmouse::robot::{Cache, Host, INTERFACE_VERSION, Recorder, Refusal};
use wasmouse::sim::{AdmissionLimits, Limits};

use wasmouse_tests::composite::Composite;
use wasmouse_tests::module::versioned;

use crate::hostile::{
    DRIVE_ON, IMPORT_LOG, Module, START_PARAMETERS, assert_unharmed, host, play, wasm,
};

/// Limits that small files can pass.
const SMALL: Limits = Limits {
    component_bytes_max: 100_000,
    start_fuel_max: 4_000_000,
    step_fuel_max: 4_000_000,
    match_fuel_max: 40_000_000,
    memory_bytes_max: 4 << 20,
    table_elements_max: 1000,
    stack_bytes_max: 128 << 10,
    core_instances_max: 8,
    memories_max: 4,
    tables_max: 4,
    journal_bytes_max: 1000,
    host_call_bytes_max: 4096,
    admission: AdmissionLimits::DEFAULT,
};

/// Compares kind and reason of the refusal.
#[track_caller]
fn check(file: &[u8], expected: &str) {
    let host = host(SMALL);
    let refusal = match host.admit(file) {
        Ok(_) => panic!("admitted, expected {expected}"),
        Err(refusal) => refusal,
    };
    let told = format!("{}: {refusal}", refusal.name());
    // Where it was found depends on the encoder.
    let told = told.split(" (byte").next().unwrap_or(&told);
    assert_eq!(told, versioned(expected));
    assert!(!refusal.hint().is_empty());
    // Looking at a file says the same as trying it.
    let inspected = host.inspect(file).refusal.expect("refused as before");
    assert_eq!(inspected.to_string(), refusal.to_string());
    assert_unharmed(&host);
}

#[test]
fn other_files_are_told_what_they_look_like() {
    check(b"", "empty: the file is empty");
    for (bytes, look) in [
        (&b"hello, I am a robot\n"[..], "a text file"),
        (
            b"\n (component)",
            "WebAssembly text (WAT), which has to be translated first",
        ),
        (b"\x7fELF\x02\x01\x01\0", "an ELF executable"),
        (b"\x1f\x8b\x08\0", "a gzip archive"),
        (b"PK\x03\x04", "a zip archive"),
        (b"MZ\x90\0", "a Windows executable"),
        (b"\0asm", "WebAssembly of an unknown version"),
        (b"\0asm\x02\0\0\0", "WebAssembly of an unknown version"),
        (b"\0\xff\xfe", "a binary file of another kind"),
    ] {
        check(
            bytes,
            &format!("not-wasm: the file is not a WebAssembly component: it looks like {look}"),
        );
    }
}

/// Machine code is only loaded from the host's own cache: the same bytes as a
/// submission are refused.
#[test]
fn machine_code_is_refused() {
    const DIGEST_BYTES: usize = 32;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = Cache::open(folder.path().join("cache")).expect("a cache");
    let caching = Host::new(SMALL, 1, Some(cache)).expect("a host");
    caching
        .admit(&Module::default().component())
        .expect("a harmless robot");
    let mut entries = std::fs::read_dir(folder.path().join("cache")).expect("a cache");
    let entry = entries.next().expect("the compiled robot").expect("a file");
    let artifact = std::fs::read(entry.path()).expect("the entry");
    check(
        &artifact[DIGEST_BYTES..],
        "not-wasm: the file is not a WebAssembly component: it looks like machine code \
         precompiled by wasmtime, which is never loaded from outside",
    );
}

#[test]
fn large_files_are_refused_unread() {
    check(
        &vec![b'x'; 100_001],
        "too-large: the file has more than 100000 bytes",
    );
}

#[test]
fn core_modules_without_the_exports_of_a_robot() {
    let start =
        format!(r#"(func (export "wasmouse:robot/controller@VERSION#start") {START_PARAMETERS})"#);
    for (module, reason) in [
        (
            "(module)".to_owned(),
            "core module without component types that exports neither \
             `wasmouse:robot/controller@VERSION#start` nor \
             `wasmouse:robot/controller@VERSION#next-move`; it exports nothing",
        ),
        (
            format!("(module {start})"),
            "core module without the export `wasmouse:robot/controller@VERSION#next-move`",
        ),
        (
            Module {
                imports: r#"(import "env" "now" (func (result f64)))"#,
                ..Module::default()
            }
            .wat(),
            "core module imports `now` from `env`, which no robot may import",
        ),
        (
            Module {
                imports: r#"(import "wasi_snapshot_preview1" "fd_write"
                    (func (param i32 i32 i32 i32) (result i32)))"#,
                ..Module::default()
            }
            .wat(),
            "core module imports `fd_write` from `wasi_snapshot_preview1`, \
             which no robot may import",
        ),
    ] {
        check(&wasm(&module), &format!("core-module: {reason}"));
    }
    // Truncated after the header, and garbage behind it.
    for rest in [&b"\x01"[..], b"\xff\xff\xff\xff\xff", b"\x01\x05\x01\x60"] {
        let host = host(SMALL);
        let file = [b"\0asm\x01\0\0\0", rest].concat();
        let refusal = host.admit(&file).err().expect("malformed");
        assert_eq!(refusal.name(), "core-module", "{refusal}");
    }
}

#[test]
fn core_modules_with_other_signatures_do_not_fit() {
    let module = r#"(module
        (memory (export "memory") 1)
        (func (export "wasmouse:robot/controller@VERSION#start"))
        (func (export "wasmouse:robot/controller@VERSION#next-move")
            (param i32 i32 i32) (result i32) i32.const 0))"#;
    let refusal = host(SMALL)
        .admit(&wasm(module))
        .err()
        .expect("`start` has no parameters");
    let reason = refusal.to_string();
    assert_eq!(refusal.name(), "core-module");
    assert!(reason.contains("does not fit the world"), "{reason}");
    assert!(
        reason.contains("/controller@") && reason.contains("#start"),
        "{reason}"
    );
}

#[test]
fn imports_that_no_robot_gets() {
    for (component, name) in [
        (
            r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#,
            "wasi:cli/environment@0.2.0",
        ),
        (
            r#"(component (import "wasi:clocks/monotonic-clock@0.2.3" (instance
                (export "now" (func (result u64))))))"#,
            "wasi:clocks/monotonic-clock@0.2.3",
        ),
        (r#"(component (import "now" (func (result u64))))"#, "now"),
        (
            r#"(component (import "wasmouse:robot/clock@VERSION" (instance)))"#,
            "wasmouse:robot/clock@VERSION",
        ),
        (r#"(component (import "m" (core module)))"#, "m"),
    ] {
        check(
            &wasm(component),
            &format!("unknown-import: the component imports `{name}`, which a robot does not get"),
        );
    }
}

#[test]
fn the_controller_has_to_be_exported_under_its_name() {
    for (component, exports) in [
        ("(component)", "nothing"),
        (
            r#"(component (instance $empty)
                (export "wasmouse:robot/controler@VERSION" (instance $empty))
                (export "other" (instance $empty)))"#,
            "`wasmouse:robot/controler@VERSION`, `other`",
        ),
    ] {
        check(
            &wasm(component),
            &format!(
                "no-controller: the component does not export \
                 `wasmouse:robot/controller@VERSION`; it exports {exports}"
            ),
        );
    }
}

/// The text of a module or component with another version in place of this host's.
fn with_version(text: &str, version: &str) -> Vec<u8> {
    wasm(&text.replace(&format!("@{INTERFACE_VERSION}"), &format!("@{version}")))
}

#[test]
fn robots_for_another_version_are_told_which() {
    let module = Module {
        imports: IMPORT_LOG,
        ..Module::default()
    };
    let composite = Composite::default();
    for version in ["0.1.0", "0.1.99", "0.3.0", "1.0.0", "0.2.0-rc.1"] {
        let expected = format!(
            "other-version: the robot was built for wasmouse:robot@{version}; \
             this host runs 0.2.x"
        );
        check(&with_version(&module.wat(), version), &expected);
        check(&with_version(&composite.wat(), version), &expected);
    }
    // One import of another version is enough.
    check(
        &wasm(
            r#"(component
                (import "wasmouse:robot/journal@0.1.0" (instance (export "log" (func))))
                (instance $empty)
                (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
        ),
        "other-version: the robot was built for wasmouse:robot@0.1.0; this host runs 0.2.x",
    );
    let old_import = IMPORT_LOG.replace("@VERSION", "@0.1.0");
    let mixed = Module {
        imports: &old_import,
        ..Module::default()
    };
    check(
        &mixed.core(),
        "other-version: the robot was built for wasmouse:robot@0.1.0; this host runs 0.2.x",
    );
    let refusal = host(SMALL).admit(&mixed.core()).err().expect("refused");
    assert!(refusal.hint().contains("rebuild"), "{}", refusal.hint());
}

#[test]
fn robots_for_another_patch_version_play() {
    let module = Module {
        imports: IMPORT_LOG,
        next: &format!("(call $log (i32.const 1) (i32.const 0) (i32.const 2)) {DRIVE_ON}"),
        ..Module::default()
    };
    let composite = Composite {
        robot: Module {
            memory: Composite::MEMORY,
            ..module
        },
        ..Composite::default()
    };
    for text in [module.wat(), composite.wat()] {
        for version in [INTERFACE_VERSION, "0.2.1", "0.2.17"] {
            let robot = with_version(&text, version);
            let host = host(SMALL);
            let mut recorder = Recorder::default();
            let outcome = play(&host, &robot, &mut recorder);
            assert_eq!(
                outcome.verdict.title(),
                "budget used up",
                "{version}\n{text}"
            );
            assert!(recorder.journal.entries().count() > 0, "{version}");
        }
    }
}

#[test]
fn a_patch_version_does_not_bring_functions_that_the_host_lacks() {
    let win = r#"(import "wasmouse:robot/journal@0.2.9" "win" (func))"#;
    let text = Module {
        imports: win,
        ..Module::default()
    }
    .wat();
    let refusal = host(SMALL)
        .admit(&with_version(&text, "0.2.9"))
        .err()
        .expect("there is no such function");
    assert!(refusal.to_string().contains("`win`"), "{refusal}");
    // Exports and imports of two patch versions are a mistake of the build.
    let refusal = host(SMALL).admit(&wasm(&text)).err().expect("refused");
    let reason = refusal.to_string();
    assert!(
        reason.contains("it imports `wasmouse:robot/journal@0.2.9`"),
        "{reason}"
    );
}

#[test]
fn the_right_names_with_other_types() {
    for component in [
        r#"(component (instance $empty)
            (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
        r#"(component
            (core module $m (func (export "f")))
            (core instance $i (instantiate $m))
            (func $f (canon lift (core func $i "f")))
            (instance $controller (export "start" (func $f)) (export "next-move" (func $f)))
            (export "wasmouse:robot/controller@VERSION" (instance $controller)))"#,
        r#"(component
            (core module $m (func (export "f")))
            (core instance $i (instantiate $m))
            (func $f (canon lift (core func $i "f")))
            (export "wasmouse:robot/controller@VERSION" (func $f)))"#,
        r#"(component
            (import "wasmouse:robot/journal@VERSION" (instance (export "log" (func))))
            (instance $empty)
            (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
        r#"(component
            (import "wasmouse:robot/journal@VERSION" (instance (export "shout" (func))))
            (instance $empty)
            (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
    ] {
        let host = host(SMALL);
        let refusal = host.admit(&wasm(component)).err().expect("refused");
        assert_eq!(refusal.name(), "wrong-type", "{refusal}\n{component}");
        assert_unharmed(&host);
    }
}

#[test]
fn needs_beyond_the_limits_are_told() {
    let many = |what: &str, count: usize| what.repeat(count);
    for (robot, expected) in [
        (
            Module {
                memory: r#"(memory (export "memory") 65)"#,
                ..Module::default()
            },
            "over-limit: the file has 4259840 bytes of one linear memory at the start, and the limit is 4194304",
        ),
        (
            Module {
                rest: "(table 1001 funcref)",
                ..Module::default()
            },
            "over-limit: the file has 1001 elements of one table at the start, and the limit is 1000",
        ),
        (
            Module {
                rest: &many("(memory 1)", 4),
                ..Module::default()
            },
            "over-limit: the file has 5 linear memories, and the limit is 4",
        ),
        (
            Module {
                rest: &many("(table 1 funcref)", 5),
                ..Module::default()
            },
            "over-limit: the file has 5 tables, and the limit is 4",
        ),
    ] {
        check(&robot.component(), expected);
    }
    let instances = "(core instance (instantiate $m))".repeat(9);
    let with_controller = format!(
        r#"(component (core module $m) {instances} (instance $empty)
            (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#
    );
    check(
        &wasm(&with_controller),
        "over-limit: the file has 9 core instances, and the limit is 8",
    );
}

#[test]
fn proposals_that_are_off_are_not_valid() {
    for (field, proposal) in [
        ("(memory i64 1)", "memory64"),
        ("(memory 1 1 shared)", "threads"),
        ("(tag)", "exceptions"),
        ("(type (struct))", "gc"),
    ] {
        let robot = Module {
            rest: field,
            ..Module::default()
        };
        let core = robot.core();
        let host = host(SMALL);
        let refusal = host.admit(&core).err().expect(proposal);
        assert!(
            matches!(refusal, Refusal::Invalid(_) | Refusal::CoreModule(_)),
            "{proposal}: {refusal}"
        );
        assert_unharmed(&host);
    }
}

/// A file cut anywhere is refused, or is a robot when only names and notes are
/// missing; the host never panics.
#[test]
fn truncated_components_are_refused() {
    let logging = Module {
        imports: IMPORT_LOG,
        ..Module::default()
    };
    let core = logging.core();
    let component = componentize(&core).expect("a robot");
    let flood = find("flood").expect("a bundled robot").component;
    let host = host(SMALL);
    for (name, file, stride) in [
        ("core module", &core[..], 1),
        ("component", &component, 7),
        ("flood", flood, 1013),
    ] {
        let mut admitted = 0;
        let cuts = (0..file.len()).step_by(stride);
        let count = cuts.len();
        for length in cuts {
            let cut = &file[..length];
            let result = catch_unwind(AssertUnwindSafe(|| host.admit(cut)))
                .unwrap_or_else(|_| panic!("{name}, {length} bytes: panicked"));
            admitted += usize::from(result.is_ok());
        }
        assert!(
            admitted * 10 <= count,
            "{name}: {admitted} of {count} admitted"
        );
    }
    assert_unharmed(&host);
}
