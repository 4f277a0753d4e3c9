//! The version of the WIT package `wasmouse:robot`, and which others are compatible with it.
//!
//! A patch version only adds to an interface, so a robot built for another patch version is
//! admitted if this host has everything that it imports; the linker checks that. A robot
//! built for any other version is rejected with a message that names the version.

/// The version in `wit/robot.wit`: the one line that changes with it, together with
/// [`COMPATIBLE`] when it is no patch version.
macro_rules! version {
    () => {
        "0.2.0"
    };
}

/// The full name of an interface of the package.
macro_rules! interface {
    ($name:literal) => {
        concat!("wasmouse:robot/", $name, "@", version!())
    };
}

/// The version of the package `wasmouse:robot` in this host.
pub const VERSION: &str = version!();

/// All versions that are compatible with [`VERSION`], for messages.
pub(super) const COMPATIBLE: &str = "0.2.x";

/// The interface that a robot exports.
pub(crate) const CONTROLLER: &str = interface!("controller");

/// The interface that a robot may import.
pub(crate) const JOURNAL: &str = interface!("journal");

/// The interface of the types of both, which every robot imports.
pub(super) const TYPES: &str = interface!("types");

/// The functions of the controller under the names by which a core module exports them.
pub(super) const CONTROLLER_FUNCTIONS: [&str; 2] = [
    concat!(interface!("controller"), "#start"),
    concat!(interface!("controller"), "#next-move"),
];

/// What the author of a robot for another version can do.
pub(super) const REBUILD: &str = "rebuild it with the SDK of this wasmouse (`wasmouse new` \
    makes a project that has it), or with bindings for this version's `wit/robot.wit`";

/// The longest version that a message quotes. Unit: bytes.
const VERSION_BYTES_MAX: usize = 40;

/// The version in the name of an interface of the package: that of `interface`, or of any.
pub(super) fn of_interface<'a>(name: &'a str, interface: Option<&str>) -> Option<&'a str> {
    let (found, version) = name.strip_prefix("wasmouse:robot/")?.split_once('@')?;
    let is_wanted = interface.is_none_or(|interface| found == interface);
    is_wanted.then_some(version)
}

/// Whether the name is that of `interface` in a compatible version.
pub(super) fn is_compatible(name: &str, interface: &str) -> bool {
    of_interface(name, Some(interface)).is_some_and(|version| patch(version).is_some())
}

/// The last number of a compatible version. Pre-releases are compatible with nothing.
pub(super) fn patch(version: &str) -> Option<u64> {
    let text = version.strip_prefix(COMPATIBLE.strip_suffix('x')?)?;
    let patch: u64 = text.parse().ok()?;
    // `parse` also takes `+1` and `01`, which are no versions.
    (patch.to_string() == text).then_some(patch)
}

/// The first incompatible version of the package in these names of interfaces. What does
/// not look like a version is ignored.
pub(super) fn other<'a>(names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let is_legible = |version: &&str| {
        let legal = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '+');
        version.starts_with(|c: char| c.is_ascii_digit())
            && version.len() <= VERSION_BYTES_MAX
            && version.chars().all(legal)
    };
    names
        .into_iter()
        .filter_map(|name| of_interface(name, None))
        .filter(is_legible)
        .find(|version| patch(version).is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patch_versions_are_compatible() {
        assert!(patch(VERSION).is_some());
        assert_eq!(patch("0.2.0"), Some(0));
        assert_eq!(patch("0.2.17"), Some(17));
        for version in ["0.1.0", "0.3.0", "1.2.0", "0.2", "0.2.", "0.2.01", "0.2.+1"] {
            assert_eq!(patch(version), None, "{version}");
        }
        for version in [
            "0.2.1-rc.1",
            "0.2.0+build",
            "0.2.1.1",
            "0.2.99999999999999999999",
        ] {
            assert_eq!(patch(version), None, "{version}");
        }
        assert!(is_compatible("wasmouse:robot/journal@0.2.9", "journal"));
        assert!(!is_compatible("wasmouse:robot/journal@0.2.9", "types"));
        assert!(!is_compatible("wasmouse:robot/journal", "journal"));
    }

    #[test]
    fn only_versions_are_quoted() {
        let found = |name| other([JOURNAL, "wasi:cli/run@0.1.0", name]);
        assert_eq!(found("wasmouse:robot/types@0.1.0"), Some("0.1.0"));
        assert_eq!(
            found("wasmouse:robot/journal@1.0.0-rc.1"),
            Some("1.0.0-rc.1")
        );
        assert_eq!(found("wasmouse:robot/journal@0.2.3"), None);
        assert_eq!(found("wasmouse:robot/journal@\u{1b}[31m"), None);
        assert_eq!(found("wasmouse:robot/journal@latest"), None);
        assert_eq!(
            found(&format!("wasmouse:robot/types@1.{}", "0".repeat(40))),
            None
        );
    }
}
