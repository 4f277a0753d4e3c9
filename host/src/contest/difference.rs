//! [`differences`]: the fields in which two values differ.

use serde::Serialize;
use serde_json::Value;

/// A field with what was recorded and what was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldDifference {
    /// Its path in the serialised form, such as `fuel.steps` or `robots[3].name`; empty for the
    /// whole value.
    pub field: String,
    /// `None` when the field is not there.
    pub recorded: Option<Value>,
    /// `None` when the field is not there.
    pub found: Option<Value>,
}

/// The fields in which two values differ, by their serialised forms.
///
/// # Panics
///
/// When a value cannot be serialised as JSON.
///
/// ```
/// use wasmouse::contest::{Seeds, differences};
///
/// let recorded = Seeds { first: 0, count: 3 };
/// let found = Seeds { first: 0, count: 4 };
/// let [difference] = &differences(&recorded, &found)[..] else {
///     panic!("one field differs");
/// };
/// assert_eq!(difference.field, "count");
/// assert_eq!(difference.found, Some(4.into()));
/// ```
pub fn differences<T: Serialize>(recorded: &T, found: &T) -> Vec<FieldDifference> {
    let value = |it: &T| serde_json::to_value(it).expect("results can be serialised");
    let mut differences = Vec::new();
    let (recorded, found) = (value(recorded), value(found));
    compare(
        String::new(),
        Some(&recorded),
        Some(&found),
        &mut differences,
    );
    differences
}

fn compare(
    field: String,
    recorded: Option<&Value>,
    found: Option<&Value>,
    differences: &mut Vec<FieldDifference>,
) {
    match (recorded, found) {
        _ if recorded == found => {}
        (Some(Value::Object(one)), Some(Value::Object(other))) => {
            let added = other.keys().filter(|name| !one.contains_key(*name));
            for name in one.keys().chain(added) {
                let dot = if field.is_empty() { "" } else { "." };
                let path = format!("{field}{dot}{name}");
                compare(path, one.get(name), other.get(name), differences);
            }
        }
        (Some(Value::Array(one)), Some(Value::Array(other))) => {
            for index in 0..one.len().max(other.len()) {
                let path = format!("{field}[{index}]");
                compare(path, one.get(index), other.get(index), differences);
            }
        }
        _ => differences.push(FieldDifference {
            field,
            recorded: recorded.cloned(),
            found: found.cloned(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[track_caller]
    fn check(recorded: Value, found: Value, expected: &[(&str, Option<Value>, Option<Value>)]) {
        let all = differences(&recorded, &found).into_iter();
        let all: Vec<_> = all.map(|it| (it.field, it.recorded, it.found)).collect();
        let expected = expected.iter().cloned();
        let expected: Vec<_> = expected
            .map(|(field, a, b)| (field.to_owned(), a, b))
            .collect();
        assert_eq!(all, expected);
    }

    #[test]
    fn fields_are_named_with_both_values() {
        check(json!({"a": 1}), json!({"a": 1}), &[]);
        check(json!(1), json!(2), &[("", Some(json!(1)), Some(json!(2)))]);
        check(
            json!({"a": {"x": 1}, "b": [1, 2], "c": null}),
            json!({"a": {"x": 2}, "b": [1], "d": "x"}),
            &[
                ("a.x", Some(json!(1)), Some(json!(2))),
                ("b[1]", Some(json!(2)), None),
                ("c", Some(json!(null)), None),
                ("d", None, Some(json!("x"))),
            ],
        );
    }
}
