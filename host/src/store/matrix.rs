//! [`Store::matrix`]: a [`ScoreMatrix`] of what is in a store.

use std::collections::{BTreeMap, HashMap};

use rusqlite::{Connection, Row, params};
use wasmouse_core::Digest;
use wasmouse_core::game::{Ruleset, Steps};
use wasmouse_core::record::MatchRecord;

use super::columns::{self, BUDGET_USED_UP, FAULT, FINISHED, GOAL_REACHED, text_at};
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Address, Table, digest_at};
use super::keys::{MatchKeys, positions};
use super::open::Store;
use super::unplayed::{self, Cause};
use super::writer::find_record;
use crate::contest::{
    MatchScore, MatrixFault, MatrixMaze, MatrixRobot, MazeSet, Outcome, ScoreMatrix, Seeds,
};

/// What a matrix is made of.
#[derive(Debug)]
pub struct MatrixRequest<'a> {
    /// The engine.
    pub engine: Digest,
    /// The rules.
    pub rules: &'a Ruleset,
    /// The robots, in the order of the plan, without faults and unplayed matches.
    pub robots: Vec<MatrixRobot>,
    /// The mazes in the order of the plan, each with the index of its set.
    pub mazes: &'a [(Digest, usize)],
    /// The sets that mazes belong to. At least one.
    pub sets: Vec<MazeSet>,
    /// The seeds of every maze.
    pub seeds: Seeds,
}

impl Store {
    /// The numbers of all matches of a plan, with the faults and the unplayed matches of each
    /// robot. Mazes that the store does not know are left out.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    ///
    /// # Panics
    ///
    /// If a maze has a set that is not listed.
    pub fn matrix(&self, request: MatrixRequest<'_>) -> Result<ScoreMatrix, StoreError> {
        let MatrixRequest {
            engine,
            rules,
            robots,
            mazes,
            sets,
            seeds,
        } = request;
        assert!(
            mazes.iter().all(|(_, set)| *set < sets.len()),
            "every set is listed"
        );
        let mut matrix = ScoreMatrix::new(rules.clone(), seeds, robots);
        matrix.sets = sets;
        self.read(|connection| {
            let rules_id = ids::find(connection, Table::Rules, &rules.digest())?;
            let mazes = push_mazes(connection, rules_id, mazes, &mut matrix)?;
            let engine_id = ids::find(connection, Table::Engine, &engine)?;
            if let (Some(engine_id), Some(rules_id)) = (engine_id, rules_id) {
                let filling = Filling {
                    connection,
                    engine,
                    engine_id,
                    rules_id,
                    mazes,
                };
                for robot in 0..matrix.robots.len() {
                    filling.fill(&mut matrix, robot)?;
                }
            }
            Ok(())
        })?;
        Ok(matrix)
    }
}

/// Adds the mazes that the store knows. Returns their positions in the matrix by their ids.
fn push_mazes(
    connection: &Connection,
    rules_id: Option<i64>,
    mazes: &[(Digest, usize)],
    matrix: &mut ScoreMatrix,
) -> Result<HashMap<i64, usize>, StoreErrorKind> {
    let digests: Vec<Digest> = mazes.iter().map(|(digest, _)| *digest).collect();
    let wanted = positions(&digests);
    let mut statement = connection.prepare(
        "SELECT z.id, z.digest, z.name, z.dimension, o.oracle_exploration, o.oracle_speed \
         FROM maze z LEFT JOIN oracle o ON o.maze = z.id AND o.rules = ?1",
    )?;
    let mut rows = statement.query([rules_id])?;
    let mut found = BTreeMap::new();
    while let Some(row) = rows.next()? {
        let digest = digest_at(row, 1)?;
        let Some(&position) = wanted.get(&digest) else {
            continue;
        };
        let oracle = row.get::<_, Option<u32>>(5)?.zip(row.get(4)?);
        let oracle = oracle.map(|(speed, exploration)| matrix.rules.game.score(speed, exploration));
        let maze = MatrixMaze {
            name: text_at(row, 2)?,
            digest,
            dimension: row.get(3)?,
            oracle,
            set: mazes[position].1,
        };
        found.insert(position, (row.get(0)?, maze));
    }
    let found = found.into_values();
    Ok(found
        .map(|(id, maze)| (id, matrix.push_maze(maze)))
        .collect())
}

