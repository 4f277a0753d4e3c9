//! [`Failure`]: how a command ends without a result.

use super::exit::Exit;
use crate::report::text::{Printable, Text, text};

/// An error for the person at the terminal: what happened, a hint, an exit code.
///
/// The message is a lowercase fragment with place and value and no full stop;
/// the hint says what to do. Printed as `error: MESSAGE`, an empty line and
/// `hint: HINT`. Both are escaped unless they are a [`Text`], which has been escaped already.
#[derive(Debug)]
pub struct Failure {
    exit: Exit,
    message: Text,
    hint: Option<Text>,
}

impl Failure {
    /// An invalid command line that clap does not notice.
    pub fn usage(message: impl Printable) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// An input, or a required tool, that is missing or invalid.
    pub fn input(message: impl Printable) -> Self {
        Self::new(Exit::Input, message)
    }

    /// A robot that is rejected.
    pub fn robot(message: impl Printable) -> Self {
        Self::new(Exit::Robot, message)
    }

    /// An internal error.
    pub fn internal(message: impl Printable) -> Self {
        Self::new(Exit::Internal, message)
    }

    fn new(exit: Exit, message: impl Printable) -> Self {
        Self {
            exit,
            message: message.to_text(),
            hint: None,
        }
    }

    /// The same failure with what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Printable) -> Self {
        self.hint = Some(hint.to_text());
        self
    }

    /// What happened, without the hint.
    pub const fn message(&self) -> &Text {
        &self.message
    }

    /// What to do about it, if that is known.
    pub const fn hint_text(&self) -> Option<&Text> {
        self.hint.as_ref()
    }

    /// The exit code that goes with it.
    pub const fn exit(&self) -> Exit {
        self.exit
    }

    /// All of it, to print it.
    pub fn report(&self) -> Text {
        match &self.hint {
            None => text!("error: {}", self.message),
            Some(hint) => text!("error: {}\n\nhint: {}", self.message, hint),
        }
    }
}

#[cfg(test)]
impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.report().as_str())
    }
}
