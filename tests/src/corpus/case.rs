//! [`Case`]: a hostile robot and the outcome that it must have.

use std::fmt;

use serde_json::{Value, json};

use crate::module::versioned;

/// How the binary runs robots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// In sandboxed worker processes: the default.
    Sandboxed,
    /// In the process itself: `--trust`.
    Trusted,
}

impl Mode {
    /// Both, the default first.
    pub const ALL: [Self; 2] = [Self::Sandboxed, Self::Trusted];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sandboxed => "sandboxed",
            Self::Trusted => "trusted",
        }
    }
}

/// What makes the files of a case.
type Make = Box<dyn Fn() -> Vec<Vec<u8>> + Send + Sync>;

/// One thing that a robot may try.
pub struct Case {
    /// Numbers in the list of cases; none for those that it does not have.
    pub numbers: &'static [u8],
    /// A name: lowercase letters, digits and hyphens.
    pub name: String,
    /// The outcomes that each file may have. Each is a part of a JSON object
    /// as `wasmouse run --json` prints them: of a match, or `{"rejection": ...}`. In
    /// texts, `...` stands for anything.
    pub expected: Vec<Value>,
    /// Ceiling of the time for everything, in seconds.
    pub seconds_max: u64,
    /// Ceiling of the memory of all processes together, in MiB.
    pub megabytes_max: u64,
    /// More arguments for `wasmouse run`.
    pub arguments: &'static [&'static str],
    /// The name of the file, without its ending, where it is not [`Case::name`].
    pub file_name: Option<&'static str>,
    /// Whether the reports for people are checked too: tables, journal and page.
    pub is_shown: bool,
    /// Whether it takes long, and is left out unless it is asked for.
    pub is_long: bool,
    make: Make,
}

/// The ceiling of memory where a case names no other, in MiB: what the host needs for
/// itself, a small robot and its compilation.
pub const MEGABYTES_MAX: u64 = 200;

/// The ceiling of time where a case names no other, in seconds.
const SECONDS_MAX: u64 = 60;

impl Case {
    /// A robot and its expected outcome.
    pub fn new(
        numbers: &'static [u8],
        name: impl Into<String>,
        expected: Value,
        make: impl Fn() -> Vec<u8> + Send + Sync + 'static,
    ) -> Self {
        Self::series(numbers, name, expected, move || vec![make()])
    }

    /// Many files of one kind in one contest.
    pub fn series(
        numbers: &'static [u8],
        name: impl Into<String>,
        expected: Value,
        make: impl Fn() -> Vec<Vec<u8>> + Send + Sync + 'static,
    ) -> Self {
        Self {
            numbers,
            name: name.into(),
            expected: vec![expected],
            seconds_max: SECONDS_MAX,
            megabytes_max: MEGABYTES_MAX,
            arguments: &[],
            file_name: None,
            is_shown: false,
            is_long: false,
            make: Box::new(make),
        }
    }

    /// The same case with one more outcome that is allowed.
    #[must_use]
    pub fn or(mut self, expected: Value) -> Self {
        self.expected.push(expected);
        self
    }

    /// The same case with that much time.
    #[must_use]
    pub const fn seconds(mut self, max: u64) -> Self {
        self.seconds_max = max;
        self
    }

    /// The same case with that much memory.
    #[must_use]
    pub const fn megabytes(mut self, max: u64) -> Self {
        self.megabytes_max = max;
        self
    }

    /// The same case with more arguments for `wasmouse run`.
    #[must_use]
    pub const fn with(mut self, arguments: &'static [&'static str]) -> Self {
        self.arguments = arguments;
        self
    }

    /// The same case in a file of that name, which may be hostile too.
    #[must_use]
    pub const fn named(mut self, file_name: &'static str) -> Self {
        self.file_name = Some(file_name);
        self
    }

    /// The same case, checked in the reports for people too.
    #[must_use]
    pub const fn shown(mut self) -> Self {
        self.is_shown = true;
        self
    }

    /// The same case, played only when long ones are asked for.
    #[must_use]
    pub const fn long(mut self) -> Self {
        self.is_long = true;
        self
    }

    /// Whether this is an outcome that a file of the case may have.
    pub fn allows(&self, outcome: &Value) -> bool {
        self.expected.iter().any(|expected| fits(expected, outcome))
    }

    /// The files.
    pub fn files(&self) -> Vec<Vec<u8>> {
        (self.make)()
    }

    /// The numbers as text.
    pub fn numbers_text(&self) -> String {
        let numbers: Vec<String> = self.numbers.iter().map(u8::to_string).collect();
        if numbers.is_empty() {
            "+".to_owned()
        } else {
            numbers.join(",")
        }
    }
}