struct Filling<'a> {
    connection: &'a Connection,
    engine: Digest,
    engine_id: i64,
    rules_id: i64,
    /// Positions of mazes by their ids.
    mazes: HashMap<i64, usize>,
}

/// The faults of one kind.
struct Faults {
    count: u64,
    /// Maze and seed of the first one, as positions.
    first: (usize, u32),
    at: Address,
}

impl Filling<'_> {
    fn fill(&self, matrix: &mut ScoreMatrix, robot: usize) -> Result<(), StoreErrorKind> {
        let MatrixRobot {
            digest, variant, ..
        } = matrix.robots[robot];
        let Some(robot_id) = ids::find(self.connection, Table::Robot, &digest)? else {
            return Ok(());
        };
        let mut faults: BTreeMap<&'static str, Faults> = BTreeMap::new();
        let seeds = matrix.seeds;
        let keys = MatchKeys {
            engine: self.engine,
            rules: matrix.rules.digest(),
            players: &[(digest, variant)],
            mazes: &[],
            seeds,
        };
        let mut statement = self.connection.prepare_cached(
            "SELECT maze, seed, verdict, exploration_steps, speed_steps, fuel_start, fuel_steps, \
             fuel_step_max, memory_bytes, fault_kind FROM match \
             WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4",
        )?;
        let mut rows =
            statement.query(params![self.engine_id, self.rules_id, robot_id, variant])?;
        while let Some(row) = rows.next()? {
            let (maze_id, seed_bits): (i64, i64) = (row.get(0)?, row.get(1)?);
            let seed = keys.seed_position(seed_bits.cast_unsigned());
            let (Some(&maze), Some(seed)) = (self.mazes.get(&maze_id), seed) else {
                continue;
            };
            let score = read_score(row)?;
            matrix.set(robot, maze, seed, score);
            if let Outcome::Fault(kind) = score.outcome {
                let first = (maze, seed);
                let at = Address {
                    engine: self.engine_id,
                    rules: self.rules_id,
                    robot: robot_id,
                    variant,
                    maze: maze_id,
                    seed: seed_bits,
                };
                let faults = faults.entry(kind.name()).or_insert(Faults {
                    count: 0,
                    first,
                    at,
                });
                faults.count += 1;
                if first < faults.first {
                    (faults.first, faults.at) = (first, at);
                }
            }
        }
        for (kind, faults) in faults {
            let first = self.record(matrix, &keys, &faults)?;
            let count = faults.count;
            let fault = MatrixFault { count, first };
            matrix.robots[robot].faults.insert(kind, fault);
        }
        let robot = &mut matrix.robots[robot];
        unplayed::each(self.connection, &keys, |_, maze, seed, cause, reason| {
            let seed = keys.seed_position(seed.cast_unsigned());
            if self.mazes.contains_key(&maze) && seed.is_some() {
                *robot.unplayed.entry(reason.into()).or_default() += 1;
                robot.failed += u64::from(cause == Cause::Failed);
            }
        })?;
        Ok(())
    }

    /// The first record of some faults.
    fn record(
        &self,
        matrix: &ScoreMatrix,
        keys: &MatchKeys<'_>,
        faults: &Faults,
    ) -> Result<MatchRecord, StoreErrorKind> {
        let (maze, seed) = faults.first;
        let mazes = &[matrix.mazes[maze].digest];
        let key = MatchKeys { mazes, ..*keys }.key(0, 0, seed);
        let record = find_record(self.connection, &faults.at, &key, &matrix.rules)?;
        record.ok_or_else(|| StoreErrorKind::Unknown(format!("match {}", key.digest())))
    }
}

fn read_score(row: &Row<'_>) -> Result<MatchScore, StoreErrorKind> {
    let outcome = match row.get(2)? {
        FINISHED => Some(Outcome::Finished),
        BUDGET_USED_UP => Some(Outcome::BudgetUsedUp {
            goal_reached: false,
        }),
        GOAL_REACHED => Some(Outcome::BudgetUsedUp { goal_reached: true }),
        FAULT => columns::fault_kind(row.get(9)?).map(Outcome::Fault),
        _ => None,
    };
    let outcome =
        outcome.ok_or_else(|| StoreErrorKind::Damaged("an unknown verdict".to_owned()))?;
    Ok(MatchScore {
        outcome,
        steps: Steps {
            exploration: row.get(3)?,
            speed: row.get(4)?,
        },
        fuel: columns::read_fuel(row, 5)?,
        memory_bytes: columns::unsigned(row, 8)?,
    })
}
