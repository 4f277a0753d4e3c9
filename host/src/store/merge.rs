//! [`Store::merge`]: everything of another store, or nothing of it.
//!
//! What can be found without playing is checked first, so that a store that was damaged, or changed
//! by someone, is refused as a whole:
//!
//! - the database itself, and the digests of engines, rules and mazes;
//! - the seal, which finds every change by someone who did not seal the store again;
//! - records whose transcripts are kept, by replaying them: verdict, steps and counts follow from
//!   the rules, whatever the store says;
//! - records that both stores have, by comparing them.
//!
//! Not found is a change of a record without a transcript, or of fuel and memory, or an invented
//! transcript, by someone who seals the store again: a seal has no secret. Playing some of the
//! matches again finds it, and only that.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use rusqlite::{Connection, Transaction};
use wasmouse_core::GuestText;
use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::MatchKey;

use super::columns::text_at;
use super::content::seal_holds;
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Address, Table, digest_at};
use super::integrity::{Replaying, check_database};
use super::mazes::{
    GENERATOR, MazeRow, MazeWriter, check_oracle, generated_by, oracle_row, parse_generated,
};
use super::open::Store;
use super::scan::{Catalog, each_record, each_transcript, found};
use super::seal::unseal;
use super::submissions::{self, Submission, robot_name};
use super::transcripts;
use super::unplayed;
use super::writer::{Put, RecordWriter, maze_name};

/// Matches that the message about conflicts names, at most.
const NAMED_MAX: u64 = 3;

/// How to merge.
#[derive(Clone, Copy, Debug)]
pub struct MergeOptions {
    /// Whether a store without a seal is refused. Default: yes.
    pub require_seal: bool,
}

impl Default for MergeOptions {
    fn default() -> Self {
        Self { require_seal: true }
    }
}

/// What a merge did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MergeReport {
    /// Matches that were new.
    pub added: u64,
    /// Matches that both stores had, with equal records.
    pub same: u64,
    /// Transcripts that were new.
    pub transcripts: u64,
    /// Submissions that were new.
    pub submissions: u64,
}

impl Store {
    /// Adds everything of another store. Merging it again adds nothing. The store has no seal
    /// then, unless nothing was new.
    ///
    /// # Errors
    ///
    /// When one of the stores cannot be used, or the other one is refused: it is damaged or was
    /// changed, was not sealed, was played with another engine, or contradicts this one. Nothing of
    /// it is merged then, and the place of the error is its file.
    pub fn merge(&mut self, from: &Self, options: MergeOptions) -> Result<MergeReport, StoreError> {
        if self.is_same_file(from) {
            return Err(from.error(StoreErrorKind::Itself));
        }
        let into_path = self.path().to_owned();
        let source = from.reading()?;
        let at_source = |kind: StoreErrorKind| from.error(kind);
        check_source(&source, options).map_err(at_source)?;
        let catalog = Catalog::load(&source).map_err(at_source)?;
        let target = self.writing()?;
        let merging = Merging {
            source: &source,
            target: &target,
            catalog: &catalog,
            into_path: into_path.clone(),
            engines: HashMap::new(),
            rules: HashMap::new(),
            robots: HashMap::new(),
            mazes: HashMap::new(),
        };
        match merging.run() {
            Ok(report) => {
                let committed = target.commit();
                committed.map_err(|error| StoreErrorKind::from(error).at(into_path))?;
                Ok(report)
            }
            Err(Blame::Source(kind)) => Err(from.error(kind)),
            Err(Blame::Target(kind)) => Err(kind.at(into_path)),
        }
    }
}

/// Which store an error is about.
enum Blame {
    Source(StoreErrorKind),
    Target(StoreErrorKind),
}

/// What fails without another word is reading the source.
impl From<StoreErrorKind> for Blame {
    fn from(kind: StoreErrorKind) -> Self {
        Self::Source(kind)
    }
}

impl From<rusqlite::Error> for Blame {
    fn from(error: rusqlite::Error) -> Self {
        Self::Source(error.into())
    }
}

fn check_source(source: &Connection, options: MergeOptions) -> Result<(), StoreErrorKind> {
    check_database(source)?;
    let sql = "SELECT count(*) FROM conflict";
    let conflicts: i64 = source.query_row(sql, [], |row| row.get(0))?;
    if conflicts > 0 {
        return Err(StoreErrorKind::HasConflicts(conflicts.cast_unsigned()));
    }
    match seal_holds(source)? {
        Some(true) => Ok(()),
        Some(false) => Err(StoreErrorKind::SealBroken),
        None if options.require_seal => Err(StoreErrorKind::Unsealed),
        None => Ok(()),
    }
}

