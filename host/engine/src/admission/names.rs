//! Lists of names in messages.

/// At most this many names are listed, so that a message stays readable.
const NAMES_SHOWN_MAX: usize = 8;

/// The names in backquotes; only their number after the first 8.
pub(super) fn list<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let count = names.len();
    if count == 0 {
        return "nothing".into();
    }
    let shown = names.take(NAMES_SHOWN_MAX);
    let mut shown: Vec<String> = shown.map(|name| format!("`{name}`")).collect();
    if count > NAMES_SHOWN_MAX {
        shown.push(format!("{} more", count - NAMES_SHOWN_MAX));
    }
    shown.join(", ")
}

/// As [`list`], with untrusted names escaped.
pub(super) fn list_escaped<'a>(names: impl IntoIterator<Item = &'a String>) -> String {
    let escaped = names
        .into_iter()
        .map(|name| name.escape_debug().to_string());
    let escaped: Vec<String> = escaped.collect();
    list(escaped.iter().map(String::as_str))
}
