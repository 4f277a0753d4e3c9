//! Files: what is no robot at the first look, or has strange sections.

use std::fs;

use wasmouse_engine::bundled::find;
use wasmouse_engine::{Cache, Limits, Runtime};

use super::binary::{custom, escaped};
use super::case::{Case, harmless, invalid, rejected, unreachable};
use crate::composite::Composite;
use crate::module::{IMPORT_LOG, Module};

/// The cases 52, 53, 55 to 57 and 68.
pub fn cases() -> Vec<Case> {
    [other_files(), cut_files(), sections()]
        .into_iter()
        .flatten()
        .collect()
}

/// A file that is rejected for what it looks like.
fn other_files() -> Vec<Case> {
    let looks = |numbers, name: &str, look: &str, bytes: &'static [u8]| {
        let reason = format!("the file is not WebAssembly: it looks like {look}");
        Case::new(numbers, name, rejected("not-wasm", &reason), || {
            bytes.to_vec()
        })
    };
    let unknown = "WebAssembly of an unknown version";
    vec![
        Case::new(
            &[52],
            "empty-file",
            rejected("empty", "the file is empty"),
            Vec::new,
        )
        .shown(),
        Case::new(
            &[55],
            "wat-text",
            rejected(
                "no-controller",
                "the component does not export `wasmouse:robot/controller@VERSION`; it exports \
                nothing",
            ),
            || b"\n (component)".to_vec(),
        ),
        looks(
            &[56],
            "elf-file",
            "an ELF executable",
            b"\x7fELF\x02\x01\x01\0",
        ),
        Case::new(
            &[56],
            "precompiled-component",
            rejected(
                "not-wasm",
                "the file is not WebAssembly: it looks like machine \
                code precompiled by wasmtime, which is never accepted",
            ),
            precompiled,
        ),
        looks(
            &[56],
            "windows-executable",
            "a Windows executable",
            b"MZ\x90\0",
        ),
        looks(&[57], "gzip-archive", "a gzip archive", b"\x1f\x8b\x08\0"),
        looks(&[57], "zip-archive", "a zip archive", b"PK\x03\x04"),
        looks(&[], "text-file", "a text file", b"hello, I am a robot\n"),
        looks(
            &[],
            "bytes-of-no-kind",
            "a binary file of another kind",
            b"\0\xff\xfe",
        ),
        looks(&[58], "magic-alone", unknown, b"\0asm"),
        looks(
            &[58],
            "unknown-version-of-wasm",
            unknown,
            b"\0asm\x02\0\0\0",
        ),
        looks(
            &[58],
            "unknown-layer-of-wasm",
            unknown,
            b"\0asm\x0d\0\x02\0",
        ),
        Case::new(
            &[58],
            "a-byte-more-than-allowed",
            rejected("too-large", "the file has more than 33554432 bytes"),
            || vec![b'x'; (32 << 20) + 1],
        ),
    ]
}

/// Machine code as it is in the cache of a host.
fn precompiled() -> Vec<u8> {
    const HEADER_BYTES: usize = 160;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = Cache::open(folder.path().join("cache")).expect("a cache");
    let runtime = Runtime::new(Limits::default(), 1, Some(cache)).expect("a runtime");
    runtime
        .admit(&Module::default().component())
        .expect("a harmless robot");
    let mut entries = fs::read_dir(folder.path().join("cache")).expect("a cache");
    let entry = entries.next().expect("the compiled robot").expect("a file");
    let artifact = fs::read(entry.path()).expect("the entry");
    artifact[HEADER_BYTES..].to_vec()
}

