//! [`MatchLink`]: a match in one word, `ROBOT/MAZE/SEED/STEP`, on the command line and in the
//! address of a page.

use std::fmt;
use std::str::FromStr;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use wasmouse_core::guest_text::GuestStr;

/// What stays as it is. Of the rest, a slash has to be encoded because it separates.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'_')
    .remove(b'.')
    .remove(b':')
    .remove(b',')
    .remove(b'=');

/// A match, or several, by what people call them.
///
/// Robot and maze are percent-encoded where they have other characters than letters, digits and
/// `-_.:,=`. An empty part, or one that is left out, means any.
///
/// ```
/// use wasmouse::report::match_link::MatchLink;
/// let link: MatchLink = "ann%20lee/gen:tree:16:1/0/212".parse()?;
/// assert_eq!(link.robot.as_deref(), Some("ann lee"));
/// assert_eq!((link.seed, link.step), (Some(0), Some(212)));
/// assert_eq!(link.to_string(), "ann%20lee/gen:tree:16:1/0/212");
/// let all: MatchLink = "/test_maze_01".parse()?;
/// assert!(all.has_match("flood", "test_maze_01", 3));
/// assert!(!all.has_match("flood", "test_maze_02", 3));
/// let flood: MatchLink = "flood".parse()?;
/// assert!(flood.has_match("flood:reset", "test_maze_01", 0));
/// # Ok::<(), wasmouse::report::match_link::ParseLinkError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MatchLink {
    /// The name of the robot.
    pub robot: Option<String>,
    /// The name of the maze.
    pub maze: Option<String>,
    /// The seed.
    pub seed: Option<u64>,
    /// Where to start watching: after this many steps.
    pub step: Option<usize>,
}

/// Why a text is not a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseLinkError {
    /// There are more than four parts.
    #[error("expected ROBOT/MAZE/SEED/STEP; write `/` in a name as `%2F`")]
    Parts,
    /// The third part is no seed.
    #[error("the seed is not a number from 0 to 18446744073709551615")]
    Seed,
    /// The fourth part is no step.
    #[error("the step is not a number")]
    Step,
    /// A name is not UTF-8 after it was decoded.
    #[error("a name is not UTF-8")]
    Utf8,
}

impl MatchLink {
    /// Whether that match is meant. A robot without a variant means all variants of it.
    pub fn has_match<'a>(
        &self,
        robot: impl Into<GuestStr<'a>>,
        maze: impl Into<GuestStr<'a>>,
        seed: u64,
    ) -> bool {
        let (robot, maze) = (robot.into(), maze.into());
        let is_robot = |it: &str| robot == it || is_variant(robot, it);
        self.robot.as_deref().is_none_or(is_robot)
            && self.maze.as_deref().is_none_or(|it| maze == it)
            && self.seed.is_none_or(|it| it == seed)
    }
}

/// Whether a robot is called so but for its variant.
fn is_variant(robot: GuestStr<'_>, name: &str) -> bool {
    !name.contains(':') && robot.starts_with(&format!("{name}:"))
}

impl FromStr for MatchLink {
    type Err = ParseLinkError;

    fn from_str(text: &str) -> Result<Self, ParseLinkError> {
        let mut parts = text.trim_start_matches('#').split('/');
        let mut part = || parts.next().filter(|part| !part.is_empty());
        let (robot, maze, seed, step) = (part(), part(), part(), part());
        let link = Self {
            robot: robot.map(decode).transpose()?,
            maze: maze.map(decode).transpose()?,
            seed: seed
                .map(str::parse)
                .transpose()
                .map_err(|_| ParseLinkError::Seed)?,
            step: step
                .map(str::parse)
                .transpose()
                .map_err(|_| ParseLinkError::Step)?,
        };
        match parts.next() {
            Some(_) => Err(ParseLinkError::Parts),
            None => Ok(link),
        }
    }
}

impl fmt::Display for MatchLink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |part: &Option<String>| {
            let part = part.as_deref().unwrap_or_default();
            utf8_percent_encode(part, ENCODED).to_string()
        };
        write!(f, "{}/{}/", name(&self.robot), name(&self.maze))?;
        if let Some(seed) = self.seed {
            write!(f, "{seed}")?;
        }
        match self.step {
            Some(step) => write!(f, "/{step}"),
            None => Ok(()),
        }
    }
}

fn decode(part: &str) -> Result<String, ParseLinkError> {
    let decoded = percent_decode_str(part).decode_utf8();
    decoded.map(Into::into).map_err(|_| ParseLinkError::Utf8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_round_trip() {
        for (robot, maze) in [
            ("flood:1", "test_maze_01"),
            ("a/b", "c#d"),
            ("\u{fc}ber 100%", "\u{1b}[31m\"<>"),
        ] {
            let link = MatchLink {
                robot: Some(robot.to_owned()),
                maze: Some(maze.to_owned()),
                seed: Some(u64::MAX),
                step: Some(3),
            };
            let text = link.to_string();
            assert!(text.is_ascii() && text.split('/').count() == 4, "{text}");
            assert_eq!(text.parse(), Ok(link.clone()));
            assert_eq!(format!("#{text}").parse(), Ok(link));
        }
    }

    #[test]
    fn other_texts_are_refused() {
        #[track_caller]
        fn check(text: &str, expected: ParseLinkError) {
            assert_eq!(text.parse::<MatchLink>(), Err(expected), "{text}");
        }
        check("a/b/c", ParseLinkError::Seed);
        check("a/b/-1", ParseLinkError::Seed);
        check("a/b/18446744073709551616", ParseLinkError::Seed);
        check("a/b/1/x", ParseLinkError::Step);
        check("a/b/1/2/3", ParseLinkError::Parts);
        check("%ff", ParseLinkError::Utf8);
        assert_eq!("".parse(), Ok(MatchLink::default()));
    }
}
