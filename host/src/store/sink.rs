//! [`StoreSink`]: writes the matches of a contest into a store while they are played.

use std::collections::{HashMap, HashSet};
use std::io;
use std::mem;

use rusqlite::Transaction;
use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, Score};
use wasmouse_core::record::{EngineId, MatchKey, MatchRecord};

use super::columns;
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Address, IdCache};
use super::mazes::{MazeRow, MazeWriter};
use super::open::Store;
use super::seal::unseal;
use super::transcripts::{self, KeptTranscripts, Rank};
use super::unplayed::{self, Cause};
use super::writer::{Put, RecordWriter, conflict, put_conflict};
use crate::contest::{ContestMatch, ContestMaze, MatchFailure, Sink};

/// Matches in a transaction. Each transaction waits for the disk once.
const BATCH: usize = 4096;

/// Writes the matches of a contest into a store, in transactions of up to 4,096.
///
/// What [`flush`](StoreSink::flush) or [`finish`](StoreSink::finish) have returned for is on the
/// disk. Whatever arrived after that is written when the sink is dropped, as far as that is
/// possible; errors are lost then.
///
/// A record that is in the store already is not written again. One that contradicts the one in
/// the store is kept as a conflict, and the sink fails with [`StoreErrorKind::Conflict`] and takes
/// nothing more.
#[derive(Debug)]
pub struct StoreSink<'s> {
    store: &'s mut Store,
    engine: EngineId,
    engine_digest: Digest,
    rules: Ruleset,
    rules_digest: Digest,
    kept: KeptTranscripts,
    /// The mazes that came before. Matches that end in any order name theirs again and again, and
    /// writing a maze takes four statements.
    announced: HashSet<Digest>,
    /// The oracle score of the last maze.
    oracle: Option<Score>,
    /// By robot and variant, the best match so far; `None` for a player without one.
    best: HashMap<(Digest, u32), Option<Rank>>,
    ids: IdCache,
    batch: Batch,
    has_failed: bool,
}

/// What was not written yet.
#[derive(Debug, Default)]
struct Batch {
    mazes: Vec<MazeRow>,
    records: Vec<MatchRecord>,
    transcripts: Vec<(MatchKey, Vec<u8>)>,
    unplayed: Vec<(MatchFailure, Cause)>,
}

impl Batch {
    const fn len(&self) -> usize {
        self.mazes.len() + self.records.len() + self.unplayed.len()
    }

    /// Empties it. Its memory is kept for what arrives next.
    fn clear(&mut self) {
        self.mazes.clear();
        self.records.clear();
        self.transcripts.clear();
        self.unplayed.clear();
    }
}

impl<'s> StoreSink<'s> {
    /// A sink for matches of that engine under those rules.
    ///
    /// # Errors
    ///
    /// When the store was opened for reading only.
    pub fn new(
        store: &'s mut Store,
        engine: EngineId,
        rules: Ruleset,
        kept: KeptTranscripts,
    ) -> Result<Self, StoreError> {
        // Nothing is written before there is something to write, so that a finished contest stays
        // sealed when it is run again.
        if !store.is_writable() {
            return Err(store.error(StoreErrorKind::ReadOnly));
        }
        // The ids of a record have just been found or added by the sink itself, so looking each of
        // them up once more finds nothing. Sealing the store does, when all has been written.
        store.check_references(false)?;
        Ok(Self {
            engine_digest: engine.digest(),
            rules_digest: rules.digest(),
            store,
            engine,
            rules,
            kept,
            announced: HashSet::new(),
            oracle: None,
            best: HashMap::new(),
            ids: IdCache::default(),
            batch: Batch::default(),
            has_failed: false,
        })
    }

    /// Writes everything that has arrived. When this returns, it is on the disk.
    ///
    /// # Errors
    ///
    /// When the store cannot be written, or has another record for a match.
    pub fn flush(&mut self) -> Result<(), StoreError> {
        if self.batch.len() == 0 {
            return Ok(());
        }
        let mut batch = mem::take(&mut self.batch);
        let (engine, rules, is_best) = (
            &self.engine,
            &self.rules,
            self.kept == KeptTranscripts::Best,
        );
        let ids = &mut self.ids;
        let written = self.store.write(|transaction| {
            let mut writing = Writing {
                engine: ids::engine(transaction, engine)?,
                rules_id: ids::rules(transaction, rules)?,
                transaction,
                rules,
                ids,
                is_best,
            };
            writing.write(&batch)
        });
        batch.clear();
        self.batch = batch;
        match written {
            Ok(None) => Ok(()),
            Ok(Some(conflict)) => {
                self.has_failed = true;
                Err(self.store.error(conflict))
            }
            Err(error) => {
                self.has_failed = true;
                self.ids.clear();
                Err(error)
            }
        }
    }

    /// Writes everything that has arrived, and ends.
    ///
    /// # Errors
    ///
    /// As [`StoreSink::flush`].
    pub fn finish(mut self) -> Result<(), StoreError> {
        self.flush()
    }

    fn flush_if_full(&mut self) -> io::Result<()> {
        if self.batch.len() >= BATCH {
            self.flush()?;
        }
        Ok(())
    }

