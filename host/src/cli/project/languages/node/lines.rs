//! [`Lines`]: where the lines of a bundle come from.
//!
//! Engines report errors by the lines of the bundle. A source map would be decoded by the robot,
//! at the expense of its fuel and memory, so the robot gets a small table instead. Errors while the
//! robot is built are translated here.

use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use serde_json::json;

/// A source map, version 3.
#[derive(Deserialize)]
struct SourceMap {
    sources: Vec<String>,
    mappings: String,
}

/// Where the lines of a bundle come from.
#[derive(Debug, PartialEq, Eq)]
pub struct Lines {
    sources: Vec<String>,
    /// In the order of the bundle.
    starts: Vec<Start>,
}

impl Lines {
    /// Reads a source map. Sources below `project` are relative to it. `None` if it cannot be read.
    pub fn read(map: &str, bundle_folder: &Path, project: &Path) -> Option<Self> {
        let map: SourceMap = serde_json::from_str(map).ok()?;
        let shown = |source: &String| shown(&bundle_folder.join(source), project);
        Some(Self {
            sources: map.sources.iter().map(shown).collect(),
            starts: starts(&map.mappings)?,
        })
    }

    /// The table, in JSON: `sources`, and `starts` with a line of the bundle, the number of its
    /// source, or -1, and a line of that source. Lines after it continue both. Lines are from 1.
    pub fn table(&self) -> String {
        json!({"sources": self.sources, "starts": self.starts}).to_string()
    }

    /// Replaces places in the bundle, such as `/robot.js:415:23`, by the file and the line of the
    /// source. The columns of a bundle are its own.
    pub fn in_sources(&self, text: &str, bundle_name: &str) -> String {
        let mark = format!("{bundle_name}:");
        let mut parts = text.split(&mark);
        let mut replaced = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (line, rest) = number(part);
            let place = line.and_then(|line| self.source_of(line));
            match place {
                Some(place) => {
                    // Engines see the bundle in the root folder.
                    if replaced.ends_with('/') {
                        replaced.pop();
                    }
                    let column = rest.strip_prefix(':').map(number);
                    let rest = match column {
                        Some((Some(_), rest)) => rest,
                        _ => rest,
                    };
                    replaced.push_str(&place);
                    replaced.push_str(rest);
                }
                None => {
                    replaced.push_str(&mark);
                    replaced.push_str(part);
                }
            }
        }
        replaced
    }

    /// File and line of the source of a line of the bundle.
    fn source_of(&self, bundle_line: i64) -> Option<String> {
        let after = self.starts.partition_point(|it| it.0 <= bundle_line);
        let &(start, source, line) = self.starts.get(after.checked_sub(1)?)?;
        let source = self.sources.get(usize::try_from(source).ok()?)?;
        Some(format!("{source}:{}", line + bundle_line - start))
    }
}

/// The number that a text begins with, and what follows.
fn number(text: &str) -> (Option<i64>, &str) {
    let end = text.find(|c: char| !c.is_ascii_digit());
    let (digits, rest) = text.split_at(end.unwrap_or(text.len()));
    (digits.parse().ok(), rest)
}

fn shown(path: &Path, project: &Path) -> String {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                normal.pop();
            }
            part => normal.push(part),
        }
    }
    let relative = normal.strip_prefix(project).unwrap_or(&normal);
    relative.to_string_lossy().replace('\\', "/")
}

/// Line of the bundle, source, line of the source.
type Start = (i64, i64, i64);

fn starts(mappings: &str) -> Option<Vec<Start>> {
    let mut starts: Vec<Start> = Vec::new();
    // The source and its line are relative to the segment before, wherever that was.
    let (mut source, mut line) = (0, 0);
    for (bundle_line, segments) in (1..).zip(mappings.split(';')) {
        let mut first = None;
        for segment in segments.split(',').filter(|it| !it.is_empty()) {
            let numbers = numbers(segment)?;
            if let [_, source_change, line_change, ..] = numbers[..] {
                source += source_change;
                line += line_change;
                first = first.or(Some((source, line + 1)));
            }
        }
        let (source, line) = first.unwrap_or((-1, 0));
        let continues = starts.last().is_some_and(|&(start, last, first_line)| {
            last == source && (source < 0 || first_line + bundle_line - start == line)
        });
        if !continues {
            starts.push((bundle_line, source, line));
        }
    }
    Some(starts)
}

/// The numbers of a segment, in base 64 with variable length.
fn numbers(segment: &str) -> Option<Vec<i64>> {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut numbers = Vec::new();
    let (mut value, mut shift) = (0_i64, 0_u32);
    for byte in segment.bytes() {
        let digit = i64::try_from(DIGITS.iter().position(|it| *it == byte)?).ok()?;
        value |= (digit & 31).checked_shl(shift)?;
        shift += 5;
        if digit & 32 == 0 {
            let magnitude = value >> 1;
            numbers.push(if value & 1 == 0 {
                magnitude
            } else {
                -magnitude
            });
            (value, shift) = (0, 0);
        }
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read() {
        assert_eq!(numbers("AAgBC"), Some(vec![0, 0, 16, 1]));
        assert_eq!(numbers("D"), Some(vec![-1]));
        assert_eq!(numbers("?"), None);
        assert_eq!(numbers("gggggggggggggggggB"), None);
    }

    #[test]
    fn runs_of_lines_have_one_entry() {
        // Lines 2 and 3 are lines 1 and 2 of the first source, 4 is from nowhere, 5 is line 1 of
        // the second source.
        let map = r#"{"sources": ["../home/bot/src/a.js", "/lib/b.js"], "mappings": ";AAAA;AACA,CAAC;;ACDA"}"#;
        let lines = Lines::read(map, Path::new("/tmp"), Path::new("/home/bot")).unwrap();
        let expected =
            r#"{"sources":["src/a.js","/lib/b.js"],"starts":[[1,-1,0],[2,0,1],[4,-1,0],[5,1,1]]}"#;
        assert_eq!(lines.table(), expected);
        for (printed, expected) in [
            ("at table (/robot.js:3:27)", "at table (src/a.js:2)"),
            ("robot.js:2:1 Error: x", "src/a.js:1 Error: x"),
            ("@robot.js:6", "@/lib/b.js:2"),
            // From nowhere, or no place.
            ("robot.js:4:1, robot.js:1:1", "robot.js:4:1, robot.js:1:1"),
            (
                "robot.js: robot.js:x robot.js:",
                "robot.js: robot.js:x robot.js:",
            ),
            ("robot.js:2:", "src/a.js:1:"),
            (
                "robot.js:99999999999999999999",
                "robot.js:99999999999999999999",
            ),
            ("nothing", "nothing"),
        ] {
            assert_eq!(lines.in_sources(printed, "robot.js"), expected);
        }
    }

    #[test]
    fn what_is_no_map_gives_no_table() {
        assert_eq!(Lines::read("", Path::new("/"), Path::new("/")), None);
        let map = r#"{"sources": [], "mappings": "?"}"#;
        assert_eq!(Lines::read(map, Path::new("/"), Path::new("/")), None);
    }
}
