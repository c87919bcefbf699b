// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// What earlier runs said, where the tables of results no longer do: so that any two runs can be
/// compared. Version 2 brought them; of runs before it there are no rows.
///
/// Of a clash that every run sees alike there is no row in `former`: its row in `clash` is what all
/// of them say.
inline constexpr const char* kHistoryTables = R"sql(
CREATE TABLE run_report (           -- how a run was asked and grouped
  run INTEGER PRIMARY KEY REFERENCES run(id),
  rules_file TEXT, rules_hash BLOB, rules_profile TEXT,  -- NULL: there were no rules
  group_by TEXT NOT NULL,           -- empty: its results were not grouped
  group_distance TEXT NOT NULL, group_contacts INTEGER NOT NULL,
  classes TEXT NOT NULL, sort TEXT NOT NULL,
  last_event INTEGER NOT NULL       -- the last event of its end: what is above came later
) STRICT;

CREATE TABLE run_result (           -- what a run found in a test, besides the counts of run_test
  run INTEGER NOT NULL REFERENCES run(id),
  test INTEGER NOT NULL REFERENCES test(id),
  settings TEXT NOT NULL,           -- for people
  hash TEXT NOT NULL,               -- of the results
  PRIMARY KEY (run, test)
) STRICT;

CREATE TABLE former (               -- what runs before `run` said of a clash, back to the row before
  clash INTEGER NOT NULL REFERENCES clash(id),
  run INTEGER NOT NULL REFERENCES run(id),
  sight TEXT NOT NULL CHECK (sight IN ('found', 'gone', 'cannot tell')),
  class TEXT NOT NULL CHECK (class IN ('HIT', 'CONTACT', 'CLEARANCE_VIOLATION')),
  d_mm REAL NOT NULL, regions INTEGER NOT NULL,
  why TEXT,                         -- why they could not tell
  PRIMARY KEY (clash, run)
) STRICT, WITHOUT ROWID;

CREATE TABLE unseen (               -- a clash that the last run lists no result of, and that is not gone
  clash INTEGER PRIMARY KEY REFERENCES clash(id),
  a_open INTEGER, b_open INTEGER    -- parts of the two without an inside when it was seen last; NULL: not known
) STRICT;

CREATE TABLE test_objects (         -- the objects of the model when the test ran last
  test INTEGER PRIMARY KEY REFERENCES test(id),
  names BLOB NOT NULL
) STRICT;

CREATE TABLE drawing_objects (      -- the objects of the model when the drawing was solved
  view INTEGER PRIMARY KEY REFERENCES view(id) ON DELETE CASCADE,
  names BLOB NOT NULL,
  far BLOB NOT NULL                 -- those that it leaves out because they lie far from all others
) STRICT;
)sql";

}  // namespace strake::project
