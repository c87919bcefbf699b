// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "model/selection/query.hpp"
#include "strake/core/result.hpp"

namespace strake::model::selection {

/// Recursive descent over
///
///     either := both ("or" both)*
///     both   := one ("and" one)*
///     one    := "not" one | "(" either ")" | "inside" box | "touches" box
///             | property [operator value] | pattern
///     box    := "(" xmin "," ymin "," zmin "," xmax "," ymax "," zmax ")"
[[nodiscard]] Result<Query> parse_query(std::string_view text);

}  // namespace strake::model::selection
