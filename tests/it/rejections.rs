//! Rejections that depend on the limits or on the version of the interface. The others are in the
//! hostile corpus.

use wasmouse_engine::admission::INTERFACE_VERSION;
use wasmouse_tests::composite::Composite;
use wasmouse_tests::module::DRIVE_ON;

use crate::hostile::{Engine, IMPORT_LOG, Module, SMALL, wasm};

/// Compares name and reason of the rejection.
#[track_caller]
fn check(file: &[u8], expected: &str) {
    let engine = Engine::new(SMALL);
    let rejection = engine.admit(file).err().expect(expected);
    let found = format!("{}: {rejection}", rejection.name().escaped());
    // Where it was found depends on the encoder.
    let places = [" (core module", " (byte"];
    let place = places.iter().find_map(|place| found.find(place));
    let found = &found[..place.unwrap_or(found.len())];
    assert_eq!(found, expected);
    engine.assert_unharmed();
}

#[test]
fn requirements_beyond_the_limits_are_rejected() {
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
            (export "wasmouse:robot/controller@0.1.0" (instance $empty)))"#
    );
    check(
        &wasm(&with_controller),
        "over-limit: the file has 9 core instances, and the limit is 8",
    );
}

/// The text of a module or component with another version in place of this host's.
fn with_version(text: &str, version: &str) -> Vec<u8> {
    wasm(&text.replace(&format!("@{INTERFACE_VERSION}"), &format!("@{version}")))
}

#[test]
fn robots_for_another_version_are_rejected() {
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
    let rejection = Engine::new(SMALL).admit(&mixed.core()).err();
    let rejection = rejection.expect("another version");
    let hint = rejection.hint().raw();
    assert!(hint.contains("rebuild"), "{hint}");
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
            let record = Engine::new(SMALL).play(&robot).record;
            let title = record.verdict.title();
            assert_eq!(title, "budget used up", "{version}\n{text}");
            assert!(record.journal.entries > 0, "{version}");
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
    for (file, expected) in [
        (with_version(&text, "0.2.9"), "`win`"),
        // Exports and imports of two patch versions are a mistake of the build.
        (wasm(&text), "it imports `wasmouse:robot/journal@0.2.9`"),
    ] {
        let rejection = Engine::new(SMALL).admit(&file).err();
        let reason = rejection.expect("there is no such function").to_string();
        assert!(reason.contains(expected), "{reason}");
    }
}
