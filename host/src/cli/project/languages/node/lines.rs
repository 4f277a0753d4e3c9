//! [`table`]: where the lines of a bundle come from.
//!
//! Engines report errors by the lines of the bundle. A source map would be decoded by the robot,
//! at the expense of its fuel and memory, so the robot gets a small table instead.

use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use serde_json::json;

/// A source map, version 3.
#[derive(Deserialize)]
struct SourceMap {
    sources: Vec<String>,
    mappings: String,
}

/// The table of a bundle, in JSON: `sources`, and `starts` with a line of the bundle, the number
/// of its source, or -1, and a line of that source. Lines after it continue both. Lines are from 1.
/// Sources below `project` are relative to it. `None` if the source map cannot be read.
pub fn table(map: &str, bundle_folder: &Path, project: &Path) -> Option<String> {
    let map: SourceMap = serde_json::from_str(map).ok()?;
    let sources: Vec<String> = map
        .sources
        .iter()
        .map(|source| shown(&bundle_folder.join(source), project))
        .collect();
    let starts = starts(&map.mappings)?;
    Some(json!({"sources": sources, "starts": starts}).to_string())
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
        let table = table(map, Path::new("/tmp"), Path::new("/home/bot")).unwrap();
        let expected =
            r#"{"sources":["src/a.js","/lib/b.js"],"starts":[[1,-1,0],[2,0,1],[4,-1,0],[5,1,1]]}"#;
        assert_eq!(table, expected);
    }

    #[test]
    fn what_is_no_map_gives_no_table() {
        assert_eq!(table("", Path::new("/"), Path::new("/")), None);
        let map = r#"{"sources": [], "mappings": "?"}"#;
        assert_eq!(table(map, Path::new("/"), Path::new("/")), None);
    }
}
