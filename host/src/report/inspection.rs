//! What `wasmouse inspect` prints, as text and as JSON.
//!
//! ```json
//! {
//!   "version": 2, "robot": "flood", "bytes": 30123, "digest": "...",
//!   "kind": "component", "admitted": true, "rejection": null,
//!   "imports": [], "exports": ["wasmouse:robot/controller@0.2.0"],
//!   "requirements": {"memories": 1, "memory_bytes": 1114112, "tables": 1, "table_elements": 12},
//!   "measures": [{"name": "functions", "found": 61, "max": 60000}],
//!   "wit": "..."
//! }
//! ```
//!
//! A rejected file has `"admitted": false` and a `rejection` with `kind`, `reason` and `hint`.
//! `measures` are what admission compares with its limits. What could not be determined is
//! null.

use std::fmt::Write as _;

use serde::Serialize;
use wasmouse_core::Digest;
use wasmouse_engine::Limits;
use wasmouse_engine::admission::precheck::{Measure, Measures};
use wasmouse_engine::admission::{BinaryKind, Inspection, ResourceRequirements};

use super::escape::for_terminal;
use super::json;
use crate::contest::RejectionEntry;

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 2;

/// The report of one file.
#[derive(Serialize)]
pub struct InspectionReport<'a> {
    version: u32,
    robot: &'a str,
    bytes: u64,
    digest: Digest,
    kind: Option<&'static str>,
    admitted: bool,
    rejection: Option<RejectionEntry>,
    imports: Option<&'a [String]>,
    exports: Option<&'a [String]>,
    requirements: Option<ResourceRequirements>,
    measures: Option<Vec<MeasureJson>>,
    wit: Option<&'a str>,
}

/// A measure beside its limit.
#[derive(Serialize)]
struct MeasureJson {
    name: &'static str,
    found: u64,
    max: u64,
    #[serde(skip)]
    what: &'static str,
}

impl MeasureJson {
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
    /// The report of an inspected robot under the name that the user gave it, with the limits
    /// that it was inspected under.
    pub fn new(robot: &'a str, inspection: &'a Inspection, limits: &Limits) -> Self {
        let shape = inspection.shape.as_ref();
        let rejection = inspection.rejection.as_ref();
        Self {
            version: VERSION,
            robot,
            bytes: inspection.bytes,
            digest: inspection.digest,
            kind: inspection.kind.map(|kind| match kind {
                BinaryKind::Component => "component",
                BinaryKind::CoreModule => "core module",
                BinaryKind::Text => "text",
                BinaryKind::Other => "other",
            }),
            admitted: rejection.is_none(),
            rejection: rejection.map(|rejection| RejectionEntry {
                kind: rejection.name().into(),
                reason: rejection.reason(),
                hint: rejection.hint().into(),
            }),
            imports: shape.map(|shape| shape.imports.as_slice()),
            exports: shape.map(|shape| shape.exports.as_slice()),
            requirements: inspection.requirements,
            measures: shape.map(|shape| MeasureJson::all(&shape.measures, limits)),
            wit: inspection.wit.as_deref(),
        }
    }

    /// The report as JSON, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// The report as text: first whether the file is admitted, then what it is. With
    /// `measures`, also every measure beside its limit. Ends with a newline.
    pub fn to_text(&self, measures: bool) -> String {
        let mut text = Lines(String::new());
        let robot = for_terminal(self.robot);
        match &self.rejection {
            None => text.push(format_args!("`{robot}` is admitted")),
            Some(rejection) => {
                let reason = for_terminal(&rejection.reason);
                text.push(format_args!("`{robot}` is rejected: {reason}"));
                text.push(format_args!("\nhint: {}\n", for_terminal(&rejection.hint)));
            }
        }
        let kind = self.kind.unwrap_or("not WebAssembly");
        text.push(format_args!("  kind      {kind}, {} bytes", self.bytes));
        text.push(format_args!("  digest    {}", self.digest));
        text.names("imports", self.imports);
        text.names("exports", self.exports);
        if let Some(needs) = self.requirements {
            let (memories, kib) = (needs.memories, needs.memory_bytes / 1024);
            text.push(format_args!(
                "  memories  {memories}, initially at most {kib} KiB each"
            ));
            let (tables, elements) = (needs.tables, needs.table_elements);
            text.push(format_args!(
                "  tables    {tables}, initially at most {elements} elements each"
            ));
        }
        if let Some(wit) = self.wit {
            text.push(format_args!("  world"));
            for line in wit.lines() {
                let line = format!("    {}", for_terminal(line));
                text.push(format_args!("{}", line.trim_end()));
            }
        }
        if measures && let Some(all) = &self.measures {
            text.push(format_args!(
                "  {:<20} {:>11} {:>11}",
                "measure", "found", "limit"
            ));
            for MeasureJson {
                name,
                found,
                max,
                what,
            } in all
            {
                text.push(format_args!("  {name:<20} {found:>11} {max:>11}  {what}"));
            }
        }
        text.0
    }
}

/// Lines of text.
struct Lines(String);

impl Lines {
    fn push(&mut self, line: std::fmt::Arguments<'_>) {
        writeln!(self.0, "{line}").expect("writing to a string cannot fail");
    }

    fn names(&mut self, title: &str, names: Option<&[String]>) {
        match names {
            None => {}
            Some([]) => self.push(format_args!("  {title}   none")),
            Some(names) => {
                for name in names {
                    self.push(format_args!("  {title}   {}", for_terminal(name)));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_engine::{Executor as _, InProcess, bundled};

    use super::*;

    fn texts(name: &str, file: &[u8]) -> [String; 3] {
        let limits = Limits::default();
        let executor = InProcess::new(limits, 1, None).expect("address space");
        let inspection = executor.inspect(file).expect("the host works");
        let report = InspectionReport::new(name, &inspection, &limits);
        [
            report.to_text(false),
            report.to_text(true),
            report.to_json(),
        ]
    }

    #[test]
    fn the_first_line_says_whether_a_file_is_admitted() {
        let flood = bundled::find("flood").expect("it is bundled");
        let [text, measures, json] = texts("flood", flood.component);
        assert!(
            text.starts_with("`flood` is admitted\n  kind      component, "),
            "{text}"
        );
        assert!(
            text.contains("\n  exports   wasmouse:robot/controller@"),
            "{text}"
        );
        assert!(!text.contains("loop_nesting"), "{text}");
        let table = measures
            .strip_prefix(&text)
            .expect("the same, and the measures");
        assert_eq!(table.lines().count(), 1 + Measure::all().count(), "{table}");
        let json: serde_json::Value = serde_json::from_str(&json).expect("it is JSON");
        assert_eq!(json["admitted"], true);
        assert_eq!(
            json["measures"].as_array().map(Vec::len),
            Some(Measure::all().count())
        );
        assert_eq!(json["digest"], flood.sha256);
        assert!(json["requirements"]["memory_bytes"].is_u64());
    }

    #[test]
    fn a_rejection_comes_with_its_hint() {
        let [text, _, json] = texts("bot\u{1b}", b"\0asm");
        let begin = "`bot\\u{1b}` is rejected: ";
        assert!(
            text.starts_with(begin) && text.contains("\n\nhint: "),
            "{text}"
        );
        let json: serde_json::Value = serde_json::from_str(&json).expect("it is JSON");
        assert_eq!(json["rejection"]["kind"], "not-wasm");
        assert_eq!(
            (&json["admitted"], &json["requirements"]),
            (&false.into(), &().into())
        );
    }
}
