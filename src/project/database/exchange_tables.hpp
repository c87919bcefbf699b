// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

// Decision 0105 says why this is a table of its own.

/// What people said, where the event of it does not show that alone: an event tells in one text
/// what was said and what was set, and knows nothing of other programs. Version 3 brought it; of
/// comments before it there are no rows, nor of those that are all that an event tells.
inline constexpr const char* kExchangeTables = R"sql(
CREATE TABLE said (
  event INTEGER PRIMARY KEY REFERENCES event(id),
  text TEXT NOT NULL,               -- what was said; empty: nothing
  guid TEXT, topic TEXT,            -- of the comment in BCF and of its topic; NULL: no other program names it
  first_at TEXT, first_by TEXT      -- when it was said, and by whom, before it was edited; NULL: it was not
) STRICT;
)sql";

}  // namespace strake::project
