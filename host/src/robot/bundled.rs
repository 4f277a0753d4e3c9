//! The robots that come with the host: [`bundled`].
//!
//! They are components like any other, built from `example-robots` ahead of time
//! (`cargo xtask robots`), so that a match needs no WebAssembly toolchain and a
//! contest has a frozen baseline. Admission treats them as it treats everybody.

mod table;

/// A robot whose component is a part of the host.
#[derive(Clone, Copy, Debug)]
pub struct BundledRobot {
    /// The name on the command line: lowercase letters and hyphens.
    pub name: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// The values of `briefing.variant` that it takes. Empty if it has only one, 0.
    pub variants: &'static [Variant],
    /// The component.
    pub component: &'static [u8],
    /// SHA-256 of the component, lowercase hexadecimal.
    pub sha256: &'static str,
}

/// One value of `briefing.variant`, with its meaning for one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// The number that the robot gets.
    pub value: u32,
    /// A short name for the number.
    pub name: &'static str,
    /// What it changes.
    pub description: &'static str,
}

/// All bundled robots, sorted by name.
pub const fn bundled() -> &'static [BundledRobot] {
    table::ROBOTS
}

/// The bundled robot with this name.
///
/// ```
/// use wasmouse::robot::bundled;
///
/// assert!(bundled::find("wall-follower").is_some());
/// assert!(bundled::find("wall follower").is_none());
/// ```
pub fn find(name: &str) -> Option<&'static BundledRobot> {
    bundled().iter().find(|robot| robot.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_sorted_and_sound() {
        assert!(bundled().is_sorted_by_key(|robot| robot.name));
        for robot in bundled() {
            let legal = |byte: u8| byte.is_ascii_lowercase() || byte == b'-';
            assert!(robot.name.bytes().all(legal), "{}", robot.name);
            assert!(robot.description.ends_with('.'), "{}", robot.name);
            let values: Vec<u32> = robot.variants.iter().map(|it| it.value).collect();
            assert!(values.is_sorted_by(|a, b| a < b), "{}", robot.name);
        }
    }
}
