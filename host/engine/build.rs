//! Gives the crate an identity of its sources, `WASMOUSE_BUILD_ID`: what one build wrote into
//! the cache of compiled robots, another must not believe.

use std::env;
use std::fs;
use std::hash::{Hash as _, Hasher as _};
use std::path::{Path, PathBuf};

fn main() {
    let engine = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    // The core too: rules and limits are there.
    let folders = [engine.join("src"), engine.join("../core/src")];
    let mut files = Vec::new();
    for folder in folders {
        // A published crate does not have its neighbour, whose version it names instead.
        if folder.is_dir() {
            println!("cargo::rerun-if-changed={}", folder.display());
            sources(&folder, &mut files);
        }
    }
    files.sort();
    // Not a cryptographic hash: nobody gains anything from two builds that look alike.
    #[expect(deprecated, reason = "its values are the same in every release")]
    let mut hasher = std::hash::SipHasher::new();
    for file in files {
        let name = file.file_name().expect("a source file has a name");
        name.hash(&mut hasher);
        fs::read(&file).expect("a source file").hash(&mut hasher);
    }
    println!(
        "cargo::rustc-env=WASMOUSE_BUILD_ID={:016x}",
        hasher.finish()
    );
}

fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|it| it == "rs") {
            files.push(path);
        }
    }
}
