//! [`Shape`]: what a component imports and exports, and how large it is.

use serde::{Deserialize, Serialize};

use super::measure::Measures;

/// What a component declares at its outermost level, and how large it is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shape {
    /// Names of imports, in order.
    pub imports: Vec<String>,
    /// Names of exports, in order.
    pub exports: Vec<String>,
    /// What was measured in it.
    pub measures: Measures,
}
