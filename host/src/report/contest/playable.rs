//! [`Playable`]: the matches that can be watched in the web page.

use std::collections::BTreeMap;

use wasmouse_core::maze::Maze;
use wasmouse_core::record::Transcript;

/// A match in a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Index of the maze.
    pub maze: usize,
    /// Index of the robot.
    pub robot: usize,
    /// Position of the seed.
    pub seed: u32,
}

/// Transcripts of matches and the mazes that they need, up to [`PLAYABLE_BYTES_MAX`].
///
/// Nothing is checked: the page replays a transcript when it is opened, and says what is wrong.
#[derive(Clone, Debug, Default)]
pub struct Playable {
    /// The [identity bytes](Maze::identity_bytes) of mazes, by index.
    mazes: BTreeMap<usize, Vec<u8>>,
    matches: BTreeMap<Place, Transcript>,
    bytes: usize,
    is_full: bool,
}

/// The bytes of transcripts and mazes in a page, at most. Compressed, they take about a third.
pub const PLAYABLE_BYTES_MAX: usize = 3_000_000;

impl Playable {
    /// Adds a match, unless it is there or there is no room for it.
    pub fn add(&mut self, place: Place, maze: &Maze, transcript: &Transcript) {
        if !self.is_full && !self.matches.contains_key(&place) {
            self.put(place, &maze.identity_bytes(), transcript);
        }
    }

    /// Adds those matches of another that are not there yet, as far as there is room.
    pub fn extend(&mut self, other: &Self) {
        for (place, transcript) in &other.matches {
            if !self.is_full && !self.matches.contains_key(place) {
                self.put(*place, other.maze(place.maze), transcript);
            }
        }
        self.is_full |= other.is_full;
    }

    fn put(&mut self, place: Place, identity: &[u8], transcript: &Transcript) {
        let mut bytes = self.bytes + transcript.to_bytes().len();
        if !self.mazes.contains_key(&place.maze) {
            bytes += identity.len();
        }
        if bytes > PLAYABLE_BYTES_MAX {
            self.is_full = true;
            return;
        }
        self.bytes = bytes;
        self.mazes
            .entry(place.maze)
            .or_insert_with(|| identity.to_vec());
        self.matches.insert(place, transcript.clone());
    }

    /// Whether a match found no room, so that more need not be tried.
    pub const fn is_full(&self) -> bool {
        self.is_full
    }

    /// The number of matches.
    pub fn len(&self) -> usize {
        self.matches.len()
    }

    /// Whether there are no matches.
    pub fn is_empty(&self) -> bool {
        self.matches.is_empty()
    }

    /// The matches by maze, robot and seed.
    pub(super) fn matches(&self) -> impl Iterator<Item = (Place, &Transcript)> {
        self.matches.iter().map(|(place, it)| (*place, it))
    }

    /// The identity bytes of a maze of a match.
    pub(super) fn maze(&self, index: usize) -> &[u8] {
        self.mazes.get(&index).map_or(&[], Vec::as_slice)
    }
}
