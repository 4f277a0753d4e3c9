//! [`Store::content_digest`]: a store in one line. [`Store::seal`]: the same, written into it.

use std::sync::mpsc::sync_channel;
use std::thread;

use rusqlite::{Connection, Row, params};
use wasmouse_core::game::Verdict;
use wasmouse_core::record::MatchRecord;
use wasmouse_core::{Digest, DigestBuilder, GuestText};

use super::columns::fault_code;
use super::error::{StoreError, StoreErrorKind};
use super::ids::Address;
use super::open::Store;
use super::scan::{Catalog, each_record, each_transcript};
use super::seal::{sealed, unseal};
use super::submissions;

impl Store {
    /// A digest of everything that the store holds: equal stores have equal digests, whatever the
    /// order in which matches were played, restarts, merges, ids, and pages. A seal is not part of
    /// it.
    ///
    /// Takes about a second for a million matches.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn content_digest(&self) -> Result<Digest, StoreError> {
        self.read(content_digest)
    }

    /// Seals the store: writes its content digest into it, because a run has ended. Whoever
    /// changes the store after that without wasmouse breaks the seal, unless they
    /// compute it again: it finds accidents and careless changes, not forgers. Writing through
    /// wasmouse removes it.
    ///
    /// # Errors
    ///
    /// When the store cannot be written.
    pub fn seal(&mut self) -> Result<Digest, StoreError> {
        let other = Self::open_read_only(self.path())?;
        self.write(|transaction| {
            let content = content_digest_through_both(transaction, other)?;
            unseal(transaction)?;
            let sql = "INSERT INTO seal(id, content) VALUES(1, ?1)";
            transaction.execute(sql, params![content.as_bytes()])?;
            Ok(content)
        })
    }

    /// The content digest with which the store was sealed; `None` if it was written since.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn sealed(&self) -> Result<Option<Digest>, StoreError> {
        self.read(sealed)
    }
}

/// Canonical encoding `wasmouse.store.1` ([`DigestBuilder`]): for each table the number of its
/// rows and their digests in the order of their bytes. Rows are encoded with digests for ids;
/// matches are grouped by player, so that those of a player are in memory at once and not all.
pub(super) fn content_digest(connection: &Connection) -> Result<Digest, StoreErrorKind> {
    let catalog = Catalog::load(connection)?;
    let (players, others) = matches(connection, &catalog, || other_tables(connection, &catalog))?;
    Ok(combine(&others, players))
}

/// The same, read through two connections at once while nobody writes to the file, because one of
/// them has a transaction to write in.
fn content_digest_through_both(
    writing: &Connection,
    other: Store,
) -> Result<Digest, StoreErrorKind> {
    let catalog = &Catalog::load(writing)?;
    thread::scope(|scope| {
        let read = move || {
            let tables = other.read(|it| other_tables(it, catalog));
            tables.map_err(|error| error.kind)
        };
        let reading = thread::Builder::new().name("tables".to_owned());
        let Ok(reading) = reading.spawn_scoped(scope, read) else {
            // Not where the system has no more threads.
            return content_digest(writing);
        };
        let (players, others) = matches(writing, catalog, || {
            let tables = reading.join();
            tables.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })?;
        Ok(combine(&others, players))
    })
}

/// The digest of the tables in their order; that of matches is the last one.
fn combine(others: &[Digest], players: Vec<Digest>) -> Digest {
    let builder = DigestBuilder::new("wasmouse.store.1");
    let builder = others.iter().fold(builder, DigestBuilder::digest);
    builder.digest(&list(players)).finish()
}

/// The digests of all tables but that of matches.
fn other_tables(connection: &Connection, catalog: &Catalog) -> Result<Vec<Digest>, StoreErrorKind> {
    let mut tables = vec![
        list(catalog.engines.values().map(|it| it.digest()).collect()),
        list(catalog.robots.values().copied().collect()),
    ];
    for (name, sql) in TABLES {
        tables.push(list(rows(connection, name, sql)?));
    }
    tables.push(list(submissions_by_name(connection)?));
    tables.push(list(transcripts(connection, catalog)?));
    Ok(tables)
}

