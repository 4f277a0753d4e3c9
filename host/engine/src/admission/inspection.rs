//! [`Inspection`]: everything that is known of a file without running it.

use serde::{Deserialize, Serialize};
use wit_component::{DecodedWasm, WitPrinter};

use wasmouse_core::Digest;

use super::binary::BinaryKind;
use super::precheck::Shape;
use super::rejection::Rejection;

/// What a file is, what it needs, and whether it would be admitted.
#[derive(Debug)]
pub struct Inspection {
    /// Size of the file, in bytes.
    pub bytes: u64,
    /// Its digest.
    pub digest: Digest,
    /// What it is; `None` when it is no WebAssembly binary.
    pub kind: Option<BinaryKind>,
    /// Its imports and exports; of a core module, those of the component that
    /// it is turned into. `None` when they cannot be read.
    pub shape: Option<Shape>,
    /// The world of the component as WIT; `None` when it cannot be read.
    pub wit: Option<String>,
    /// What it needs at the start; `None` unless it is admitted.
    pub requirements: Option<ResourceRequirements>,
    /// Why it is rejected; `None` when it is admitted.
    pub rejection: Option<Rejection>,
}

/// What a component needs before it does anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ResourceRequirements {
    /// Linear memories.
    pub memories: u32,
    /// The largest of their initial sizes, in bytes.
    pub memory_bytes: u64,
    /// Tables.
    pub tables: u32,
    /// The largest of their initial sizes, in elements.
    pub table_elements: u64,
}

impl Inspection {
    /// What is known of any bytes.
    pub fn new(bytes: &[u8]) -> Self {
        Self {
            bytes: u64::try_from(bytes.len()).unwrap_or(u64::MAX),
            digest: Digest::of(bytes),
            kind: None,
            shape: None,
            wit: None,
            requirements: None,
            rejection: None,
        }
    }
}

/// The world that a component implements, as WIT; `None` when it cannot be decoded.
pub fn world(component: &[u8]) -> Option<String> {
    // The decoder panics on some valid components: a function that is exported under the name
    // of an interface, for example.
    let decoded = std::panic::catch_unwind(|| wit_component::decode(component));
    let decoded = decoded.ok()?.ok()?;
    let DecodedWasm::Component(resolve, world) = &decoded else {
        return None;
    };
    let package = resolve.worlds[*world].package?;
    let mut printer = WitPrinter::default();
    printer.print(resolve, package, &[]).ok()?;
    Some(printer.output.to_string())
}
