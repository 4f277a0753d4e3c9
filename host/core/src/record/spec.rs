//! [`MatchSpec`]: a match to play.

use std::sync::Arc;

use super::MatchKey;
use crate::game::Ruleset;
use crate::maze::Maze;

/// A match to play: its key, with the maze and the rules that the key identifies by digest. The
/// executor has the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatchSpec {
    /// The identity of the match.
    pub key: MatchKey,
    /// The maze; the key has its digest.
    pub maze: Arc<Maze>,
    /// The rules; the key has their digest.
    pub rules: Arc<Ruleset>,
}
