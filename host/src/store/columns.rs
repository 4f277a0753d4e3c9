//! A [`MatchRecord`] as the columns of the table `match`, and back.

use rusqlite::types::ToSqlOutput;
use rusqlite::{CachedStatement, Connection, Row, ToSql, params, params_from_iter};
use wasmouse_core::GuestText;
use wasmouse_core::game::{Counts, Fault, FaultKind, Phase, Ruleset, Run, Score, Steps, Verdict};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::Cell;
use wasmouse_core::record::{FuelUse, MatchKey, MatchRecord, RecordVersion};

use super::error::StoreErrorKind;
use super::ids::{Address, digest_at};

/// A text from outside as the value of a column.
pub(super) struct Column<'a>(GuestStr<'a>);

/// The value of a column for that text.
pub(super) fn column<'a>(text: impl Into<GuestStr<'a>>) -> Column<'a> {
    Column(text.into())
}

impl ToSql for Column<'_> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        self.0.raw().to_sql()
    }
}

/// The text of a column.
pub(super) fn text_at(row: &Row<'_>, index: usize) -> rusqlite::Result<GuestText> {
    row.get::<_, String>(index).map(GuestText::from)
}

/// The text of a column that may have none.
pub(super) fn optional_text_at(row: &Row<'_>, index: usize) -> rusqlite::Result<Option<GuestText>> {
    Ok(row.get::<_, Option<String>>(index)?.map(GuestText::from))
}

/// The columns of a record after those of its address, in the order of [`read_record`].
macro_rules! record_columns {
    () => {
        "verdict, exploration_steps, speed_steps, fuel_start, fuel_steps, fuel_step_max, \
         memory_bytes, fault_kind, bumps, clamps, resets_before_goal, resets_in_speed_run, \
         journal_entries, journal_dropped, transcript, fault_phase, fault_run, fault_step, \
         fault_x, fault_y, fault_detail"
    };
}

/// The columns of every record, in the order of their parameters.
macro_rules! inserted_columns {
    () => {
        "engine, rules, robot, variant, maze, seed, verdict, exploration_steps, speed_steps, \
         fuel_start, fuel_steps, fuel_step_max, memory_bytes, bumps, clamps, resets_before_goal, \
         resets_in_speed_run, journal_entries, journal_dropped, transcript"
    };
}

/// Adds a record without a fault unless its address has one.
const INSERT: &str = concat!(
    "INSERT INTO match(",
    inserted_columns!(),
    ") VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, \
     ?19, ?20) ON CONFLICT DO NOTHING"
);

/// Adds a record with a fault unless its address has one.
const INSERT_FAULT: &str = concat!(
    "INSERT INTO match(",
    inserted_columns!(),
    ", fault_kind, fault_phase, fault_run, fault_step, fault_x, fault_y, fault_detail",
    ") VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, \
     ?19, ?20, ?21, ?22, ?23, ?24, ?25, ?26, ?27) ON CONFLICT DO NOTHING"
);

/// One record.
pub(super) const SELECT_RECORD: &str = concat!(
    "SELECT ",
    record_columns!(),
    " FROM match WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4 \
     AND maze = ?5 AND seed = ?6"
);

/// The records of a player in a maze with seeds of a range, after the seed.
pub(super) const SELECT_SEEDS: &str = concat!(
    "SELECT ",
    record_columns!(),
    ", seed FROM match WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4 \
     AND maze = ?5 AND seed BETWEEN ?6 AND ?7"
);

/// The records of a player whose transcripts are kept, with the digest of the maze, the seed and
/// the oracle's steps (exploration, speed) behind.
pub(super) const SELECT_KEPT: &str = concat!(
    "SELECT ",
    record_columns!(),
    ", z.digest, m.seed, oracle_exploration, oracle_speed FROM transcript t \
     JOIN match m USING(engine, rules, robot, variant, maze, seed) JOIN maze z ON z.id = m.maze \
     LEFT JOIN oracle o ON o.maze = m.maze AND o.rules = m.rules \
     WHERE t.engine = ?1 AND t.rules = ?2 AND t.robot = ?3 AND t.variant = ?4"
);

/// The records of a player in the order of the file, with maze and seed behind.
pub(super) const SELECT_PLAYER: &str = concat!(
    "SELECT ",
    record_columns!(),
    ", maze, seed FROM match WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4 \
     ORDER BY maze, seed"
);

/// The number of columns of a record: the first one behind.
pub(super) const RECORD_COLUMNS: usize = 21;

/// Codes of the column `verdict`.
pub(super) const FINISHED: u8 = 0;
pub(super) const BUDGET_USED_UP: u8 = 1;
pub(super) const GOAL_REACHED: u8 = 2;
pub(super) const FAULT: u8 = 3;

/// Why a record cannot be stored, because it would not be the same when it is read.
pub(super) fn inconsistency(record: &MatchRecord, rules: &Ruleset) -> Option<&'static str> {
    let Verdict::Finished { score } = &record.verdict else {
        return None;
    };
    let Steps { exploration, speed } = record.steps;
    let expected = rules.game.score(speed, exploration);
    (!same_parts(*score, expected)).then_some("its score does not follow from its steps")
}

/// Scores are equal when their values are; here every part counts.
fn same_parts(left: Score, right: Score) -> bool {
    left.speed_steps() == right.speed_steps()
        && left.exploration_steps() == right.exploration_steps()
        && left.divisor() == right.divisor()
}

/// Adds records. Most have no fault, and are added faster without its columns.
pub(super) struct Insert<'c> {
    without_fault: CachedStatement<'c>,
    with_fault: CachedStatement<'c>,
}

