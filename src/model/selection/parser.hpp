// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "model/selection/query.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/function_ref.hpp"

namespace strake::model::selection {

/// What set(NAME) stands for; an error's place is for the caller to say.
using SetLookup =
    parallel::FunctionRef<Result<std::shared_ptr<const Query>>(std::string_view name)>;

/// Recursive descent over
///
///     either := both ("or" both)*
///     both   := one ("and" one)*
///     one    := "not" one | "(" either ")" | "inside" box | "touches" box
///             | "set" "(" name ")" | property [operator value] | pattern
///     box    := "(" xmin "," ymin "," zmin "," xmax "," ymax "," zmax ")"
[[nodiscard]] Result<Query> parse_query(std::string_view text, SetLookup lookup);

}  // namespace strake::model::selection
