// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "strake/model/model.hpp"

namespace strake::report {

/// Returns what an object states under a name, itself or by the nearest group above that does;
/// several values of the name with "; " between. Nothing where none states it.
[[nodiscard]] std::optional<std::string> stated_text(const model::Model& model, model::ObjectId id,
                                                     std::string_view attribute);

}  // namespace strake::report
