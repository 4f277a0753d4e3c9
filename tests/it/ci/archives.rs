//! `cargo xtask dist`, with a script in the place of the program.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::path::Path;

use flate2::read::GzDecoder;
use xtask::dist::{Args, run, version};

use super::repository_file;

const PROGRAM: &str = "#!/bin/sh\n";

/// Packs a program for that platform and returns the archive.
fn pack(folder: &Path, target: &str) -> Vec<u8> {
    let program = folder.join("program");
    fs::write(&program, PROGRAM).expect("a file");
    let args = Args {
        target: Some(target.to_owned()),
        binary: Some(program),
        to: Some(folder.to_owned()),
        ..Args::default()
    };
    run(&xtask::repository(), &args).expect("an archive");
    fs::read(folder.join(format!("wasmouse-{target}.tar.gz"))).expect("the archive")
}

/// Names, modes and contents of the files of an archive.
fn files(archive: &[u8]) -> BTreeMap<String, (u32, String)> {
    let mut archive = tar::Archive::new(GzDecoder::new(archive));
    let entries = archive.entries().expect("an archive");
    let files = entries.map(|entry| {
        let mut entry = entry.expect("a file");
        let name = entry.path().expect("a name").display().to_string();
        let mode = entry.header().mode().expect("a mode");
        let mut text = String::new();
        entry.read_to_string(&mut text).expect("text");
        (name, (mode, text))
    });
    files.collect()
}

#[test]
fn an_archive_has_the_program_and_the_documents() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (target, program) in [
        ("x86_64-unknown-linux-gnu", "wasmouse"),
        ("x86_64-pc-windows-msvc", "wasmouse.exe"),
    ] {
        let archive = pack(folder.path(), target);
        let files = files(&archive);
        let top = format!("wasmouse-{target}/");
        assert!(files.keys().all(|name| name.starts_with(&top)), "{files:?}");
        let program = &files[&format!("{top}{program}")];
        assert_eq!(*program, (0o755, PROGRAM.to_owned()));
        let version = version(&xtask::repository()).expect("a version");
        assert_eq!(files[&format!("{top}VERSION")].1, format!("{version}\n"));
        for document in [
            "README.md",
            "LICENSE-MIT",
            "LICENSE-APACHE",
            "LICENSE_DEJAVU",
            "CI.md",
        ] {
            let (mode, text) = &files[&format!("{top}{document}")];
            assert!(*mode == 0o644 && !text.is_empty(), "{document}");
        }
        let checksum = folder
            .path()
            .join(format!("wasmouse-{target}.tar.gz.sha256"));
        let line = fs::read_to_string(checksum).expect("a checksum");
        let digest = xtask::sources::sha256(&archive);
        assert_eq!(line, format!("{digest}  wasmouse-{target}.tar.gz\n"));
        // The same bytes when it is made again.
        assert!(pack(folder.path(), target) == archive);
    }
}

#[test]
fn a_tag_of_another_version_makes_no_release() {
    let args = Args {
        tag: Some("v999.0.0".to_owned()),
        ..Args::default()
    };
    let error = run(&xtask::repository(), &args).expect_err("it is not that version");
    assert!(error.starts_with("the tag is `v999.0.0`"), "{error}");
}

#[test]
fn installers_learn_where_they_are_published() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = folder.path().join("program");
    fs::write(&program, PROGRAM).expect("a file");
    let pack = |repository: &str| {
        let args = Args {
            binary: Some(program.clone()),
            to: Some(folder.path().to_owned()),
            repository: Some(repository.to_owned()),
            ..Args::default()
        };
        run(&xtask::repository(), &args)
    };
    pack("https://example.org/a/b").expect("installers");
    for (name, line) in [
        ("install.sh", "published_at='https://example.org/a/b'"),
        ("install.ps1", "$PublishedAt = 'https://example.org/a/b'"),
    ] {
        let script = fs::read_to_string(folder.path().join(name)).expect("a script");
        let original = fs::read_to_string(repository_file(name)).expect("a script");
        let differing = script.lines().zip(original.lines()).filter(|(a, b)| a != b);
        let differing: Vec<_> = differing.map(|it| it.0).collect();
        assert_eq!(differing, [line]);
    }
    let error = pack("https://example.org/'; rm -rf /").expect_err("no address");
    assert!(
        error.contains("is not the address of a repository"),
        "{error}"
    );
}

/// `cargo binstall` makes names by templates; they have to give those of the archives.
#[test]
fn cargo_binstall_finds_the_archives() {
    let manifest = fs::read_to_string(repository_file("host/Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = toml::from_str(&manifest).expect("a manifest");
    let metadata = &manifest["package"]["metadata"]["binstall"];
    let fill = |key: &str| {
        let template = metadata[key].as_str().expect("a template");
        [
            ("{ repo }", "https://example.org/a/b"),
            ("{ version }", "1.2.3"),
            ("{ target }", "T"),
            ("{ bin }", "wasmouse"),
            ("{ binary-ext }", ".exe"),
        ]
        .iter()
        .fold(template.to_owned(), |text, (key, value)| {
            text.replace(key, value)
        })
    };
    let folder = "https://example.org/a/b/releases/download/v1.2.3";
    assert_eq!(fill("pkg-url"), format!("{folder}/wasmouse-T.tar.gz"));
    assert_eq!(fill("bin-dir"), "wasmouse-T/wasmouse.exe");
    assert_eq!(metadata["pkg-fmt"].as_str(), Some("tgz"));
}
