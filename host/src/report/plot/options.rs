//! [`Options`]: how a plot looks.

use crate::report::picture::Theme;

/// How a plot looks.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Instead of the title that tells the kind. May be untrusted.
    pub title: Option<String>,
    /// [`Theme::Auto`] is light.
    pub theme: Theme,
}
