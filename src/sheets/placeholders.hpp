// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/function_ref.hpp"

namespace strake::sheets {

/// A text, and the name of what follows it; the last piece of a text names nothing.
struct Piece {
  std::string text, name;
};

/// "scale {{scale}}" in pieces. Errors: usage, where a {{ is not closed or names nothing.
[[nodiscard]] Result<std::vector<Piece>> split_placeholders(std::string_view text);

/// What a name stands for.
using Lookup = parallel::FunctionRef<std::string(const std::string& name)>;

[[nodiscard]] std::string filled(const std::vector<Piece>& pieces, Lookup lookup);

}  // namespace strake::sheets
