// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake::project {

/// Stored views: what a person requested, and what was last solved for it.
inline constexpr std::string_view kViewTables = R"(
CREATE TABLE view (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  settings TEXT NOT NULL,      -- the options as written, a JSON object
  created TEXT NOT NULL,       -- UTC, as 2026-01-31T08:00:00Z
  changed TEXT NOT NULL        -- when the settings were last written
) STRICT;
CREATE TABLE drawing (
  view INTEGER PRIMARY KEY REFERENCES view (id) ON DELETE CASCADE,
  program TEXT NOT NULL,       -- version of the program that solved it
  drawn TEXT NOT NULL,         -- when it was solved, UTC
  objects INTEGER NOT NULL,    -- of the model then
  pieces INTEGER NOT NULL,     -- of lines, in all states
  edges_solved INTEGER NOT NULL,  -- anew, the last time
  edges INTEGER NOT NULL,
  seconds REAL NOT NULL,       -- that hidden lines took the last time
  lines BLOB NOT NULL,         -- the drawing, compressed
  made_from BLOB NOT NULL      -- signatures and boxes of the objects, compressed
) STRICT;
)";

}  // namespace strake::project
