// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/run/project_input.hpp"
#include "cli/run/session.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// A BCF that comes back.
struct BcfReview {
  std::string file, by;         ///< who decided where the file does not say
  bool prefers_review = false;  ///< what changed on both sides is as the file has it
};

/// Takes statuses, assignees and comments of a BCF into a project, in one transaction, and says
/// what became of them. Errors: those of bcf::read_bcf() and project::take_review().
[[nodiscard]] Status take_bcf(Session& session, OpenedProject& opened, const BcfReview& review);

}  // namespace strake::cli