impl<'c> Insert<'c> {
    pub fn new(connection: &'c Connection) -> rusqlite::Result<Self> {
        Ok(Self {
            without_fault: connection.prepare_cached(INSERT)?,
            with_fault: connection.prepare_cached(INSERT_FAULT)?,
        })
    }

    /// Adds a record unless its address has one; whether it did.
    pub fn execute(&mut self, at: &Address, record: &MatchRecord) -> rusqlite::Result<bool> {
        let verdict = match &record.verdict {
            Verdict::Finished { .. } => FINISHED,
            Verdict::BudgetUsedUp {
                goal_reached: false,
            } => BUDGET_USED_UP,
            Verdict::BudgetUsedUp { goal_reached: true } => GOAL_REACHED,
            Verdict::Fault { .. } => FAULT,
        };
        let values = params![
            at.engine,
            at.rules,
            at.robot,
            at.variant,
            at.maze,
            at.seed,
            verdict,
            record.steps.exploration,
            record.steps.speed,
            record.fuel.start.cast_signed(),
            record.fuel.steps.cast_signed(),
            record.fuel.step_max.cast_signed(),
            record.memory_bytes.cast_signed(),
            record.counts.bumps,
            record.counts.clamps,
            record.counts.resets_before_goal,
            record.counts.resets_in_speed_run,
            record.journal.entries.cast_signed(),
            record.journal.dropped.cast_signed(),
            record.transcript.as_bytes(),
        ];
        let rows = match record.verdict.fault() {
            None => self.without_fault.execute(values)?,
            Some(fault) => {
                let fault = params![
                    fault_code(fault.kind),
                    code(&Phase::ALL, fault.phase),
                    fault.run.number(),
                    fault.step,
                    fault.cell.x,
                    fault.cell.y,
                    column(&fault.detail),
                ];
                let values = values.iter().chain(fault);
                self.with_fault.execute(params_from_iter(values))?
            }
        };
        Ok(rows > 0)
    }
}

/// The code of a kind of fault.
pub(super) fn fault_code(kind: FaultKind) -> u8 {
    code(&FaultKind::ALL, kind)
}

fn code<T: PartialEq>(all: &[T], value: T) -> u8 {
    let position = all.iter().position(|it| *it == value);
    let position = position.expect("every value is in the list of all");
    u8::try_from(position).expect("a list of fewer than 256 values")
}

/// The kind of fault of a code.
pub(super) fn fault_kind(code: u8) -> Option<FaultKind> {
    FaultKind::ALL.get(usize::from(code)).copied()
}

/// Reads the first [`RECORD_COLUMNS`] columns of a row.
pub(super) fn read_record(
    row: &Row<'_>,
    key: MatchKey,
    rules: &Ruleset,
) -> Result<MatchRecord, StoreErrorKind> {
    let steps = Steps {
        exploration: row.get(1)?,
        speed: row.get(2)?,
    };
    let verdict = match row.get(0)? {
        FINISHED => Some(Verdict::Finished {
            score: rules.game.score(steps.speed, steps.exploration),
        }),
        BUDGET_USED_UP => Some(Verdict::BudgetUsedUp {
            goal_reached: false,
        }),
        GOAL_REACHED => Some(Verdict::BudgetUsedUp { goal_reached: true }),
        FAULT => read_fault(row)?.map(|fault| Verdict::Fault { fault }),
        _ => None,
    };
    let verdict = verdict.ok_or_else(|| {
        let address = key.digest();
        StoreErrorKind::Damaged(format!("match {address} has an unknown verdict"))
    })?;
    Ok(MatchRecord {
        version: RecordVersion,
        key,
        verdict,
        steps,
        counts: Counts {
            bumps: row.get(8)?,
            clamps: row.get(9)?,
            resets_before_goal: row.get(10)?,
            resets_in_speed_run: row.get(11)?,
        },
        fuel: read_fuel(row, 3)?,
        memory_bytes: unsigned(row, 6)?,
        journal: JournalCounts {
            entries: unsigned(row, 12)?,
            dropped: unsigned(row, 13)?,
        },
        transcript: digest_at(row, 14)?,
    })
}

/// The fuel in three columns.
pub(super) fn read_fuel(row: &Row<'_>, first: usize) -> rusqlite::Result<FuelUse> {
    Ok(FuelUse {
        start: unsigned(row, first)?,
        steps: unsigned(row, first + 1)?,
        step_max: unsigned(row, first + 2)?,
    })
}

/// A number that is stored by its bits.
pub(super) fn unsigned(row: &Row<'_>, column: usize) -> rusqlite::Result<u64> {
    row.get::<_, i64>(column).map(i64::cast_unsigned)
}

/// The fault; `None` for an unknown code.
fn read_fault(row: &Row<'_>) -> rusqlite::Result<Option<Fault>> {
    let (kind, phase, run): (u8, u8, u8) = (row.get(7)?, row.get(15)?, row.get(16)?);
    let phase = Phase::ALL.get(usize::from(phase)).copied();
    let run = [Run::Exploration, Run::Speed]
        .into_iter()
        .find(|it| it.number() == run);
    let (Some(kind), Some(phase), Some(run)) = (fault_kind(kind), phase, run) else {
        return Ok(None);
    };
    Ok(Some(Fault {
        kind,
        phase,
        run,
        step: row.get(17)?,
        cell: Cell::new(row.get(18)?, row.get(19)?),
        detail: text_at(row, 20)?,
    }))
}
