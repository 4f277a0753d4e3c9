//! `wasmouse-core` has few dependencies, which only compute, and compiles for WebAssembly.
//!
//! [`layers`](super::layers) checks its own code for files, threads and clocks.

use std::path::Path;

use wasmouse_tests::binary::stdout_of;
use wasmouse_tests::wasm_target::{cargo, check};

/// The crates that may be linked into the core. None of them opens files, starts threads or
/// knows WebAssembly. `libc` is there on aarch64 only, where `cpufeatures` asks the operating
/// system for the features of the processor.
const REVIEWED: &str = "
    block-buffer cfg-if const-oid cpufeatures crypto-common data-encoding digest hybrid-array libc
    ppv-lite86 rand_chacha rand_core serde serde_core sha2 thiserror typenum zerocopy";

/// One platform of each kind. Not all of them at once (`--target all`), because that includes
/// what only a build for libFuzzer has.
const PLATFORMS: [&str; 5] = [
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "aarch64-apple-darwin",
    "x86_64-pc-windows-msvc",
    "wasm32-unknown-unknown",
];

/// Procedural macros run in the compiler alone.
#[test]
fn the_core_links_only_reviewed_crates() {
    PLATFORMS.into_iter().for_each(check_links);
}

fn check_links(platform: &str) {
    let tree = "tree --locked --package wasmouse-core --edges normal,no-proc-macro";
    let tree = stdout_of(cargo(tree).args(["--target", platform, "--prefix", "none"]));
    let names: Vec<&str> = tree
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(names.first(), Some(&"wasmouse-core"));
    for name in &names[1..] {
        let is_reviewed = REVIEWED.split_whitespace().any(|it| it == *name);
        assert!(is_reviewed, "`{name}` is not reviewed:\n{tree}");
    }
}

/// Including procedural macros.
#[test]
fn the_dependency_tree_of_the_core_fits_on_a_screen() {
    let tree = stdout_of(&mut cargo(
        "tree --locked --package wasmouse-core --edges normal",
    ));
    let lines = tree.lines().count();
    assert!((5..=40).contains(&lines), "{lines} lines:\n{tree}");
}

#[test]
fn the_core_compiles_for_webassembly() {
    let target_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("core-for-wasm");
    stdout_of(&mut check("wasmouse-core", &target_folder));
}
