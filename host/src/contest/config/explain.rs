//! Messages of serde in the words of a person who writes a configuration file.

use super::suggest::suggestion;

/// The message and the hint for an error of serde at a key.
pub(super) fn explain(message: &str, key: &str) -> (String, Option<String>) {
    let at_key = |text: String| match key {
        "" => text,
        key => format!("`{key}`: {text}"),
    };
    if let Some((found, expected)) = split_names(message, "unknown field `") {
        let names: Vec<&str> = quoted(expected).collect();
        let hint = suggestion(found, names.iter().copied()).unwrap_or_else(|| valid_keys(&names));
        let table = key.strip_suffix(found).and_then(|it| it.strip_suffix('.'));
        let message = match table {
            None => format!("unknown key `{found}`"),
            Some(table) => format!("unknown key `{found}` in `{table}`"),
        };
        return (message, Some(hint));
    }
    if let Some(name) = message.strip_prefix("missing field `") {
        let name = name.trim_end_matches('`');
        let message = match key {
            "" => format!("missing key `{name}`"),
            key => format!("missing key `{name}` in `{key}`"),
        };
        return (message, None);
    }
    if let Some((found, expected)) = split_names(message, "unknown variant `") {
        let names: Vec<&str> = quoted(expected).collect();
        let hint = suggestion(found, names.iter().copied());
        let message = format!("expected {}, found `{found}`", one_of(&names));
        return (at_key(message), hint);
    }
    let value = split(message, "invalid type: ", ", expected ")
        .or_else(|| split(message, "invalid value: ", ", expected "));
    if let Some((found, expected)) = value {
        let (found, expected) = (plain_found(found), plain_expected(expected));
        let message = format!("expected {expected}, found {found}");
        return (at_key(message), brackets(&found, &expected, key));
    }
    (at_key(message.to_owned()), None)
}

/// What stands between a prefix and the last separator, and what follows. The first part may be
/// of the file, and have separators in it.
fn split<'a>(message: &'a str, prefix: &str, separator: &str) -> Option<(&'a str, &'a str)> {
    message.strip_prefix(prefix)?.rsplit_once(separator)
}

/// What stands between a prefix and the list of names that are valid instead, and the list.
fn split_names<'a>(message: &'a str, prefix: &str) -> Option<(&'a str, &'a str)> {
    let message = message.strip_prefix(prefix)?;
    // As serde writes it: for more than two names, for one or two, and for none.
    let lists = ["`, expected one of `", "`, expected `", "`, there are no "];
    let at = lists.iter().filter_map(|list| message.rfind(list)).max()?;
    Some((&message[..at], &message[at + 1..]))
}

/// The names in backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

fn valid_keys(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|it| format!("`{it}`")).collect();
    match names.as_slice() {
        [] => "it has no keys".to_owned(),
        [name] => format!("the only key is {name}"),
        _ => format!("the keys are {}", names.join(", ")),
    }
}

/// `` `a`, `b` or `c` ``.
fn one_of(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|it| format!("`{it}`")).collect();
    match names.split_last() {
        None => "nothing".to_owned(),
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
    }
}

/// What serde calls a value, in TOML's words.
fn plain_found(found: &str) -> String {
    let number = |text: &str| text.trim_matches('`').to_owned();
    match found.split_once(' ') {
        Some(("integer", value)) => number(value),
        Some(("floating", value)) => number(value.trim_start_matches("point ")),
        Some(("boolean", value)) => number(value),
        Some(("string", value)) => format!("the string {value}"),
        _ => match found {
            "map" => "a table".to_owned(),
            "sequence" => "an array".to_owned(),
            other => other.to_owned(),
        },
    }
}

/// What serde expects, in TOML's words.
fn plain_expected(expected: &str) -> String {
    match expected {
        "a sequence" => "an array",
        "a map" => "a table",
        "a boolean" => "`true` or `false`",
        "u8" => "an integer from 0 to 255",
        "u16" => "an integer from 0 to 65535",
        "u32" => "an integer from 0 to 4294967295",
        "u64" => "an integer from 0 to 18446744073709551615",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
    .to_owned()
}

/// What to write where the brackets of a table's header are wrong.
fn brackets(found: &str, expected: &str, key: &str) -> Option<String> {
    let is_plain = !key.is_empty() && !key.contains(['.', '[']);
    match (expected, found) {
        ("an array", "a table") if is_plain => {
            Some(format!("write `[[{key}]]` in two pairs of brackets"))
        }
        ("a table", "an array") if is_plain => {
            Some(format!("write `[{key}]` in one pair of brackets"))
        }
        ("an array", _) => Some("put it into brackets: [...]".to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(message: &str, key: &str, expected: &str, hint: Option<&str>) {
        let explained = explain(message, key);
        assert_eq!(
            (explained.0.as_str(), explained.1.as_deref()),
            (expected, hint)
        );
    }

    #[test]
    fn a_value_of_the_file_cannot_change_the_message() {
        check(
            "unknown field `a`, expected `b`, expected one of `name`, `path`",
            "robots[0].a`, expected `b",
            "unknown key `a`, expected `b` in `robots[0]`",
            Some("the keys are `name`, `path`"),
        );
        check(
            "invalid type: string \"x, expected y\", expected u32",
            "n",
            "`n`: expected an integer from 0 to 4294967295, found the string \"x, expected y\"",
            None,
        );
    }

    #[test]
    fn all_names_that_are_valid_are_listed() {
        check(
            "unknown variant `bets`, expected one of `none`, `best`, `all`",
            "run.keep",
            "`run.keep`: expected `none`, `best` or `all`, found `bets`",
            Some("did you mean `best`?"),
        );
        check(
            "unknown field `x`, there are no fields",
            "x",
            "unknown key `x`",
            Some("it has no keys"),
        );
    }

    #[test]
    fn wrong_brackets_have_a_hint() {
        check(
            "invalid type: map, expected a sequence",
            "robots",
            "`robots`: expected an array, found a table",
            Some("write `[[robots]]` in two pairs of brackets"),
        );
        check(
            "invalid type: sequence, expected struct Rules",
            "rules",
            "`rules`: expected a table, found an array",
            Some("write `[rules]` in one pair of brackets"),
        );
    }
}
