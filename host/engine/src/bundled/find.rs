//! [`bundled`] and [`find`]: the bundled robots by name.

use super::robot::BundledRobot;
use super::table;

/// All bundled robots, sorted by name.
pub const fn bundled() -> &'static [BundledRobot] {
    table::ROBOTS
}

/// The bundled robot with this name.
///
/// ```
/// use wasmouse_engine::bundled;
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