/// A cut file is rejected, or harmless where only names and notes are missing.
fn cut_files() -> Vec<Case> {
    let cut = |name: &str, file: fn() -> Vec<u8>, stride: usize| {
        Case::series(&[53], name, rejected("...", "..."), move || {
            let file = file();
            let lengths = (0..file.len()).step_by(stride);
            lengths.map(|length| file[..length].to_vec()).collect()
        })
        .or(harmless())
    };
    vec![
        cut("core-module-cut-at-every-byte", || logging().core(), 1),
        cut("component-cut-at-every-byte", || logging().component(), 5),
        cut(
            "flood-cut",
            || find("flood").expect("a bundled robot").component.to_vec(),
            1013,
        ),
        // The same with other bytes instead of none.
        Case::series(
            &[53],
            "component-with-a-flipped-bit",
            rejected("...", "..."),
            || {
                let file = logging().component();
                let flip = |at: usize| {
                    let mut file = file.clone();
                    file[at] ^= 1 << (at % 8);
                    file
                };
                (0..file.len()).step_by(7).map(flip).collect()
            },
        )
        .or(harmless())
        .or(serde_json::json!({"verdict": {"kind": "fault"}})),
    ]
}

fn logging() -> Module<'static> {
    Module {
        imports: IMPORT_LOG,
        ..Module::default()
    }
}

fn sections() -> Vec<Case> {
    let large = || custom("note", &vec![0; 31 << 20]);
    let malformed =
        |name: &str, make: fn() -> Vec<u8>| Case::new(&[68], name, unreachable(), make).shown();
    vec![
        Case::new(
            &[68],
            "custom-section-of-100-mb",
            rejected("too-large", "the file has more than 33554432 bytes"),
            || {
                [
                    Module::default().component(),
                    custom("note", &vec![0; 100 << 20]),
                ]
                .concat()
            },
        ),
        Case::new(&[68], "custom-section-of-31-mb", harmless(), move || {
            [Module::default().component(), large()].concat()
        }),
        Case::new(
            &[68],
            "custom-section-of-31-mb-in-a-module",
            harmless(),
            move || [Module::default().core(), large()].concat(),
        )
        .megabytes(250),
        Case::new(&[68], "100000-custom-sections", harmless(), || {
            let sections = custom("note", b"x").repeat(100_000);
            [Module::default().component(), sections].concat()
        }),
        Case::new(
            &[68],
            "custom-section-longer-than-the-file",
            invalid("unexpected end-of-file"),
            || {
                [
                    &Module::default().component(),
                    &b"\0\xff\xff\xff\xff\x0f\x04note"[..],
                ]
                .concat()
            },
        ),
        malformed("malformed-names", || noted(&[("name", &noise())])),
        // Function names, one of which claims to be 4 GiB long.
        malformed("names-that-lie", || {
            noted(&[("name", b"\x01\x0a\x02\x00\x01a\x01\xff\xff\xff\xff\x0fb")])
        }),
        malformed("malformed-dwarf", || {
            let noise = noise();
            noted(&[
                (".debug_info", &noise),
                (".debug_abbrev", &noise),
                (".debug_line", &noise),
                (".debug_str", &noise),
                (".debug_ranges", &noise),
            ])
        }),
        malformed("malformed-producers", || noted(&[("producers", &noise())])),
        malformed("malformed-source-map", || {
            noted(&[("sourceMappingURL", b"\x20file:///etc/passwd\x1b[31m")])
        }),
        // Turning a module into a component reads some of them.
        Case::new(
            &[68],
            "malformed-names-in-a-core-module",
            rejected(
                "core-module",
                "core module does not fit the world `wasmouse:robot/robot@VERSION`: ...",
            ),
            || [Module::default().core(), custom("name", &noise())].concat(),
        ),
        Case::new(&[68], "malformed-component-type", harmless(), || {
            [
                Module::default().core(),
                custom("component-type:robot", &noise()),
            ]
            .concat()
        }),
    ]
}

/// A robot that fails, with these custom sections in its module.
fn noted(sections: &[(&str, &[u8])]) -> Vec<u8> {
    let notes: String = sections
        .iter()
        .map(|(name, content)| format!(r#"(@custom "{name}" "{}")"#, escaped(content)))
        .collect();
    Composite {
        robot: Module {
            memory: Composite::MEMORY,
            next: "unreachable",
            rest: &notes,
            ..Module::default()
        },
        ..Composite::default()
    }
    .component()
}

/// As hard to read as anything, and the same everywhere.
fn noise() -> Vec<u8> {
    let mut state = 1_u32;
    let next = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state.to_le_bytes()[3]
    };
    (0..4096).map(next).collect()
}
