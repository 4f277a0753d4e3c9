//! What `wasmouse inspect` prints, as text and as JSON.
//!
//! ```json
//! {
//!   "schema": 1, "robot": "flood", "bytes": 30123, "sha256": "...",
//!   "kind": "component", "admitted": true,
//!   "imports": [], "exports": ["wasmouse:robot/controller@0.2.0"],
//!   "memories": 1, "memory_bytes": 1114112, "tables": 1, "table_elements": 12
//! }
//! ```
//!
//! `measures` is a list of `{"name": "functions", "found": 61, "max": 60000}`: what
//! admission measures beside its limits. A refused file has `"admitted": false` and `refusal` with `kind`, `reason`
//! and `hint`. `memory_bytes` and `table_elements` are initial sizes.

use std::fmt;

use serde::Serialize;

use super::{json, visible};
use crate::robot::componentize::BinaryKind;
use crate::robot::precheck::{Measure, Measures};
use crate::robot::{Inspection, Refusal};
use crate::sim::Limits;

/// The version of this JSON; raised when a reader of the old one would go wrong.
const SCHEMA: u32 = 1;

/// The report of one file.
#[derive(Serialize)]
pub struct InspectionReport<'a> {
    schema: u32,
    robot: &'a str,
    bytes: u64,
    sha256: String,
    kind: Option<&'static str>,
    admitted: bool,
    imports: Option<&'a [String]>,
    exports: Option<&'a [String]>,
    memories: Option<u32>,
    memory_bytes: Option<u64>,
    tables: Option<u32>,
    table_elements: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<Vec<WireMeasure>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refusal: Option<WireRefusal<'a>>,
    wit: Option<&'a str>,
}

#[derive(Serialize)]
struct WireRefusal<'a> {
    kind: &'a str,
    reason: String,
    hint: &'a str,
}

impl<'a> WireRefusal<'a> {
    fn new(refusal: &'a Refusal) -> Self {
        Self {
            kind: refusal.name(),
            reason: refusal.to_string(),
            hint: refusal.hint(),
        }
    }
}

/// A measure beside its limit.
#[derive(Serialize)]
struct WireMeasure {
    name: &'static str,
    found: u64,
    max: u64,
    #[serde(skip)]
    what: &'static str,
}

impl WireMeasure {
    fn all(measures: &Measures, limits: &Limits) -> Vec<Self> {
        Measure::all()
            .map(|measure| Self {
                name: measure.name(),
                found: measures.get(measure),
                max: measure.max(limits),
                what: measure.what(),
            })
            .collect()
    }
}

impl<'a> InspectionReport<'a> {
    /// The report of an inspected robot under the name that the user gave it, with
    /// the limits that it was inspected under.
    pub fn new(robot: &'a str, inspection: &'a Inspection, limits: &Limits) -> Self {
        let shape = inspection.shape.as_ref();
        let needs = inspection.needs.as_ref();
        Self {
            schema: SCHEMA,
            robot,
            bytes: inspection.bytes,
            sha256: inspection.digest.hex(),
            kind: inspection.kind.map(|kind| match kind {
                BinaryKind::Component => "component",
                BinaryKind::CoreModule => "core module",
                BinaryKind::Other => "other",
            }),
            admitted: inspection.refusal.is_none(),
            imports: shape.map(|shape| shape.imports.as_slice()),
            exports: shape.map(|shape| shape.exports.as_slice()),
            memories: needs.map(|needs| needs.memories),
            memory_bytes: needs.map(|needs| needs.memory_bytes),
            tables: needs.map(|needs| needs.tables),
            table_elements: needs.map(|needs| needs.table_elements),
            measures: shape.map(|shape| WireMeasure::all(&shape.measures, limits)),
            refusal: inspection.refusal.as_ref().map(WireRefusal::new),
            wit: inspection.wit.as_deref(),
        }
    }

    /// The report as JSON, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}

impl fmt::Display for InspectionReport<'_> {
    /// The report for people; ends with a newline.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "robot     {}", visible(self.robot))?;
        writeln!(f, "kind      {}", self.kind.unwrap_or("not WebAssembly"))?;
        writeln!(f, "size      {} bytes", self.bytes)?;
        writeln!(f, "sha256    {}", self.sha256)?;
        write_names(f, "imports", self.imports)?;
        write_names(f, "exports", self.exports)?;
        if let (Some(memories), Some(bytes)) = (self.memories, self.memory_bytes) {
            let kib = bytes / 1024;
            writeln!(
                f,
                "memories  {memories}, the largest {kib} KiB at the start"
            )?;
        }
        if let (Some(tables), Some(elements)) = (self.tables, self.table_elements) {
            let elements = format!("the largest {elements} elements at the start");
            writeln!(f, "tables    {tables}, {elements}")?;
        }
        if let Some(measures) = &self.measures {
            writeln!(f, "measures  found, limit")?;
            for WireMeasure {
                found, max, what, ..
            } in measures
            {
                writeln!(f, "  {found:>9} {max:>10} {what}")?;
            }
        }
        if let Some(wit) = self.wit {
            writeln!(f, "world")?;
            for line in wit.lines() {
                writeln!(f, "  {}", visible(line))?;
            }
        }
        match &self.refusal {
            None => writeln!(f, "admitted  yes"),
            Some(refusal) => {
                writeln!(f, "admitted  no: {}", visible(&refusal.reason))?;
                writeln!(f, "  hint: {}", refusal.hint)
            }
        }
    }
}

fn write_names(f: &mut fmt::Formatter<'_>, title: &str, names: Option<&[String]>) -> fmt::Result {
    match names {
        None => Ok(()),
        Some([]) => writeln!(f, "{title}   nothing"),
        Some(names) => {
            for name in names {
                writeln!(f, "{title}   {}", visible(name))?;
            }
            Ok(())
        }
    }
}
