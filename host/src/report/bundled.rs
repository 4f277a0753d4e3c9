//! The JSON of `wasmouse robots`.
//!
//! ```json
//! {
//!   "schema": 1,
//!   "robots": [{
//!     "name": "wall-follower", "description": "...", "bytes": 20123, "sha256": "...",
//!     "settings": [{"value": 0, "name": "left", "description": "..."}]
//!   }]
//! }
//! ```

use serde::Serialize;

use super::json;
use crate::robot::bundled::BundledRobot;

/// The version of this JSON; raised when a reader of the old one would go wrong.
const SCHEMA: u32 = 1;

/// The whole document.
#[derive(Serialize)]
pub struct BundledReport {
    schema: u32,
    robots: Vec<WireRobot>,
}

#[derive(Serialize)]
struct WireRobot {
    name: &'static str,
    description: &'static str,
    bytes: usize,
    sha256: &'static str,
    settings: Vec<WireSetting>,
}

#[derive(Serialize)]
struct WireSetting {
    value: u32,
    name: &'static str,
    description: &'static str,
}

impl BundledReport {
    /// The document for these robots.
    pub fn new(robots: &[BundledRobot]) -> Self {
        let robots = robots.iter().map(|robot| WireRobot {
            name: robot.name,
            description: robot.description,
            bytes: robot.component.len(),
            sha256: robot.sha256,
            settings: robot
                .variants
                .iter()
                .map(|setting| WireSetting {
                    value: setting.value,
                    name: setting.name,
                    description: setting.description,
                })
                .collect(),
        });
        Self {
            schema: SCHEMA,
            robots: robots.collect(),
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}