    /// An error for a match that does not belong here.
    fn inconsistent(&self, key: &MatchKey, problem: &str) -> io::Error {
        let kind = StoreErrorKind::Inconsistent {
            key: Box::new(*key),
            problem: problem.to_owned(),
        };
        self.store.error(kind).into()
    }

    fn check(&self, key: &MatchKey) -> io::Result<()> {
        if key.engine != self.engine_digest || key.rules != self.rules_digest {
            return Err(self.inconsistent(key, "it has another engine or other rules"));
        }
        Ok(())
    }

    /// Whether this match is the best of its player so far.
    fn is_best(&mut self, record: &MatchRecord) -> Result<bool, StoreError> {
        let key = &record.key;
        let player = (key.robot, key.variant);
        if !self.best.contains_key(&player) {
            let rules = &self.rules;
            let best = self.store.read(|it| transcripts::best(it, key, rules))?;
            self.best.insert(player, best.map(|(rank, _)| rank));
        }
        let rank = Rank::new(record, self.oracle);
        let best = self.best.get(&player).copied().flatten();
        // An equal one is the same match, whose transcript may have been lost.
        let is_best = best.is_none_or(|best| rank < best);
        if is_best {
            self.best.insert(player, Some(rank));
        }
        Ok(is_best)
    }
}

impl Sink for StoreSink<'_> {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.oracle = maze.oracle;
        if !self.announced.insert(maze.digest) {
            return Ok(());
        }
        self.batch.mazes.push(MazeRow::new(maze));
        self.flush_if_full()
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        let record = &played.record;
        self.check(&record.key)?;
        if let Some(problem) = columns::inconsistency(record, &self.rules) {
            return Err(self.inconsistent(&record.key, problem));
        }
        let is_kept = match self.kept {
            KeptTranscripts::None => false,
            KeptTranscripts::Best => self.is_best(record)?,
            KeptTranscripts::All => true,
        };
        if is_kept {
            let bytes = played.transcript.to_bytes();
            if Digest::of(&bytes) != record.transcript {
                return Err(self.inconsistent(&record.key, "its transcript has another digest"));
            }
            self.batch.transcripts.push((record.key, bytes));
        }
        self.batch.records.push(record.clone());
        self.flush_if_full()
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.check(&failure.key)?;
        self.batch.unplayed.push((failure.clone(), Cause::Failed));
        self.flush_if_full()
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.check(&failure.key)?;
        self.batch
            .unplayed
            .push((failure.clone(), Cause::Withdrawn));
        self.flush_if_full()
    }
}

impl Drop for StoreSink<'_> {
    fn drop(&mut self) {
        if !self.has_failed {
            // Nobody is left to tell. What is not written is played again.
            let _ = self.flush();
        }
        // A store that cannot do that cannot write, either.
        let _ = self.store.check_references(true);
    }
}

/// A batch on its way into the store.
struct Writing<'a> {
    transaction: &'a Transaction<'a>,
    engine: i64,
    rules_id: i64,
    rules: &'a Ruleset,
    ids: &'a mut IdCache,
    is_best: bool,
}

impl Writing<'_> {
    /// Writes all of it. The first conflict is returned, after everything has been written.
    fn write(&mut self, batch: &Batch) -> Result<Option<StoreErrorKind>, StoreErrorKind> {
        unseal(self.transaction)?;
        let mut mazes = MazeWriter::new(self.transaction)?;
        for maze in &batch.mazes {
            let id = mazes.put(maze, self.rules_id)?;
            self.ids.remember_maze(&maze.digest, id);
        }
        let mut records = Vec::with_capacity(batch.records.len());
        for record in &batch.records {
            records.push((self.address(&record.key)?, record));
        }
        // In the order of the file, neighbours go to the same page.
        records.sort_by_key(|(at, _)| *at);
        let mut writer = RecordWriter::new(self.transaction)?;
        let mut conflicts = HashSet::new();
        for (at, record) in &records {
            if writer.put(at, record, self.rules)? == Put::Different {
                put_conflict(self.transaction, record)?;
                conflicts.insert(record.key);
            }
        }
        for (key, bytes) in &batch.transcripts {
            if !conflicts.contains(key) {
                let at = self.address(key)?;
                transcripts::put(self.transaction, &at, self.is_best, bytes)?;
            }
        }
        for (failure, cause) in &batch.unplayed {
            let at = self.address(&failure.key)?;
            unplayed::put(self.transaction, &at, *cause, failure.reason.as_guest())?;
        }
        let first = batch.records.iter().find(|it| conflicts.contains(&it.key));
        first
            .map(|it| conflict(self.transaction, &it.key))
            .transpose()
    }

    fn address(&mut self, key: &MatchKey) -> Result<Address, StoreErrorKind> {
        let robot = self.ids.robot(self.transaction, &key.robot)?;
        let maze = self.ids.maze(self.transaction, &key.maze)?;
        let maze = maze.ok_or_else(|| StoreErrorKind::Unknown(format!("maze {}", key.maze)))?;
        Ok(Address {
            engine: self.engine,
            rules: self.rules_id,
            robot,
            variant: key.variant,
            maze,
            seed: key.seed.cast_signed(),
        })
    }
}
