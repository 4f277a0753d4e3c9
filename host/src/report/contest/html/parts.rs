//! Small parts that several sections of the page have.

use maud::{Markup, html};
use wasmouse_core::guest_text::GuestStr;

use crate::report::escape::for_terminal;

/// Text of others as the page shows it; maud escapes it for HTML.
pub(super) fn shown<'a>(text: impl Into<GuestStr<'a>>) -> String {
    for_terminal(text)
}

/// A name in a table: on one line if it is short, and never wider than the style allows.
pub(super) fn label<'a>(text: impl Into<GuestStr<'a>>) -> Markup {
    html! { span.label { (shown(text)) } }
}

/// The same of which the player makes a link to the match at that position in its data, if any.
pub(super) fn playable<'a>(text: impl Into<GuestStr<'a>>, position: Option<usize>) -> Markup {
    html! { span.label data-play=[position] { (shown(text)) } }
}

/// The caption of a table, which stays in view when a wide table is scrolled.
pub(super) fn caption(text: &str) -> Markup {
    html! { caption { span { (text) } } }
}

/// What stands below a list of `total` things of which fewer are shown.
pub(super) fn more(shown: usize, total: usize, what: &str) -> Markup {
    html! { @if shown < total { p.note { "Shown: " (shown) " of " (total) " " (what) "." } } }
}
