// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// Tests, runs, clashes and what became of them. docs/statuses.md says what the statuses mean.
///
/// `clash.decision` is NULL while nobody has decided: such a clash is new in the run `new_run` and
/// active from the next one on, so that a night on which nothing changes writes no rows. The view
/// `clashes` shows it as people see it.
///
/// A row that comes by the thousand spells its words out: for a list of more than two after IN,
/// SQLite makes a table of its own each time it inserts a row.
///
/// Keys come in no order: many rows at once are faster without their index, which is made again
/// after them. So the index has a name, and the table no UNIQUE, which it had before version 5.
inline constexpr const char* kResultTables = R"sql(
CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  started TEXT NOT NULL,            -- UTC, 2026-01-31T23:59:59Z
  program TEXT NOT NULL,            -- its version
  who TEXT NOT NULL,
  seconds REAL NOT NULL
) STRICT;

CREATE TABLE test (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,        -- empty: the test of the command line
  settings TEXT NOT NULL,           -- for people
  run INTEGER NOT NULL REFERENCES run(id),  -- the last one
  objects INTEGER NOT NULL          -- of the model then
) STRICT;

CREATE TABLE report (               -- the last result of a test; apart, as a row is written whole
  test INTEGER PRIMARY KEY REFERENCES test(id),
  snapshot BLOB NOT NULL,           -- what it was computed from
  head BLOB NOT NULL,               -- all of it but pairs and regions
  kept BLOB NOT NULL,               -- what the next run needs besides (clash::KeptForChanges)
  seal BLOB NOT NULL                -- a hash over head, kept and all of report_part
) STRICT;

CREATE TABLE report_part (          -- pairs and regions of a range of objects
  test INTEGER NOT NULL REFERENCES test(id),
  part INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (test, part)
) STRICT;

CREATE TABLE run_test (             -- what a run did and found, for the trend
  run INTEGER NOT NULL REFERENCES run(id),
  test INTEGER NOT NULL REFERENCES test(id),
  how TEXT NOT NULL CHECK (how IN ('full', 'changes', 'nothing')),
  objects INTEGER NOT NULL, changed_objects INTEGER NOT NULL,
  tested_pairs INTEGER NOT NULL, kept_results INTEGER NOT NULL,
  hit INTEGER NOT NULL, contact INTEGER NOT NULL, clearance_violation INTEGER NOT NULL,
  allowed INTEGER NOT NULL,
  appeared INTEGER NOT NULL, gone INTEGER NOT NULL,
  new INTEGER NOT NULL, active INTEGER NOT NULL, reviewed INTEGER NOT NULL,
  approved INTEGER NOT NULL, resolved INTEGER NOT NULL, cannot_tell INTEGER NOT NULL,
  PRIMARY KEY (run, test)
) STRICT;

CREATE TABLE clash (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL,
  test INTEGER NOT NULL REFERENCES test(id),
  a_file TEXT NOT NULL, a_id TEXT NOT NULL, a_name TEXT NOT NULL,
  b_file TEXT NOT NULL, b_id TEXT NOT NULL, b_name TEXT NOT NULL,
  class TEXT NOT NULL CHECK
    (class = 'CONTACT' OR class = 'HIT' OR class = 'CLEARANCE_VIOLATION'),
  relation TEXT NOT NULL CHECK
    (relation = 'ABUT_OUTSIDE' OR relation = 'INTERFERE' OR relation = 'SEPARATE' OR
     relation = 'ABUT_INSIDE' OR relation = 'CROSS' OR relation = 'A_IN_B' OR
     relation = 'B_IN_A' OR relation = 'DUPLICATE'),
  d_mm REAL NOT NULL, x_mm REAL NOT NULL, y_mm REAL NOT NULL, z_mm REAL NOT NULL,
  regions INTEGER NOT NULL,
  first_run INTEGER NOT NULL REFERENCES run(id),
  new_run INTEGER NOT NULL REFERENCES run(id),  -- in which it was new last
  gone_run INTEGER REFERENCES run(id),          -- the first that did not find it any more
  unknown TEXT,                     -- why the last run cannot tell whether it is there
  decision TEXT CHECK (decision = 'active' OR decision = 'reviewed' OR
    decision = 'approved' OR decision = 'resolved'),
  decided_by TEXT, decided_at TEXT, comment TEXT, assignee TEXT,
  decided_class TEXT CHECK (decided_class = 'CONTACT' OR decided_class = 'HIT' OR
    decided_class = 'CLEARANCE_VIOLATION'),
  decided_d_mm REAL, decided_regions INTEGER  -- with its class: what was decided about
) STRICT;
CREATE UNIQUE INDEX clash_key ON clash (key);
CREATE INDEX clash_decided ON clash (test, decision) WHERE decision IS NOT NULL;
CREATE INDEX clash_watched ON clash (test) WHERE gone_run IS NULL AND
  (decision IS NOT NULL OR unknown IS NOT NULL OR comment IS NOT NULL OR assignee IS NOT NULL);
CREATE INDEX clash_gone ON clash (test, gone_run) WHERE gone_run IS NOT NULL;

CREATE TABLE event (                -- changes of status
  id INTEGER PRIMARY KEY,
  clash INTEGER NOT NULL REFERENCES clash(id),
  run INTEGER REFERENCES run(id),   -- NULL: a person did it between runs
  at TEXT NOT NULL,
  who TEXT NOT NULL,                -- 'strake' where the program did it
  before TEXT NOT NULL CHECK (before = 'new' OR before = 'active' OR before = 'reviewed' OR
    before = 'approved' OR before = 'resolved'),
  after TEXT NOT NULL CHECK (after = 'new' OR after = 'active' OR after = 'reviewed' OR
    after = 'approved' OR after = 'resolved'),
  comment TEXT NOT NULL
) STRICT;
CREATE INDEX event_of_clash ON event (clash);

CREATE VIEW clashes AS SELECT clash.*, test.name AS test_name,
  CASE WHEN decision IS NOT NULL THEN decision
       WHEN new_run = test.run THEN 'new' ELSE 'active' END AS status,
  CASE WHEN gone_run IS NOT NULL OR unknown IS NOT NULL THEN NULL ELSE test.run END AS last_run
  FROM clash JOIN test ON test.id = clash.test;
)sql";

/// Statements that take the index of keys away and make it again, and those that turn the UNIQUE of
/// earlier versions into it in the table of tables: it is the same tree.
inline constexpr const char* kDropKeyIndex = "DROP INDEX clash_key";
inline constexpr const char* kMakeKeyIndex = "CREATE UNIQUE INDEX clash_key ON clash (key)";
inline constexpr const char* kNameKeyIndex = R"sql(
UPDATE sqlite_schema SET sql = replace(sql, 'key TEXT NOT NULL UNIQUE,', 'key TEXT NOT NULL,')
  WHERE type = 'table' AND name = 'clash';
UPDATE sqlite_schema SET name = 'clash_key', sql = 'CREATE UNIQUE INDEX clash_key ON clash (key)'
  WHERE type = 'index' AND name = 'sqlite_autoindex_clash_1';
)sql";

}  // namespace strake::project
