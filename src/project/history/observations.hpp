// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "project/database/database.hpp"
#include "project/results/clash_rows.hpp"
#include "strake/core/result.hpp"

/// What runs said of clashes, out of their rows of today and those of before.
namespace strake::project {

/// What a run said of a clash.
struct ObservationAt {
  enum class Kind : std::uint8_t {
    not_known,  ///< a later run found it first
    found,
    gone,
    cannot_tell,
  };
  Kind kind = Kind::not_known;
  Measure now;      ///< where it was found
  std::string why;  ///< why it cannot tell, or does not know
};

using ObservationPair = std::pair<ObservationAt, ObservationAt>;

class Observations {
 public:
  [[nodiscard]] static Result<Observations> of(Database& database);

  using Take = std::function<Status(const ClashRow&, const ObservationPair&)>;
  /// Tells of each clash of a test what two runs said, in the order in which they were found.
  /// Errors: those of `take`; input for a damaged project.
  [[nodiscard]] Status each(std::int64_t test, const std::pair<std::int64_t, std::int64_t>& runs,
                            const Take& take);

  /// Returns "allowed by rule 'X'" where that is why a clash was gone in a run; else nothing.
  [[nodiscard]] Result<std::string> allowed_by(std::int64_t clash, std::int64_t run);

 private:
  Observations(Database& database, Statement allowed);
  Database* database_;
  Statement allowed_;
};

}  // namespace strake::project
