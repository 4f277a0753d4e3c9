-- The first schema of a store. A change of it is a new migration, never an edit of this file.
--
-- Ids are local to a file; digests are what files share. A number that can exceed 2^63 - 1 (seeds,
-- fuel, memory, counts of the journal) is stored by its bits, so 2^64 - 1 is -1 here.

PRAGMA application_id = 0x774d6f75;

CREATE TABLE engine(
  id INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK(length(digest) = 32),
  name TEXT NOT NULL
) STRICT;

CREATE TABLE rules(
  id INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK(length(digest) = 32),
  json TEXT NOT NULL
) STRICT;

CREATE TABLE robot(
  id INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK(length(digest) = 32)
) STRICT;

-- `walls` is null for a maze that its name generates.
CREATE TABLE maze(
  id INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK(length(digest) = 32),
  name TEXT NOT NULL,
  dimension INTEGER NOT NULL,
  walls BLOB
) STRICT;

-- The steps of a robot that knows the maze depend on the rules.
CREATE TABLE oracle(
  maze INTEGER NOT NULL REFERENCES maze,
  rules INTEGER NOT NULL REFERENCES rules,
  oracle_exploration INTEGER,
  oracle_speed INTEGER,
  PRIMARY KEY(maze, rules),
  CHECK((oracle_exploration IS NULL) = (oracle_speed IS NULL))
) STRICT, WITHOUT ROWID;

-- Specifications of generated mazes, so that a finished contest is planned without generating.
CREATE TABLE generated(
  generator TEXT NOT NULL,
  name TEXT NOT NULL,
  maze INTEGER NOT NULL REFERENCES maze,
  PRIMARY KEY(generator, name)
) STRICT, WITHOUT ROWID;

-- The records. The columns that standings read come first, because SQLite decodes a row up to
-- the last column that is asked for. Score and divisor follow from the steps and the rules.
CREATE TABLE match(
  engine INTEGER NOT NULL REFERENCES engine,
  rules INTEGER NOT NULL REFERENCES rules,
  robot INTEGER NOT NULL REFERENCES robot,
  variant INTEGER NOT NULL,
  maze INTEGER NOT NULL REFERENCES maze,
  seed INTEGER NOT NULL,
  verdict INTEGER NOT NULL, -- 0 finished, 1 budget used up, 2 the same with the goal reached, 3 fault
  exploration_steps INTEGER NOT NULL,
  speed_steps INTEGER NOT NULL,
  fuel_start INTEGER NOT NULL,
  fuel_steps INTEGER NOT NULL,
  fuel_step_max INTEGER NOT NULL,
  memory_bytes INTEGER NOT NULL,
  fault_kind INTEGER, -- the index in FaultKind::ALL
  bumps INTEGER NOT NULL,
  clamps INTEGER NOT NULL,
  resets_before_goal INTEGER NOT NULL,
  resets_in_speed_run INTEGER NOT NULL,
  journal_entries INTEGER NOT NULL,
  journal_dropped INTEGER NOT NULL,
  transcript BLOB NOT NULL, -- a digest
  fault_phase INTEGER, -- the index in Phase::ALL
  fault_run INTEGER, -- 1 exploration, 2 speed
  fault_step INTEGER,
  fault_x INTEGER,
  fault_y INTEGER,
  fault_detail TEXT,
  PRIMARY KEY(engine, rules, robot, variant, maze, seed)
) STRICT, WITHOUT ROWID;

CREATE TRIGGER match_is_kept BEFORE DELETE ON match
BEGIN SELECT RAISE(ABORT, 'records of matches are never deleted'); END;
CREATE TRIGGER match_is_final BEFORE UPDATE ON match
BEGIN SELECT RAISE(ABORT, 'records of matches never change'); END;

-- Transcripts of some matches. `is_best` is 1 for one that a better match replaces.
CREATE TABLE transcript(
  engine INTEGER NOT NULL,
  rules INTEGER NOT NULL,
  robot INTEGER NOT NULL,
  variant INTEGER NOT NULL,
  maze INTEGER NOT NULL,
  seed INTEGER NOT NULL,
  is_best INTEGER NOT NULL CHECK(is_best IN (0, 1)),
  bytes BLOB NOT NULL,
  PRIMARY KEY(engine, rules, robot, variant, maze, seed),
  FOREIGN KEY(engine, rules, robot, variant, maze, seed) REFERENCES match
) STRICT, WITHOUT ROWID;

-- Matches that were not played: 0 the host failed, 1 the robot was withdrawn.
CREATE TABLE unplayed(
  engine INTEGER NOT NULL REFERENCES engine,
  rules INTEGER NOT NULL REFERENCES rules,
  robot INTEGER NOT NULL REFERENCES robot,
  variant INTEGER NOT NULL,
  maze INTEGER NOT NULL REFERENCES maze,
  seed INTEGER NOT NULL,
  cause INTEGER NOT NULL CHECK(cause IN (0, 1)),
  reason TEXT NOT NULL,
  PRIMARY KEY(engine, rules, robot, variant, maze, seed)
) STRICT, WITHOUT ROWID;

-- Other records for an address that has one. Nobody but a bug or a changed file makes these.
CREATE TABLE conflict(
  id INTEGER PRIMARY KEY,
  record TEXT NOT NULL UNIQUE
) STRICT;

CREATE TRIGGER conflict_is_kept BEFORE DELETE ON conflict
BEGIN SELECT RAISE(ABORT, 'conflicts are never deleted'); END;
CREATE TRIGGER conflict_is_final BEFORE UPDATE ON conflict
BEGIN SELECT RAISE(ABORT, 'conflicts never change'); END;

-- What was submitted, in order. The last one of a name counts, the others are its history.
CREATE TABLE submission(
  ordinal INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  author TEXT,
  class TEXT,
  robot INTEGER NOT NULL REFERENCES robot,
  variant INTEGER NOT NULL,
  rejection_kind TEXT,
  rejection_reason TEXT,
  rejection_hint TEXT
) STRICT;

CREATE TRIGGER submission_is_kept BEFORE DELETE ON submission
BEGIN SELECT RAISE(ABORT, 'submissions are never deleted'); END;
CREATE TRIGGER submission_is_final BEFORE UPDATE ON submission
BEGIN SELECT RAISE(ABORT, 'submissions never change'); END;

-- The content digest when a run ended. Whoever writes removes it.
CREATE TABLE seal(
  id INTEGER PRIMARY KEY CHECK(id = 1),
  content BLOB NOT NULL CHECK(length(content) = 32)
) STRICT;
