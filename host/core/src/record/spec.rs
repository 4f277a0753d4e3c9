//! [`MatchSpec`]: a match that is to be played.

use std::sync::Arc;

use super::MatchKey;
use crate::game::Ruleset;
use crate::maze::Maze;

/// What to play, besides the robot itself: the key of the match, with the maze and the rules
/// that the key names.
#[derive(Clone, Debug)]
pub struct MatchSpec {
    /// The identity of the match.
    pub key: MatchKey,
    /// The maze; its digest is that of the key.
    pub maze: Arc<Maze>,
    /// The rules; their digest is that of the key.
    pub rules: Arc<Ruleset>,
}
