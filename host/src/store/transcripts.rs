//! Transcripts in a store: of all matches, or of the best of each robot.

use std::cmp::Reverse;

use rusqlite::{Connection, params};
use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, Score, Verdict};
use wasmouse_core::record::{MatchKey, MatchRecord, Transcript};

use super::columns::{self, unsigned};
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Address};
use super::open::Store;

/// Which transcripts are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum KeptTranscripts {
    /// None.
    #[default]
    None,
    /// That of the best match of each robot in each of its variants: the one with the smallest
    /// regret; without a score, the one that reached the goal, or else took the most steps.
    Best,
    /// All.
    All,
}

/// How good a match is: the better, the smaller. No two matches of a player are equal, so it does
/// not matter in which order they come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    class: u8,
    regret: u64,
    steps: Reverse<u32>,
    maze: Digest,
    seed: u64,
}

impl Rank {
    pub fn new(record: &MatchRecord, oracle: Option<Score>) -> Self {
        let (class, regret) = match &record.verdict {
            Verdict::Finished { score } => {
                let oracle = oracle.map_or(0, Score::thousandths);
                (0, score.thousandths().saturating_sub(oracle))
            }
            Verdict::BudgetUsedUp { goal_reached: true } => (1, 0),
            Verdict::BudgetUsedUp { .. } | Verdict::Fault { .. } => (2, 0),
        };
        Self {
            class,
            regret,
            steps: Reverse(record.steps.total()),
            maze: record.key.maze,
            seed: record.key.seed,
        }
    }
}

impl Store {
    /// The transcript of a match; `None` if it was not kept.
    ///
    /// # Errors
    ///
    /// When the store cannot be read, or the transcript is not the one of the record.
    pub fn transcript(&self, key: &MatchKey) -> Result<Option<Transcript>, StoreError> {
        self.read(|connection| {
            let Some(at) = ids::address(connection, key)? else {
                return Ok(None);
            };
            let mut statement = connection.prepare_cached(
                "SELECT t.bytes, m.transcript FROM transcript t JOIN match m \
                 USING(engine, rules, robot, variant, maze, seed) \
                 WHERE t.engine = ?1 AND t.rules = ?2 AND t.robot = ?3 AND t.variant = ?4 \
                 AND t.maze = ?5 AND t.seed = ?6",
            )?;
            let mut rows = statement.query(params![
                at.engine, at.rules, at.robot, at.variant, at.maze, at.seed,
            ])?;
            let Some(row) = rows.next()? else {
                return Ok(None);
            };
            let bytes = row.get_ref(0)?.as_blob().unwrap_or_default();
            decode(bytes, &ids::digest_at(row, 1)?, key).map(Some)
        })
    }

    /// The match whose transcript [`KeptTranscripts::Best`] keeps, if the store has one: of that
    /// engine, those rules, that robot and that variant.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn best_match(
        &self,
        engine: &Digest,
        rules: &Ruleset,
        robot: &Digest,
        variant: u32,
    ) -> Result<Option<(MatchRecord, Transcript)>, StoreError> {
        let key = MatchKey {
            engine: *engine,
            rules: rules.digest(),
            robot: *robot,
            variant,
            maze: Digest::from_bytes([0; 32]),
            seed: 0,
        };
        let best = self.read(|connection| best(connection, &key, rules))?;
        let Some((_, record)) = best else {
            return Ok(None);
        };
        let transcript = self.transcript(&record.key)?;
        Ok(transcript.map(|it| (record, it)))
    }
}

/// Decodes a transcript, and checks that it has that digest.
pub(super) fn decode(
    bytes: &[u8],
    digest: &Digest,
    key: &MatchKey,
) -> Result<Transcript, StoreErrorKind> {
    let inconsistent = |problem| StoreErrorKind::Inconsistent {
        key: Box::new(*key),
        problem,
    };
    if Digest::of(bytes) != *digest {
        return Err(inconsistent("its transcript has another digest".to_owned()));
    }
    Transcript::from_bytes(bytes).map_err(|error| inconsistent(error.to_string()))
}

/// The best match of the player of this key among those whose transcript is kept.
pub(super) fn best(
    connection: &Connection,
    key: &MatchKey,
    rules: &Ruleset,
) -> Result<Option<(Rank, MatchRecord)>, StoreErrorKind> {
    let find = |table, digest| ids::find(connection, table, digest);
    let engine = find(ids::Table::Engine, &key.engine)?;
    let rules_id = find(ids::Table::Rules, &key.rules)?;
    let robot = find(ids::Table::Robot, &key.robot)?;
    let mut statement = connection.prepare_cached(columns::SELECT_KEPT)?;
    let mut rows = statement.query(params![engine, rules_id, robot, key.variant])?;
    let mut best: Option<(Rank, MatchRecord)> = None;
    while let Some(row) = rows.next()? {
        let behind = columns::RECORD_COLUMNS;
        let key = MatchKey {
            maze: ids::digest_at(row, behind)?,
            seed: unsigned(row, behind + 1)?,
            ..*key
        };
        let (exploration, speed) = (row.get(behind + 2)?, row.get::<_, Option<u32>>(behind + 3)?);
        let oracle = speed.zip(exploration);
        let oracle = oracle.map(|(speed, exploration)| rules.game.score(speed, exploration));
        let record = columns::read_record(row, key, rules)?;
        let rank = Rank::new(&record, oracle);
        if best.as_ref().is_none_or(|(best, _)| rank < *best) {
            best = Some((rank, record));
        }
    }
    Ok(best)
}

/// Keeps a transcript of a match that is in the store.
pub(super) fn put(
    connection: &Connection,
    at: &Address,
    is_best: bool,
    bytes: &[u8],
) -> Result<bool, StoreErrorKind> {
    if is_best {
        let mut statement = connection.prepare_cached(
            "DELETE FROM transcript WHERE engine = ?1 AND rules = ?2 AND robot = ?3 \
             AND variant = ?4 AND is_best = 1 AND NOT (maze = ?5 AND seed = ?6)",
        )?;
        statement.execute(params![
            at.engine, at.rules, at.robot, at.variant, at.maze, at.seed,
        ])?;
    }
    // One that is kept for good stays so.
    let mut statement = connection.prepare_cached(
        "INSERT INTO transcript(engine, rules, robot, variant, maze, seed, is_best, bytes) \
         VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8) \
         ON CONFLICT DO UPDATE SET is_best = 0 WHERE excluded.is_best < is_best",
    )?;
    let rows = statement.execute(params![
        at.engine, at.rules, at.robot, at.variant, at.maze, at.seed, is_best, bytes,
    ])?;
    Ok(rows > 0)
}
