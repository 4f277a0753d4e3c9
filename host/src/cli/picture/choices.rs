//! What `wasmouse picture` lets people choose, as its arguments say it.

use std::str::FromStr;

use crate::report::picture::Theme;
use crate::report::scene::Overlay;

/// `--step`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepChoice {
    At(usize),
    Last,
}

impl FromStr for StepChoice {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "last" => Ok(Self::Last),
            _ => text
                .parse()
                .map(Self::At)
                .map_err(|_| "expected a number or `last`"),
        }
    }
}

/// `--steps`: both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct StepRange {
    pub(super) first: usize,
    pub(super) last: Option<usize>,
}

impl FromStr for StepRange {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let expected = "expected a range such as 10..=40, 10.. or ..=40";
        let (first, last) = text.split_once("..").ok_or(expected)?;
        let number = |text: &str| text.parse().map_err(|_| expected);
        let first = if first.is_empty() { 0 } else { number(first)? };
        let last = match last.strip_prefix('=') {
            Some(last) => Some(number(last)?),
            None if last.is_empty() => None,
            None => return Err("the last step is included: write ..= before it"),
        };
        match last {
            Some(last) if last < first => Err("the first step is after the last one"),
            _ => Ok(Self { first, last }),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum OverlayChoice {
    /// The path of the speed run, or the last 20 steps of the exploration run
    Path,
    /// Only walls that the robot can know of; others are dots
    Knowledge,
    /// Only walls that the robot says that it believes in, if its replay has a journal that does
    Beliefs,
    /// How often the robot was in each cell
    Heat,
    /// The steps from the start to each cell, as heat
    Costs,
    /// The steps from each cell to the goal, as numbers
    Distances,
    /// An optimal path
    Optimum,
    /// What the robot has painted and labelled
    Journal,
    /// Nothing
    None,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum PictureTheme {
    Auto,
    Light,
    Dark,
}

impl From<PictureTheme> for Theme {
    fn from(choice: PictureTheme) -> Self {
        match choice {
            PictureTheme::Auto => Self::Auto,
            PictureTheme::Light => Self::Light,
            PictureTheme::Dark => Self::Dark,
        }
    }
}

impl From<OverlayChoice> for Option<Overlay> {
    fn from(choice: OverlayChoice) -> Self {
        Some(match choice {
            OverlayChoice::Path => Overlay::Path,
            OverlayChoice::Knowledge => Overlay::Knowledge,
            OverlayChoice::Beliefs => Overlay::Beliefs,
            OverlayChoice::Heat => Overlay::Heat,
            OverlayChoice::Costs => Overlay::Costs,
            OverlayChoice::Distances => Overlay::Distances,
            OverlayChoice::Optimum => Overlay::Optimum,
            OverlayChoice::Journal => Overlay::Journal,
            OverlayChoice::None => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_include_their_ends() {
        let parse = |text: &str| text.parse::<StepRange>();
        for (text, first, last) in [
            ("3..=9", 3, Some(9)),
            ("..=9", 0, Some(9)),
            ("3..", 3, None),
        ] {
            assert_eq!(parse(text), Ok(StepRange { first, last }), "{text}");
        }
        for text in ["", "7", "3..9", "9..=3", "a..", "..=", "-1.."] {
            assert!(parse(text).is_err(), "{text}");
        }
        assert_eq!("last".parse(), Ok(StepChoice::Last));
        assert_eq!("40".parse(), Ok(StepChoice::At(40)));
        assert!("-1".parse::<StepChoice>().is_err());
    }
}
