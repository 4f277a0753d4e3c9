//! What a component needs beyond the limits before it runs.
//!
//! wasmtime's pool refuses such a component while it is compiled and says so in
//! words only. Its version is exact, and end-to-end tests hold the words; where they
//! are not recognised the refusal is [`Refusal::Invalid`] with the same words.

use super::Refusal;
use crate::sim::Limits;

/// A need: the words before and after its number, how it is told, and its limit.
struct Need {
    before: &'static str,
    after: &'static str,
    tell: fn(&str) -> String,
    limit: fn(&Limits) -> u64,
}

const NEEDS: [Need; 7] = [
    Need {
        before: "memory has a minimum byte size of ",
        after: " which exceeds",
        tell: |bytes| format!("a memory of {bytes} bytes"),
        limit: |limits| limits.memory_bytes_max,
    },
    Need {
        before: "has a minimum element size of ",
        after: " which exceeds",
        tell: |elements| format!("a table of {elements} elements"),
        limit: |limits| limits.table_elements_max,
    },
    Need {
        before: "defined memories count of ",
        after: " exceeds",
        tell: memories,
        limit: |limits| limits.memories_max.into(),
    },
    Need {
        before: "transitively contains ",
        after: " Wasm linear memories",
        tell: memories,
        limit: |limits| limits.memories_max.into(),
    },
    Need {
        before: "defined tables count of ",
        after: " exceeds",
        tell: tables,
        limit: |limits| limits.tables_max.into(),
    },
    Need {
        before: "transitively contains ",
        after: " tables",
        tell: tables,
        limit: |limits| limits.tables_max.into(),
    },
    Need {
        before: "transitively contains ",
        after: " core module instances",
        tell: |count| format!("{count} core instances"),
        limit: |limits| limits.core_instances_max.into(),
    },
];

fn memories(count: &str) -> String {
    format!("{count} memories")
}

fn tables(count: &str) -> String {
    format!("{count} tables")
}

/// The refusal of a component that could not be compiled.
pub(super) fn refusal(error: &wasmtime::Error, limits: &Limits) -> Refusal {
    let message = format!("{error:#}");
    let needed = NEEDS.iter().find_map(|need| {
        let number = between(&message, need.before, need.after)?;
        Some(Refusal::OverLimit {
            what: (need.tell)(number),
            max: (need.limit)(limits),
        })
    });
    needed.unwrap_or(Refusal::Invalid(message))
}

/// The number between the two pieces of text.
fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(before)?;
    let (number, _) = rest.split_once(after)?;
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(message: &str, expected: &str) {
        let error = wasmtime::Error::msg(message.to_owned());
        let refusal = refusal(&error, &Limits::default());
        assert_eq!(format!("{}: {refusal}", refusal.name()), expected);
    }

    #[test]
    fn only_numbers_between_the_words_count() {
        check(
            "The component transitively contains 9 tables, which exceeds",
            "over-limit: the component needs 9 tables, and the limit is 16",
        );
        check(
            "The component transitively contains many tables, which exceeds",
            "invalid: the component is not valid: \
             The component transitively contains many tables, which exceeds",
        );
        check(
            "unexpected end",
            "invalid: the component is not valid: unexpected end",
        );
    }
}