/// Tables whose rows are digests, numbers and text without ids.
const TABLES: [(&str, &str); 6] = [
    ("wasmouse.store.rules.1", "SELECT digest, json FROM rules"),
    (
        "wasmouse.store.maze.1",
        "SELECT digest, name, dimension FROM maze",
    ),
    (
        "wasmouse.store.oracle.1",
        "SELECT z.digest, r.digest, ifnull(oracle_exploration, -1), ifnull(oracle_speed, -1) \
         FROM oracle o JOIN maze z ON z.id = o.maze JOIN rules r ON r.id = o.rules",
    ),
    (
        "wasmouse.store.generated.1",
        "SELECT z.digest, g.generator, g.name FROM generated g JOIN maze z ON z.id = g.maze",
    ),
    ("wasmouse.store.conflict.1", "SELECT record FROM conflict"),
    (
        "wasmouse.store.unplayed.1",
        "SELECT e.digest, r.digest, o.digest, u.variant, z.digest, u.seed, u.cause, u.reason \
         FROM unplayed u JOIN engine e ON e.id = u.engine JOIN rules r ON r.id = u.rules \
         JOIN robot o ON o.id = u.robot JOIN maze z ON z.id = u.maze",
    ),
];

/// A digest of digests that does not depend on their order.
fn list(mut digests: Vec<Digest>) -> Digest {
    digests.sort_unstable();
    let builder = DigestBuilder::new("wasmouse.store.list.1").numbers(&[digests.len() as u64]);
    digests.iter().fold(builder, DigestBuilder::digest).finish()
}

fn rows(connection: &Connection, name: &str, sql: &str) -> Result<Vec<Digest>, StoreErrorKind> {
    let mut statement = connection.prepare(sql)?;
    let columns = statement.column_count();
    let digests = statement.query_map([], |row| {
        let builder = DigestBuilder::new(name);
        let builder =
            (0..columns).try_fold(builder, |builder, column| add_column(builder, row, column))?;
        Ok(builder.finish())
    })?;
    Ok(digests.collect::<Result<_, _>>()?)
}

fn add_column(
    builder: DigestBuilder,
    row: &Row<'_>,
    column: usize,
) -> rusqlite::Result<DigestBuilder> {
    use rusqlite::types::ValueRef;
    Ok(match row.get_ref(column)? {
        ValueRef::Integer(number) => builder.numbers(&[1, number.cast_unsigned()]),
        ValueRef::Text(bytes) => builder.numbers(&[2]).bytes(bytes),
        ValueRef::Blob(bytes) => builder.numbers(&[3]).bytes(bytes),
        ValueRef::Null | ValueRef::Real(_) => builder.numbers(&[0]),
    })
}

/// The submissions of each name, in their order.
fn submissions_by_name(connection: &Connection) -> Result<Vec<Digest>, StoreErrorKind> {
    let mut all = submissions::all(connection)?;
    // Stable, so the order within a name stays.
    all.sort_by(|left, right| left.name.cmp(&right.name));
    let text = |builder: DigestBuilder, text: Option<&str>| match text {
        Some(text) => builder.numbers(&[1]).bytes(text.as_bytes()),
        None => builder.numbers(&[0]),
    };
    let by_name = all.chunk_by(|left, right| left.name == right.name);
    let digests = by_name.map(|history| {
        let builder = DigestBuilder::new("wasmouse.store.submissions.1");
        let builder = history.iter().fold(builder, |builder, it| {
            let rejection = it.rejection.as_ref();
            let builder = builder.bytes(it.name.raw().as_bytes()).digest(&it.robot);
            let builder = builder.numbers(&[it.variant.into()]);
            let builder = text(builder, it.author.as_ref().map(GuestText::raw));
            let builder = text(builder, it.class.as_ref().map(GuestText::raw));
            let builder = text(builder, rejection.map(|it| it.kind.raw()));
            let builder = text(builder, rejection.map(|it| it.reason.raw()));
            text(builder, rejection.map(|it| it.hint.raw()))
        });
        builder.finish()
    });
    Ok(digests.collect())
}

