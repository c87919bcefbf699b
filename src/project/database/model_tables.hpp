// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// Model files and what is in them. Everything of one kind in a file lies in blocks, columns of one
/// after the other: a row for each primitive would cost as much as the primitive.
inline constexpr const char* kModelTables = R"sql(
CREATE TABLE file (
  id INTEGER PRIMARY KEY,
  position INTEGER NOT NULL UNIQUE, -- files are read in this order
  path TEXT NOT NULL UNIQUE,        -- where it is read again from, absolute
  given TEXT NOT NULL,              -- the path that it was read by
  name TEXT NOT NULL,               -- its label where it is alone
  label TEXT NOT NULL UNIQUE,       -- what results call it: with folders, if names repeat
  format TEXT NOT NULL,             -- 'RVM 2', 'GLB' ...
  unit TEXT NOT NULL,
  up_axis TEXT NOT NULL,
  bytes INTEGER NOT NULL,
  precision_mm REAL NOT NULL,       -- half the spacing of its numbers
  folders TEXT NOT NULL,            -- that it lies in
  ends_early INTEGER NOT NULL,      -- 1: it was cut off
  option_unit_mm REAL,              -- what was said when it was read: its unit,
  option_up_axis TEXT,              -- 'x', 'y' or 'z',
  option_encoding TEXT,             -- the encoding of names
  content BLOB NOT NULL,            -- hash of it and of the files that are read with it
  objects INTEGER NOT NULL,
  bodies INTEGER NOT NULL,
  shapes INTEGER NOT NULL,
  groups INTEGER NOT NULL,
  group_attributes INTEGER NOT NULL, -- groups that state some
  blocks BLOB NOT NULL              -- hash of what is in all its blocks
) STRICT;

CREATE TABLE model_seal (           -- without it, a file that is missing would not be missed
  id INTEGER PRIMARY KEY CHECK (id = 1),
  files BLOB NOT NULL               -- hash of the rows of all files; zeros: there are none
) STRICT;
INSERT INTO model_seal VALUES (1, zeroblob(16));

CREATE TABLE file_block (           -- 32768 of one kind, the last block fewer
  id INTEGER PRIMARY KEY,
  file INTEGER NOT NULL REFERENCES file(id) ON DELETE CASCADE,
  kind TEXT NOT NULL,               -- 'objects', 'bodies', 'shapes', 'groups', 'group attributes'; 'diagnostics'
  number INTEGER NOT NULL,          -- from 0
  data BLOB NOT NULL,               -- columns, compressed by zstd
  UNIQUE (file, kind, number)
) STRICT;

CREATE TABLE shape_pack (           -- meshes and polylines, each once for all files
  id INTEGER PRIMARY KEY,
  shapes INTEGER NOT NULL,          -- that it holds
  hashes BLOB NOT NULL,             -- 16 bytes a shape; zeros where it is no longer in use
  data BLOB NOT NULL                -- and a hash over hashes
) STRICT;
)sql";

}  // namespace strake::project
