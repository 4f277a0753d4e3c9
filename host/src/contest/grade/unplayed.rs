//! [`UnplayedMatches`]: which robots have matches that were not played, and why.

use std::collections::HashMap;
use std::io;

use wasmouse_core::{Digest, GuestText};

use super::super::sink::{ContestMatch, MatchFailure, Sink};

/// Why matches of a robot were not played: the first reason of each sort.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Unplayed {
    /// The robot was withdrawn.
    pub withdrawn: Option<GuestText>,
    /// The host failed.
    pub failed: Option<GuestText>,
}

/// A sink that keeps why matches were not played, by robot.
#[derive(Clone, Debug, Default)]
pub struct UnplayedMatches(HashMap<(Digest, u32), Unplayed>);

impl UnplayedMatches {
    /// What there is about a robot.
    pub fn of(&self, robot: Digest, variant: u32) -> Unplayed {
        self.0.get(&(robot, variant)).cloned().unwrap_or_default()
    }

    fn entry(&mut self, failure: &MatchFailure) -> &mut Unplayed {
        let key = (failure.key.robot, failure.key.variant);
        self.0.entry(key).or_default()
    }
}

impl Sink for UnplayedMatches {
    fn played(&mut self, _: &ContestMatch) -> io::Result<()> {
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let reason = || failure.reason.clone();
        self.entry(failure).failed.get_or_insert_with(reason);
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let reason = || failure.reason.clone();
        self.entry(failure).withdrawn.get_or_insert_with(reason);
        Ok(())
    }
}