fn transcripts(connection: &Connection, catalog: &Catalog) -> Result<Vec<Digest>, StoreErrorKind> {
    let mut digests = Vec::new();
    each_transcript(connection, |row| -> Result<(), StoreErrorKind> {
        let builder = DigestBuilder::new("wasmouse.store.transcript.1")
            .digest(&catalog.key(&row.at)?.digest())
            .numbers(&[row.is_best.into()])
            .bytes(row.bytes);
        digests.push(builder.finish());
        Ok(())
    })?;
    Ok(digests)
}

/// Records of a player that are hashed together.
type Group = (Address, Vec<MatchRecord>);

/// The most records of a [`Group`].
const GROUP_MAX: usize = 1024;

/// Groups that wait to be hashed, at most.
const GROUPS_WAITING: usize = 4;

/// The digests of the players, and what `meanwhile` returns. Reading the records takes twice as
/// long as hashing them, so another thread does that meanwhile; this one reads something else
/// while the other comes to its end.
fn matches<T>(
    connection: &Connection,
    catalog: &Catalog,
    meanwhile: impl FnOnce() -> Result<T, StoreErrorKind>,
) -> Result<(Vec<Digest>, T), StoreErrorKind> {
    thread::scope(|scope| {
        let (sender, groups) = sync_channel::<Group>(GROUPS_WAITING);
        let mut players = PlayerDigests::new(catalog);
        let hash = move || {
            groups.into_iter().try_for_each(|it| players.add(&it))?;
            players.finish()
        };
        let hashing = thread::Builder::new().name("digest".to_owned());
        let Ok(hashing) = hashing.spawn_scoped(scope, hash) else {
            // Not where the system has no more threads.
            let mut players = PlayerDigests::new(catalog);
            each_group(connection, catalog, |it| players.add(&it))?;
            return Ok((players.finish()?, meanwhile()?));
        };
        let read = each_group(connection, catalog, |group| {
            // Whoever does not receive it has failed, and says why when it is joined.
            let _ = sender.send(group);
            Ok(())
        });
        drop(sender);
        let other = read.and_then(|()| meanwhile());
        let players = hashing.join();
        let other = other?;
        let players = players.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        Ok((players, other))
    })
}

/// Passes all records to `visit`, those of a player one group after the other.
fn each_group(
    connection: &Connection,
    catalog: &Catalog,
    mut visit: impl FnMut(Group) -> Result<(), StoreErrorKind>,
) -> Result<(), StoreErrorKind> {
    let mut group: Option<Group> = None;
    each_record(connection, catalog, |at, record| match &mut group {
        Some((player, records)) if player.is_same_player(at) && records.len() < GROUP_MAX => {
            records.push(record);
            Ok(())
        }
        _ => group
            .replace((*at, vec![record]))
            .map_or(Ok(()), &mut visit),
    })?;
    group.map_or(Ok(()), visit)
}

/// Digests of players, made of their records.
struct PlayerDigests<'c> {
    catalog: &'c Catalog,
    players: Vec<Digest>,
    /// The player whose records are being added, and their digests.
    current: Option<(Address, Vec<Digest>)>,
}

impl<'c> PlayerDigests<'c> {
    const fn new(catalog: &'c Catalog) -> Self {
        Self {
            catalog,
            players: Vec::new(),
            current: None,
        }
    }

    fn add(&mut self, (at, records): &Group) -> Result<(), StoreErrorKind> {
        let digests = records.iter().map(record_digest);
        match &mut self.current {
            Some((player, all)) if player.is_same_player(at) => all.extend(digests),
            _ => {
                let next = (*at, digests.collect());
                if let Some(last) = self.current.replace(next) {
                    self.end(last)?;
                }
            }
        }
        Ok(())
    }

