//! The JSON of `wasmouse robots`.
//!
//! ```json
//! {
//!   "version": 2,
//!   "robots": [{
//!     "name": "wall-follower", "description": "...", "bytes": 20123, "digest": "...",
//!     "variants": [{"value": 0, "name": "left", "description": "..."}]
//!   }]
//! }
//! ```
//!
//! `bytes` is the size of the component, `digest` its SHA-256.

use serde::Serialize;
use wasmouse_engine::bundled::BundledRobot;

use super::json;

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 2;

/// The whole document.
#[derive(Serialize)]
pub struct BundledReport {
    version: u32,
    robots: Vec<RobotJson>,
}

#[derive(Serialize)]
struct RobotJson {
    name: &'static str,
    description: &'static str,
    bytes: usize,
    digest: &'static str,
    variants: Vec<VariantJson>,
}

#[derive(Serialize)]
struct VariantJson {
    value: u32,
    name: &'static str,
    description: &'static str,
}

impl BundledReport {
    /// The document for these robots.
    pub fn new(robots: &[BundledRobot]) -> Self {
        let robots = robots.iter().map(|robot| RobotJson {
            name: robot.name,
            description: robot.description,
            bytes: robot.component.len(),
            digest: robot.sha256,
            variants: robot
                .variants
                .iter()
                .map(|variant| VariantJson {
                    value: variant.value,
                    name: variant.name,
                    description: variant.description,
                })
                .collect(),
        });
        Self {
            version: VERSION,
            robots: robots.collect(),
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}
