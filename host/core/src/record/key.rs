//! [`MatchKey`]: the identity of a match.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{Digest, DigestBuilder};

/// The name of an engine: everything else besides a [`MatchKey`] that can change fuel or a
/// verdict, such as the version of wasmtime and its configuration. Serialises as a string.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct EngineId(String);

impl EngineId {
    /// The engine with that name.
    pub fn new(name: impl Into<String>) -> Self {
        Self(name.into())
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The identity of the engine.
    ///
    /// Canonical encoding `wasmouse.engine.1` ([`DigestBuilder`]): the name as bytes.
    pub fn digest(&self) -> Digest {
        DigestBuilder::new("wasmouse.engine.1")
            .bytes(self.0.as_bytes())
            .finish()
    }
}

impl fmt::Display for EngineId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Everything that decides a match.
///
/// Two matches with the same key have the same record and transcript. Stores, caches and queues
/// use the [digest](MatchKey::digest) of the key as address.
///
/// Serialises as an object with these fields after `id`, the digest of the key; deserialising
/// fails if the id does not match the other fields.
///
/// ```
/// use wasmouse_core::Digest;
/// use wasmouse_core::game::Ruleset;
/// use wasmouse_core::maze::{Maze, Walls};
/// use wasmouse_core::record::{EngineId, MatchKey};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let key = MatchKey {
///     engine: EngineId::new("example").digest(),
///     rules: Ruleset::default().digest(),
///     robot: Digest::of(b"the bytes of a component"),
///     variant: 0,
///     maze: maze.digest(),
///     seed: 1,
/// };
/// let json = serde_json::to_value(key)?;
/// assert_eq!(json["id"], key.digest().to_string());
/// assert_eq!(serde_json::from_value::<MatchKey>(json)?, key);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "Form", try_from = "Form")]
pub struct MatchKey {
    /// The engine: [`EngineId::digest`].
    pub engine: Digest,
    /// The rules: [`Ruleset::digest`](crate::game::Ruleset::digest).
    pub rules: Digest,
    /// The robot: the digest of the submitted file.
    pub robot: Digest,
    /// The variant of the robot: the number that chooses its mode.
    pub variant: u32,
    /// The maze: [`Maze::digest`](crate::maze::Maze::digest).
    pub maze: Digest,
    /// The seed: the robot's only source of randomness.
    pub seed: u64,
}

impl MatchKey {
    /// The address of the match.
    ///
    /// Canonical encoding `wasmouse.match.1` ([`DigestBuilder`]): the digests of engine,
    /// rules, robot and maze, then the numbers variant and seed.
    pub fn digest(&self) -> Digest {
        DigestBuilder::new("wasmouse.match.1")
            .digest(&self.engine)
            .digest(&self.rules)
            .digest(&self.robot)
            .digest(&self.maze)
            .numbers(&[self.variant.into(), self.seed])
            .finish()
    }
}

/// The serialised form of a key.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    id: Digest,
    engine: Digest,
    rules: Digest,
    robot: Digest,
    variant: u32,
    maze: Digest,
    seed: u64,
}

impl From<MatchKey> for Form {
    fn from(key: MatchKey) -> Self {
        let MatchKey {
            engine,
            rules,
            robot,
            variant,
            maze,
            seed,
        } = key;
        Self {
            id: key.digest(),
            engine,
            rules,
            robot,
            variant,
            maze,
            seed,
        }
    }
}

impl TryFrom<Form> for MatchKey {
    type Error = &'static str;

    fn try_from(form: Form) -> Result<Self, &'static str> {
        let key = Self {
            engine: form.engine,
            rules: form.rules,
            robot: form.robot,
            variant: form.variant,
            maze: form.maze,
            seed: form.seed,
        };
        let is_consistent = key.digest() == form.id;
        is_consistent
            .then_some(key)
            .ok_or("the id of a match does not match its key")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key() -> MatchKey {
        MatchKey {
            engine: EngineId::new("wasmtime-1").digest(),
            rules: Digest::of(b"rules"),
            robot: Digest::of(b"robot"),
            variant: 2,
            maze: Digest::of(b"maze"),
            seed: 3,
        }
    }

    #[test]
    fn every_part_changes_the_address() {
        let mut all = vec![key(); 7];
        all[1].engine = Digest::of(b"");
        all[2].rules = Digest::of(b"");
        all[3].robot = Digest::of(b"");
        all[4].variant = 1;
        all[5].maze = Digest::of(b"");
        all[6].seed = 1;
        let mut addresses: Vec<Digest> = all.iter().map(MatchKey::digest).collect();
        addresses.sort();
        addresses.dedup();
        assert_eq!(addresses.len(), all.len());
    }

    /// Other programs store addresses, so they must never change.
    #[test]
    fn the_address_of_a_key_never_changes() {
        assert_eq!(
            key().digest().to_string(),
            "53100879a960548ebd946cb0b0e61c4571b4ba794cef05c1f051b3b22c93ce1f"
        );
    }

    #[test]
    fn a_key_deserialises_only_with_its_own_id() {
        let json = serde_json::to_string(&key()).expect("it serialises");
        assert_eq!(serde_json::from_str::<MatchKey>(&json).ok(), Some(key()));
        let changed = json.replace("\"seed\":3", "\"seed\":4");
        assert_ne!(changed, json);
        let error = serde_json::from_str::<MatchKey>(&changed).expect_err("another seed");
        assert!(error.to_string().contains("the id of a match"), "{error}");
    }
}
