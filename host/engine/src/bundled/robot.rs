//! [`BundledRobot`]: a robot that comes with wasmouse, and its variants.

/// A robot whose component is a part of the host.
#[derive(Clone, Copy, Debug)]
pub struct BundledRobot {
    /// The name on the command line: lowercase letters and hyphens.
    pub name: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// Its variants; empty if there is nothing to choose, and the variant is 0 then.
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
    /// What the robot does in it.
    pub description: &'static str,
}