impl fmt::Debug for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Case")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

/// The robot fails in step 1, at the start.
pub fn fault(kind: &str, detail: &str) -> Value {
    fault_in("next-move", 1, kind, detail)
}

/// The robot fails in that phase and step.
pub fn fault_in(phase: &str, step: u32, kind: &str, detail: &str) -> Value {
    let fault = json!({"phase": phase, "step": step, "kind": kind, "detail": detail});
    json!({"verdict": {"kind": "fault", "fault": fault}})
}

/// The robot passes or returns something that the interface does not allow.
pub fn violation(detail: &str) -> Value {
    fault(
        "invalid-action",
        &format!("violated the interface: {detail}"),
    )
}

/// The robot executes `unreachable` in step 1.
pub fn unreachable() -> Value {
    let detail = "executed `unreachable` (panicked or aborted)";
    fault("unreachable", detail)
}

/// The robot takes too long before the first step.
pub fn out_of_start_fuel(phase: &str) -> Value {
    let detail = "exceeded the start fuel limit (2,000,000,000)";
    fault_in(phase, 0, "out-of-start-fuel", detail)
}

/// The robot takes too long in step 1.
pub fn out_of_step_fuel() -> Value {
    let detail = "exceeded the per-step fuel limit (2,000,000,000)";
    fault("out-of-step-fuel", detail)
}

/// The robot takes too long in all, which ends it in that step.
pub fn out_of_match_fuel(step: u32) -> Value {
    let detail = "exceeded the match fuel limit (20,000,000,000)";
    fault_in("next-move", step, "out-of-match-fuel", detail)
}

/// The file is not admitted.
pub fn rejected(kind: &str, reason: &str) -> Value {
    json!({"rejection": {"kind": kind, "reason": versioned(reason)}})
}

/// The file exceeds a limit.
pub fn over_limit(found: &str, max: u64) -> Value {
    let reason = format!("the file has {found}, and the limit is {max} (...)");
    rejected("over-limit", &reason)
}

/// The component is not valid, for that reason.
pub fn invalid(reason: &str) -> Value {
    let reason = format!("the component is not valid: {reason} at byte ...");
    rejected("invalid", &reason)
}

/// The robot does no harm and gets nowhere.
pub fn harmless() -> Value {
    json!({
        "verdict": {"kind": "budget-used-up", "goal_reached": false},
        "steps": {"exploration": 1000, "speed": 0},
    })
}

/// Whether everything that `expected` has is in `found`.
fn fits(expected: &Value, found: &Value) -> bool {
    match (expected, found) {
        (Value::Object(expected), Value::Object(found)) => expected
            .iter()
            .all(|(name, value)| found.get(name).is_some_and(|found| fits(value, found))),
        (Value::String(pattern), Value::String(text)) => text_fits(pattern, text),
        _ => expected == found,
    }
}

/// Whether the text is the pattern, where `...` in the pattern stands for anything.
fn text_fits(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split("...");
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = text.strip_prefix(first) else {
        return false;
    };
    let mut ends_open = pattern == first;
    if ends_open {
        return rest.is_empty();
    }
    for part in parts {
        let Some(at) = rest.find(part) else {
            return false;
        };
        rest = &rest[at + part.len()..];
        ends_open = part.is_empty();
    }
    ends_open || rest.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_stand_for_anything() {
        for (pattern, text, expected) in [
            ("abc", "abc", true),
            ("abc", "abcd", false),
            ("a...", "abc", true),
            ("...c", "abc", true),
            ("...b", "abc", false),
            ("a...c...e", "abcde", true),
            ("a...e...c", "abcde", false),
        ] {
            assert_eq!(text_fits(pattern, text), expected, "{pattern} {text}");
        }
    }

    #[test]
    fn only_what_is_expected_counts() {
        let found = json!({"verdict": "fault", "fault": {"kind": "x", "detail": "1 of 2"}});
        assert!(fits(&json!({"fault": {"detail": "... of 2"}}), &found));
        assert!(!fits(&json!({"fault": {"kind": "y"}}), &found));
        assert!(!fits(&json!({"score": 1}), &found));
    }
}
