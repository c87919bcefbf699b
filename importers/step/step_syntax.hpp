// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::import_step {

/// What the references of a STEP file lack.
struct StepReferences {
  static constexpr std::size_t kMaxListed = 20;

  std::size_t missing = 0;          ///< how many name an entity that is not there
  std::vector<std::string> listed;  ///< the first of them: "#12 in line 40 refers to #99"
};

/// Checks the syntax of a STEP file (ISO 10303-21): Open CASCADE crashes on some faults, and says
/// nothing of entities that are not there. Errors: input, with the line.
[[nodiscard]] Result<StepReferences> check_step_syntax(std::string_view text,
                                                       const std::filesystem::path& file);

}  // namespace strake::import_step
