//! [`Commitment`]: hidden mazes that are fixed before a contest and shown after it.
//!
//! The organiser publishes the commitment before submissions close and keeps the [`Opening`]. When
//! the contest has ended, the opening lets anyone compute the commitment again: the mazes were not
//! chosen after the robots were known. The salt keeps contestants from trying out seeds of
//! generators until the digest of a set matches.

use serde::{Deserialize, Serialize};
use wasmouse_core::maze::Maze;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::{Digest, DigestBuilder, GuestText};

use super::maze_source::MazeSource;

/// The version of both documents.
pub const COMMITMENT_VERSION: u32 = 1;

/// What is published before a contest. Serialises as an object with these fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Commitment {
    /// [`COMMITMENT_VERSION`].
    pub version: u32,
    /// The name of the contest.
    pub contest: String,
    /// The hidden sets.
    pub sets: Vec<CommittedSet>,
}

/// A hidden set in a [`Commitment`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CommittedSet {
    /// The name of the set.
    pub name: String,
    /// How many mazes it has.
    pub mazes: u64,
    /// [`OpenedSet::digest`].
    pub digest: Digest,
}

/// What is kept secret until the contest has ended. Serialises as an object with these fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// [`COMMITMENT_VERSION`].
    pub version: u32,
    /// The name of the contest.
    pub contest: String,
    /// The hidden sets with their mazes.
    pub sets: Vec<OpenedSet>,
}

/// A hidden set in an [`Opening`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OpenedSet {
    /// The name of the set.
    pub name: String,
    /// 32 random bytes.
    pub salt: Digest,
    /// The mazes, in the order of the contest.
    pub mazes: Vec<OpenedMaze>,
}

/// A maze in an [`Opening`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OpenedMaze {
    /// What results call it; the specification of a generated maze.
    pub name: GuestText,
    /// Its digest.
    pub digest: Digest,
    /// The maze in the format `competition`; `None` for a generated maze, which anyone can
    /// generate again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
}

impl OpenedSet {
    /// A set with that salt.
    pub fn new(name: String, salt: Digest, mazes: &[MazeSource]) -> Self {
        let opened = |source: &MazeSource| match source {
            MazeSource::Generated(generated) => OpenedMaze {
                name: generated.to_string().into(),
                digest: generated.generate().digest(),
                text: None,
            },
            MazeSource::Loaded { name, maze } => OpenedMaze {
                name: name.clone(),
                digest: maze.digest(),
                text: Some(
                    format::print(maze, Format::Competition)
                        .expect("the format can mark every start and goal"),
                ),
            },
        };
        Self {
            name,
            salt,
            mazes: mazes.iter().map(opened).collect(),
        }
    }

    /// What commits to the set.
    ///
    /// Canonical encoding `wasmouse.commitment.1` ([`DigestBuilder`]): the name of the contest and
    /// that of the set as bytes, the salt as a digest, the number of mazes, then for each maze its
    /// name as bytes and its digest.
    pub fn digest(&self, contest: &str) -> Digest {
        let builder = DigestBuilder::new("wasmouse.commitment.1")
            .bytes(contest.as_bytes())
            .bytes(self.name.as_bytes())
            .digest(&self.salt)
            .numbers(&[self.mazes.len() as u64]);
        let add = |builder: DigestBuilder, maze: &OpenedMaze| {
            builder
                .bytes(maze.name.raw().as_bytes())
                .digest(&maze.digest)
        };
        self.mazes.iter().fold(builder, add).finish()
    }
}

