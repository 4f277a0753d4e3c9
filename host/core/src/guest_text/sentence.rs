//! [`guest_text!`](crate::guest_text!): a sentence with texts from outside.

use std::fmt::{Display, Write as _};

use super::borrowed::GuestStr;
use super::owned::GuestText;

/// What can be a part of a [`GuestText`]: another one as it is, and everything that can be printed.
pub trait Part {
    /// Adds it to the end.
    fn add_to(&self, text: &mut GuestText);
}

impl<T: Display + ?Sized> Part for T {
    fn add_to(&self, text: &mut GuestText) {
        write!(text, "{self}").expect("a text takes any text");
    }
}

impl Part for GuestText {
    fn add_to(&self, text: &mut GuestText) {
        text.push(self);
    }
}

impl Part for &GuestText {
    fn add_to(&self, text: &mut GuestText) {
        text.push(*self);
    }
}

impl Part for GuestStr<'_> {
    fn add_to(&self, text: &mut GuestText) {
        text.push(*self);
    }
}

/// Makes a [`GuestText`] as `format!` makes a string. Arguments are strings, numbers, and texts from
/// outside, each at a `{}` of the format.
///
/// ```
/// use wasmouse_core::{GuestText, guest_text};
///
/// let name = GuestText::from("\u{1b}[2Jdone");
/// let sentence = guest_text!("robot `{}`, step {}", name, 7);
/// assert_eq!(sentence.escaped().to_string(), "robot `\\u{1b}[2Jdone`, step 7");
/// ```
///
/// ```compile_fail
/// use wasmouse_core::guest_text;
/// println!("{}", guest_text!("step {}", 7));
/// ```
///
/// ```compile_fail
/// use wasmouse_core::guest_text;
/// guest_text!("step {} of {}", 7);
/// ```
#[macro_export]
macro_rules! guest_text {
    ($format:literal $(, $argument:expr)* $(,)?) => {{
        const _: () = $crate::guest_text::assert_placeholders(
            $format,
            0 $(+ { let _ = stringify!($argument); 1 })*,
        );
        $crate::guest_text::sentence($format, &[$(&$argument),*])
    }};
}

/// The sentence of [`guest_text!`](crate::guest_text!), which checks the number of parts.
pub fn sentence(format: &str, parts: &[&dyn Part]) -> GuestText {
    let mut text = GuestText::new();
    let mut parts = parts.iter();
    for (index, literal) in format.split("{}").enumerate() {
        if let Some(part) = (index > 0).then(|| parts.next()).flatten() {
            part.add_to(&mut text);
        }
        text.push(literal);
    }
    text
}

/// Fails to compile when a format has another number of `{}`, or any other brace.
///
/// ```
/// const _: () = wasmouse_core::guest_text::assert_placeholders("robot `{}`, step {}", 2);
/// ```
///
/// ```compile_fail
/// const _: () = wasmouse_core::guest_text::assert_placeholders("robot `{name}`", 1);
/// ```
///
/// # Panics
///
/// When it does.
pub const fn assert_placeholders(format: &str, expected: usize) {
    let format = format.as_bytes();
    let (mut at, mut found) = (0, 0);
    while at < format.len() {
        if format[at] == b'{' {
            at += 1;
            found += 1;
            assert!(
                at < format.len() && format[at] == b'}',
                "the arguments of a guest text have an empty pair of braces each"
            );
        } else {
            assert!(format[at] != b'}', "a brace is closed that was not opened");
        }
        at += 1;
    }
    assert!(found == expected, "a pair of braces for each argument");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_put_in_order_and_kept_as_they_are() {
        let name = GuestText::from("a{}\n");
        let line = GuestStr::from("\u{1b}");
        assert_eq!(guest_text!("nothing"), "nothing");
        assert_eq!(
            guest_text!("{}{}: {} of {}", name, line, 7, "b{}"),
            "a{}\n\u{1b}: 7 of b{}"
        );
    }
}
