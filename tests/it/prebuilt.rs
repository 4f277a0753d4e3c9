//! The prebuilt robots are those of the sources, of the manifest and of the host.

use wasmouse::robot::bundled::bundled;
use xtask::manifest::Manifest;
use xtask::{repository, robots};

#[test]
fn no_prebuilt_robot_is_stale() {
    let problems = robots::problems(&repository()).expect("the manifest and the sources");
    assert!(
        problems.is_empty(),
        "run `cargo xtask robots` and commit the result:\n{}",
        problems.join("\n")
    );
}

#[test]
fn the_host_embeds_what_the_manifest_lists() {
    let manifest = Manifest::load(&repository()).expect("the manifest");
    assert_eq!(bundled().len(), manifest.robots.len());
    for (embedded, listed) in bundled().iter().zip(&manifest.robots) {
        assert_eq!(embedded.name, listed.name);
        assert_eq!(embedded.description, listed.description);
        assert_eq!(embedded.sha256, listed.sha256);
        assert_eq!(xtask::sources::sha256(embedded.component), listed.sha256);
        assert_eq!(embedded.component.len(), listed.size_bytes);
        let settings: Vec<_> = embedded
            .settings
            .iter()
            .map(|it| (it.value, it.name, it.description))
            .collect();
        let expected: Vec<_> = listed
            .settings
            .iter()
            .map(|it| (it.value, it.name.as_str(), it.description.as_str()))
            .collect();
        assert_eq!(settings, expected, "{}", embedded.name);
    }
}