impl Opening {
    /// What is published of it.
    ///
    /// ```
    /// use wasmouse::contest::{COMMITMENT_VERSION, MazeSource, OpenedSet, Opening};
    /// use wasmouse_core::Digest;
    /// use wasmouse_core::maze::generate::GenSpec;
    ///
    /// let spec: GenSpec = "gen:braid:16:7..=9".parse().expect("a specification");
    /// let mazes: Vec<MazeSource> = spec.expand().map(MazeSource::Generated).collect();
    /// let salt = Digest::of(b"random bytes");
    /// let mut opening = Opening {
    ///     version: COMMITMENT_VERSION,
    ///     contest: "spring cup".to_owned(),
    ///     sets: vec![OpenedSet::new("final".to_owned(), salt, &mazes)],
    /// };
    /// let commitment = opening.commitment();
    /// assert!(opening.check(&commitment).is_empty());
    /// opening.sets[0].mazes.pop();
    /// assert_eq!(opening.check(&commitment).len(), 2);
    /// ```
    pub fn commitment(&self) -> Commitment {
        let sets = self.sets.iter().map(|set| CommittedSet {
            name: set.name.clone(),
            mazes: set.mazes.len() as u64,
            digest: set.digest(&self.contest),
        });
        Commitment {
            version: COMMITMENT_VERSION,
            contest: self.contest.clone(),
            sets: sets.collect(),
        }
    }

    /// In what respects it does not keep the commitment; empty when it does.
    pub fn check(&self, commitment: &Commitment) -> Vec<Broken> {
        let mut broken = Vec::new();
        if self.contest != commitment.contest {
            broken.push(Broken::Contest {
                committed: commitment.contest.clone(),
                opened: self.contest.clone(),
            });
        }
        for committed in &commitment.sets {
            let name = committed.name.clone();
            match self.sets.iter().find(|it| it.name == committed.name) {
                None => broken.push(Broken::MissingSet { name }),
                Some(set) => {
                    let mazes = set.mazes.len() as u64;
                    if mazes != committed.mazes {
                        let committed = committed.mazes;
                        let name = name.clone();
                        broken.push(Broken::Mazes {
                            name,
                            committed,
                            opened: mazes,
                        });
                    }
                    if set.digest(&commitment.contest) != committed.digest {
                        broken.push(Broken::Set { name });
                    }
                }
            }
        }
        for set in &self.sets {
            if commitment.sets.iter().all(|it| it.name != set.name) {
                let name = set.name.clone();
                broken.push(Broken::OtherSet { name });
            }
            let mazes = set.mazes.iter().filter_map(OpenedMaze::check);
            broken.extend(mazes.map(|(name, reason)| Broken::Maze { name, reason }));
        }
        broken
    }
}

impl OpenedMaze {
    /// The maze itself.
    ///
    /// # Errors
    ///
    /// When the text is no maze, or there is neither a text nor the specification of a generator.
    pub fn maze(&self) -> Result<Maze, String> {
        if let Some(text) = &self.text {
            let parsed = format::parse_as(text, Format::Competition);
            return parsed.map(|it| it.maze).map_err(|error| error.to_string());
        }
        let spec: GenSpec = self.name.raw().parse().map_err(|error| {
            format!("it has no text, and its name does not generate it: {error}")
        })?;
        let mut mazes = spec.expand();
        match (mazes.next(), mazes.next()) {
            (Some(maze), None) => Ok(maze.generate()),
            _ => Err("its name stands for more than one maze".to_owned()),
        }
    }

    /// The name with the reason when the maze is not the one of the digest.
    fn check(&self) -> Option<(GuestText, String)> {
        let reason = match self.maze() {
            Ok(maze) if maze.digest() == self.digest => return None,
            Ok(_) => "it has another digest".to_owned(),
            Err(reason) => reason,
        };
        Some((self.name.clone(), reason))
    }
}