/// A merge in progress. The maps have the ids of the target by those of the source.
struct Merging<'a> {
    source: &'a Connection,
    target: &'a Transaction<'a>,
    catalog: &'a Catalog,
    into_path: PathBuf,
    engines: HashMap<i64, i64>,
    rules: HashMap<i64, i64>,
    robots: HashMap<i64, i64>,
    mazes: HashMap<i64, i64>,
}

impl Merging<'_> {
    fn run(mut self) -> Result<MergeReport, Blame> {
        let before = self.target.total_changes();
        self.engines()?;
        self.rules_and_robots()?;
        self.mazes()?;
        let mut report = self.records()?;
        report.transcripts = self.transcripts()?;
        self.unplayed()?;
        report.submissions = self.submissions()?;
        if self.target.total_changes() > before {
            unseal(self.target).map_err(Blame::Target)?;
        }
        Ok(report)
    }

    fn engines(&mut self) -> Result<(), Blame> {
        let target = Catalog::load(self.target).map_err(Blame::Target)?;
        for (&id, engine) in &self.catalog.engines {
            let is_known = target.engines.values().any(|it| it == engine);
            if !is_known && !target.engines.is_empty() {
                let mut expected: Vec<_> =
                    target.engines.values().map(ToString::to_string).collect();
                expected.sort_unstable();
                return Err(Blame::Source(StoreErrorKind::OtherEngine {
                    found: engine.to_string(),
                    into: self.into_path.clone(),
                    expected: expected.join("`, `"),
                }));
            }
            let into = ids::engine(self.target, engine).map_err(Blame::Target)?;
            self.engines.insert(id, into);
        }
        Ok(())
    }

    fn rules_and_robots(&mut self) -> Result<(), Blame> {
        for (&id, rules) in &self.catalog.rules {
            let into = ids::rules(self.target, rules).map_err(Blame::Target)?;
            self.rules.insert(id, into);
        }
        for (&id, robot) in &self.catalog.robots {
            let into = ids::robot(self.target, robot).map_err(Blame::Target)?;
            self.robots.insert(id, into);
        }
        Ok(())
    }

    /// Adds the mazes. What the target has already was checked when it came.
    fn mazes(&mut self) -> Result<(), Blame> {
        let mut verified: HashSet<String> = HashSet::new();
        let mut writer = MazeWriter::new(self.target).map_err(Blame::Target)?;
        let mut statement = self
            .source
            .prepare("SELECT id, digest, name, dimension, walls FROM maze ORDER BY id")?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let id: i64 = row.get(0)?;
            let maze = MazeRow {
                name: text_at(row, 2)?,
                digest: digest_at(row, 1)?,
                dimension: row.get(3)?,
                walls: row.get(4)?,
                oracle: None,
            };
            let known = ids::find(self.target, Table::Maze, &maze.digest).map_err(Blame::Target)?;
            let mut walls = None;
            if known.is_none() {
                let (built, name) = maze.build(self.source, id)?;
                verified.extend(name);
                walls = Some(built);
            }
            let into = writer.put_alone(&maze).map_err(Blame::Target)?;
            self.mazes.insert(id, into);
            self.oracles((id, into), &maze, walls, &mut writer)?;
        }
        let mut statement = self
            .source
            .prepare("SELECT name, maze FROM generated WHERE generator = ?1")?;
        let mut rows = statement.query([GENERATOR])?;
        while let Some(row) = rows.next()? {
            let (name, maze): (String, i64) = (row.get(0)?, row.get(1)?);
            let into = *found(&self.mazes, maze)?;
            let known = generated_by(self.target, &name).map_err(Blame::Target)?;
            let is_right = match known {
                Some(known) => known == into,
                None if verified.contains(&name) => true,
                None => {
                    let digest = parse_generated(&name)?.generate().digest();
                    digest == *found(&self.catalog.mazes, maze)?
                }
            };
            if !is_right {
                let problem = format!("`{name}` is another maze");
                return Err(Blame::Source(StoreErrorKind::Damaged(problem)));
            }
            let put = writer.put_generated((&name).into(), into);
            put.map_err(Blame::Target)?;
        }
        Ok(())
    }

    /// Adds what the source says of the oracle in a maze, which is given by both ids.
    fn oracles(
        &self,
        (id, into): (i64, i64),
        maze: &MazeRow,
        mut walls: Option<Maze>,
        writer: &mut MazeWriter<'_>,
    ) -> Result<(), Blame> {
        for (&rules_id, rules) in &self.catalog.rules {
            let Some(said) = oracle_row(self.source, id, rules_id)? else {
                continue;
            };
            let rules_into = *found(&self.rules, rules_id)?;
            let known = oracle_row(self.target, into, rules_into).map_err(Blame::Target)?;
            if known == Some(said) {
                continue;
            }
            let built = match walls.take() {
                Some(walls) => walls,
                None => maze.build(self.source, id)?.0,
            };
            check_oracle(self.source, &maze.digest, &built, rules_id, rules)?;
            let put = writer.put_oracle(into, rules_into, said);
            put.map_err(Blame::Target)?;
            walls = Some(built);
        }
        Ok(())
    }

    fn address(&self, at: &Address) -> Result<Address, StoreErrorKind> {
        Ok(Address {
            engine: *found(&self.engines, at.engine)?,
            rules: *found(&self.rules, at.rules)?,
            robot: *found(&self.robots, at.robot)?,
            variant: at.variant,
            maze: *found(&self.mazes, at.maze)?,
            seed: at.seed,
        })
    }

    fn records(&self) -> Result<MergeReport, Blame> {
        let mut report = MergeReport::default();
        let mut conflicts = 0;
        let mut named = Vec::new();
        let mut writer = RecordWriter::new(self.target).map_err(Blame::Target)?;
        each_record(self.source, self.catalog, |at, record| {
            let into = self.address(at)?;
            let rules: &Ruleset = self.catalog.rules(at)?;
            match writer.put(&into, &record, rules).map_err(Blame::Target)? {
                Put::Added => report.added += 1,
                Put::Same => report.same += 1,
                Put::Different => {
                    conflicts += 1;
                    if conflicts <= NAMED_MAX {
                        named.push(self.describe(&record.key)?);
                    }
                }
            }
            Ok::<(), Blame>(())
        })?;
        if conflicts > 0 {
            return Err(Blame::Source(StoreErrorKind::Conflicts {
                count: conflicts,
                first: named.join("; "),
                into: self.into_path.clone(),
            }));
        }
        Ok(report)
    }

    /// A match in words.
    fn describe(&self, key: &MatchKey) -> Result<String, StoreErrorKind> {
        let robot = robot_name(self.source, &key.robot, key.variant)?;
        let maze = maze_name(self.source, key)?;
        Ok(format!(
            "robot `{}`, maze `{}`, seed {}",
            robot.escaped(),
            maze.escaped(),
            key.seed
        ))
    }

    fn transcripts(&self) -> Result<u64, Blame> {
        let mut added = 0;
        let mut replaying = Replaying::new(self.source, self.catalog);
        each_transcript(self.source, |row| {
            let into = self.address(&row.at)?;
            replaying.check(&row.at, row.bytes)?;
            if row.is_best && !self.is_better(&row.at)? {
                return Ok(());
            }
            let is_new = transcripts::put(self.target, &into, row.is_best, row.bytes);
            added += u64::from(is_new.map_err(Blame::Target)?);
            Ok::<(), Blame>(())
        })?;
        Ok(added)
    }

    /// Whether a best match of the source is better than those whose transcripts the target has.
    fn is_better(&self, at: &Address) -> Result<bool, Blame> {
        let (key, rules) = (self.catalog.key(at)?, self.catalog.rules(at)?);
        let theirs = transcripts::best(self.source, &key, rules)?;
        let ours = transcripts::best(self.target, &key, rules).map_err(Blame::Target)?;
        let rank = |best: Option<(transcripts::Rank, _)>| best.map(|(rank, _)| rank);
        Ok(match (rank(theirs), rank(ours)) {
            (Some(theirs), Some(ours)) => theirs < ours,
            (theirs, _) => theirs.is_some(),
        })
    }

    fn unplayed(&self) -> Result<(), Blame> {
        let mut statement = self.source.prepare(
            "SELECT engine, rules, robot, variant, maze, seed, cause, reason FROM unplayed",
        )?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let at = Address {
                engine: row.get(0)?,
                rules: row.get(1)?,
                robot: row.get(2)?,
                variant: row.get(3)?,
                maze: row.get(4)?,
                seed: row.get(5)?,
            };
            let cause = unplayed::Cause::of_code(row.get(6)?)?;
            let reason = text_at(row, 7)?;
            let into = self.address(&at)?;
            unplayed::put_least(self.target, &into, cause, reason.as_guest())
                .map_err(Blame::Target)?;
        }
        Ok(())
    }

    /// Adds what is new in the history of each name. The target has it in the same order, perhaps
    /// with others in between.
    fn submissions(&self) -> Result<u64, Blame> {
        let ours = submissions::all(self.target).map_err(Blame::Target)?;
        let mut histories: HashMap<&GuestText, Vec<&Submission>> = HashMap::new();
        for submission in &ours {
            histories
                .entry(&submission.name)
                .or_default()
                .push(submission);
        }
        let mut added = 0;
        for theirs in &submissions::all(self.source)? {
            let history = histories.entry(&theirs.name).or_default();
            match history.iter().position(|it| *it == theirs) {
                Some(position) => {
                    history.drain(..=position);
                }
                None => {
                    history.clear();
                    submissions::append(self.target, theirs).map_err(Blame::Target)?;
                    added += 1;
                }
            }
        }
        Ok(added)
    }
}
