//! [`Difference`]: a field of a document that is not what it should be.

use std::fmt;

use serde::Serialize;
use serde_json::Value;

use super::super::visible;

/// Differences that are kept; more are only counted, so that a document in which
/// everything is wrong takes no more memory than others.
const KEPT_MAX: usize = 10_000;

/// Characters of a value that are shown in text.
const VALUE_SHOWN_MAX: usize = 100;

/// A field with what was recorded, and what it is by a better source.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Such as `matches[17].steps_fuel`.
    pub path: String,
    /// `None` when there is nothing.
    pub recorded: Option<Value>,
    /// Where `found` comes from, to be read before it: `played`, `here`.
    pub source: String,
    /// `None` when there is nothing.
    pub found: Option<Value>,
    /// The match that the field belongs to, if it does.
    #[serde(rename = "match", skip_serializing_if = "Option::is_none")]
    pub of: Option<MatchName>,
}

/// A match by the names in the document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MatchName {
    /// The robot.
    pub robot: String,
    /// The maze.
    pub maze: String,
    /// The seed.
    pub seed: u64,
}

/// What is wrong with a document, in the order in which it was found.
#[derive(Clone, Debug, Default)]
pub struct Differences {
    kept: Vec<Difference>,
    count: usize,
}

impl Differences {
    /// Those that are kept: the first 10,000.
    pub fn kept(&self) -> &[Difference] {
        &self.kept
    }

    /// How many there are, kept or not.
    pub const fn count(&self) -> usize {
        self.count
    }

    /// Adds one.
    pub fn push(&mut self, difference: Difference) {
        if self.kept.len() < KEPT_MAX {
            self.kept.push(difference);
        }
        self.count += 1;
    }

    /// Adds one before all others: it may be the reason for them.
    pub fn push_first(&mut self, difference: Difference) {
        self.kept.truncate(KEPT_MAX - 1);
        self.kept.insert(0, difference);
        self.count += 1;
    }

    /// Adds every field in which two values differ that are written at `path`.
    pub(super) fn compare<T: Serialize>(
        &mut self,
        path: &str,
        source: &str,
        (recorded, found): (&T, &T),
        of: Option<&MatchName>,
    ) {
        let value =
            |it: &T| serde_json::to_value(it).expect("strings, numbers and lists always serialise");
        let (recorded, found) = (value(recorded), value(found));
        self.walk(path.to_owned(), source, (Some(&recorded), Some(&found)), of);
    }

    fn walk(
        &mut self,
        path: String,
        source: &str,
        (recorded, found): (Option<&Value>, Option<&Value>),
        of: Option<&MatchName>,
    ) {
        match (recorded, found) {
            _ if recorded == found => {}
            (Some(Value::Object(one)), Some(Value::Object(other))) => {
                let added = other.keys().filter(|name| !one.contains_key(*name));
                for name in one.keys().chain(added) {
                    let path = if path.is_empty() {
                        name.clone()
                    } else {
                        format!("{path}.{name}")
                    };
                    self.walk(path, source, (one.get(name), other.get(name)), of);
                }
            }
            (Some(Value::Array(one)), Some(Value::Array(other))) => {
                for index in 0..one.len().max(other.len()) {
                    let path = format!("{path}[{index}]");
                    self.walk(path, source, (one.get(index), other.get(index)), of);
                }
            }
            _ => self.push(Difference {
                path,
                recorded: recorded.cloned(),
                source: source.to_owned(),
                found: found.cloned(),
                of: of.cloned(),
            }),
        }
    }
}

impl Difference {
    /// In one line, with words before the two values.
    pub fn told(&self, before_recorded: &str, before_found: &str) -> String {
        let (recorded, found) = (shown(self.recorded.as_ref()), shown(self.found.as_ref()));
        let mut text = format!(
            "{}: {before_recorded} {recorded}, {before_found} {found}",
            self.path
        );
        if let Some(MatchName { robot, maze, seed }) = &self.of {
            let (robot, maze) = (visible(robot), visible(maze));
            text.push_str(&format!(" (`{robot}` in `{maze}`, seed {seed})"));
        }
        text
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told("recorded", &visible(&self.source)))
    }
}

fn shown(value: Option<&Value>) -> String {
    let Some(value) = value else {
        return "nothing".to_owned();
    };
    let text = visible(&value.to_string());
    match text.char_indices().nth(VALUE_SHOWN_MAX) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[track_caller]
    fn check(recorded: Value, found: Value, expected: &[&str]) {
        let mut differences = Differences::default();
        differences.compare("m[0]", "played", (&recorded, &found), None);
        let shown: Vec<String> = differences.kept().iter().map(ToString::to_string).collect();
        assert_eq!(shown, expected);
    }

    #[test]
    fn fields_are_named_with_both_values() {
        check(json!({"a": 1}), json!({"a": 1}), &[]);
        check(
            json!({"a": 1, "b": [1, 2], "c": null}),
            json!({"a": 1.0, "b": [1], "d": "x"}),
            &[
                "m[0].a: recorded 1, played 1.0",
                "m[0].b[1]: recorded 2, played nothing",
                "m[0].c: recorded null, played nothing",
                "m[0].d: recorded nothing, played \"x\"",
            ],
        );
        check(
            json!("\u{202e}"),
            json!("x".repeat(200)),
            &[&format!(
                "m[0]: recorded \"\\u{{202e}}\", played \"{}...",
                "x".repeat(99)
            )],
        );
    }

    #[test]
    fn memory_is_limited() {
        let mut differences = Differences::default();
        let (none, many) = (Vec::new(), vec![7; 20_000]);
        differences.compare("m", "played", (&none, &many), None);
        assert_eq!(
            (differences.kept().len(), differences.count()),
            (10_000, 20_000)
        );
    }
}
