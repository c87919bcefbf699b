// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// How the model came to be what it is: what was added, read again and removed, and what changed.
/// Words of many rows are spelled out as those of results are.
inline constexpr const char* kRevisionTables = R"sql(
CREATE TABLE revision (
  id INTEGER PRIMARY KEY,
  at TEXT NOT NULL,                 -- UTC, 2026-01-31T23:59:59Z
  what TEXT NOT NULL CHECK (what IN ('add', 'update', 'remove')),
  added INTEGER NOT NULL, removed INTEGER NOT NULL, moved INTEGER NOT NULL,
  reshaped INTEGER NOT NULL, reattributed INTEGER NOT NULL, renamed INTEGER NOT NULL,
  unchanged INTEGER NOT NULL        -- objects; one that changed may be counted for several kinds
) STRICT;

CREATE TABLE changed_file (
  id INTEGER PRIMARY KEY,
  revision INTEGER NOT NULL REFERENCES revision(id),
  what TEXT NOT NULL CHECK (what IN ('added', 'removed', 'read', 'renamed')),
  file TEXT NOT NULL,               -- its label now; of a removed one the one that it had
  before TEXT                       -- the label that it had, where it was renamed
) STRICT;
CREATE INDEX changed_file_of_revision ON changed_file (revision);

CREATE TABLE changed_object (       -- none for objects of files that were added or removed whole
  id INTEGER PRIMARY KEY,
  revision INTEGER NOT NULL REFERENCES revision(id),
  kind TEXT NOT NULL CHECK
    (kind = 'moved' OR kind = 'reshaped' OR kind = 'added' OR kind = 'removed' OR
     kind = 'reattributed' OR kind = 'renamed'),
  file TEXT NOT NULL, object TEXT NOT NULL, name TEXT NOT NULL,
  before_file TEXT, before_object TEXT  -- where they were others
) STRICT;
CREATE INDEX changed_object_of_revision ON changed_object (revision, kind);
)sql";

}  // namespace strake::project