    fn end(&mut self, (at, records): (Address, Vec<Digest>)) -> Result<(), StoreErrorKind> {
        let key = self.catalog.key(&at)?;
        let builder = DigestBuilder::new("wasmouse.store.player.1")
            .digest(&key.engine)
            .digest(&key.rules)
            .digest(&key.robot)
            .numbers(&[key.variant.into()])
            .digest(&list(records));
        self.players.push(builder.finish());
        Ok(())
    }

    fn finish(mut self) -> Result<Vec<Digest>, StoreErrorKind> {
        if let Some(last) = self.current.take() {
            self.end(last)?;
        }
        Ok(self.players)
    }
}

/// The digest of a record among those of its player.
fn record_digest(record: &MatchRecord) -> Digest {
    let verdict = match &record.verdict {
        Verdict::Finished { .. } => 0,
        Verdict::BudgetUsedUp { goal_reached } => 1 + u64::from(*goal_reached),
        Verdict::Fault { .. } => 3,
    };
    let builder = DigestBuilder::new("wasmouse.store.match.1")
        .digest(&record.key.maze)
        .digest(&record.transcript)
        .numbers(&[
            record.key.seed,
            verdict,
            record.steps.exploration.into(),
            record.steps.speed.into(),
            record.counts.bumps.into(),
            record.counts.clamps.into(),
            record.counts.resets_before_goal.into(),
            record.counts.resets_in_speed_run.into(),
            record.fuel.start,
            record.fuel.steps,
            record.fuel.step_max,
            record.memory_bytes,
            record.journal.entries,
            record.journal.dropped,
        ]);
    let Some(fault) = record.verdict.fault() else {
        return builder.finish();
    };
    let phase = serde_json::to_string(&fault.phase).expect("a phase has a JSON form");
    builder
        .numbers(&[
            fault_code(fault.kind).into(),
            fault.run.number().into(),
            fault.step.into(),
            fault.cell.x.into(),
            fault.cell.y.into(),
        ])
        .bytes(phase.as_bytes())
        .bytes(fault.detail.raw().as_bytes())
        .finish()
}

/// Whether the store still has the content with which it was sealed; `None` without a seal.
pub(super) fn seal_holds(connection: &Connection) -> Result<Option<bool>, StoreErrorKind> {
    let Some(sealed) = sealed(connection)? else {
        return Ok(None);
    };
    Ok(Some(content_digest(connection)? == sealed))
}

#[cfg(test)]
mod tests {
    use super::super::sample::{Contest, new_store};
    use super::super::{KeptTranscripts, StoreError};
    use super::*;
    use crate::contest::Seeds;

    #[test]
    fn a_player_has_one_digest_however_many_groups_are_hashed() -> Result<(), StoreError> {
        let seeds = Seeds {
            first: 0,
            count: 700,
        };
        let contest = Contest::new(2, 3, seeds);
        let (_folder, mut store) = new_store();
        contest.store(&mut store, KeptTranscripts::None, |_, _, _| true);
        let (found, ()) = store.read(|it| matches(it, &Catalog::load(it)?, || Ok(())))?;
        let on_this_thread = store.read(|it| {
            let catalog = Catalog::load(it)?;
            let mut players = PlayerDigests::new(&catalog);
            each_group(it, &catalog, |it| players.add(&it))?;
            players.finish()
        })?;
        assert_eq!(on_this_thread, found);

        let expected = [0, 1].map(|player| {
            let places = (0..3).flat_map(|maze| (0..700).map(move |seed| (maze, seed)));
            let records = places.map(|(maze, seed)| contest.play(player, maze, seed).record);
            let digests: Vec<Digest> = records.map(|it| record_digest(&it)).collect();
            assert!(digests.len() > 2 * GROUP_MAX);
            let (robot, variant) = contest.players[player];
            DigestBuilder::new("wasmouse.store.player.1")
                .digest(&contest.engine.digest())
                .digest(&contest.rules.digest())
                .digest(&robot)
                .numbers(&[variant.into()])
                .digest(&list(digests))
                .finish()
        });
        assert_eq!(found, expected);
        Ok(())
    }
}