/// Why an opening does not keep a commitment.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Broken {
    /// It is about another contest.
    #[error("the commitment is for the contest `{committed}`, the opening for `{opened}`")]
    Contest {
        /// The name in the commitment.
        committed: String,
        /// The name in the opening.
        opened: String,
    },
    /// A set is not opened.
    #[error("the set `{name}` is not in the opening")]
    MissingSet {
        /// The set.
        name: String,
    },
    /// A set was not committed to.
    #[error("nothing was committed to for the set `{name}`")]
    OtherSet {
        /// The set.
        name: String,
    },
    /// A set has another number of mazes.
    #[error("the set `{name}` has another number of mazes: {opened} instead of {committed}")]
    Mazes {
        /// The set.
        name: String,
        /// How many it had.
        committed: u64,
        /// How many it has.
        opened: u64,
    },
    /// A set is not the one that was committed to.
    #[error(
        "the set `{name}` is not the one that was committed to: salt, names, order or mazes differ"
    )]
    Set {
        /// The set.
        name: String,
    },
    /// A maze is not what it is said to be.
    #[error("maze `{}`: {reason}", name.escaped())]
    Maze {
        /// The maze.
        name: GuestText,
        /// Why.
        reason: String,
    },
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use wasmouse_core::maze::bundled;

    use super::*;

    fn opening() -> Opening {
        let first = &bundled()[0];
        let text = format::parse(first.text).expect("a bundled maze");
        let loaded = MazeSource::Loaded {
            name: first.name.into(),
            maze: Arc::new(text.maze),
        };
        let spec: GenSpec = "gen:tree:12:3".parse().expect("a specification");
        let mut mazes = vec![loaded];
        mazes.extend(spec.expand().map(MazeSource::Generated));
        Opening {
            version: COMMITMENT_VERSION,
            contest: "cup".to_owned(),
            sets: vec![OpenedSet::new(
                "final".to_owned(),
                Digest::of(b"salt"),
                &mazes,
            )],
        }
    }

    #[track_caller]
    fn check_change(change: impl FnOnce(&mut Opening), expected: &[&str]) {
        let mut changed = opening();
        change(&mut changed);
        let broken = changed.check(&opening().commitment());
        let messages: Vec<String> = broken.iter().map(ToString::to_string).collect();
        assert_eq!(messages, expected);
    }

    #[test]
    fn every_change_of_an_opening_is_named() {
        const OTHER: &str = "the set `final` is not the one that was committed to: salt, names, order or mazes differ";
        check_change(|_| {}, &[]);
        check_change(|it| it.sets[0].salt = Digest::of(b""), &[OTHER]);
        check_change(|it| it.sets[0].mazes.reverse(), &[OTHER]);
        check_change(
            |it| it.contest = "bowl".to_owned(),
            &["the commitment is for the contest `cup`, the opening for `bowl`"],
        );
        check_change(
            |it| it.sets[0].name = "semi".to_owned(),
            &[
                "the set `final` is not in the opening",
                "nothing was committed to for the set `semi`",
            ],
        );
        check_change(
            |it| drop(it.sets[0].mazes.pop()),
            &[
                "the set `final` has another number of mazes: 1 instead of 2",
                OTHER,
            ],
        );
        let generated = |it: &mut Opening, name: &str| it.sets[0].mazes[1].name = name.into();
        check_change(
            |it| generated(it, "gen:tree,loops=12:12:4"),
            &[
                OTHER,
                "maze `gen:tree,loops=12:12:4`: it has another digest",
            ],
        );
        check_change(
            |it| generated(it, "gen:tree:12:3..=4"),
            &[
                OTHER,
                "maze `gen:tree:12:3..=4`: its name stands for more than one maze",
            ],
        );
        check_change(
            |it| it.sets[0].mazes[0].text = Some("no maze".to_owned()),
            &[
                "maze `test_maze_01`: line 1, column 8: expected a whole number of cells, four \
               characters each, and a post, found the end of the line",
            ],
        );
    }

    #[test]
    fn a_commitment_says_nothing_without_the_salt() {
        let one = opening();
        let mut other = opening();
        other.sets[0].salt = Digest::of(b"other");
        assert_ne!(one.commitment(), other.commitment());
    }

    /// Commitments are published, so they must never change.
    #[test]
    fn the_digest_of_a_set_never_changes() {
        let digest = opening().commitment().sets[0].digest.to_string();
        assert_eq!(
            digest,
            "1ae74a97015829f2ac0220137eaef56a76b2525d2ecf2664ea5950715f70b609"
        );
    }
}
