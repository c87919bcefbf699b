// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// Where files lie on a map, and drawings in parts. Version 5 brought both: of a file that an
/// earlier version read nothing is known until it is read again, and a drawing that it stored is
/// in `drawing` alone until it is stored again.
inline constexpr const char* kMapAndDrawingTables = R"sql(
CREATE TABLE map_place (            -- a file that says where on a map it lies
  file INTEGER PRIMARY KEY REFERENCES file(id) ON DELETE CASCADE,
  crs TEXT NOT NULL,                -- the coordinate system of the map, as 'EPSG:25832'
  to_map BLOB NOT NULL              -- the 16 numbers of a matrix, millimetres to millimetres
) STRICT;

CREATE TABLE drawing_part (         -- 256 objects of a drawing
  view INTEGER NOT NULL REFERENCES view(id) ON DELETE CASCADE,
  part INTEGER NOT NULL,
  lines BLOB NOT NULL,
  made_from BLOB NOT NULL,          -- identities, signatures and boxes
  PRIMARY KEY (view, part)
) STRICT;
)sql";

}  // namespace strake::project
