// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "meshed_piece.hpp"
#include "strake/core/result.hpp"

namespace strake::import_step {

/// What an importer is called with.
struct Arguments {
  std::filesystem::path input, output, report;
  unsigned threads = 1;
  std::optional<double> sag_mm;
};

/// Errors: usage, where a word is not known or makes no sense.
[[nodiscard]] Result<Arguments> parse_arguments(std::span<char*> words);

}  // namespace strake::import_step
