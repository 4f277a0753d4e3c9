//! [`Text`]: text that is safe to print. Messages are made of nothing else.
//!
//! Names of robots and mazes, paths, reasons and hints may hold anything: a file can be named
//! after an escape sequence, and a robot can end its match with one. So `text!` escapes every
//! value that it puts into a text, and there is no other way to make one. What is written in the
//! code stays as it is, and so does a [`Text`] inside another.

use std::ffi::OsStr;
use std::fmt::{self, Write as _};

use super::escape::for_terminal;

/// Text without a character that could control a terminal, except the line breaks that its
/// author wrote.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text(String);

/// What can become part of a [`Text`]: a text as it is, and everything else escaped.
///
/// A path is neither: it may not even be Unicode. [`Text::of_path`] makes a text of it.
/// A [`GuestText`](wasmouse_core::GuestText) is neither: its
/// [`escaped`](wasmouse_core::GuestText::escaped) form is.
///
/// ```
/// use wasmouse::report::text::Printable as _;
/// assert_eq!("\u{1b}[31mred".to_text().as_str(), "\\u{1b}[31mred");
/// ```
///
/// ```compile_fail
/// use wasmouse::report::text::Printable as _;
/// std::path::Path::new("red").to_text();
/// ```
///
/// ```compile_fail
/// use wasmouse::report::text::Printable as _;
/// wasmouse_core::GuestText::from("red").to_text();
/// ```
pub trait Printable {
    /// The safe text.
    fn to_text(&self) -> Text;
}

impl<T: fmt::Display + ?Sized> Printable for T {
    fn to_text(&self) -> Text {
        Text(for_terminal(&self.to_string()))
    }
}

impl Printable for Text {
    fn to_text(&self) -> Text {
        self.clone()
    }
}

impl Printable for &Text {
    fn to_text(&self) -> Text {
        (*self).clone()
    }
}

impl Text {
    /// A path or file name. Bytes that are not Unicode are shown by their numbers.
    ///
    /// ```
    /// use wasmouse::report::text::Text;
    /// assert_eq!(Text::of_path("a\u{1b}[2J.wasm").as_str(), "a\\u{1b}[2J.wasm");
    /// ```
    pub fn of_path(path: impl AsRef<OsStr>) -> Self {
        let mut shown = String::new();
        for chunk in path.as_ref().as_encoded_bytes().utf8_chunks() {
            shown.push_str(&for_terminal(chunk.valid()));
            for byte in chunk.invalid() {
                write!(shown, "\\x{byte:02x}").expect("writing to a string cannot fail");
            }
        }
        Self(shown)
    }

    /// Text of several lines, of which each is escaped. Only for what wrote its lines itself and
    /// puts nothing of others into them that could break one.
    pub fn of_lines(lines: &str) -> Self {
        let lines: Vec<String> = lines.split('\n').map(for_terminal).collect();
        Self(lines.join("\n"))
    }

    /// The text, to print it.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// For `text!`, which sees to it that all arguments are [`Shown`].
    pub(crate) fn from_arguments(arguments: fmt::Arguments<'_>) -> Self {
        Self(arguments.to_string())
    }
}

/// An argument of `text!`.
pub(crate) struct Shown<'a, T: ?Sized>(pub(crate) &'a T);

impl<T: Printable + ?Sized> fmt::Display for Shown<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0.to_text().0)
    }
}

/// Makes a [`Text`] as `format!` makes a string. The arguments must be positional, because
/// those that are named inside of the braces could not be escaped; it does not compile otherwise.
macro_rules! text {
    ($format:literal $(, $argument:expr)* $(,)?) => {{
        const _: () = $crate::report::text::assert_positional($format);
        $crate::report::text::Text::from_arguments(
            format_args!($format $(, $crate::report::text::Shown(&$argument))*)
        )
    }};
}

pub(crate) use text;

/// Fails to compile when a format names an argument.
///
/// ```
/// const _: () = wasmouse::report::text::assert_positional("unknown robot `{}` {{name}}");
/// ```
///
/// ```compile_fail
/// const _: () = wasmouse::report::text::assert_positional("unknown robot `{name}`");
/// ```
///
/// # Panics
///
/// When it does.
pub const fn assert_positional(format: &str) {
    let format = format.as_bytes();
    let mut at = 0;
    while at < format.len() {
        if format[at] == b'{' {
            at += 1;
            assert!(at < format.len(), "a format ends in a brace");
            assert!(
                matches!(format[at], b'{' | b'}' | b':'),
                "arguments of a safe text must be positional"
            );
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    #[cfg(unix)]
    use super::*;

    #[test]
    fn values_are_escaped_once_and_texts_are_kept() {
        let inner = text!("{}\n  {}", "a\nb", 7);
        assert_eq!(inner.as_str(), "a\\nb\n  7");
        assert_eq!(text!("<{}>", inner).as_str(), "<a\\nb\n  7>");
        assert_eq!(text!("{:<4}|{:>3}", "\t", 5).as_str(), "\\t  |  5");
    }

    #[cfg(unix)]
    #[test]
    fn paths_that_are_not_unicode_can_be_told_apart() {
        use std::os::unix::ffi::OsStrExt as _;
        let path = OsStr::from_bytes(b"a\xff\x1b.wasm");
        assert_eq!(Text::of_path(path).as_str(), "a\\xff\\u{1b}.wasm");
    }
}
