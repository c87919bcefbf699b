// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "project/database/database.hpp"
#include "project/results/clash_rows.hpp"
#include "strake/core/result.hpp"

/// What the row of a clash does not say: what runs said of it before, and what is known of one that
/// the last run lists no result of.
namespace strake::project {

/// How many parts of the two objects of a clash had no inside when it was seen last; nothing: it is
/// not known.
struct OpenParts {
  std::optional<std::int64_t> a, b;
  friend bool operator==(const OpenParts&, const OpenParts&) = default;
};

/// The tables `former` and `unseen`, with statements that are prepared once.
class ClashHistory {
 public:
  [[nodiscard]] static Result<ClashHistory> of(Database& database);

  /// Keeps what runs before `run` said of a clash, as its row has it.
  [[nodiscard]] Status add_former(const ClashRow& before, std::int64_t run);
  /// Returns nothing where the last run lists a result of the clash, or the clash is gone.
  [[nodiscard]] Result<std::optional<OpenParts>> unseen(std::int64_t clash);
  [[nodiscard]] Status set_unseen(std::int64_t clash, const OpenParts& parts);
  [[nodiscard]] Status remove_unseen(std::int64_t clash);

 private:
  ClashHistory(Statement former, Statement find, Statement put, Statement remove);
  Statement former_, find_, put_, remove_;
};

}  // namespace strake::project
