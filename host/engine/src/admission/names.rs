//! The names of the robot interface, and lists of names in messages.

/// The export that makes a component a robot.
pub(crate) const CONTROLLER: &str = "wasmouse:robot/controller@0.1.0";

/// The journal's name as an import; a robot built against another patch version of the same
/// interface links all the same.
pub(crate) const JOURNAL: &str = "wasmouse:robot/journal@0.1.0";

/// The interface `types` holds no functions, but its types are imported by every component
/// that uses them.
const TYPES: &str = "wasmouse:robot/types@0.1.0";

/// Whether a robot may import an interface of that name.
pub(super) fn is_known_import(name: &str) -> bool {
    name == JOURNAL || name == TYPES
}

/// At most this many names are listed, so that a message stays readable.
const NAMES_SHOWN_MAX: usize = 8;

/// The names in backquotes; only their number after the first 8.
pub(super) fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "nothing".into();
    }
    let shown = names.iter().take(NAMES_SHOWN_MAX);
    let mut shown: Vec<String> = shown.map(|name| format!("`{name}`")).collect();
    if names.len() > NAMES_SHOWN_MAX {
        shown.push(format!("{} more", names.len() - NAMES_SHOWN_MAX));
    }
    shown.join(", ")
}

/// As [`list`], with untrusted names escaped.
pub(super) fn list_escaped<'a>(names: impl IntoIterator<Item = &'a String>) -> String {
    let escaped = names
        .into_iter()
        .map(|name| name.escape_debug().to_string());
    list(&escaped.collect::<Vec<String>>())
}
