//! [`Inspection`]: everything that can be told about a file without playing.

use serde::{Deserialize, Serialize};
use wit_component::{DecodedWasm, WitPrinter};

use super::componentize::BinaryKind;
use super::{Digest, Host, Refusal, Shape, admission};

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
    pub needs: Option<Needs>,
    /// Why it would be refused; `None` when it would be admitted.
    pub refusal: Option<Refusal>,
}

/// What a component needs before it does anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Needs {
    /// Linear memories.
    pub memories: u32,
    /// The largest of their initial sizes, in bytes.
    pub memory_bytes: u64,
    /// Tables.
    pub tables: u32,
    /// The largest of their initial sizes, in elements.
    pub table_elements: u64,
}

/// A page of linear memory, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

impl Inspection {
    /// What can be told of any bytes.
    pub(super) fn new(bytes: &[u8]) -> Self {
        Self {
            bytes: u64::try_from(bytes.len()).unwrap_or(u64::MAX),
            digest: Digest::of(bytes),
            kind: None,
            shape: None,
            wit: None,
            needs: None,
            refusal: None,
        }
    }
}

impl Host {
    /// Looks at a file as [`Host::admit`] would, and tells everything.
    pub fn inspect(&self, bytes: &[u8]) -> Inspection {
        let mut inspection = Inspection::new(bytes);
        let read = match admission::read(bytes, self.limits()) {
            Ok(read) => read,
            Err(refusal) => {
                inspection.kind = match BinaryKind::of(bytes) {
                    BinaryKind::Other => None,
                    kind => Some(kind),
                };
                inspection.refusal = Some(refusal);
                return inspection;
            }
        };
        inspection.kind = Some(read.kind);
        inspection.wit = world(&read.bytes);
        inspection.shape = Some(read.shape);
        match self.admit(bytes) {
            Ok(robot) => inspection.needs = robot.needs(),
            Err(refusal) => inspection.refusal = Some(refusal),
        }
        inspection
    }
}

impl super::Robot {
    /// What the robot needs before it does anything.
    pub(super) fn needs(&self) -> Option<Needs> {
        let required = self.component().resources_required()?;
        Some(Needs {
            memories: required.num_memories,
            memory_bytes: required.max_initial_memory_size.unwrap_or(0) * PAGE_BYTES,
            tables: required.num_tables,
            table_elements: required.max_initial_table_size.unwrap_or(0),
        })
    }
}

/// The world that a component implements, as WIT.
pub(super) fn world(component: &[u8]) -> Option<String> {
    let decoded = wit_component::decode(component).ok()?;
    let DecodedWasm::Component(resolve, world) = &decoded else {
        return None;
    };
    let package = resolve.worlds[*world].package?;
    let mut printer = WitPrinter::default();
    printer.print(resolve, package, &[]).ok()?;
    Some(printer.output.to_string())
}
