//! [`GuestText`]: text from outside, which cannot be printed as it is.
//!
//! Robots, file names and mazes bring text that may hold anything: an escape sequence that clears
//! the screen, a tag, a formula, characters that reverse the direction of writing. Such text is a
//! [`GuestText`], or a [`GuestStr`] where it is borrowed. Neither is [`Display`](std::fmt::Display)
//! nor turns into a string by itself, so what prints one without escaping it does not compile.
//!
//! Text leaves these types in three ways:
//!
//! - [`escaped`](GuestText::escaped), for terminals and messages;
//! - serde, as a string: a form has its own escapes, and a program reads it;
//! - [`raw`](GuestText::raw), for what escapes it for another output, or stores it. Few files may
//!   call it; a test has the list of them, with the reason for each.
//!
//! [`guest_text!`](crate::guest_text!) makes a sentence of such texts and others: it is one itself.

mod borrowed;
mod escape;
mod owned;
mod sentence;

pub use borrowed::GuestStr;
pub use escape::{Escaped, misleads};
pub use owned::GuestText;
pub use sentence::{Part, assert_placeholders, sentence};
